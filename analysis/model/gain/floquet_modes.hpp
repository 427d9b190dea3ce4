// The modes of the errors about a steady state at one frequency: where to begin a basis in which they have
// constant coefficients. In floating point.
#pragma once

#include <vector>

#include "analysis/model/steady_state/phase_grid.hpp"

namespace veritrack::model {

/// Which modes share a block of the constant matrix, and their basis: such as are nearly parallel and pairs
/// of complex ones, orthonormal; or all, so that the mean of the basis over the phase is the unit matrix.
/// Which gives better bounds depends on the loop.
enum class FloquetGauge { by_mode, by_state };

/// A basis over the phase. The first `modes` columns are modes, in groups; the others are constant.
struct FloquetBasis {
  Eigen::MatrixXd values;     ///< n^2 x grid.size(): column-major matrices
  std::vector<int> group_of;  ///< by mode, in order, from 0

  [[nodiscard]] Eigen::Index modes() const { return static_cast<Eigen::Index>(group_of.size()); }
};

/// `jacobians`: n^2 x grid.size(), column-major matrices A(phi). A mode is p with A(phi) p(phi) = lambda
/// p(phi + omega). Each multiplier has others beside it, lambda e^(i h omega); taken is the one with the
/// argument within omega / 2 and the fewest harmonics. Parts that decay by a factor of 20 or more while the
/// phase turns by a radian are no modes (their size may depend on the phase by orders of magnitude), nor are
/// states that only delay others: unit vectors complete the basis. By state: no modes where there is no such
/// basis.
[[nodiscard]] FloquetBasis floquet_modes(const PhaseGrid& grid, double omega,
                                         const Eigen::MatrixXd& jacobians, Eigen::Index states,
                                         FloquetGauge gauge);

}  // namespace veritrack::model
