// One step of an extended Kalman filter in a tube that bounds its covariance, over a part of the tube's
// phases and frequencies.
//
// The updated covariance P+ = P - P H' (H P H' + R)^-1 H P grows with the predicted one, P, in the order of
// symmetric matrices, and the estimate after it is x+ = x^ + P+ H' R^-1 (y - h(x^)). The only fact used about
// P+ is that it is between the updated bounds.
#pragma once

#include <optional>
#include <vector>

#include "checker/model/place_matrix.hpp"
#include "checker/model/tube_step.hpp"

namespace veritrack::checker {

/// True only for a filter whose H does not depend on the estimate: only then do bounds of the covariance mean
/// what they should. (Q and R are symmetric matrices of every filter: model_recursion.cpp.)
bool bounds_suit(const ModelRecursion& recursion);

/// The room that bounds of a covariance leave from one sample to the next.
struct BoundsToSpare {
  /// F P F' + Q is below (1 - margin) high and above low/(1 - margin): a share of the bounds.
  double margin = 0.0;
  /// The same for c high and low/c in place of high and low, on both sides, for all c from 1 to this.
  double ratio = 1.0;
};

class FilterStep {
 public:
  /// The second vector of the monomials, which must outlive this, is v if there is noise; the third one is
  /// zeta if there is a slew, in rad/sample per sample.
  FilterStep(const TrackedModel& model, const PhaseTube& tube, const TubePart& part,
             const VectorMonomials& monomials, double slew = 0.0);

  /// Whether the shape is valid here and a sample later.
  [[nodiscard]] bool has_shape() const { return here_.has_shape() && there_.has_shape(); }
  /// True only when the bounds are a range of covariances here, and F P F' + Q is between those of the next
  /// sample, at every frequency that it moves to, for every updated covariance of that range and all |xi| <=
  /// radius.
  [[nodiscard]] bool keeps_covariance(double radius, const BoundsToSpare& spare = {}) const;
  /// A vector that is at least as long as F for |xi| <= radius, |v| <= noise and every covariance in the
  /// bounds, where the ball polynomials are in xi/radius and v/noise. It is chosen to be short where |v| <=
  /// noise; or, if `of_gaussian` is not 0, where the square of its part with v/noise counts that many times.
  [[nodiscard]] std::vector<BallPolynomial> map(double radius, double noise, double of_gaussian = 0.0) const;

 private:
  /// The quantities a sample later that depend on the place only.
  struct LaterPlace {
    PlaceMatrix gain;    ///< of the middle of both updated bounds
    PlaceMatrix reach;   ///< L of R^-1 H delta H' R^-1, delta half of their difference
    PlaceMatrix spread;  ///< U^-1 delta U^-T
  };
  [[nodiscard]] const LaterPlace& later() const;
  [[nodiscard]] PlaceMatrix updated(const PlaceMatrix& predicted) const;
  /// Curve and shape a sample later, as functions of zeta.
  [[nodiscard]] TubeOver moved() const;

  const TrackedModel* model_;
  const VectorMonomials* monomials_;
  const PhaseTube* tube_;
  TubePart part_;
  std::size_t states_;
  double slew_;
  TubeOver here_;
  TubeOver there_;  ///< of no vector: with a slew, for every zeta
  std::vector<BallPolynomial> signal_;
  PlaceMatrix measured_, process_noise_, noise_;  ///< H, Q, R
  PlaceMatrix weighted_;                          ///< R^-1 H
  mutable std::optional<LaterPlace> later_;       ///< once it was asked for
};

}  // namespace veritrack::checker
