// Does the tracker never leave a set of tubes, and what follows from that?
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "checker/model/tube_cover.hpp"

namespace veritrack::checker {

/// Statements about a set. Each is true only when it is certain; all but `is_never_left` are about the tubes
/// alone. The model and the set must outlive it; cells are counted in `cells`.
class PhaseTubeCheck {
 public:
  PhaseTubeCheck(const TrackedModel& model, const TubeSet& set, std::int64_t& cells)
      : model_(&model), set_(&set), cells_(&cells) {}

  /// For all phases, all frequencies of the cells, |v| <= noise and a frequency that moves by at most the
  /// slew: |F| <= shrinking_j r for all |xi| <= r, for all r from R_{j+1} to R_j; with one level, |F| <=
  /// shrinking_0 R_0 for |xi| <= R_0. (A bound that consists of terms of degree a in xi times the a-th power
  /// of the scale, and a fixed error, is convex in the scale: the ends decide, if need be those of two parts
  /// of the interval, with a bound for each.) With slew, also the borders of the cells, which must be in
  /// order (tube_borders.hpp). The shape is valid, everything is defined, only angles turn, and angles are
  /// known modulo 2 pi.
  [[nodiscard]] bool is_never_left(Objections& objections) const;

  /// |h - omega| < bound, or <= bound, at all states of the level with this number.
  [[nodiscard]] bool error_is_below(const std::function<std::size_t(const PhaseTube&)>& level,
                                    const Ball& bound) const {
    return error_is_within(level, bound, true);
  }
  [[nodiscard]] bool error_is_at_most(const std::function<std::size_t(const PhaseTube&)>& level,
                                      const Ball& bound) const {
    return error_is_within(level, bound, false);
  }
  /// At every phase and frequency there are states of level R_0 with h - omega >= reach and with
  /// h - omega <= -reach.
  [[nodiscard]] bool contains_errors(const Ball& reach) const;
  /// The mean of h - omega over the phase, for every frequency and any states of level R_m.
  [[nodiscard]] bool mean_error_is_between(const Ball& low, const Ball& high) const;
  /// The greatest h - omega minus the least one over the phase, for every frequency and any states of level
  /// R_m.
  [[nodiscard]] bool error_varies_by_at_most(const Ball& most) const;
  /// |U^-1 d| <= share R_0 for all d with |d_i| <= deviations_i.
  [[nodiscard]] bool contains_starts(const std::vector<Ball>& deviations, const Ball& share = one) const;

 private:
  [[nodiscard]] bool error_is_within(const std::function<std::size_t(const PhaseTube&)>& level,
                                     const Ball& bound, bool strictly) const;
  /// Whether the answer is true for all frequencies: it is asked about h - omega on all parts of a turn, for
  /// some frequencies at a time; `without_common`: minus a function of the frequency.
  [[nodiscard]] bool holds_for_turns(
      const std::function<bool(const std::vector<BallPolynomial>& errors)>& holds, bool without_common) const;

  const TrackedModel* model_;
  const TubeSet* set_;
  std::int64_t* cells_;
};

/// Whether angles are known modulo 2 pi, and only angles turn. Objects otherwise.
bool has_known_angles(const TrackedModel& model, const TubeSet& set, Objections& objections);

/// The number of the last level of a tube: m.
inline std::size_t last_level(const PhaseTube& tube) {
  return tube.levels.size() - 1;
}
/// The number of samples after which a state of level R_0 of this tube of the set stays at level R_j for
/// ever, over all tubes that the frequency moves through.
Ball samples_to_level(const TubeSet& set, const PhaseTube& tube, std::size_t level);

}  // namespace veritrack::checker
