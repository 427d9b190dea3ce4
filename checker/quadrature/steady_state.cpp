#include "checker/quadrature/steady_state.hpp"

#include <arb_mat.h>

#include <algorithm>
#include <cmath>

#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

namespace {

/// The step and its derivatives by the nine entries of the state and by the frequency, over a box.
struct Linearized {
  StateVector value;
  std::array<std::array<Ball, kStates + 1>, kStates> by;
};

Linearized linearized(const Design& design, const StateVector& x, const Ball& omega) {
  Linearized result;
  // Forward differentiation by four variables at a time.
  for (std::size_t first = 0; first <= kStates; first += kVariables) {
    const auto variable = [&](std::size_t i, const Ball& range) {
      return i >= first && i < first + kVariables ? Slope::variable(range, i - first) : Slope(range);
    };
    PolarState<Slope> state;
    for (std::size_t i = 0; i < kStates; ++i) {
      (i < 3 ? state.error[i] : state.covariance[i - 3]) = variable(i, x[i]);
    }
    const PolarState<Slope> next = polar_step(design, state, variable(kStates, omega));
    for (std::size_t i = 0; i < kStates; ++i) {
      const Slope& entry = i < 3 ? next.error[i] : next.covariance[i - 3];
      result.value[i] = entry.value;
      for (std::size_t j = first; j < std::min(first + kVariables, kStates + 1); ++j) {
        result.by[i][j] = entry.along[j - first];
      }
    }
  }
  return result;
}

/// Contains A^-1 b for every A = 1 - dG/dX of the Jacobians; empty when one of them may be singular.
std::optional<StateVector> solved(const Linearized& local, const StateVector& b) {
  arb_mat_t a;
  arb_mat_t x;
  arb_mat_init(a, kStates, kStates);
  arb_mat_init(x, kStates, 1);
  for (std::size_t i = 0; i < kStates; ++i) {
    arb_set(arb_mat_entry(x, i, 0), b[i].raw());
    for (std::size_t j = 0; j < kStates; ++j) {
      arb_sub_si(arb_mat_entry(a, i, j), local.by[i][j].raw(), i == j ? 1 : 0, precision());
      arb_neg(arb_mat_entry(a, i, j), arb_mat_entry(a, i, j));
    }
  }
  std::optional<StateVector> result;
  if (arb_mat_solve_precond(x, a, x, precision()) != 0) {
    result.emplace();
    for (std::size_t i = 0; i < kStates; ++i) {
      arb_set((*result)[i].raw(), arb_mat_entry(x, i, 0));
    }
  }
  arb_mat_clear(a);
  arb_mat_clear(x);
  return result;
}

StateVector moved(const StateVector& x, const StateVector& by, const Ball& factor) {
  StateVector result;
  for (std::size_t i = 0; i < kStates; ++i) {
    result[i] = x[i] + factor * by[i];
  }
  return result;
}

bool contains(const StateVector& outer, const StateVector& inner) {
  for (std::size_t i = 0; i < kStates; ++i) {
    if (!outer[i].finite() || arb_contains(outer[i].raw(), inner[i].raw()) == 0) {
      return false;
    }
  }
  return true;
}

StateVector midpoints(StateVector x) {
  for (Ball& entry : x) {
    entry = entry.middle();
  }
  return x;
}

/// The displacement by the step of the points of the curve middle + slope (omega - centre): at the centre,
/// and by its derivative along the curve.
StateVector residual(const Design& design, const SteadyCell& cell, const StateVector& curve) {
  const Ball offset = cell.frequency - cell.centre;
  const Linearized at = linearized(design, cell.middle, cell.centre);
  const Linearized over = linearized(design, curve, cell.frequency);
  StateVector result;
  for (std::size_t i = 0; i < kStates; ++i) {
    Ball drift = over.by[i][kStates] - cell.slope[i];
    for (std::size_t j = 0; j < kStates; ++j) {
      drift += over.by[i][j] * cell.slope[j];
    }
    result[i] = at.value[i] - cell.middle[i] + drift * offset;
  }
  return result;
}

/// A cell with a fixed point near `start`, by Newton's method over balls: with A the Jacobians of 1 - G over
/// a box E about the curve and d the residual, each zero e of the deviation in E is in A^-1 d. If A^-1 d is
/// in E there is one, by Brouwer's theorem for e -> A(e)^-1 d, A(e) the mean Jacobian between 0 and e; and
/// only one, since every A is regular.
std::optional<SteadyCell> steady_cell(const Design& design, const StateVector& start, double from,
                                      double to) {
  constexpr int kSteps = 10;
  SteadyCell cell;
  cell.from = from;
  cell.to = to;
  cell.frequency = Ball::hull(Ball(from), Ball(to));
  const Ball& frequency = cell.frequency;
  cell.centre = frequency.middle();
  StateVector guess = midpoints(start);
  for (int i = 0; i < kSteps; ++i) {
    const Linearized at = linearized(design, guess, cell.centre);
    const auto step = solved(at, moved(at.value, guess, Ball(-1.0)));
    if (!step) {
      return std::nullopt;
    }
    guess = midpoints(moved(guess, *step, one));
  }
  cell.middle = guess;
  const Linearized at = linearized(design, guess, cell.centre);
  StateVector by_frequency;
  for (std::size_t i = 0; i < kStates; ++i) {
    by_frequency[i] = at.by[i][kStates];
  }
  const auto slope = solved(at, by_frequency);
  if (!slope) {
    return std::nullopt;
  }
  cell.slope = midpoints(*slope);
  const StateVector curve = moved(cell.middle, cell.slope, frequency - cell.centre);
  const StateVector distance = residual(design, cell, curve);
  std::optional<StateVector> image = solved(linearized(design, curve, frequency), distance);
  for (int i = 0; i < kSteps && image; ++i) {
    for (std::size_t k = 0; k < kStates; ++k) {
      const Ball room = start[k].radius();  // for the neighbour's enclosure
      cell.unique[k] = Ball::within(four * (abs((*image)[k]) + room) + Ball(0x1p-80));
    }
    image = solved(linearized(design, moved(curve, cell.unique, one), frequency), distance);
    if (image && contains(cell.unique, *image)) {
      cell.tight = *image;
      const Linearized over = linearized(design, moved(curve, cell.tight, one), frequency);
      for (std::size_t k = 0; k < kStates; ++k) {
        by_frequency[k] = over.by[k][kStates];
      }
      const auto derivative = solved(over, by_frequency);
      if (!derivative) {
        return std::nullopt;
      }
      cell.derivative = *derivative;
      return cell;
    }
  }
  return std::nullopt;
}

/// The steady state at frequency 0, where an exact estimate stays exact: P is followed from 0, where it grows
/// in the Loewner order since the step is monotone, and from `large` I, where it falls because its first step
/// falls. Matrices between them have entries that differ by at most the root of the two diagonal ones.
std::optional<StateVector> steady_state_at_zero(const Design& design) {
  constexpr int kSteps = 400;
  const Ball large = Ball(1000.0) * (design.r + design.q1 + design.q2);
  // Exact matrices below (-1) or above (1) the image of a step.
  const auto follow = [&](Symmetric<Ball> p, double side, int steps) {
    for (int i = 0; i < steps; ++i) {
      const Symmetric<Ball> next = polar_step<Ball>(design, {{zero, zero, zero}, p}, zero).covariance;
      Ball rounding(0.0);
      for (std::size_t k = 0; k < next.size(); ++k) {
        p[k] = next[k].middle();
        rounding += two * abs(next[k] - p[k]).upper();
      }
      for (const Entry k : {k11, k22, k33}) {
        p[k] = side < 0.0 ? (p[k] - rounding).lower() : (p[k] + rounding).upper();
      }
    }
    return p;
  };
  const Symmetric<Ball> top{large, zero, zero, large, zero, large};
  // cannot bind (matrix_of(follow(top, 1.0, 1))): updates with variance r leave at most r of the variances in
  // the plane, and at most half of `large` of the frequency's, which is correlated with the phase by then.
  if (!definite(matrix_of(top) - matrix_of(follow(top, 1.0, 1)))) {
    return std::nullopt;
  }
  const Symmetric<Ball> low = follow({}, -1.0, kSteps);
  const Symmetric<Ball> high = follow(top, 1.0, kSteps);
  const std::array<Ball, 3> reach{high[k11] - low[k11], high[k22] - low[k22], high[k33] - low[k33]};
  StateVector state;
  std::size_t k = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j, ++k) {
      state[k] = low[k - 3] + Ball::within(sqrt(reach[i] * reach[j]));
    }
  }
  return state;
}

}  // namespace

