// Bounds of a loop's errors that are resolved over the phases (docs/gain-proof.md, section 10).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/gain/gain_bounds.hpp"
#include "analysis/model/gain/phase_kernels.hpp"

namespace veritrack::model {

/// Bounds of the frequency error, rad/sample.
struct PhaseErrors {
  double for_ever = 0.0;
  std::vector<double> from_block;  ///< from the first sample of each block of the horizon on
  double long_run = 0.0;
  double linear = 0.0;         ///< in the long run to first order, without bias and remainders
  double bias = 0.0;           ///< the largest of the steady state, at any phase
  rigor::Interval mean;        ///< over the phase, in the long run
  double ripple = 0.0;         ///< the difference between the highest and the lowest error in the long run
  std::vector<double> states;  ///< with rounding: how far each is from the curve, at most

  /// Those of both.
  void join(const PhaseErrors& other);
};

/// Bounds for some parts together: for one part at a constant frequency, or, with a slew, for all parts of a
/// cell.
class PhaseGains {
 public:
  /// Empty unless errors decay. `slew`: up to which there are bounds. Needs the upward rounding mode.
  [[nodiscard]] static std::optional<PhaseGains> make(std::vector<PhasePart> parts,
                                                      const PhaseGridding& gridding, double slew);
  PhaseGains(PhaseGains&&) = default;
  PhaseGains& operator=(PhaseGains&&) = default;
  PhaseGains(const PhaseGains&) = delete;  // the kernels refer to the parts
  PhaseGains& operator=(const PhaseGains&) = delete;
  ~PhaseGains() = default;

  /// Empty where no bound closes, and for a slew beyond that with which this was made.
  [[nodiscard]] std::optional<PhaseErrors> errors(const LoopDisturbance& disturbance) const;
  [[nodiscard]] std::size_t states() const { return parts_.front().states; }
  /// The error of the sums on the grid in the gain from noise to the frequency error, relative to it.
  [[nodiscard]] double missed_share() const;
  /// From noise to the frequency error, without that.
  [[nodiscard]] double largest_gain() const { return linear_error({1.0, 0.0, {}}); }
  /// The largest frequency error on the curve, rad/sample.
  [[nodiscard]] double largest_bias() const;
  /// What a program's frequency is off from that of its states, rad/sample.
  [[nodiscard]] double rounding_of_frequency() const;
  [[nodiscard]] std::optional<std::pair<std::size_t, rigor::Interval>> frequency_state() const;

 private:
  PhaseGains() = default;
  using Bounds = std::vector<std::vector<double>>;  ///< by cell of phases, by form
  [[nodiscard]] std::vector<double> sizes(const PhasePart& part, double noise,
                                          const std::vector<double>& bounds, std::size_t phase) const;
  /// The sizes of the inputs with columns, and of all inputs, at these bounds, for all parts.
  struct Sizes {
    std::vector<std::vector<std::vector<double>>> of_input;  ///< by part, cell, input
    std::vector<std::vector<double>> of_column;              ///< by gate, cell: the largest of all parts
  };
  [[nodiscard]] Sizes sizes_at(double noise, const Bounds& bounds) const;
  [[nodiscard]] Bounds after(const LoopDisturbance& disturbance, const Bounds& bounds) const;
  void add_part(const LoopDisturbance& disturbance, const Sizes& sizes, std::size_t part,
                Bounds& result) const;
  [[nodiscard]] static Bounds plus(const Bounds& bounds, const std::vector<double>& by_form);
  /// Bounds of these disturbances and what starts add, by form. Empty where none close.
  [[nodiscard]] std::optional<Bounds> closed(const LoopDisturbance& disturbance,
                                             const std::vector<double>& from_start) const;
  [[nodiscard]] double error_of(const Bounds& bounds) const;
  /// With the rounding of a program, which rounds starts, too.
  [[nodiscard]] std::vector<double> rounded(const std::vector<double>& start) const;
  /// Deviations of states, at most, in the basis.
  [[nodiscard]] std::vector<double> in_basis(const std::vector<double>& start) const;
  [[nodiscard]] Bounds in_long_run(const LoopDisturbance& disturbance, Bounds bounds) const;
  [[nodiscard]] double linear_error(const LoopDisturbance& disturbance) const;
  void add_mean_and_ripple(const Bounds& bounds, PhaseErrors& errors) const;

  std::vector<PhasePart> parts_;
  std::vector<PhaseKernels> kernels_;
  std::size_t phases_ = 0;
  double slew_ = 0.0;
};

}  // namespace veritrack::model
