// Which line of a program makes most of its rounding, and what would be left if it were computed in double
// precision.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/code/listing_rounding.hpp"
#include "analysis/model/question/proved_sets.hpp"
#include "certificates/code/compilation.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

/// A line of the user's source.
struct RoundingLine {
  trackers::code::Place place;            ///< of the line's first operation
  std::optional<std::size_t> integrator;  ///< a state that the line adds to and stores in single precision
  double left = 0.0;                      ///< the error by rounding with the line in double precision
  double all = 0.0;                       ///< and as it is
};

/// The line whose rounding contributes most, by `gains` from what each state's step is off to the error, when
/// the step begins in these ranges; nothing where no line makes half of it. In double precision a line also
/// keeps the states that it stores in double precision. Needs the upward rounding mode.
[[nodiscard]] std::optional<RoundingLine> line_of_most_rounding(const code::CompiledCode& code,
                                                                const model::code::StepRanges& ranges,
                                                                const std::vector<double>& gains);

/// The same of a proof, in words: "Most of the rounding is in line 38 of pll.c: ..."; empty where there is
/// nothing to say.
[[nodiscard]] std::string rounding_line_text(const ModelTables& tables, const model::GainProof& proof,
                                             const FrequencyUnits& units);

}  // namespace veritrack::certificates
