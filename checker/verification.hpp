// The whole certificate: every part that claims something is verified, or says why not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/json_tree.hpp"

namespace veritrack::checker {

/// A derivation, a set, a claim, or another part.
struct Part {
  std::string name;
  std::vector<std::string> objections;  ///< none: verified
};

struct Verification {
  std::vector<Part> parts;
  std::int64_t cells = 0;  ///< boxes that the contraction sets took
  /// True only when every part is verified, and there is one.
  [[nodiscard]] bool verified() const;
};

/// Throws Malformed for what is not a certificate of this format.
Verification verify(const Tree& certificate);

}  // namespace veritrack::checker
