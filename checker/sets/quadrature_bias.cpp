#include "checker/sets/quadrature_bias.hpp"

#include <algorithm>

#include "checker/numbers/gradient.hpp"

namespace veritrack::checker {

namespace {

constexpr slong kSize = kToneStates;
constexpr std::size_t kFrequency = kToneStates;  // the last variable
using Model = Gradient<Ball, kToneStates + 1>;

/// A sample of the tracker that measures both coordinates, in the frame of the true phase: tone_step's
/// prediction, and one update after the other.
template <typename S>
ToneState<S> quadrature_step(const ToneState<S>& x, const S& frequency, const TrackerValues<S>& values) {
  const S unit(1.0);
  const S kept = unit - values.epsilon;
  const auto [sine, cosine] = sine_cosine(x[2]);
  const S amplitude = unit + x[0];
  const S z1 = cosine * amplitude - sine * x[1];
  const S z2 = sine * amplitude + cosine * x[1];
  std::array<S, 3> error{z1 - unit, z2, kept * x[2] - values.epsilon * frequency};
  using Row = std::array<S, 3>;
  const std::array<Row, 3> p{Row{x[3], x[4], x[6]}, Row{x[4], x[5], x[7]}, Row{x[6], x[7], x[8]}};
  const S none(0.0);
  const std::array<Row, 3> a{Row{cosine, none - sine, none - z2}, Row{sine, cosine, z1},
                             Row{none, none, kept}};
  std::array<Row, 3> m{Row{values.q1, none, none}, Row{none, values.q1, none}, Row{none, none, values.q2}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const S ap = a[i][0] * p[0][k] + a[i][1] * p[1][k] + a[i][2] * p[2][k];
      for (std::size_t j = 0; j < 3; ++j) {
        m[i][j] = m[i][j] + ap * a[j][k];
      }
    }
  }
  for (std::size_t channel = 0; channel < 2; ++channel) {
    const S over = reciprocal(m[channel][channel] + values.r);
    const Row gain{m[0][channel] * over, m[1][channel] * over, m[2][channel] * over};
    const Row row = m[channel];
    const S seen = error[channel];
    for (std::size_t i = 0; i < 3; ++i) {
      error[i] = error[i] - gain[i] * seen;
      for (std::size_t j = 0; j < 3; ++j) {
        m[i][j] = m[i][j] - gain[i] * row[j];
      }
    }
  }
  return {error[0], error[1], error[2], m[0][0], m[1][0], m[1][1], m[2][0], m[2][1], m[2][2]};
}

/// 1 - DG by the state, DG by the frequency, and G(x) - x, over a box.
struct Linearized {
  Matrix regular{kSize, kSize}, by_frequency{kSize, 1}, moved{kSize, 1};
};
Linearized linearized(const TrackerValues<Ball>& values, const Matrix& x, const Ball& frequency) {
  ToneState<Model> state;
  for (std::size_t i = 0; i < kToneStates; ++i) {
    state[i] = Model(x(static_cast<slong>(i), 0));
    state[i].along[i] = one;
  }
  Model omega(frequency);
  omega.along[kFrequency] = one;
  const ToneState<Model> image = quadrature_step(
      state, omega, {Model(values.q1), Model(values.q2), Model(values.r), Model(values.epsilon)});
  Linearized result;
  for (slong i = 0; i < kSize; ++i) {
    const Model& entry = image[static_cast<std::size_t>(i)];
    for (slong j = 0; j < kSize; ++j) {
      result.regular.set(i, j, Ball(i == j ? 1.0 : 0.0) - entry.along[static_cast<std::size_t>(j)]);
    }
    result.by_frequency.set(i, 0, entry.along[kFrequency]);
    result.moved.set(i, 0, entry.value - x(i, 0));
  }
  return result;
}

template <typename Function>
Matrix each(const Matrix& x, const Function& function) {
  Matrix y(kSize, 1);
  for (slong i = 0; i < kSize; ++i) {
    y.set(i, 0, function(x(i, 0)));
  }
  return y;
}
/// Exactly the nearest doubles.
Matrix rounded(const Matrix& x) {
  return each(x, [](const Ball& entry) { return Ball(entry.near()); });
}
bool contains(const Matrix& outer, const Matrix& inner) {
  for (slong i = 0; i < kSize; ++i) {
    const Ball out = outer(i, 0);
    if (!out.finite() || arb_contains(out.raw(), inner(i, 0).raw()) == 0) {
      return false;
    }
  }
  return true;
}
/// The variances, and the minors of P that together decide whether it is positive definite.
bool holds_covariances(const Matrix& x) {
  Matrix p(3, 3);
  slong at = 3;
  for (slong i = 0; i < 3; ++i) {
    for (slong j = 0; j <= i; ++j, ++at) {
      p.set(i, j, x(at, 0));
      p.set(j, i, x(at, 0));
    }
  }
  return p.definite();
}

}  // namespace

