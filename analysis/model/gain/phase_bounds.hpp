// Bounds of a loop's errors that are resolved over the phases (docs/gain-proof.md, section 10).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/gain/grid_function.hpp"
#include "analysis/model/gain/phase_step.hpp"

namespace veritrack::model {

/// How the bounds are computed: the cells of phases, the horizon, and the parts of the frequencies.
struct PhaseGridding {
  std::size_t phases = 64;
  std::size_t horizon = 1024;
  std::size_t parts = 1;
};

/// Bounds of the frequency error, rad/sample, of starts in the steady state or near it.
struct PhaseErrors {
  double for_ever = 0.0;
  double long_run = 0.0;
  double linear = 0.0;  ///< of the noise alone, to first order, without the bias
};

/// The loop over one part of the frequencies of a cell.
class PhaseLoop {
 public:
  /// Empty unless errors decay. Throws NoFrame where the rules do not cover the loop. Needs the upward
  /// rounding mode.
  [[nodiscard]] static std::optional<PhaseLoop> make(const TrackerModel& tracker, const FloquetCell& cell,
                                                     const PhaseGridding& gridding, std::size_t part);

  /// For noise of at most this size, from starts in the steady state. Empty where no bound closes.
  [[nodiscard]] std::optional<PhaseErrors> errors(double noise) const;

 private:
  using Bounds = std::vector<std::vector<double>>;  ///< by cell of phases, by form
  /// Of one form and one input: sums over the lags of a window of source cells, by dest cell, corner, window.
  struct Kernel {
    std::vector<double> sums;
    double missed = 0.0;
  };
  struct Window {
    std::size_t offset = 0;  ///< the first cell, from the dest cell on
    std::size_t width = 0;
  };
  void find_windows(const FloquetCell& cell, const PhaseGridding& gridding, std::size_t part);
  bool find_kernels();
  [[nodiscard]] std::optional<std::vector<double>> total_of(const std::vector<GridFunction>& columns) const;
  [[nodiscard]] double missed_of(const GridFunction& form, const GridFunction& column,
                                 const std::vector<double>& total) const;
  void add_sums(const GridFunction& form, const std::vector<GridFunction>& columns,
                std::vector<double>& sums) const;
  [[nodiscard]] std::vector<double> sizes(double noise, const std::vector<double>& bounds,
                                          std::size_t phase) const;
  [[nodiscard]] Bounds after(double noise, const Bounds& bounds) const;
  [[nodiscard]] double error_of(const Bounds& bounds) const;

  std::vector<PhaseStep> steps_;  ///< by cell of phases
  std::size_t states_ = 0, phases_ = 0, horizon_ = 0;
  double first_ = 0.0, half_width_ = 0.0;  ///< of the frequencies
  std::vector<std::vector<rigor::Interval>> matrix_;
  std::vector<double> powers_;                          ///< of the matrix, by lag, rows
  std::vector<double> power_sum_, power_sum_weighted_;  ///< of absolute values; weighted with L ceil L
  std::vector<double> defect_;                          ///< M
  std::vector<Window> windows_;
  std::vector<std::size_t> window_of_;        ///< by lag
  std::vector<std::vector<Kernel>> kernels_;  ///< by form, by gate
  std::vector<std::vector<double>> noise_;    ///< by form, by phase: gains of the noise
  std::vector<double> residual_;              ///< by form
};

}  // namespace veritrack::model
