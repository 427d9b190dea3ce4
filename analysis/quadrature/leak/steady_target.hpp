// A set around the steady state as the target of a capture.
#pragma once

#include "analysis/quadrature/capture/capture_target.hpp"
#include "analysis/quadrature/leak/steady_set.hpp"
#include "analysis/sets/fixed_point_quadrature.hpp"

namespace veritrack::quadrature {

/// Omega_s, s the level, at the frequencies whose steady states (polar frame) lie in a box. The level that it
/// gives for states is an upper bound on the least s such that Omega_s holds them.
class SteadySetTarget final : public CaptureTarget {
 public:
  SteadySetTarget(const SteadySet& set,
                  const rigor::IntervalVector<sets::QuadraturePolarLoop::kStates>& steady, double level)
      : set_(set), steady_(steady), level_(level) {}
  [[nodiscard]] std::optional<Settled> settled(const StateEnclosure& states) const override;

 private:
  SteadySet set_;
  rigor::IntervalVector<sets::QuadraturePolarLoop::kStates> steady_;
  double level_;
};

}  // namespace veritrack::quadrature
