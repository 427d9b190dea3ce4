// The checker's answer on a certificate and its documents before they were written.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace veritrack::certificates {

/// A part of a certificate, or a file beside it, that the checker refuses.
struct RefusedPart {
  std::string name;
  std::vector<std::string> objections;
};

/// The answer of this release's veritrack-verify.
struct Verification {
  enum class Outcome {
    left_out,  ///< it was not asked
    verified,  ///< it verifies all parts
    refused    ///< it does not, or it gave no answer
  };
  Outcome outcome = Outcome::left_out;
  std::size_t parts = 0;                  ///< that it examined
  std::vector<RefusedPart> refused = {};  ///< empty when it gave no answer
  std::string failure = {};               ///< why it gave no answer, in one line; empty when it gave one
};

}  // namespace veritrack::certificates
