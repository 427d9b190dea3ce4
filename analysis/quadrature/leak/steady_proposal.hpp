// Proposals, in floating point, of sets around the steady state of a leaky tracker. Nothing here is evidence;
// steady_verification.hpp decides.
#pragma once

#include <optional>
#include <vector>

#include "analysis/quadrature/leak/steady_gain.hpp"
#include "analysis/quadrature/leak/steady_set.hpp"

namespace veritrack::quadrature {

/// The request for a proposal; amplitude 1.
struct SteadyRequest {
  trackers::ToneModel<double> design;
  /// The steady states that the set is fitted to, in the order of their frequencies.
  std::vector<SteadyState<double>> steady;
  /// dX*/domega there, in the order of the polar frame; used for the slew only.
  std::vector<rigor::Vector<9>> slopes;
  double noise = 0.0;  ///< relative to the amplitude
  double slew = 0.0;   ///< rad/sample per sample
  /// The largest frequency error in level 1, about the steady state, rad/sample; 0 where it is not
  /// prescribed.
  double radius = 0.0;
  /// Largest errors of the start from the true signal: amplitude, phase (rad), frequency (rad/sample). A set
  /// that holds them is preferred.
  rigor::Vector<3> start = rigor::Vector<3>::Zero();
  int evaluations = 60;
};

/// By which inequality samples judge a step: the one that the proof uses, or one that asks for more. Sets by
/// the latter are smaller, contract faster, and are quick to verify.
enum class SteadyJudgement { sharp, cautious };

/// The metric in which sampling found the largest set, scaled to level 1.
struct SteadyShape {
  rigor::Matrix<3> metric;
};

/// The best shape found; nothing when sampling finds no set at all. Deterministic.
[[nodiscard]] std::optional<SteadyShape> propose_steady_shape(const SteadyRequest& request,
                                                              SteadyJudgement judgement);

/// A set of this shape, smaller by `fraction`, with covariance bounds and rates that leave room for the
/// verification; nothing when sampling finds that no such set exists.
[[nodiscard]] std::optional<SteadySet> propose_steady_set(const SteadyRequest& request,
                                                          const SteadyShape& shape, double fraction,
                                                          SteadyJudgement judgement);

}  // namespace veritrack::quadrature
