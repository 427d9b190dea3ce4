// certificate.md of a loop that is certified by gains: its error budget, its limits, and what is covered.
#pragma once

#include <string>
#include <string_view>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

/// Needs the upward rounding mode, and model_sets(certificate).gains.
[[nodiscard]] std::string model_gains_section(const Certificate& certificate, const Model& model,
                                              const MarkdownOptions& options);

/// The most that is tolerated of each disturbance alone, by these sets, each of which may be none; empty
/// where nothing is.
[[nodiscard]] std::string gain_limits_table(const model::ProvedSet* noise, const model::ProvedSet* slew,
                                            const model::ProvedSet& starts, const FrequencyUnits& units);

/// The section on what is covered by gains alone. `steady_state`: what it is in the document, "table".
[[nodiscard]] std::string gains_coverage_section(const ModelTables& tables, bool is_rounded,
                                                 std::string_view steady_state);

}  // namespace veritrack::certificates
