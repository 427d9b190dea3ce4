// The covariance with which the user may start the quadrature tracker, in decimals.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "analysis/sets/start_covariance.hpp"
#include "analysis/statements/derivation.hpp"
#include "certificates/quadrature/quadrature_design.hpp"

namespace veritrack::certificates {

/// P(0|0) in signal units and in the frame of the estimated phase: the matrix of the design file, or, where
/// that says "steady-state" or gives multiples of it, a matrix of five digits next to the filter's steady
/// state at the middle of the band.
struct StartCovarianceText {
  using Entries = std::array<std::array<std::string, 3>, 3>;
  Entries entries;
  bool is_given = false;                                ///< the matrices are those of the design file
  std::optional<Entries> highest;                       ///< the other end of a range of matrices
  std::optional<std::array<std::string, 2>> multiples;  ///< those of the design file
};

/// Needs round-to-nearest.
[[nodiscard]] StartCovarianceText start_covariance_text(const QuadratureEkfTables& tables);

/// The same at amplitude 1, with the multiples that every statement is to cover. Needs the upward mode.
[[nodiscard]] sets::StartCovariance start_covariance(const QuadratureEkfTables& tables);

/// "and with P(0|0) from 0.5 M to 2 M, M = ...": the multiples rounded inward, or as in the design.
[[nodiscard]] std::string covariance_words(const StartCovarianceText& text,
                                           const std::optional<rigor::Interval>& multiples);

/// Adds the evidence "start-covariance", from which the checker takes those words; nothing for a given
/// matrix, which is in the design.
void add_start_covariance(const StartCovarianceText& text, const std::optional<rigor::Interval>& multiples,
                          theorems::Derivation& derivation);

}  // namespace veritrack::certificates
