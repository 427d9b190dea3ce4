// Bounds of a filter's covariance and a shape, carried along an orbit of the tone: see filter_proposal.hpp.
#pragma once

#include <cstddef>

#include "analysis/model/filter/filter_growth.hpp"
#include "analysis/model/filter/orbit_points.hpp"

namespace veritrack::model::detail {

/// The slack of the bounds, in units of themselves.
inline constexpr double kSlack = 0.006;
/// The slack of bounds in the long run, where it is also the rate at which the covariance comes between them,
/// and of bounds for a frequency that moves, which have to fit together at borders of cells.
inline constexpr double kWideSlack = 0.012;

/// The quantities that are carried along.
struct FilterOnOrbit {
  SmallMatrix low, high;  ///< predicted for this sample
  SmallMatrix shape;      ///< Pi after it
};

class FilterOrbit {
 public:
  /// `around`: the bounds are for all estimates in there, not only for those in the shape.
  /// `slope`: of the curve by the frequency, for a slew. `points`: of the same orbit from the phase at which
  /// it begins, or none.
  FilterOrbit(const TrackedTone& tone, const NodeCurve& curve, const FilterParameters& parameters,
              const Surroundings& around = {}, const Eigen::MatrixXcd* slope = nullptr,
              const OrbitPoints* points = nullptr)
      : walk_(tone, curve, around, parameters.slew > 0.0 ? slope : nullptr),
        parameters_(parameters),
        is_inside_(around.tube != nullptr),
        moves_(parameters.slew > 0.0 && slope != nullptr),
        points_(points) {}

  /// Starts at this phase, from the steady state of the filter.
  void begin(double phase);
  /// Advances to the next sample; false where bounds or shape are invalid.
  [[nodiscard]] bool step();
  [[nodiscard]] const FilterOnOrbit& here() const { return here_; }
  /// The largest frequency errors in the shape.
  [[nodiscard]] double reach() const;
  /// The growth of the last step: see FilterGrowthBound.
  [[nodiscard]] FilterGrowth growth(double enough = 0.0) {
    return bound_.of(last_, walk_.numbers(), parameters_, enough);
  }

 private:
  [[nodiscard]] bool step_bounds(const SmallMatrix& wide, FilterOnOrbit& next);
  void step_gain();
  [[nodiscard]] SmallMatrix next_shape() const;
  void advance();

  OrbitWalk walk_;
  FilterParameters parameters_;
  bool is_inside_, moves_;
  const OrbitPoints* points_;
  std::size_t number_ = 0;
  const OrbitPoint* point_ = nullptr;  ///< the sample
  OrbitPoint own_;                     ///< one that is not among the points
  SmallMatrix updated_low_, updated_high_;
  FilterOnOrbit here_;
  FilterStepOnOrbit last_;
  FilterGrowthBound bound_;
};

}  // namespace veritrack::model::detail
