// One step of a tracker in the coordinates of a tube, over a part of the tube's phases and frequencies:
//   F(xi, v) = U(phi + omega, omega)^-1 [G(C(phi, omega) + U(phi, omega) xi, Y(phi + omega) + v)
//              - C(phi + omega, omega)],
// where G is the step, Y the signal and C + U xi the tube. U^-1 is not computed: forward substitution. When
// the frequency moves by W zeta, |zeta| <= 1, in a sample, C and U there are those of the frequency that it
// moves to.
#pragma once

#include <vector>

#include "checker/model/ball_polynomial.hpp"
#include "checker/model/model_recursion.hpp"
#include "checker/model/tube_evidence.hpp"

namespace veritrack::checker {

/// The tracker, and the amplitude of its signal.
struct TrackedModel {
  const ModelRecursion* recursion = nullptr;
  Ball amplitude;                 ///< of each sample
  bool amplitude_varies = false;  ///< from sample to sample, in that range

  /// Whether samples may differ from a signal of one amplitude. A vector v of the monomials belongs to it.
  [[nodiscard]] bool is_disturbed(double noise) const { return noise != 0.0 || amplitude_varies; }
};

/// Phases 2 pi (turn - half_turn) to 2 pi (turn + half_turn), and z - half_z to z + half_z of a tube.
/// Binary fractions, so that parts fit together exactly. s and z of ball polynomials are places in it.
struct TubePart {
  double turn = 0.5;
  double half_turn = 0.5;
  double z = 0.0;
  double half_z = 1.0;
  double z_error = 0.0;  ///< also includes everything within this distance

  /// Part number `phase` of `phases` parts of a turn, and number `frequency` of `frequencies` parts of the
  /// frequencies: both counts are powers of two.
  static TubePart of_grid(std::size_t phase, std::size_t phases, std::size_t frequency,
                          std::size_t frequencies);
  /// The first or the second half.
  [[nodiscard]] TubePart half_of_phases(bool second) const;
  [[nodiscard]] TubePart half_of_frequencies(bool second) const;
  /// The point in the middle.
  [[nodiscard]] TubePart middle() const { return {turn, 0.0, z, 0.0, z_error}; }
};

/// The move of the frequency: z moves by `most` zeta.
struct FrequencyMove {
  Ball most;
  BallPolynomial zeta;
};

/// The curve and the shape over a part of a tube, or where they are some samples later.
struct TubeOver {
  std::vector<BallPolynomial> curve;
  std::vector<BallPolynomial> shape;                            ///< the lower triangle, row by row
  std::vector<BallPolynomial> covariance_low, covariance_high;  ///< of a filter: lower triangles

  /// `later`: that many samples later, at the same frequency or one that it moves to.
  TubeOver(const PhaseTube& tube, const TubePart& part, std::size_t later,
           const FrequencyMove* move = nullptr);
  /// The diagonal of the shape is certainly positive.
  [[nodiscard]] bool has_shape() const;
  /// C + radius U x, for components x.
  [[nodiscard]] std::vector<BallPolynomial> point(double radius, const std::vector<BallPolynomial>& x) const;
  /// U^-1 of a vector.
  [[nodiscard]] std::vector<BallPolynomial> coordinates(const std::vector<BallPolynomial>& vector) const;
};

/// The signal over the part, `later` samples later, without noise.
std::vector<BallPolynomial> signal_later(const TrackedModel& model, const PhaseTube& tube,
                                         const TubePart& part, std::size_t later = 1);
/// The same with |v| <= noise in signal units, v the second vector of the monomials. Where the amplitude
/// varies, its effect on a sample is within the errors of the signal's polynomials: an error of the sample
/// beside the noise, whose length is at most that of these errors.
std::vector<BallPolynomial> with_noise(const TrackedModel& model, std::vector<BallPolynomial> signal,
                                       double noise, const VectorMonomials& monomials);
/// omega over the part, and the estimate of the frequency at a state minus omega; rad/sample.
BallPolynomial frequency_over(const PhaseTube& tube, const TubePart& part);
BallPolynomial frequency_error(const TrackedModel& model, const PhaseTube& tube, const TubePart& part,
                               const std::vector<BallPolynomial>& state);
/// The components of xi.
std::vector<BallPolynomial> components(const VectorMonomials& monomials);

/// The step over a part of a tube.
class TubeStep {
 public:
  /// For a slew in rad/sample per sample: zeta is the only component of the third vector of the monomials,
  /// which must outlive this.
  TubeStep(const TrackedModel& model, const PhaseTube& tube, const TubePart& part,
           const VectorMonomials& monomials, double slew = 0.0);

  /// Whether the shape is valid here and a sample later: certainly positive on its diagonal.
  [[nodiscard]] bool has_shape() const { return here_.has_shape() && there_.has_shape(); }
  /// F for |xi| <= radius, |v| <= noise, where the ball polynomials are in xi/radius and v/noise. The second
  /// vector of the monomials is v if samples are disturbed.
  [[nodiscard]] std::vector<BallPolynomial> map(double radius, double noise) const;

 private:
  [[nodiscard]] TubeOver after_step(const PhaseTube& tube, const TubePart& part, double slew) const;

  const TrackedModel* model_;
  const VectorMonomials* monomials_;
  TubeOver here_, there_;
  std::vector<BallPolynomial> signal_;  ///< a sample later
};

}  // namespace veritrack::checker
