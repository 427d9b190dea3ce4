#include "papers/claims/steady_loop.hpp"

#include <array>
#include <cmath>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using Unknown = rigor::Dual<Interval, 3>;
using Design = trackers::ToneModel<Interval>;

/// a, b, c of the predicted covariance.
template <typename Scalar>
using PhaseCovariance = std::array<Scalar, 3>;

/// A sample later: update, then prediction.
template <typename Scalar>
PhaseCovariance<Scalar> next_covariance(const PhaseCovariance<Scalar>& m,
                                        const trackers::ToneModel<Scalar>& design) {
  const auto& [a, b, c] = m;
  const Scalar sum = a + design.r;
  const Scalar kept = Scalar(1.0) - design.epsilon;
  const Scalar p22 = a * design.r / sum;
  const Scalar p23 = b * design.r / sum;
  const Scalar p33 = c - b * b / sum;
  return {p22 + p23 + p23 + p33 + design.q1, kept * (p23 + p33), kept * kept * p33 + design.q2};
}

/// The steady state by iteration, which proves nothing.
PhaseCovariance<double> proposal(const Design& design) {
  constexpr int kSamples = 20'000;
  const trackers::ToneModel<double> at{rigor::midpoint(design.q1), rigor::midpoint(design.q2),
                                       rigor::midpoint(design.r), rigor::midpoint(design.epsilon)};
  PhaseCovariance<double> m{at.r + at.q1, 0.0, at.r + at.q2};
  for (int k = 0; k < kSamples; ++k) {
    m = next_covariance(m, at);
  }
  return m;
}

/// next_covariance(m) - m.
PhaseCovariance<Unknown> change(const PhaseCovariance<Unknown>& m, const Design& design) {
  const trackers::ToneModel<Unknown> constant{Unknown(design.q1), Unknown(design.q2), Unknown(design.r),
                                              Unknown(design.epsilon)};
  const PhaseCovariance<Unknown> then = next_covariance(m, constant);
  return {then[0] - m[0], then[1] - m[1], then[2] - m[2]};
}

PhaseCovariance<Unknown> variables(const std::array<Interval, 3>& at) {
  PhaseCovariance<Unknown> m;
  for (std::size_t i = 0; i < m.size(); ++i) {
    std::array<Interval, 3> derivatives{Interval(0.0), Interval(0.0), Interval(0.0)};
    derivatives.at(i) = Interval(1.0);
    m.at(i) = Unknown(at.at(i), derivatives);
  }
  return m;
}

/// middle - J(box)^-1 change(middle); nothing when no inverse was verified.
std::optional<rigor::IntervalVector<3>> newton(const std::array<Interval, 3>& middle,
                                               const std::array<Interval, 3>& box, const Design& design) {
  const PhaseCovariance<Unknown> over = change(variables(box), design);
  const PhaseCovariance<Unknown> there = change(variables(middle), design);
  rigor::IntervalMatrix<3> slope;
  rigor::IntervalVector<3> value;
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    value(i) = there.at(row).value();
    for (int k = 0; k < 3; ++k) {
      slope(i, k) = over.at(row).derivative(k);
    }
  }
  auto step = rigor::solve(slope, value);
  if (!step) {
    return std::nullopt;
  }
  rigor::IntervalVector<3> image;
  for (int i = 0; i < 3; ++i) {
    image(i) = middle.at(static_cast<std::size_t>(i)) - (*step)(i);
  }
  return image;
}

}  // namespace

Interval SteadyLoop::phase_gain() const {
  return Interval(1.0) - r / (variance + r);
}

Interval SteadyLoop::frequency_gain() const {
  return covariance / (variance + r);
}

Interval SteadyLoop::squared_factor() const {
  return r / (variance + r) * (Interval(1.0) - epsilon);
}

bool SteadyLoop::oscillates() const {
  const Interval trace = r / (variance + r) + (Interval(1.0) - epsilon) - frequency_gain();
  return rigor::certainly_less(square(trace), Interval(4.0) * squared_factor());
}

Interval SteadyLoop::lag(const Interval& drift) const {
  return drift / (epsilon + covariance / variance);
}

Interval SteadyLoop::error_in_ramp(const Interval& frequency, const Interval& slew) const {
  // I - A = [[g, -left], [k, epsilon + k]], g + left = 1.
  const Interval g = phase_gain();
  const Interval left = r / (variance + r);
  const Interval k = frequency_gain();
  const Interval determinant = g * epsilon + k;
  const Interval inner = epsilon * slew / determinant;
  return (k * (inner * left) + g * (slew + epsilon * frequency - inner * g)) / determinant;
}

Interval SteadyLoop::noise_variance(const Interval& noise) const {
  const Interval left = r / (variance + r);
  const Interval k2 = phase_gain();
  const Interval k3 = frequency_gain();
  const Interval last = Interval(1.0) - epsilon - k3;
  const Interval two(2.0);
  const Interval one(1.0);
  // S = A S A' + noise K K', A = [[left, left], [-k3, last]], for S22, S23 and S33.
  rigor::IntervalMatrix<3> matrix;
  matrix << one - square(left), -(two * square(left)), -square(left),  //
      left * k3, one - left * last + left * k3, -(left * last),        //
      -square(k3), two * k3 * last, one - square(last);
  rigor::IntervalVector<3> right;
  right << noise * square(k2), noise * k2 * k3, noise * square(k3);
  const auto solution = rigor::solve(matrix, right);
  return solution ? (*solution)(2) : Interval::empty();
}

std::optional<SteadyLoop> steady_loop(const Design& design) {
  const PhaseCovariance<double> proposed = proposal(design);
  std::array<Interval, 3> middle;
  std::array<Interval, 3> box;
  constexpr double kReach = 1e-9;
  for (std::size_t i = 0; i < box.size(); ++i) {
    middle.at(i) = Interval(proposed.at(i));
    box.at(i) = middle.at(i) + rigor::symmetric(kReach * std::fabs(proposed.at(i)));
  }
  const auto image = newton(middle, box, design);
  if (!image) {
    return std::nullopt;
  }
  for (int i = 0; i < 3; ++i) {
    if (!rigor::is_interior((*image)(i), box.at(static_cast<std::size_t>(i)))) {
      return std::nullopt;
    }
  }
  const Interval& a = (*image)(0);
  const Interval& b = (*image)(1);
  const Interval& c = (*image)(2);
  // cannot bind (a, c): the iteration keeps its covariance positive definite, and the box about it is narrow.
  const bool is_positive = rigor::certainly_positive(a) && rigor::certainly_positive(a * c - square(b));
  return is_positive ? std::optional<SteadyLoop>({a, b, design.r, design.epsilon}) : std::nullopt;
}

}  // namespace veritrack::theorems
