#include "checker/model/gain/detector_loop.hpp"

#include <arb_mat.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "checker/model/gain/stability.hpp"

namespace veritrack::checker {

namespace {

const Ball kRoundingOfRows(0x1p-30);

/// r t, and the sum of the sizes of its terms.
struct TurnsOfForm {
  Ball sum, size;
};
TurnsOfForm turns_of(const std::vector<Ball>& row, const std::vector<long>& turns) {
  TurnsOfForm result;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Ball term = row[i] * Ball(static_cast<double>(turns[i]));
    result.sum += term;
    result.size += abs(term);
  }
  return result;
}

bool same_row(const std::vector<Ball>& x, const std::vector<Ball>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!certainly_at_most(abs(x[i] - y[i]), kRoundingOfRows * (abs(x[i]) + abs(y[i])))) {
      return false;
    }
  }
  return true;
}

/// A - (f - 1) b c.
BallRows with_gain(const DetectorLoop& loop, const Ball& factor) {
  BallRows matrix = loop.matrix;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) {
      matrix[i][j] -= (factor - one) * loop.effect[i] * loop.compared[j];
    }
  }
  return matrix;
}

/// The symmetric X = A X A' + b b', as a linear system in the entries of its lower triangle. Empty where it
/// may not have one solution only.
BallRows covariance_of(const BallRows& a, const std::vector<Ball>& b) {
  const std::size_t n = a.size();
  const auto place = [](std::size_t i, std::size_t j) {
    const std::size_t low = std::min(i, j);
    const std::size_t high = std::max(i, j);
    return static_cast<slong>(high * (high + 1) / 2 + low);
  };
  const slong unknowns = place(n - 1, n - 1) + 1;
  arb_mat_t system, right, solution;
  arb_mat_init(system, unknowns, unknowns);
  arb_mat_init(right, unknowns, 1);
  arb_mat_init(solution, unknowns, 1);
  spend(10 * unknowns * unknowns * unknowns);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const slong row = place(i, j);
      arb_set(arb_mat_entry(right, row, 0), (b[i] * b[j]).raw());
      arb_one(arb_mat_entry(system, row, row));
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t l = 0; l < n; ++l) {
          arb_ptr entry = arb_mat_entry(system, row, place(k, l));
          arb_submul(entry, a[i][k].raw(), a[j][l].raw(), precision());
        }
      }
    }
  }
  BallRows x;
  if (arb_mat_solve_precond(solution, system, right, precision()) != 0) {
    x.assign(n, std::vector<Ball>(n));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        arb_set(x[i][j].raw(), arb_mat_entry(solution, place(i, j), 0));
      }
    }
  }
  arb_mat_clear(system);
  arb_mat_clear(right);
  arb_mat_clear(solution);
  return x;
}

/// The loop with its states in units in which the diagonal of this is about 1: powers of two, nothing is
/// rounded.
DetectorLoop in_units_of(const BallRows& covariance, const DetectorLoop& loop) {
  std::vector<Ball> unit;
  unit.reserve(loop.matrix.size());
  for (std::size_t i = 0; i < loop.matrix.size(); ++i) {
    const double size = std::sqrt(std::fabs(covariance[i][i].near()));
    unit.emplace_back(std::isnormal(size) ? std::exp2(std::round(std::log2(size))) : 1.0);
  }
  DetectorLoop scaled = loop;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    scaled.effect[i] = loop.effect[i] / unit[i];
    scaled.compared[i] = loop.compared[i] * unit[i];
    for (std::size_t j = 0; j < unit.size(); ++j) {
      scaled.matrix[i][j] = loop.matrix[i][j] * unit[j] / unit[i];
    }
  }
  return scaled;
}

BallRows middle_of_rows(BallRows rows) {
  for (std::vector<Ball>& row : rows) {
    for (Ball& entry : row) {
      entry = entry.middle();
    }
  }
  return rows;
}

