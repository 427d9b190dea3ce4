// The place in the design file where something happens, for messages about a model.
#pragma once

#include <string>
#include <vector>

#include "certificates/model/model.hpp"

namespace veritrack::certificates {

/// Throws language::LanguageError, with the formula and its place, when a step or a frequency depends on
/// whole turns of an angle, or a formula of the `signal` (those of signal_of) on whole turns of the phase:
/// statements over phases from 0 to 2 pi would not cover the others. Needs the upward rounding mode.
void require_whole_turns(const Model& model, const ModelTable& table, const std::vector<SourceText>& signal);

/// The meaning of an undefined operation of the step, one for each: "the denominator i - 0.5 (line 14) may
/// vanish".
[[nodiscard]] std::vector<std::string> objections_to_operations(const Model& model);

/// The clamps of the step: "clamp(e, -0.3, 0.3) (line 14)", with the value of a limit that is a parameter.
[[nodiscard]] std::vector<std::string> clamps_of(const Model& model);

}  // namespace veritrack::certificates
