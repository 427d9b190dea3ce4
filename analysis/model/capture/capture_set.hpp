// A set of states on its way: a polynomial in the start and the phase, and a ball of errors around it.
//
// At sample k the states are P(s, x, y) + U xi with |xi| <= radius: s is the place of the phase in its cell,
// x and y are the deviations of the start, and U is the shape of the tube at the phase. A step of the
// recursion G, by the mean value theorem,
//   G(P + U xi, Y + v) = G(P, Y) + A U xi + B v,
// with A and B averages of the derivatives of G between (P, Y) and (P + U xi, Y + v), which are Taylor
// models, too. G(P, Y) is one: its polynomial is the next P; its remainder, A U xi and B v are in the next
// ball. In the coordinates of the tube errors shrink as they do in the tube, so that they do not add up
// (docs/model-proof.md).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/model/capture/capture_track.hpp"

namespace veritrack::model {

struct FollowedSet {
  std::vector<CaptureModel> middle;  ///< polynomials without remainder, one for each state
  double radius = 0.0;
  std::size_t sample = 0;
};

/// The result of a step. Nothing is known unless the radius is finite.
struct FollowedStep {
  FollowedSet set;
  double added = 0.0;  ///< to the radius, by the terms that the polynomials do not keep
};

/// Two deviations from the curve, each an interval; the other states are on the curve.
struct StartBox {
  std::size_t x_state = 0;
  std::size_t y_state = 1;
  rigor::Interval x, y;
};

/// Follows sets along tracks. Needs the upward rounding mode; for one thread.
class Follower {
 public:
  /// `problem` must outlive the follower.
  explicit Follower(const CaptureProblem& problem);

  /// The starts C(phi, omega) + (x, y), phi in the cell of the track, at sample 0.
  [[nodiscard]] FollowedSet start(CaptureTrack& track, const StartBox& box) const;

  /// One sample later.
  [[nodiscard]] FollowedStep step(CaptureTrack& track, const FollowedSet& set);

  /// The square of the level of P in the tube: a Taylor model.
  [[nodiscard]] CaptureModel squared_level(CaptureTrack& track, const FollowedSet& set) const;

 private:
  struct Derivatives {
    SlopeMatrix by_state;
    SlopeMatrix by_sample;
  };
  template <int Directions>
  [[nodiscard]] Derivatives derivatives_at(const std::vector<SlopeModel>& place) const;
  [[nodiscard]] Derivatives derivatives(const std::vector<SlopeModel>& place) const;
  /// The states and the samples after the set, each as a function of the place, with an error up to
  /// everything that the ball and the noise allow.
  [[nodiscard]] std::vector<SlopeModel> widened_place(CaptureTrack& track, const FollowedSet& set) const;

  const CaptureProblem* problem_;
  std::vector<CaptureModel> inputs_;
  std::vector<CaptureModel> registers_;
};

/// Deviations x and y that lie in another box, in terms of those that the box started with: for
/// `substituted`.
struct SubBox {
  std::array<std::array<CaptureModel, kCaptureDegree + 1>, kCaptureDegree + 1> powers;  ///< x^a y^b
};

/// `inner` within `outer`, for the models that belong to `outer`.
[[nodiscard]] SubBox sub_box(const StartBox& outer, const StartBox& inner);

/// The same polynomial in terms of the places in the inner box, with the remainder that rounding needs.
[[nodiscard]] CaptureModel substituted(const CaptureModel& polynomial, const SubBox& box);

/// The part of a set that belongs to the inner box. `target`: at the set's sample.
[[nodiscard]] FollowedSet part_of(const FollowedSet& set, const CaptureTarget& target, const SubBox& box);

/// Upper bound of the level of the states, from a bound of squared_level over them; NaN when nothing is
/// known.
[[nodiscard]] double level_bound(const rigor::Interval& squared_level, double radius);

/// The share of a set that comes from each variable, in the coordinates of the tube. Not evidence.
[[nodiscard]] std::array<double, 3> spread_of(const FollowedSet& set, const CaptureTarget& target);

}  // namespace veritrack::model