Matrix3 matrix_of(const Symmetric<Ball>& p) {
  return {{{p[k11], p[k12], p[k13]}, {p[k12], p[k22], p[k23]}, {p[k13], p[k23], p[k33]}}};
}

Symmetric<Ball> covariance_part(const StateVector& state) {
  Symmetric<Ball> p;
  std::copy(state.begin() + 3, state.end(), p.begin());
  return p;
}

StateVector SteadyCell::at(const Ball& omega) const {
  return moved(moved(middle, slope, omega - centre), tight, one);
}

std::optional<std::vector<SteadyCell>> steady_branch(const Design& design, double widest, double accuracy) {
  const Ball& low = design.lowest_frequency;
  const Ball& high = design.highest_frequency;
  constexpr double kNarrowest = 1e-3;
  const double first = std::nextafter(low.near(), -HUGE_VAL);
  const double last = std::nextafter(high.near(), HUGE_VAL);
  std::optional<StateVector> start = steady_state_at_zero(design);
  if (!start || !certainly_not_negative(Ball(first)) || !certainly_at_most(Ball(first), low) ||
      !certainly_at_most(high, Ball(last))) {
    return std::nullopt;
  }
  std::vector<SteadyCell> cells;
  double from = 0.0;
  double width = widest;
  for (const double end : {first, last}) {
    while (from < end) {
      const double to = std::min(from + width, end);
      auto cell = steady_cell(design, *start, from, to);
      // The neighbour's fixed point, at the frequency that both have, is the one of this cell.
      const bool joins = cell && contains(moved(moved(cell->middle, cell->slope, Ball(from) - cell->centre),
                                                cell->unique, one),
                                          *start);
      // cannot bind (Ball(accuracy)): wider enclosures are right, too, and prove less.
      if (!joins || !certainly_less(abs(cell->tight[2]), Ball(accuracy))) {
        width *= 0.5;
        if (width < kNarrowest) {
          return std::nullopt;
        }
        continue;
      }
      start = cell->at(Ball(to));
      if (from >= first) {
        cells.push_back(std::move(*cell));
      }
      from = to;
      width = std::min(2.0 * width, widest);
    }
  }
  if (cells.empty()) {
    return std::nullopt;  // nothing covers no band
  }
  return cells;
}

}  // namespace veritrack::checker
