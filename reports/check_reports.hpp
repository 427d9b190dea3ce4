// The verdicts on requirements in the formats that continuous integration reads.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::reports {

/// A certificate together with the path of its design file as the user gave it.
struct CheckedDesign {
  std::string path;
  certificates::Certificate certificate;
};

/// JUnit XML: a test suite for each design, a test case for each requirement; REFUTED and UNDECIDED are
/// failures of that type.
[[nodiscard]] std::string to_junit(const std::vector<CheckedDesign>& designs);

/// SARIF 2.1.0: a result for each requirement that is not PROVED, at its line; REFUTED is an error, UNDECIDED
/// a warning.
[[nodiscard]] std::string to_sarif(const std::vector<CheckedDesign>& designs);

}  // namespace veritrack::reports
