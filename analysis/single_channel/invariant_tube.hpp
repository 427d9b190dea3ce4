// A tube about a curve over the phase, for each frequency of an interval: in which the single-channel
// tracker's steady state is sought. The proof is in tube_verification.hpp.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/single_channel/phase_series.hpp"

namespace veritrack::single_channel {

/// A part of the period with its coordinates.
struct CurveCell {
  rigor::Interval phase;
  rigor::Matrix<9> matrix;           ///< V
  rigor::IntervalMatrix<9> inverse;  ///< V^-1, enclosed
  std::vector<std::size_t> targets;  ///< the cells that meet this one moved on by omega, modulo pi
  std::array<double, 9> reach;       ///< |row of V|, upper bounds
};

/// {(phi, C(phi; omega) + V_i u) : phi in cell i, |u| <= R}, R to be chosen.
struct InvariantTube {
  trackers::ToneModel<rigor::Interval> design;
  rigor::Interval frequency;  ///< rad/sample
  PhaseFamily curve;
  std::vector<CurveCell> cells;
  double expected_rate = 1.0;  ///< by which the map is expected to contract in the coordinates
};

/// Coordinates for `count` cells along the curve in the middle of the interval; nothing when there are none
/// or a matrix could not be inverted.
[[nodiscard]] std::optional<InvariantTube> propose_tube(const trackers::ToneModel<rigor::Interval>& design,
                                                        const rigor::Interval& frequency,
                                                        const PhaseFamily& curve, std::size_t count);

/// |x| from above; infinite when x is not finite. Needs the upward mode.
[[nodiscard]] double length(const rigor::IntervalVector<9>& x);

/// Calls body(cell index) for every cell, in parallel, in the upward mode.
template <typename Body>
void for_each_cell(const InvariantTube& tube, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tube.cells.size()), [&](const auto& range) {
    const rigor::UpwardRounding upward;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      body(i);
    }
  });
}

}  // namespace veritrack::single_channel
