// An adaptive observer of order seven for a sinusoid with an unknown offset, after M. Hou, "Amplitude and
// frequency estimator of a sinusoid", IEEE Trans. Automatic Control 50(6), 2005, as section V of L. Praly, L.
// Marconi and A. Isidori, "A new observer for an unknown harmonic oscillator", prints it. Hou's paper was not
// at hand and the print is damaged (both filters carry the same name, the constant regressor is missing), so
// the observer is derived again here.
//
// Derivation. y = s + A sin(w t + p) gives y'' = -w^2 (y - s) and y'^2 = w^2 (A^2 - (y - s)^2), so that v =
// y^2/2 satisfies
//     v'' = y'^2 + y y'' = f't,   f = (1, 3 y, -2 y^2),   t = (w^2 (A^2 - s^2), w^2 s, w^2):
// linear in the unknown t. Filter f: r' = -lambda r + lambda f. With z1 = lambda v and z2 = z1' - r't,
//     z1' = z2 + r't,   z2' = lambda v'' - r''t = lambda r't,
// and the observer copies this, corrects with e = lambda y^2/2 - z1, and adapts t' = G r e:
//     z1' = z2 + r't + (1 + alpha lambda) e,   z2' = lambda r't + alpha e.
// From the parameter error to e the transfer function is (s + lambda) / (s^2 + (1 + alpha lambda) s + alpha),
// strictly positive real for alpha > 0 and 1 + alpha lambda > lambda. The constant 1 passes the filter
// unchanged, which leaves 2 + 2 + 3 = 7 states.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace veritrack::trackers {

/// The engineer's choices. Assumed, not checked: all positive and 1 + alpha lambda > lambda.
struct AdaptiveObserverDesign {
  double lambda;          ///< filter rate, 1/s
  double alpha;           ///< correction
  Eigen::Vector3d gains;  ///< gamma_0, gamma_1, gamma_2: how fast offset terms and frequency adapt
};

/// The observer with its memory, solved by the classical Runge-Kutta method of order four with the input
/// interpolated linearly. It starts at zero, apart from the frequency.
class AdaptiveOscillatorObserver {
 public:
  using State = Eigen::Matrix<double, 7, 1>;  ///< filters of 3 y and -2 y^2; z1, z2; t

  /// `frequency`: the first estimate, rad/s. `interval` in s.
  AdaptiveOscillatorObserver(const AdaptiveObserverDesign& design, double frequency, double interval)
      : design_(design), interval_(interval) {
    state_.setZero();
    state_(6) = frequency * frequency;
  }

  /// One interval in which y runs on a straight line from `first` to `last`, signal units.
  void step(double first, double last) {
    const double h = interval_;
    const double middle = 0.5 * (first + last);
    const State k1 = slope(state_, first);
    const State k2 = slope(state_ + 0.5 * h * k1, middle);
    const State k3 = slope(state_ + 0.5 * h * k2, middle);
    const State k4 = slope(state_ + h * k3, last);
    state_ += (h / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }

  [[nodiscard]] const State& state() const { return state_; }
  /// rad/s; NaN while the estimate of w^2 is negative.
  [[nodiscard]] double frequency() const { return std::sqrt(state_(6)); }
  /// Signal units; NaN while the estimates fit no sinusoid.
  [[nodiscard]] double amplitude() const {
    const double offset = state_(5) / state_(6);
    return std::sqrt(state_(4) / state_(6) + offset * offset);
  }

 private:
  [[nodiscard]] State slope(const State& x, double y) const {
    const double lambda = design_.lambda;
    const double alpha = design_.alpha;
    const Eigen::Vector3d regressor(1.0, x(0), x(1));
    const double driven = regressor.dot(x.tail<3>());
    const double error = 0.5 * lambda * y * y - x(2);
    State result;
    result(0) = lambda * (3.0 * y - x(0));
    result(1) = lambda * (-2.0 * y * y - x(1));
    result(2) = x(3) + driven + (1.0 + alpha * lambda) * error;
    result(3) = lambda * driven + alpha * error;
    result.tail<3>() = design_.gains.cwiseProduct(regressor) * error;
    return result;
  }

  AdaptiveObserverDesign design_;
  double interval_;
  State state_;
};

}  // namespace veritrack::trackers
