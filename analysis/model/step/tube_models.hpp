// A tube and the formulas of a tracker, as ball models over a cell.
#pragma once

#include <vector>

#include "analysis/model/step/tube.hpp"
#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/ball_model.hpp"
#include "trackers/model/straight_line_program.hpp"

namespace veritrack::model {

/// A tube at a phase and a frequency, each a ball model of the place in a cell.
struct TubeHere {
  std::vector<rigor::BallModel> curve;
  std::vector<rigor::BallModel> shape;  ///< the lower triangle, row by row
  /// Bounds of a filter's predicted covariance, lower triangles; or empty.
  std::vector<rigor::BallModel> covariance_low, covariance_high;
};

/// The phase, rad, and the place z in the band of the tube, over a cell.
struct CellPlace {
  rigor::BallModel phase;
  rigor::BallModel z;
};
[[nodiscard]] CellPlace place_of(const TubeCell& cell);

/// The frequency at z, rad/sample.
[[nodiscard]] rigor::BallModel frequency_at(const Tube& tube, const rigor::BallModel& z);

[[nodiscard]] TubeHere tube_at(const Tube& tube, const rigor::BallModel& phase, const rigor::BallModel& z);

/// The derivative of the curve by z at a phase that does not change with z.
[[nodiscard]] std::vector<rigor::BallModel> curve_slope_at(const Tube& tube, const rigor::BallModel& phase,
                                                           const rigor::BallModel& z);

/// The quantities that depend on the place in a cell only: computed among polynomials of two variables, and
/// then lifted to those of the scope.
struct CellFrame {
  rigor::BallModel phase;              ///< rad
  rigor::BallModel z;                  ///< place in the band of the tube
  rigor::BallModel frequency;          ///< rad/sample
  rigor::BallModel next_phase;         ///< phase + frequency
  TubeHere here;                       ///< the tube at the phase
  TubeHere there;                      ///< at the next phase
  std::vector<rigor::BallModel> next;  ///< the samples at the next phase
};

/// The samples of a frame, with |v| <= noise, times `stretch` for the ball: the first disturbances of the
/// scope. An amplitude that varies is an error of the models of the samples, so that a sample is their
/// polynomial and |v| <= noise + the length of these errors. Needs the upward rounding mode.
[[nodiscard]] std::vector<rigor::BallModel> noisy_samples(const TrackerModel& model,
                                                          const std::vector<rigor::BallModel>& samples,
                                                          double noise, double stretch);

/// The parts to compute: all but `there` and `next`; all but `there`; all.
enum class FrameParts { here, with_samples, with_next };
/// `store`: of this model and tube, or none.
[[nodiscard]] CellFrame frame_of(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                                 FrameParts parts, PlaceStore* store = nullptr);

/// C_a - C_b and U_a - U_b at one phase, where the frequency has the place z_of_a in a and z_of_b in b. Their
/// coefficients are subtracted before the harmonics are expanded: the error of the models is in proportion to
/// the difference, which is small between tubes that fit together. Both turn alike.
[[nodiscard]] TubeHere tube_difference(const Tube& a, const rigor::BallModel& z_of_a, const Tube& b,
                                       const rigor::BallModel& z_of_b, const rigor::BallModel& phase);

/// C + radius U x, where x is the ball, or a given vector.
[[nodiscard]] std::vector<rigor::BallModel> state_in(const TubeHere& here, double radius);
[[nodiscard]] std::vector<rigor::BallModel> state_in(const TubeHere& here, double radius,
                                                     const std::vector<rigor::BallModel>& x);

/// U^-1 deviation, by forward substitution.
[[nodiscard]] std::vector<rigor::BallModel> in_units_of(const TubeHere& there,
                                                        const std::vector<rigor::BallModel>& deviation);

/// Whether no diagonal entry of the shape vanishes anywhere in the cell: all are positive.
[[nodiscard]] bool is_shape(const TubeHere& here);

/// The results of a program whose inputs are the constants of the model, and then these.
[[nodiscard]] std::vector<rigor::BallModel> run(const TrackerModel& model,
                                                const trackers::StraightLineProgram& program,
                                                const std::vector<rigor::BallModel>& inputs);

/// The estimated frequency at a state, rad/sample. For a filter, the covariance is unknown.
[[nodiscard]] rigor::BallModel frequency_of(const TrackerModel& model, std::vector<rigor::BallModel> state);

/// Throws std::invalid_argument when sizes do not fit.
void require_sizes(const TrackerModel& model, const Tube& tube);

}  // namespace veritrack::model
