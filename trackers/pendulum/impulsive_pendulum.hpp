// A damped pendulum that is driven by periodic impulses, and calmed by others.
//
// Z.-H. Guan, G. Chen and T. Ueta, on impulsive control of a chaotic pendulum, IEEE Trans. Automatic Control
// 45, 2000 (of which one page is at hand, with (1)-(4)):
//     x' = y + (pi/2) sum_k (h - g_k) delta(t - k tau),   y' = -b y - sin x,   x modulo 2 pi.
// Between impulses this is a pendulum; at t = k tau the angle x jumps by (pi/2)(h - g_k). Chaotic at b = 0.2,
// h = 2, tau = 4.32 according to their Figure 1. The conditions on g_k that their page announces are not on
// it.
//
// A template over the scalar, solved by the classical Runge-Kutta method of order four; a step does not
// allocate.
#pragma once

#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// The pendulum and its impulses.
template <typename Scalar>
struct ImpulsivePendulumModel {
  Scalar damping;       ///< b; > 0, or 0 for none
  Scalar drive;         ///< h: each impulse turns by (pi/2) h rad
  Scalar interval;      ///< tau between impulses; > 0
  int substeps = 1000;  ///< Runge-Kutta steps between impulses; >= 1
};

/// b = 0.2, h = 2, tau = 4.32 of Figure 1.
template <typename Scalar>
[[nodiscard]] inline ImpulsivePendulumModel<Scalar> chaotic_pendulum() {
  return {Scalar(0.2), Scalar(2.0), Scalar(4.32)};
}

/// Angle x in rad, not wrapped (nothing depends on its turns), and rate y in rad per unit of time.
template <typename Scalar>
struct PendulumState {
  Scalar angle;
  Scalar rate;
};

/// The pendulum with its state, which is that just after an impulse.
template <typename Scalar = double>
class ImpulsivePendulum {
 public:
  ImpulsivePendulum(const ImpulsivePendulumModel<Scalar>& model, const PendulumState<Scalar>& start)
      : model_(model), state_(start) {}

  /// One interval of free motion, then the impulse (pi/2)(h - g) rad with the controller's g.
  void step(const Scalar& control = Scalar(0.0)) {
    swing(model_.interval, model_.substeps);
    state_.angle = state_.angle + Scalar(0x1.921fb54442d18p+0) * (model_.drive - control);
  }

  /// Free motion for this time, in this number of steps.
  void swing(const Scalar& time, int steps) {
    const Scalar h = time / Scalar(static_cast<double>(steps));
    const Scalar half = Scalar(0.5) * h;
    const Scalar sixth = h / Scalar(6.0);
    for (int i = 0; i < steps; ++i) {
      const PendulumState<Scalar> k1 = slope(state_);
      const PendulumState<Scalar> k2 = slope(moved(k1, half));
      const PendulumState<Scalar> k3 = slope(moved(k2, half));
      const PendulumState<Scalar> k4 = slope(moved(k3, h));
      const Scalar two(2.0);
      state_.angle = state_.angle + sixth * (k1.angle + two * (k2.angle + k3.angle) + k4.angle);
      state_.rate = state_.rate + sixth * (k1.rate + two * (k2.rate + k3.rate) + k4.rate);
    }
  }

  [[nodiscard]] const PendulumState<Scalar>& state() const { return state_; }

 private:
  [[nodiscard]] PendulumState<Scalar> slope(const PendulumState<Scalar>& at) const {
    using detail::sin_cos;
    return {at.rate, -(model_.damping * at.rate) - sin_cos(at.angle).first};
  }
  [[nodiscard]] PendulumState<Scalar> moved(const PendulumState<Scalar>& direction, const Scalar& by) const {
    return {state_.angle + by * direction.angle, state_.rate + by * direction.rate};
  }

  ImpulsivePendulumModel<Scalar> model_;
  PendulumState<Scalar> state_;
};

}  // namespace veritrack::trackers
