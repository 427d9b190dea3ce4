// l over a box, from below, against l at points by textbook formulas.
#include "checker/quadrature/lock_left.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::Matrix;
using lock_test::Vector;

namespace {

const LockMeanSquare kForm{
    {Ball(2.5), Ball(3.0), Ball(-2.0), Ball(7.0)}, Ball(1.25), Ball(0.001), Ball(30.0), Ball(0.0016)};

double at_point(const LockCorners& corners, const std::array<double, 4>& share) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kLockCorners; ++k) {
    double weight = 1.0;
    for (std::size_t i = 0; i < 4; ++i) {
      weight *= ((k >> i) & 1U) != 0U ? share[i] : 1.0 - share[i];
    }
    sum += weight * corners[k].near();
  }
  return sum;
}

struct PointOfBox {
  Vector u;
  double s, twice;
};
PointOfBox point_at(const LockSet& set, const std::array<double, 4>& low, double width,
                    const std::array<double, 4>& share) {
  PointOfBox point;
  for (int i = 0; i < 3; ++i) {
    point.u[i] = low[static_cast<std::size_t>(i)] + share[static_cast<std::size_t>(i)] * width;
  }
  point.s = low[3] + share[3] * width;
  point.twice = point.u.squaredNorm() + set.weight.near() * point.s * point.s;
  return point;
}

}  // namespace

TEST_CASE("l is nowhere below what its corners say, and near it in small boxes") {
  test::Random random(5410);
  for (const LockSet& set : {lock_test::WrittenSet().set(), lock_test::leaking_set()}) {
    const lock_test::Textbook book{{}, set};
    const LockLeft drift = left_of_drift(set);
    LockMeanSquare form = kForm;
    if (certainly_positive(set.highest_frequency)) {  // with a leak
      form.offset = {Ball(0.01), Ball(-0.03), Ball(0.02)};
    }
    const Vector offset(form.offset[0].near(), form.offset[1].near(), form.offset[2].near());
    const LockLeft mean_square = left_of_mean_square(set, form);
    Matrix r = Matrix::Zero();
    r << kForm.metric.amplitude.near(), 0.0, 0.0, 0.0, kForm.metric.phase.near(),
        kForm.metric.coupling.near(), 0.0, 0.0, kForm.metric.frequency.near();
    const Matrix relative = r * book.metric().inverse();
    const double room = lock_room().near();
    for (int k = 0; k < 300; ++k) {
      const double width = k % 2 == 0 ? 0.4 : 1e-4;
      std::array<double, 4> low = lock_test::somewhere(set, random);
      std::array<double, 4> high = low;
      for (double& end : high) {
        end += width;
      }
      const LockBox box(low, high);
      LockCorners levels;
      const double level = random.uniform(0.0, 3.0);
      levels.fill(Ball(level));
      const std::array<double, 4> share{random.uniform(), random.uniform(), random.uniform(),
                                        random.uniform()};
      const PointOfBox x = point_at(set, low, width, share);
      const double next = level + room;
      const double weight = set.weight.near();
      const double l = x.twice - weight * next * next +
                       2.0 * std::log(set.decay.near() + set.drift.near() * std::exp(-0.5 * x.twice)) -
                       2.0 * room;
      const double found = at_point(drift.at_corners(box, levels), share);
      CHECK(found <= l + 1e-9);
      const Vector e = book.metric().inverse() * x.u;
      const double nu = e[2] + set.bias[2].near();
      const double g = kForm.weight.near();
      const double w = std::exp(0.5 * x.twice);
      const double m = (r * (e - offset)).squaredNorm() + g * (x.s * x.s - next * next) +
                       kForm.share.near() * ((1.0 - set.decay.near()) * w - set.drift.near()) +
                       kForm.rate.near() * (kForm.bound.near() - nu * nu) -
                       (room + room * room) * relative.squaredNorm();
      const double found_square = at_point(mean_square.at_corners(box, levels), share);
      CHECK(found_square <= m + 1e-9 * (1.0 + std::fabs(m)));
      if (width < 1e-3) {
        CHECK(found == doctest::Approx(l).epsilon(1e-4));
        CHECK(found_square == doctest::Approx(m).epsilon(1e-3));
        CHECK(mean_square.near_middle(box, level) == doctest::Approx(m).epsilon(5e-3));
      }
    }
    CHECK(relative_norm_squared(form, set).near() == doctest::Approx(relative.squaredNorm()));
    CHECK(offset_length(form).near() == doctest::Approx((r * offset).norm()));
  }
}
