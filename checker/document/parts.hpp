// The parts of a certificate, each with what is wrong with it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "checker/document/statement.hpp"

namespace veritrack::checker {

constexpr const char* kUnknown = "no check for this kind";
constexpr const char* kUnverified = "its derivation is not verified";

/// A derivation, a set, a claim, or another part.
struct Part {
  std::string name;
  Objections objections;  ///< none: verified
};

struct Verification {
  std::vector<Part> parts;
  std::int64_t cells = 0;  ///< boxes that the certified sets took
  /// True only when every part is verified, and there is one.
  [[nodiscard]] bool verified() const;
};

/// A kind of tracker. A new one is a folder beside the others and an entry of the registry.
struct TrackerKind {
  const char* name;  ///< the `tracker` of its design files
  /// Adds a part for everything that the certificate says. Throws Malformed for what is not a certificate of
  /// this kind. `all_boxes`: see checker/verification.hpp.
  void (*verify)(const Tree& certificate, bool all_boxes, Verification& result);
};

/// Adds a part for each claim, checked by `check`, and one for the verdict of the certificate: the required
/// claims are those of [require] (`asked`, their ids), each of them is verified, and the verdict
/// is theirs together.
void check_claims(const Tree& certificate, std::vector<std::string> asked,
                  const std::function<void(const Tree& claim, Objections& objections)>& check,
                  Verification& result);

}  // namespace veritrack::checker
