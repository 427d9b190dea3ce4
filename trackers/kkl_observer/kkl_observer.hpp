// The Kazantzis-Kravaris-Luenberger observer for amplitude, phase and frequency of a sinusoid.
//
// L. Praly, L. Marconi and A. Isidori, "A new observer for an unknown harmonic oscillator". Equation numbers
// are the paper's. Time is continuous: frequencies in rad/s, filter rates in 1/s.
//
// The signal is y = x1 with
//     x1' = -x2,   x2' = x3 x1,   x3' = 0,
// that is y(t) = A sin(w t + p), x1 = A sin(w t + p), x2 = -A w cos(w t + p), x3 = w^2. With this sign the
// map of (6), T_i(x) = (lambda_i x1 + x2) / (lambda_i^2 + x3), solves (3) for the filters xi_i' = -lambda_i
// xi_i + y. (The phase formula of the paper's section III belongs to the other sign, x1' = x2.)
//
// The observer is M filters, whose states xi tend to T(x), and the static map gamma of (8)-(9), which turns
// xi into an estimate of x.
//
// Everything is a template over the scalar, free of branches on scalar values. It does not allocate, and it
// never throws unless the scalar does. docs/rounding.md bounds the rounding of the estimates in double
// precision. Assumed, not checked: lambda positive and distinct, ell >= 0, M >= 4.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "trackers/kkl_observer/kkl_results.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// The engineer's choices.
template <typename Scalar, int M = 4>
struct KklObserverDesign {
  Eigen::Matrix<Scalar, M, 1> lambda;  ///< filter rates, 1/s; positive and distinct
  Scalar ell;                          ///< of (9): at most twice the infimum of (10) for an exact inverse
};

/// (x1, x2, x3) of an oscillator: signal units, signal units times rad/s, (rad/s)^2.
template <typename Scalar>
using OscillatorState = Eigen::Matrix<Scalar, 3, 1>;

/// The state of the oscillator with y = amplitude sin(phase), rising at `frequency` rad/s; phase in rad.
template <typename Scalar>
[[nodiscard]] inline OscillatorState<Scalar> oscillator_state(const Scalar& amplitude, const Scalar& phase,
                                                              const Scalar& frequency) {
  using detail::sin_cos;
  using detail::square;
  const auto [sine, cosine] = sin_cos(phase);
  OscillatorState<Scalar> x;
  x(0) = amplitude * sine;
  x(1) = -(amplitude * frequency * cosine);
  x(2) = square(frequency);
  return x;
}

/// An oscillator in engineering units.
template <typename Scalar>
struct OscillatorEstimate {
  Scalar amplitude;  ///< signal units
  Scalar phase;      ///< rad: y = amplitude sin(phase)
  Scalar frequency;  ///< rad/s
};

/// Amplitude, phase and frequency of a state. Meaningless (NaN over double) unless x3 > 0.
template <typename Scalar, typename Known = KklNothingKnown>
[[nodiscard]] inline OscillatorEstimate<Scalar> in_engineering_units(const OscillatorState<Scalar>& x,
                                                                     const Known& known = {}) {
  using detail::square;
  using std::atan2;
  using std::sqrt;
  const Scalar frequency = sqrt(x(2));
  const Scalar squared = known(KklResult::squared_amplitude, Scalar(square(x(0)) + square(x(1)) / x(2)));
  return {sqrt(squared), atan2(Scalar(frequency * x(0)), Scalar(-x(1))), frequency};
}

/// T of (5)-(6): where the filters settle when the signal is that of x.
template <typename Scalar, int M>
[[nodiscard]] inline Eigen::Matrix<Scalar, M, 1> kkl_transform(const OscillatorState<Scalar>& x,
                                                               const Eigen::Matrix<Scalar, M, 1>& lambda) {
  using detail::square;
  Eigen::Matrix<Scalar, M, 1> transformed;
  for (int i = 0; i < M; ++i) {
    transformed(i) = (lambda(i) * x(0) + x(1)) / (square(lambda(i)) + x(2));
  }
  return transformed;
}

