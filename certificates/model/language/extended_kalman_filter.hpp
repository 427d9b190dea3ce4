// The extended Kalman filter of a model, written out: its estimate and its covariance as one recursion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/model/language/compiler.hpp"
#include "trackers/model/filter_parts.hpp"

namespace veritrack::certificates::language {

/// The model that the filter is made for.
struct FilterModel {
  std::vector<std::string> states;
  std::vector<Definition> predict;  ///< the next value of each state
  std::vector<Expression> measure;  ///< one for each sample
  /// F = df/dx in formulas of the states, where it is not the derivative of `predict`; otherwise empty.
  std::vector<std::vector<Expression>> jacobian;
  std::vector<std::vector<Expression>> process_noise;      ///< Q: as many rows and columns as states
  std::vector<std::vector<Expression>> measurement_noise;  ///< R: as many rows and columns as samples
};

/// The states of the filter: those of the model, then the upper triangle of the covariance row by row, P.a.b.
[[nodiscard]] std::vector<std::string> filter_states(const std::vector<std::string>& states);

/// Literals that the derivatives need beside those of the formulas: to be collected with them.
[[nodiscard]] std::vector<Expression> literals_of_derivatives(const FilterModel& model);

/// One step of the filter from the filtered estimate and covariance to the next ones: prediction with F =
/// df/dx at the filtered estimate, P- = F P F' + Q; measurement with H = dh/dx at the predicted estimate, K =
/// P- H' (H P- H'
/// + R)^-1, P = P- - K H P-. Derivatives are those of the formulas, by the chain rule; terms that are 0
/// because a formula does not depend on a state, or an entry of Q or R is written as 0, are left out. Inputs:
/// the constants, filter_states, the samples. Throws LanguageError.
[[nodiscard]] CompiledProgram compile_filter(const FilterModel& model, const Constants& constants,
                                             const std::vector<std::string>& samples, Position place);

/// Whether one of the results first, ..., last - 1 of a program depends on an input with this number or a
/// larger one.
[[nodiscard]] bool depends_on_inputs(const trackers::StraightLineProgram& program, int input,
                                     std::size_t first, std::size_t last);

/// The same filter by its parts. Empty unless the measurement is linear: entries of H that depend on the
/// state would make the updated covariance depend on it in another way. F may be given.
[[nodiscard]] std::optional<trackers::FilterParts> compile_filter_parts(
    const FilterModel& model, const Constants& constants, const std::vector<std::string>& samples,
    Position place);

}  // namespace veritrack::certificates::language
