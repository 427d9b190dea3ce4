// Adaptive notch filters, for a real channel and for a quadrature signal: the gradient descends the mean p-th
// power of the notch's output.
//
// The filter with which B. F. La Scala and R. R. Bitmead, "Design of an extended Kalman filter frequency
// tracker", IEEE Trans. Signal Processing 44(3), 1996, Table I, compare theirs is that of S.-C. Pei and C.-C.
// Tseng, "Adaptive IIR notch filter based on least mean p-power error criterion", IEEE Trans. Circuits and
// Systems II 40(8), 1993. That paper was not at hand and the parameters of Table I are not printed, so the
// filters are derived again here.
//
// Real: the notch (1 + a q^-1 + q^-2) / (1 + rho a q^-1 + rho^2 q^-2), a = -2 cos(frequency), with
//     e_k = y_k + a y_{k-1} + y_{k-2} - rho a e_{k-1} - rho^2 e_{k-2},
//     g_k = y_{k-1} - rho e_{k-1} - rho a g_{k-1} - rho^2 g_{k-2}     (de_k/da at constant a),
//     a <- a - mu p |e|^{p-1} sign(e) g.
// Quadrature: the notch (1 - c q^-1) / (1 - rho c q^-1), c = e^{j frequency}, with
//     e_k = y_k - c y_{k-1} + rho c e_{k-1},   g_k = -j c y_{k-1} + j rho c e_{k-1} + rho c g_{k-1},
//     frequency <- frequency - mu p |e|^{p-2} Re(conj(e) g).
// At a constant frequency a tone at the notch decays by rho with every sample.
//
// Templates over a floating-point scalar; a step does not allocate. Assumed, not checked: 0 < rho < 1, mu >=
// 0, p >= 1.
#pragma once

#include <cmath>
#include <complex>
#include <concepts>

namespace veritrack::trackers {

/// The engineer's choices.
template <typename Scalar>
struct NotchDesign {
  Scalar rho;  ///< radius of the poles; in (0, 1), close to 1 is narrow
  Scalar mu;   ///< step of the gradient; >= 0
  Scalar p;    ///< power of the error that is minimised; >= 1, 2 is least mean squares
};

/// One channel.
template <std::floating_point Scalar = double>
class RealNotch {
 public:
  /// `frequency`: the first estimate, rad/sample, in (0, pi).
  RealNotch(const NotchDesign<Scalar>& design, Scalar frequency)
      : design_(design), a_(Scalar(-2) * std::cos(frequency)) {}

  /// One sample, signal units. A correction that would take |a| to 2 or beyond, where no frequency exists, is
  /// omitted.
  void step(Scalar sample) {
    const Scalar rho = design_.rho;
    const Scalar error = sample + a_ * y1_ + y2_ - rho * a_ * e1_ - rho * rho * e2_;
    const Scalar gradient = y1_ - rho * e1_ - rho * a_ * g1_ - rho * rho * g2_;
    y2_ = y1_;
    y1_ = sample;
    e2_ = e1_;
    e1_ = error;
    g2_ = g1_;
    g1_ = gradient;
    const Scalar power = std::pow(std::fabs(error), design_.p - Scalar(1));
    const Scalar next =
        error == Scalar(0) ? a_ : a_ - design_.mu * design_.p * std::copysign(power, error) * gradient;
    if (std::fabs(next) < Scalar(2)) {
      a_ = next;
    }
  }

  /// rad/sample, in (0, pi).
  [[nodiscard]] Scalar frequency() const { return std::acos(a_ / Scalar(-2)); }
  /// The remainder of the last sample after the notch, signal units.
  [[nodiscard]] Scalar error() const { return e1_; }
  /// de/da of the last sample, signal units.
  [[nodiscard]] Scalar gradient() const { return g1_; }
  /// -2 cos(frequency).
  [[nodiscard]] Scalar coefficient() const { return a_; }

 private:
  NotchDesign<Scalar> design_;
  Scalar a_;
  Scalar y1_ = 0, y2_ = 0, e1_ = 0, e2_ = 0, g1_ = 0, g2_ = 0;
};

/// Both channels.
template <std::floating_point Scalar = double>
class QuadratureNotch {
 public:
  using Complex = std::complex<Scalar>;

  /// `frequency`: the first estimate, rad/sample.
  QuadratureNotch(const NotchDesign<Scalar>& design, Scalar frequency)
      : design_(design), frequency_(frequency) {}

  /// One sample, signal units.
  void step(Scalar in_phase, Scalar quadrature) {
    const Complex sample(in_phase, quadrature);
    const Complex turn = std::polar(Scalar(1), frequency_);
    const Complex inside = turn * (y_ - design_.rho * e_);  // -de/dc c
    const Complex gradient = Complex(inside.imag(), -inside.real()) + design_.rho * (turn * g_);
    const Complex error = sample - inside;
    y_ = sample;
    e_ = error;
    g_ = gradient;
    const Scalar size = std::abs(error);
    if (size > Scalar(0)) {
      frequency_ -= design_.mu * design_.p * std::pow(size, design_.p - Scalar(2)) *
                    (error.real() * gradient.real() + error.imag() * gradient.imag());
    }
  }

  /// rad/sample, not wrapped.
  [[nodiscard]] Scalar frequency() const { return frequency_; }
  /// The remainder of the last sample after the notch, signal units.
  [[nodiscard]] Complex error() const { return e_; }
  /// de/dfrequency of the last sample, signal units.
  [[nodiscard]] Complex gradient() const { return g_; }

 private:
  NotchDesign<Scalar> design_;
  Scalar frequency_;
  Complex y_ = 0, e_ = 0, g_ = 0;
};

}  // namespace veritrack::trackers