/// |M xi|^2 for the matrix M below (9), as the sum over all triples of filters of the squared determinant of
/// (lambda, 1, xi): that is what M computes for four filters, and it is det(L'L) for any number of them.
template <typename Scalar, int M>
[[nodiscard]] inline Scalar kkl_excitation(const Eigen::Matrix<Scalar, M, 1>& xi,
                                           const Eigen::Matrix<Scalar, M, 1>& lambda) {
  using detail::square;
  Scalar sum(0.0);
  for (int i = 0; i < M; ++i) {
    for (int j = i + 1; j < M; ++j) {
      for (int k = j + 1; k < M; ++k) {
        sum += square(Scalar(xi(i) * (lambda(j) - lambda(k)) + xi(j) * (lambda(k) - lambda(i)) +
                             xi(k) * (lambda(i) - lambda(j))));
      }
    }
  }
  return sum;
}

/// mu of (9).
template <typename Scalar, int M, typename Known = KklNothingKnown>
[[nodiscard]] inline Scalar kkl_regularization(const Eigen::Matrix<Scalar, M, 1>& xi,
                                               const KklObserverDesign<Scalar, M>& design,
                                               const Known& known = {}) {
  using detail::square;
  using std::max;
  Scalar squared_norm(0.0);
  for (int i = 0; i < M; ++i) {
    squared_norm += square(xi(i));
  }
  squared_norm = Scalar(known(KklResult::squared_norm, squared_norm));
  const Scalar excess =
      known(KklResult::excess,
            Scalar(design.ell * squared_norm - Scalar(2.0) * kkl_excitation<Scalar, M>(xi, design.lambda)));
  return max(excess, Scalar(0.0));
}

/// gamma of (8): the solution of (15), with (L'L + mu I) x = L' F^2 xi and L = (lambda, 1, -xi). The matrix
/// is 3 x 3 (the paper's "4 x 4 identity" is a slip). At xi = 0, where (8) leaves the value free, it divides
/// by zero.
template <typename Scalar, int M, typename Known = KklNothingKnown>
[[nodiscard]] inline OscillatorState<Scalar> kkl_inverse(const Eigen::Matrix<Scalar, M, 1>& xi,
                                                         const KklObserverDesign<Scalar, M>& design,
                                                         const Known& known = {}) {
  using detail::square;
  const Scalar mu = kkl_regularization<Scalar, M>(xi, design, known);
  // Phi, symmetric, and the right-hand side.
  Scalar p11(mu);
  Scalar p12(0.0);
  Scalar p13(0.0);
  Scalar p22(mu);
  Scalar p23(0.0);
  Scalar p33(mu);
  OscillatorState<Scalar> right;
  right(0) = right(1) = right(2) = Scalar(0.0);
  for (int i = 0; i < M; ++i) {
    const Scalar& lambda = design.lambda(i);
    const Scalar lambda_squared = square(lambda);
    const Scalar driven = lambda_squared * xi(i);
    p11 += lambda_squared;
    p12 += lambda;
    p13 -= lambda * xi(i);
    p22 += Scalar(1.0);
    p23 -= xi(i);
    p33 += square(Scalar(xi(i)));
    right(0) += lambda * driven;
    right(1) += driven;
    right(2) -= xi(i) * driven;
  }
  p13 = Scalar(known(KklResult::entry_13, p13));
  p23 = Scalar(known(KklResult::entry_23, p23));
  p33 = Scalar(known(KklResult::entry_33, p33));
  right(0) = Scalar(known(KklResult::right_1, right(0)));
  right(1) = Scalar(known(KklResult::right_2, right(1)));
  right(2) = Scalar(known(KklResult::right_3, right(2)));
  // Cholesky's factors without roots: Phi = U' D U with U unit upper triangular.
  const Scalar u12 = p12 / p11;
  const Scalar u13 = p13 / p11;
  const Scalar d2 = p22 - p12 * u12;
  const Scalar c23 = known(KklResult::reduced_23, Scalar(p23 - p12 * u13));
  const Scalar u23 = c23 / d2;
  const Scalar d3 = known(KklResult::reduced_33, Scalar(p33 - p13 * u13 - c23 * u23));
  const Scalar z2 = known(KklResult::reduced_2, Scalar(right(1) - u12 * right(0)));
  const Scalar z3 = known(KklResult::reduced_3, Scalar(right(2) - u13 * right(0) - u23 * z2));
  OscillatorState<Scalar> x;
  x(2) = known(KklResult::x3, Scalar(z3 / d3));
  x(1) = z2 / d2 - u23 * x(2);
  x(0) = right(0) / p11 - u12 * x(1) - u13 * x(2);
  return x;
}

