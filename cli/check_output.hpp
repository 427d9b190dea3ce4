// The output of `veritrack check`: lines on the standard streams, and reports.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "reports/check/checked_design.hpp"

namespace veritrack::cli {

/// Prints what came of a design or a report: on standard error what makes the exit status 2, else on standard
/// output; for GitHub an annotation as well.
void print_checked(const reports::CheckedDesign& design);

/// The requested reports that cannot be written. This writes none; no report may be one of the designs.
[[nodiscard]] std::vector<reports::CheckedDesign> unwritable_reports(const CheckOptions& options,
                                                                     const std::vector<std::string>& designs);

/// Writes the reports, except those that `checked` says cannot be written. A further report that turns out to
/// be one of these is printed, added to `checked`, and named in the others.
void write_reports(const CheckOptions& options, std::vector<reports::CheckedDesign>& checked);

}  // namespace veritrack::cli
