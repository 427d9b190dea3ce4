// The effect of the program's rounding on one step of a set around the steady state (docs/rounding.md).
#pragma once

#include <vector>

#include "analysis/quadrature/leak/steady_set.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "analysis/sets/fixed_point_bias.hpp"

namespace veritrack::quadrature {

/// The program's step is the exact step, followed by a change of e by at most `error` in |T e| and of P by at
/// most `covariance` times `below` and times `above`, in the Loewner order. Upper bounds; infinite or empty
/// when unknown.
struct SteadyRounding {
  rigor::Interval error, covariance;
};

/// From any state of Omega_1 at any frequency of the branch, if the exact step leads into Omega_1, for noise
/// of at most that of the set. Needs the upward mode.
[[nodiscard]] SteadyRounding steady_rounding(const trackers::ToneModel<rigor::Interval>& design,
                                             const TrackedSignal& signal,
                                             const std::vector<sets::BranchCell>& branch,
                                             const SteadySet& set);

}  // namespace veritrack::quadrature
