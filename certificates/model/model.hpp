// A tracker that a user has written down, made ready to run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/model/language/compiler.hpp"
#include "certificates/model/language/written_listing.hpp"
#include "certificates/model/model_design.hpp"
#include "trackers/model/filter_parts.hpp"
#include "trackers/model/model_tracker.hpp"

namespace veritrack::certificates {

/// The recursion of a design, with its names. Programs begin their inputs with the values of `constants`.
struct Model {
  language::Constants constants;
  std::vector<std::string>
      parameter_texts;  ///< the formulas of the parameters, which are the first constants
  std::vector<std::string> samples;
  std::vector<std::string> states;
  trackers::Recursion recursion;
  /// For a filter with a linear measurement, whose frequency is a formula of the estimate.
  std::optional<trackers::FilterParts> filter;
  language::CompiledProgram step;                   ///< of the recursion, with places and names
  language::CompiledProgram frequency;              ///< likewise
  trackers::StraightLineProgram start{0};           ///< inputs A, omega: the state where a search begins
  std::optional<language::WrittenListing> written;  ///< in an arithmetic that is not exact
  trackers::StraightLineProgram signal{0};          ///< inputs A, phi: the samples, 2 pi-periodic in phi
};

/// The formulas of the signal; where none are given, the tone alone: in phase, and in quadrature.
[[nodiscard]] std::vector<SourceText> signal_of(const ModelTable& table,
                                                const std::vector<SourceText>& signal);

/// Whether the signal is the tone alone, written out or not.
[[nodiscard]] bool is_pure_tone(const ModelTables& tables);

/// Throws language::LanguageError, with a position in the design file, for what cannot be understood. Needs
/// the upward rounding mode.
[[nodiscard]] Model make_model(const ModelTable& table, const std::vector<SourceText>& signal);

/// The largest deviation of each state at the start; 0 for those that are not named. Throws
/// language::LanguageError. Needs the upward rounding mode.
[[nodiscard]] std::vector<rigor::Interval> start_deviations(const Model& model, const ModelTable& table,
                                                            const std::vector<NamedText>& start_within);

/// The state in which the tracker is started, a value for each state, or none where none is given. Throws
/// language::LanguageError, also where a state is missing. Needs the upward rounding mode.
[[nodiscard]] std::vector<rigor::Interval> exact_start(const Model& model, const ModelTable& table,
                                                       const std::vector<NamedText>& start_exactly);

}  // namespace veritrack::certificates
