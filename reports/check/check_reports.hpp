// The verdicts on requirements in the formats that continuous integration reads.
#pragma once

#include <string>
#include <vector>

#include "reports/check/checked_design.hpp"

namespace veritrack::reports {

/// JUnit XML: a test suite for each design with the seconds that it took, a test case for each requirement;
/// REFUTED and UNDECIDED are failures of that type, a design without verdicts is one test case with an error,
/// or with a failure where it has to require something. Every report has everything that makes
/// `exit_status_of` 1 or 2.
[[nodiscard]] std::string to_junit(const std::vector<CheckedDesign>& designs);

/// SARIF 2.1.0: an error for each requirement that is not PROVED, at its line, and for each design without
/// verdicts. Paths are relative references, percent-encoded.
[[nodiscard]] std::string to_sarif(const std::vector<CheckedDesign>& designs);

/// JSON, "veritrack/check/1" (check.schema.json): every design in the given order, with all that was found.
[[nodiscard]] std::string to_check_json(const std::vector<CheckedDesign>& designs);

/// Workflow commands of GitHub, a line for each requirement that is not PROVED and each design without
/// verdicts; empty when all is PROVED.
[[nodiscard]] std::string to_annotations(const CheckedDesign& design);

/// A path as a URI reference (RFC 3986): all but unreserved characters and slashes are percent-encoded.
[[nodiscard]] std::string uri_of(const std::string& path);

}  // namespace veritrack::reports
