// Parts of the band that are bounded together: all of them where the frequency moves, else each by itself
// (docs/gain-proof.md, section 10).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "checker/model/gain/phase_kernels.hpp"
#include "checker/model/gain/phase_part.hpp"
#include "checker/model/gain/size_vectors.hpp"

namespace veritrack::checker {

class PhaseGroup {
 public:
  /// For changes of the frequency of at most `slew` in a sample (rad/sample); 0: the parts are one. The parts
  /// go from low frequencies to high ones, and must outlive this.
  PhaseGroup(std::vector<const PhasePart*> parts, std::size_t phases, const PhaseHorizon& horizon,
             double slew);

  PhaseGroup(PhaseGroup&&) = default;
  PhaseGroup& operator=(PhaseGroup&&) = default;
  PhaseGroup(const PhaseGroup&) = delete;  // parts refer to those of the group itself
  PhaseGroup& operator=(const PhaseGroup&) = delete;
  ~PhaseGroup() = default;

  /// Whether all sums are bounded, and what starts and early inputs leave dies out. Nothing else is known
  /// where it is not so.
  [[nodiscard]] bool is_certain() const { return is_certain_; }
  [[nodiscard]] std::size_t size() const { return parts_.size(); }
  [[nodiscard]] const PhasePart& part(std::size_t number) const { return *parts_[number]; }
  [[nodiscard]] const PhaseKernels& kernels(std::size_t number) const { return kernels_[number]; }
  [[nodiscard]] std::size_t phases() const { return phases_; }
  [[nodiscard]] double slew() const { return slew_; }

  /// The factor of the largest size of an input.
  [[nodiscard]] double rest(std::size_t part, std::size_t form, std::size_t input) const {
    return rests_[part][form][input];
  }
  /// The amount that the residual of the curve adds to a form.
  [[nodiscard]] double of_residual(std::size_t part, std::size_t form) const {
    return residuals_[part][form];
  }
  /// The amount that a program's rounding adds to a form.
  [[nodiscard]] double of_rounding(std::size_t part, std::size_t form) const {
    return roundings_[part][form];
  }
  /// M p, where p bounds all products of matrices with these deviations from the steady state, by part;
  /// nothing where it is not known.
  [[nodiscard]] std::optional<Table> late_starts(const std::vector<double>& start) const;
  /// Deviations of eta, from those of the states.
  [[nodiscard]] std::vector<double> components(std::size_t part, const std::vector<double>& start) const;

 private:
  /// A part with what the move of the frequency after its step multiplies everything by.
  struct Widened {
    Table of_matrix;  ///< by how much more the matrix may differ
    std::vector<std::array<std::vector<double>, 2>> column_errors;
    std::vector<double> residual, rounding;
  };
  [[nodiscard]] std::optional<Widened> widened(const PhasePart& part) const;
  [[nodiscard]] std::vector<PhaseStage> stages(const std::vector<Widened>& all, std::size_t part) const;
  /// Adds what comes in at every step, of these sizes, to each form. False where no bound is known.
  [[nodiscard]] bool add_steady(const std::vector<double>& sizes, Table& of_forms) const;
  [[nodiscard]] bool close(const std::vector<Widened>& all);
  [[nodiscard]] std::vector<const Table*> defects() const;

  std::vector<PhasePart> flat_;  ///< with a slew: the parts without what leans
  std::vector<const PhasePart*> parts_;
  std::size_t phases_;
  double slew_;
  std::vector<PhaseKernels> kernels_;
  std::vector<Table> rests_;  ///< by part, form and input
  Table residuals_;           ///< by part and form
  Table roundings_;           ///< the same
  bool is_certain_ = false;
};

}  // namespace veritrack::checker
