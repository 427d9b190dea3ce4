#include "analysis/quadrature/gaussian/mean_square_inequality.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/quadrature/gaussian/mean_square_search.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/analysis/quadrature/gaussian/textbook_filter.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using namespace test_sets;

/// A set, and a form for it with a little more than what sampled points need.
struct Example {
  TextbookFilter filter;
  LockMeanSquare form;
};
Example example(std::size_t design, double walk, double more, double level = 12.0) {
  const bool leaks = design == 2;
  Example result{{leaks ? kLeakingDesign : kDesigns[design], leaks ? leaking_set() : lock_set(design, 21.0)},
                 {}};
  result.filter.set.level = std::min(result.filter.set.level, level);
  result.filter.set.frequency_walk = walk;
  const rigor::UpwardRounding upward;
  // With a leak as it was proposed once, which takes some seconds.
  result.form = leaks
                    ? LockMeanSquare{{2.4465, 2.0639, -1.429, 4.7181}, 0.40485, 5.6875e-5, 5.8811, 0.0049671,
                                     {-0.0018595, -0.033475, 0.043704}}
                    : propose_mean_square(result.filter.design, result.filter.set).value();
  result.form.bound *= more;
  return result;
}

double squared_length(const BlockMetric<double>& r, const Eigen::Vector3d& e) {
  Eigen::Matrix3d matrix;
  matrix << r.amplitude, 0.0, 0.0, 0.0, r.phase, r.coupling, 0.0, 0.0, r.frequency;
  return (matrix * e).squaredNorm();
}

/// E U+ - U - h (c - nu^2) by the mean and the covariance of the textbook filter's next error, over h c.
double excess(const Example& example, const Eigen::Vector3d& away, const Matrix& p, double frequency) {
  const LockSet& set = example.filter.set;
  const LockMeanSquare& form = example.form;
  const auto next = example.filter.step(away, p, frequency);
  const Eigen::Vector3d offset(form.offset[0], form.offset[1], form.offset[2]);
  double after = squared_length(form.metric, next.mean - offset);
  const Eigen::Vector3d values = oracle::symmetric_eigenvalues(next.sigma);
  const Matrix directions = oracle::symmetric_eigenvectors(next.sigma);
  for (int i = 0; i < 3; ++i) {
    after += values[i] * squared_length(form.metric, directions.col(i));
  }
  const double now = example.filter.level_of(p);
  const double w = std::exp(0.5 * away.dot(example.filter.weight() * away) + 0.5 * set.weight * now * now);
  const double nu = away[2] + set.bias[2];
  return (after + form.weight * next.level * next.level + form.share * (set.decay * w + set.drift) -
          squared_length(form.metric, away - offset) - form.weight * now * now - form.share * w -
          form.rate * (form.bound - nu * nu)) /
         (form.rate * form.bound);
}

}  // namespace

TEST_CASE("where a cell is proved, the textbook filter's next error keeps the inequality") {
  test::Random random(4420);
  for (std::size_t design = 0; design < 3; ++design) {
    // With a leak the frequency is constant.
    for (const double walk : design == 2 ? std::vector{0.0} : std::vector{0.0, 0.002}) {
      const Example found = example(design, walk, 1.3);
      const LockSet& set = found.filter.set;
      int proved = 0;
      double closest = -1e9;
      for (int k = 0; k < 60; ++k) {
        const Place place = somewhere(set, 0.06, random);
        CellDrift drift;
        {
          const rigor::UpwardRounding upward;
          drift = MeanSquareInequality(enclosed(found.filter.design), set, found.form).check(place.cell);
        }
        proved += drift.holds ? 1 : 0;
        for (int l = 0; drift.holds && l < 20; ++l) {
          std::array<double, 4> x{};
          for (std::size_t i = 0; i < 4; ++i) {
            x[i] = random.uniform(place.cell.low[i], place.cell.high[i]);
          }
          const std::array<double, 3> e = errors_of(set.metric, std::array<double, 3>{x[0], x[1], x[2]});
          const Matrix p = covariance_of_level(set, x[3], random);
          const double level = 0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + set.weight * x[3] * x[3]);
          if (level > set.level || found.filter.level_of(p) < place.cell.low[3]) {
            continue;  // nothing is said of it
          }
          const double more = excess(found, {e[0], e[1], e[2]}, p,
                                     random.uniform(set.lowest_frequency, set.highest_frequency));
          CHECK(more <= 0.0);
          closest = std::max(closest, more);
        }
      }
      MESSAGE("design " << design << ", walk " << walk << ": " << proved << " of 60 cells proved, closest "
                        << closest);
      CHECK(proved > 20);
    }
  }
}

TEST_CASE("a cell with a point where the form grows too fast is not proved") {
  test::Random random(4421);
  const Example found = example(1, 0.0, 0.3, 1.0);
  const LockSet& set = found.filter.set;
  int looked = 0;
  const rigor::UpwardRounding upward;
  const MeanSquareInequality inequality(enclosed(found.filter.design), set, found.form);
  for (int k = 0; k < 300; ++k) {
    const Place place = somewhere(set, 1e-3, random);
    const std::array<double, 3> e =
        errors_of(set.metric, std::array<double, 3>{place.x[0], place.x[1], place.x[2]});
    const Matrix p = covariance_of_level(set, place.x[3], random);
    const double level = found.filter.level_of(p);
    if (level < place.cell.low[3] || level > place.cell.high[3] || is_outside(set, place.cell)) {
      continue;
    }
    if (!(excess(found, {e[0], e[1], e[2]}, p, 0.0) <= 1e-3)) {
      ++looked;
      CHECK_FALSE(inequality.check(place.cell).holds);
    }
  }
  CHECK(looked > 20);
}

TEST_CASE("what a point needs is what the textbook filter needs there, or a little more") {
  test::Random random(4422);
  for (const std::size_t design : {std::size_t{0}, std::size_t{2}}) {
    const Example found = example(design, 0.0, 1.0);
    const LockSet& set = found.filter.set;
    const rigor::UpwardRounding upward;
    const MeanSquareInequality inequality(enclosed(found.filter.design), set, found.form);
    for (int k = 0; k < 100; ++k) {
      const Place place = somewhere(set, 0.0, random);
      const std::array<double, 3> e =
          errors_of(set.metric, std::array<double, 3>{place.x[0], place.x[1], place.x[2]});
      for (int l = 0; l < 20; ++l) {
        const Matrix p = covariance_of_level(set, place.x[3], random);
        if (found.filter.level_of(p) > 0.999 * place.x[3]) {
          const double frequency = random.uniform(set.lowest_frequency, set.highest_frequency);
          const double needed = found.form.bound * (1.0 + excess(found, {e[0], e[1], e[2]}, p, frequency));
          CHECK(needed <= inequality.needed_at(place.x) + 1e-6 * found.form.bound);
        }
      }
    }
  }
}

}  // namespace veritrack::quadrature
