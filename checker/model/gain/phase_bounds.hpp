// Bounds on the errors of a loop whose errors depend on the phase (docs/gain-proof.md, section 10, theorem
// 2).
#pragma once

#include <memory>
#include <vector>

#include "checker/model/gain/loop_bounds.hpp"
#include "checker/model/gain/phase_group.hpp"

namespace veritrack::checker {

/// The verified evidence, but for the sums over the lags, which depend on the slew.
struct PhaseLoopEvidence {
  PhaseStructure structure;
  std::vector<std::vector<PhasePart>> cells;  ///< by cell: its parts, from low frequencies to high ones
  std::size_t phases = 0;
  PhaseHorizon horizon;
  std::vector<Ball> frequency_factors;    ///< by state: the derivative of the frequency, wherever it is
  std::optional<RoundedProgram> program;  ///< then states are forms; none: exact arithmetic
};

/// Bounds by form and cell of phases.
using PhaseTable = Table;

/// The fixed point of a group of parts.
class PhaseSolver {
 public:
  PhaseSolver(const PhaseLoopEvidence& evidence, const PhaseGroup& group, double noise,
              const std::vector<double>& start);

  /// Bounds that contain their own right side; nothing where none are found. `near` may be such bounds of
  /// another group, from which the search begins.
  [[nodiscard]] std::optional<PhaseTable> for_ever(const PhaseTable* near) const;
  /// The right side in the long run, from bounds of all later samples.
  [[nodiscard]] PhaseTable in_long_run(PhaseTable bounds) const;
  /// Bounds of the form of the frequency by cell of phases, from this sample on, by part.
  [[nodiscard]] Table errors_from(std::size_t sample, const PhaseTable& for_ever) const;

 private:
  struct Sizes;
  [[nodiscard]] std::optional<Sizes> sizes_at(const PhaseTable& bounds) const;
  [[nodiscard]] std::vector<double> of_form(const Sizes& sizes, std::size_t part, std::size_t form,
                                            double start) const;
  [[nodiscard]] std::optional<PhaseTable> next(const PhaseTable& bounds, bool is_started) const;
  /// Whether states are within their room.
  [[nodiscard]] bool keeps_room(const PhaseTable& bounds) const;
  [[nodiscard]] double direct(const Sizes& sizes, std::size_t part, std::size_t form, std::size_t cell) const;
  [[nodiscard]] double of_start(std::size_t part, std::size_t form, std::size_t first) const;

  const PhaseLoopEvidence* evidence_;
  const PhaseGroup* group_;
  double noise_;
  std::vector<double> start_;                ///< of eta
  std::optional<Table> late_starts_;         ///< M p by part
  Table starts_;                             ///< by part and form
  std::vector<std::vector<EndSums>> given_;  ///< of noise and slew, by part and form
  Table given_rest_;                         ///< by part and form
};

class PhaseBounds : public LoopBounds {
 public:
  explicit PhaseBounds(PhaseLoopEvidence evidence) : evidence_(std::move(evidence)) {}

  /// Whether sums are bounded with such a slew.
  [[nodiscard]] bool is_certain(const Ball& slew) const;
  [[nodiscard]] std::size_t states() const override { return evidence_.structure.states; }
  [[nodiscard]] std::unique_ptr<FrequencyErrors> errors(const Ball& noise, const Ball& slew,
                                                        const std::vector<Ball>& start) const override;
  [[nodiscard]] std::vector<Ball> starts_within(const Ball& reach) const override;

  [[nodiscard]] bool is_rounded() const override { return evidence_.program.has_value(); }

 private:
  [[nodiscard]] Ball rounding_of_frequency() const;
  /// A program rounds its starts, too.
  void add_rounding_of_start(std::vector<double>& deviations) const;
  using Groups = std::vector<std::shared_ptr<const PhaseGroup>>;
  /// The groups for a slew; they are kept until they are asked for with another one.
  [[nodiscard]] const Groups& groups(double slew) const;

  PhaseLoopEvidence evidence_;
  mutable Groups groups_;
  mutable double slew_of_groups_ = -1.0;
};

}  // namespace veritrack::checker
