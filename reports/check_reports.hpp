// The verdicts on requirements in the formats that continuous integration reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::reports {

/// What came of a design file, with its path as the user gave it.
struct CheckedDesign {
  std::string path;
  std::optional<certificates::Certificate> certificate;  ///< none when there was an error
  std::string error;                                     ///< one line: what is wrong with the file
  certificates::Position position;                       ///< of the error in the file; line 0 without one
};

/// JUnit XML: a test suite for each design, a test case for each requirement; REFUTED and UNDECIDED are
/// failures of that type, a file that cannot be used is one test case with an error.
[[nodiscard]] std::string to_junit(const std::vector<CheckedDesign>& designs);

/// SARIF 2.1.0: a result for each requirement that is not PROVED, at its line; REFUTED is an error, UNDECIDED
/// a warning. A file that cannot be used is an error.
[[nodiscard]] std::string to_sarif(const std::vector<CheckedDesign>& designs);

}  // namespace veritrack::reports
