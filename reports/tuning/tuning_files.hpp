// The files that `veritrack tune` writes beside the certificate of the tuned design.
#pragma once

#include <filesystem>
#include <string>

#include "certificates/document/tuning.hpp"

namespace veritrack::reports {

/// tuning.md: what was gained, what would have to change, the figure, and the designs of the trade-off.
/// `tuned_name`: of the tuned design file; `has_figure`: figures/trade-off.svg is there.
[[nodiscard]] std::string tuning_document(const certificates::TuningResult& result,
                                          const std::string& tuned_name, const std::string& caption);

/// A line for each design that was looked at: role, values, response, objective, whether all is met.
[[nodiscard]] std::string tuning_table(const certificates::TradeOff& trade_off);

/// Writes tuning.md, tuning.csv and figures/trade-off.svg into `directory`; without gnuplot all but the
/// figure, whose reason is the result. The tuning must have a trade-off. Throws certificates::OutputError.
std::string write_tuning_files(const certificates::TuningResult& result, const std::string& tuned_name,
                               const std::filesystem::path& directory);

}  // namespace veritrack::reports
