// Proposals, in floating point: which set of errors and covariances might be certified. Nothing here is
// evidence; verification.hpp decides.
#pragma once

#include <optional>
#include <vector>

#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "analysis/quadrature/contraction/step_inequality.hpp"
#include "analysis/sets/contraction_question.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// The purpose of the set. The first three do not depend on the start; the others are for a given start,
/// which lies in the set.
enum class Objective {
  start_error,      ///< the largest frequency error, for the given noise and slew
  noise,            ///< the largest noise that the set tolerates, without slew
  slew,             ///< the largest slew that the set tolerates, without noise
  frequency_bound,  ///< the least bound on the frequency error from the start on
  ultimate_error,   ///< the least bound on the frequency error in the long run
  settling,         ///< the least number of samples until the frequency error is below `settled_error`
  requirement       ///< all that `required` asks, with room
};

/// The request for a proposal. The design has epsilon = 0 and belongs to amplitude 1.
struct ProposalRequest {
  trackers::ToneModel<double> design;
  Objective objective = Objective::start_error;
  double noise = 0.0;  ///< relative to the amplitude; without meaning for Objective::noise and slew
  double slew = 0.0;   ///< rad/sample per sample; without meaning for Objective::noise and slew
  /// Bounds on |amplitude|, |phase| (rad) and |frequency error| (rad/sample) at the start.
  rigor::Vector<3> start = rigor::Vector<3>::Zero();
  std::optional<CovarianceRange> start_covariance;  ///< to be held by the set; for objectives about a start
  double settled_error = 0.0;                       ///< rad/sample, for settling and requirement
  sets::RequiredBounds required;                    ///< for Objective::requirement
  int evaluations = 150;  ///< of the search; a hundred take about a quarter of a second
};

/// A metric, a radius and gains at which sampling found the objective best.
struct Shape {
  BlockMetric<double> metric;
  double radius = 0.0;
  double noise_gain = 0.0, slew_gain = 0.0;
  double objective = 0.0;  ///< rad/sample, noise, slew, or (less is better) minus rad/sample or samples
};

/// The best shapes found, one or two, the best first; none when sampling finds no set at all (q1 = 0, say).
/// Deterministic.
[[nodiscard]] std::vector<Shape> propose_shapes(const ProposalRequest& request);

/// A shape, and the part of its contraction that is to be claimed of it (propose_set).
struct SufficientShape {
  Shape shape;
  double fraction = 0.0;
};

/// For Objective::requirement: shapes for which samples of a set meet all requirements: the one found first
/// and the best; none when the search finds none. Deterministic.
[[nodiscard]] std::vector<SufficientShape> propose_sufficient_shapes(const ProposalRequest& request);

/// A set of this shape at `fraction` of its objective, 0 < fraction <= 1, with as much room for the
/// verification as noise and slew leave; nothing when sampling finds that no such set exists. For objectives
/// about a given start the set keeps its size, and the fraction is that of the contraction, 1 - rate^2, which
/// is claimed.
[[nodiscard]] std::optional<CertifiedSet> propose_set(const ProposalRequest& request, const Shape& shape,
                                                      double fraction);

}  // namespace veritrack::quadrature
