// Several cells of phase and frequency at once: window_claim.cpp covers a period and a band with them, and
// window_cell_lanes.hpp says what has to hold in each.
#pragma once

#include "analysis/single_channel/covariance_window.hpp"

namespace veritrack::single_channel {

/// Up to kMost cells, a column each. Plain arrays, which units for different processors share.
struct WindowCells {
  static constexpr int kMost = 8;
  int count = 0;
  double phase[2][kMost];      ///< from, to; rad NOLINT: plain
  double frequency[2][kMost];  ///< rad/sample NOLINT
};

/// The claims to be shown in each of them: a WindowClaim, and whether diagonal matrices are below every
/// covariance.
struct WindowTask {
  static constexpr int kMostStarts = 3;
  trackers::ToneModel<rigor::Interval> design;
  WindowAssumption assumption;
  WindowLength length;
  const double* shares = nullptr;  ///< length.window of them
  double curvature = 0.0;
  double curvature_weight = 1.0;
  double signal_uncertainty = 0.0;
  int starts = 0;
  rigor::Interval start_signal[kMostStarts];     // NOLINT
  rigor::Interval start_frequency[kMostStarts];  // NOLINT
};

/// The result of examining them.
struct WindowAnswers {
  bool holds[WindowCells::kMost];                              ///< the claim, certainly NOLINT
  bool is_below[WindowTask::kMostStarts][WindowCells::kMost];  ///< the start, certainly NOLINT
  double p11[WindowCells::kMost];                              ///< below those of every covariance NOLINT
  double p22[WindowCells::kMost];                              // NOLINT
  double p33[WindowCells::kMost];                              // NOLINT
};

namespace detail {
using CheckWindow = void(const WindowTask& task, const WindowCells& cells, WindowAnswers& answers);
CheckWindow check_window_avx2;
CheckWindow check_window_avx512;
}  // namespace detail

}  // namespace veritrack::single_channel
