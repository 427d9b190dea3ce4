// Proposals, in floating point: which set of errors and covariances might be certified. Nothing here is
// evidence; verification.hpp decides.
#pragma once

#include <optional>

#include "analysis/contraction/certified_set.hpp"
#include "trackers/quadrature_ekf.hpp"

namespace veritrack::contraction {

/// What the set is chosen for.
enum class Objective {
  start_error,  ///< the largest frequency error, for the given noise and slew
  noise,        ///< the largest noise that the set bears, for the given slew
  slew          ///< the largest slew that the set bears, for the given noise
};

/// What is asked of a proposal. The design has epsilon = 0 and belongs to amplitude 1.
struct ProposalRequest {
  trackers::QuadratureEkfDesign<double> design;
  Objective objective = Objective::start_error;
  double noise = 0.0;     ///< relative to the amplitude; without meaning for Objective::noise
  double slew = 0.0;      ///< rad/sample per sample; without meaning for Objective::slew
  int evaluations = 150;  ///< of the search; a hundred take about a quarter of a second
};

/// A metric T = [[amplitude, 0, 0], [0, phase, coupling], [0, 0, frequency]] and a radius at which sampling
/// found the objective (rad/sample, or noise, or slew) largest.
struct Shape {
  double amplitude = 0.0, phase = 0.0, coupling = 0.0, frequency = 0.0;
  double radius = 0.0;
  double objective = 0.0;
};

/// The best shape found; nothing when sampling finds no set at all (q1 = 0, say). Deterministic.
[[nodiscard]] std::optional<Shape> propose_shape(const ProposalRequest& request);

/// A set of this shape at `fraction` of its objective, 0 < fraction <= 1, complete but for the gains, with as
/// much room for the verification as noise and slew leave; nothing when sampling finds that none is there.
[[nodiscard]] std::optional<CertifiedSet> propose_set(const ProposalRequest& request, const Shape& shape,
                                                      double fraction);

}  // namespace veritrack::contraction