/// The filters over one sampling interval, solved exactly for two kinds of input between the samples.
template <typename Scalar, int M = 4>
class KklDiscretization {
 public:
  /// `interval` in s, > 0.
  KklDiscretization(const Eigen::Matrix<Scalar, M, 1>& lambda, const Scalar& interval) {
    using std::exp;
    for (int i = 0; i < M; ++i) {
      const Scalar decay = exp(Scalar(-(lambda(i) * interval)));
      decay_(i) = decay;
      gain_(i) = (Scalar(1.0) - decay) / lambda(i);
      ramp_(i) = (Scalar(1.0) - gain_(i) / interval) / lambda(i);
    }
  }

  /// xi after the interval when y stays at `value`.
  [[nodiscard]] Eigen::Matrix<Scalar, M, 1> held(const Eigen::Matrix<Scalar, M, 1>& xi,
                                                 const Scalar& value) const {
    Eigen::Matrix<Scalar, M, 1> next;
    for (int i = 0; i < M; ++i) {
      next(i) = decay_(i) * xi(i) + gain_(i) * value;
    }
    return next;
  }

  /// xi after the interval when y runs on a straight line from `first` to `last`.
  [[nodiscard]] Eigen::Matrix<Scalar, M, 1> interpolated(const Eigen::Matrix<Scalar, M, 1>& xi,
                                                         const Scalar& first, const Scalar& last) const {
    Eigen::Matrix<Scalar, M, 1> next;
    for (int i = 0; i < M; ++i) {
      next(i) = decay_(i) * xi(i) + gain_(i) * first + ramp_(i) * (last - first);
    }
    return next;
  }

 private:
  Eigen::Matrix<Scalar, M, 1> decay_;  ///< exp(-lambda h)
  Eigen::Matrix<Scalar, M, 1> gain_;   ///< of a constant input: (1 - exp(-lambda h)) / lambda, s
  Eigen::Matrix<Scalar, M, 1> ramp_;   ///< of an input that rises from 0 to 1, s
};

/// The observer with its memory, sampled at a fixed interval. Its filters start at rest.
template <typename Scalar = double, int M = 4>
class KklObserver {
 public:
  /// `interval` in s.
  KklObserver(const KklObserverDesign<Scalar, M>& design, const Scalar& interval)
      : design_(design), discretization_(design.lambda, interval) {
    for (int i = 0; i < M; ++i) {
      xi_(i) = Scalar(0.0);
    }
  }

  /// One interval in which y stays at `value`, signal units.
  void step_held(const Scalar& value) { xi_ = discretization_.held(xi_, value); }
  /// One interval in which y runs on a straight line from `first` to `last`, signal units.
  void step_interpolated(const Scalar& first, const Scalar& last) {
    xi_ = discretization_.interpolated(xi_, first, last);
  }

  [[nodiscard]] const KklObserverDesign<Scalar, M>& design() const { return design_; }
  [[nodiscard]] const Eigen::Matrix<Scalar, M, 1>& filters() const { return xi_; }
  /// gamma(xi). Not before the first sample that is not zero.
  [[nodiscard]] OscillatorState<Scalar> state() const { return kkl_inverse(xi_, design_); }
  [[nodiscard]] OscillatorEstimate<Scalar> estimate() const { return in_engineering_units(state()); }

 private:
  KklObserverDesign<Scalar, M> design_;
  KklDiscretization<Scalar, M> discretization_;
  Eigen::Matrix<Scalar, M, 1> xi_;
};

}  // namespace veritrack::trackers