// Interval Newton about a line: e = X* - (middle + slope (omega - center)) is in (1 - DG)^-1 d with the
// Jacobians over the box and d = G(line) - line, by the mean value theorem; if that is in the box there is
// exactly one fixed point in it, since every 1 - DG is regular. d over the cell: d at the center, and its
// derivative times the distance.
bool QuadratureBranch::add_cell(const Ball& frequencies) {
  const Ball center(frequencies.near());
  Matrix middle(kSize, 1);
  if (cells_.empty()) {
    // From the exact estimate, simulated.
    ToneState<double> x{0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0};
    constexpr int kSettlingSamples = 3000;
    for (int k = 0; k < kSettlingSamples; ++k) {
      x = quadrature_step<double>(
          x, 0.0, {values_.q1.near(), values_.q2.near(), values_.r.near(), values_.epsilon.near()});
    }
    for (slong i = 0; i < kSize; ++i) {
      middle.set(i, 0, Ball(x[static_cast<std::size_t>(i)]));
    }
  } else {
    middle = rounded(cells_.back().around(center, cells_.back().tight));
    constexpr int kSteps = 5;
    for (int k = 0; k < kSteps; ++k) {
      const Linearized at = linearized(values_, middle, center);
      middle = rounded(middle + at.regular.solve(at.moved));
    }
  }
  const Linearized at = linearized(values_, middle, center);
  Matrix slope = rounded(at.regular.solve(at.by_frequency));
  const Ball offset = frequencies - center;
  const Matrix line = middle + offset * slope;
  const Linearized over = linearized(values_, line, frequencies);
  const Matrix drift = over.by_frequency - over.regular * slope;
  const Matrix moved = at.moved + offset * drift;
  Matrix image = over.regular.solve(moved);
  constexpr int kTries = 5;
  for (int k = 0; k < kTries; ++k) {
    Matrix box = each(
        image, [](const Ball& entry) { return Ball::within(four * abs(entry).upper() + Ball(0x1p-40)); });
    image = linearized(values_, line + box, frequencies).regular.solve(moved);
    if (contains(box, image)) {
      cells_.push_back(
          {frequencies, center, std::move(middle), std::move(slope), std::move(box), std::move(image)});
      return true;
    }
  }
  return false;
}

// At frequency 0 the step commutes with the reflection of the plane, (delta_2, nu, P21, P31) to their
// negatives. So the only fixed point of a box that is symmetric has these zero, then delta_1 = (1 - K_11)
// delta_1, hence delta_1 = 0, and P is the one positive definite fixed point of a Riccati equation: it is the
// exact estimate with its steady covariance.
Ball QuadratureBranch::error_at(const Ball& frequency) {
  constexpr double kWidth = 0x1p-6;  // rad/sample
  // cannot bind (frequency.lower(), frequency): the cells begin at 0 and are right at every frequency, but
  // the branch would never end.
  if (!certainly_not_negative(frequency.lower()) || !certainly_less(frequency, pi() + one)) {
    return Ball::everything();
  }
  if (cells_.empty() && !lost_) {
    lost_ = !add_cell(zero);
    if (!lost_) {
      const Cell& first = cells_.front();
      constexpr std::array<slong, 4> kOdd{1, 2, 4, 6};
      // cannot bind (first.middle(i, 0)): the simulation adds products with sin 0 and with zeros to zero.
      const bool symmetric = std::all_of(kOdd.begin(), kOdd.end(),
                                         [&](slong i) { return certainly_equal(first.middle(i, 0), zero); });
      lost_ = !symmetric || !holds_covariances(first.around(zero, first.unique));
      if (lost_) {
        cells_.clear();
      }
    }
  }
  // cannot bind (cells_.back().frequencies.upper()): a frequency that no cell contains is found in none
  // below.
  while (!lost_ && !certainly_at_most(frequency.upper(), cells_.back().frequencies.upper())) {
    const Ball end = cells_.back().frequencies.upper();
    lost_ = !add_cell(Ball::hull(end, end + Ball(kWidth)));
    if (!lost_) {
      // The two cells share the end of the first: the same fixed point there.
      const Cell& last = cells_.back();
      const Cell& before = cells_[cells_.size() - 2];
      lost_ = !contains(last.around(end, last.unique), before.around(end, before.tight));
      if (lost_) {
        cells_.pop_back();
      }
    }
  }
  Ball found = Ball::everything();
  for (const Cell& cell : cells_) {
    if (certainly_at_most(cell.frequencies.lower(), frequency.lower()) &&
        certainly_at_most(frequency.upper(), cell.frequencies.upper())) {
      // Newton's steps at this frequency, from a point; the Jacobians are those between it and the fixed
      // point.
      Matrix x = cell.around(frequency, cell.tight);
      constexpr int kSteps = 3;
      for (int k = 0; k < kSteps; ++k) {
        const Matrix point = rounded(x);
        const Matrix between =
            point + each(x - point, [](const Ball& entry) { return Ball::hull(zero, entry); });
        x = point + linearized(values_, between, frequency)
                        .regular.solve(linearized(values_, point, frequency).moved);
      }
      found = x(2, 0);
    }
  }
  return found;
}

}  // namespace veritrack::checker
