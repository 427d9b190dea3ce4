// What `veritrack check` tells: lines on the standard streams, and reports.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "reports/check/checked_design.hpp"

namespace veritrack::cli {

/// Prints what came of a design or a report: on standard error what makes the exit status 2, else on standard
/// output; for GitHub an annotation as well.
void print_checked(const reports::CheckedDesign& design);

/// The reports that cannot be written, of those that are asked for. None is written, and none may be one of
/// the designs.
[[nodiscard]] std::vector<reports::CheckedDesign> unwritable_reports(const CheckOptions& options,
                                                                     const std::vector<std::string>& designs);

/// Writes the reports, but for those of which `checked` says that they cannot be written. What turns out to
/// be another one of them is printed and added to `checked`, and is in the others.
void write_reports(const CheckOptions& options, std::vector<reports::CheckedDesign>& checked);

}  // namespace veritrack::cli