/// No point between those of the two discs is 0: all are on one side of a line through 0.
bool excludes_zero(const ValuesInDisc& first, const ValuesInDisc& second) {
  const auto near = [](const ComplexBall& x) { return std::complex(x.real.near(), x.imaginary.near()); };
  const std::complex<double> start = near(first.centre);
  const std::complex<double> way = near(second.centre) - start;
  const double share = std::norm(way) > 0.0 ? -(std::conj(way) * start).real() / std::norm(way) : 0.0;
  const std::complex<double> nearest = start + std::clamp(share, 0.0, 1.0) * way;
  const ComplexBall direction{Ball(nearest.real()), Ball(nearest.imag())};
  const auto is_beyond = [&](const ValuesInDisc& values) {
    const Ball along = values.centre.real * direction.real + values.centre.imaginary * direction.imaginary;
    return certainly_less(values.spread * length(direction), along);
  };
  return is_beyond(first) && is_beyond(second);
}

/// For no z on the unit circle a polynomial between the two is 0. Their coefficients are real.
bool no_root_on_unit_circle(const std::vector<Ball>& first, const std::vector<Ball>& second) {
  constexpr long kMostArcs = 100'000;
  constexpr double kFinest = 0x1p-48;  // of the place
  double from = 0.0;
  double step = 0.25;
  for (long arc = 0; arc < kMostArcs && step > kFinest * from; ++arc) {
    const bool is_last = from + step > std::numbers::pi;
    const Ball start(from);
    const Ball end = is_last ? pi() : Ball(from + step);
    const ComplexBall centre = exponential(zero, (start + end) * half);
    const Ball radius = (end - start) * half;
    if (!excludes_zero(values_in_disc(first, centre, radius), values_in_disc(second, centre, radius))) {
      step *= 0.5;
      continue;
    }
    if (is_last) {
      return true;
    }
    from += step;
    step *= 2.0;
  }
  return false;
}

}  // namespace

std::optional<DetectorLoop> detector_loop(const GainNetwork& network) {
  if (network.has_vector) {
    return std::nullopt;  // the gain of a detector is not in what is kept of the samples
  }
  const std::size_t n = network.states();
  std::optional<std::vector<Ball>> compared;
  for (const std::size_t angle : network.angle_forms) {
    const GainForm& form = network.forms[angle];
    const TurnsOfForm turns = turns_of(form.row, network.turns);
    if (certainly_equal(turns.size, zero)) {
      continue;  // of states that do not turn with the signal
    }
    if (!certainly_less(kRoundingOfRows * turns.size, abs(turns.sum))) {
      return std::nullopt;
    }
    std::vector<Ball> row;
    row.reserve(n);
    for (const Ball& entry : form.row) {
      row.push_back(entry / turns.sum);
    }
    if (compared && !same_row(*compared, row)) {
      return std::nullopt;
    }
    if (!compared) {
      compared = row;
    }
  }
  if (!compared) {
    return std::nullopt;
  }
  DetectorLoop loop{network.matrix, std::vector<Ball>(n), *compared};
  for (std::size_t i = 0; i < n; ++i) {
    loop.effect[i] = Ball(static_cast<double>(network.turns[i]));
    for (std::size_t j = 0; j < n; ++j) {
      loop.effect[i] -= network.matrix[i][j] * Ball(static_cast<double>(network.turns[j]));
    }
  }
  return loop;
}

Ball noise_bandwidth(const DetectorLoop& loop) {
  if (!all_eigenvalues_within(loop.matrix, one)) {
    return Ball::everything();
  }
  const BallRows about = covariance_of(middle_of_rows(loop.matrix), loop.effect);
  if (about.empty()) {
    return Ball::everything();
  }
  const DetectorLoop scaled = in_units_of(about, loop);
  const BallRows x = covariance_of(scaled.matrix, scaled.effect);
  if (x.empty()) {
    return Ball::everything();
  }
  Ball sum;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      sum += scaled.compared[i] * x[i][j] * scaled.compared[j];
    }
  }
  return pi() * sum;
}

bool is_stable_up_to(const DetectorLoop& loop, const Ball& factor) {
  return certainly_at_most(one, factor) && all_eigenvalues_within(loop.matrix, one) &&
         no_root_on_unit_circle(characteristic_polynomial(loop.matrix),
                                characteristic_polynomial(with_gain(loop, factor)));
}

bool is_unstable_up_to(const DetectorLoop& loop, const Ball& factor) {
  return certainly_at_most(one, factor) &&
         (an_eigenvalue_beyond(loop.matrix, one) || an_eigenvalue_beyond(with_gain(loop, factor), one));
}

}  // namespace veritrack::checker
