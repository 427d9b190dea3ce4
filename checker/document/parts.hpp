// The parts of a certificate, each with its objections, and the sentences that are established.
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

/// A claim of the certificate in the checker's own words.
struct Sentence {
  std::string id;
  Verdict verdict = Verdict::undecided;  ///< of the sentence as written
  std::string text;                      ///< with all hypotheses
  bool is_summary = false;               ///< belongs to the block at the top of the document
  std::string hypotheses = {};           ///< the beginning of the text, where it is known
  std::string finding = {};              ///< in short, where the headline names it once it is refuted
};

/// The requirement of a key of [require].
struct Requirement {
  std::string claim;  ///< the id of the claim that decides it
  std::string text;   ///< in short
  Verdict verdict = Verdict::undecided;
};

struct Verification {
  std::vector<Part> parts;
  std::vector<Sentence> sentences;        ///< of the claims that are verified
  std::vector<Requirement> requirements;  ///< in the order of the certificate's claims
  /// Everything that [require] asks for is among them and PROVED, and something is asked for.
  bool requirements_proved = false;
  std::vector<std::string> quoted;  ///< name and source of the design; nothing rests on them
  std::string design_sha256;        ///< of the design file, as the certificate says
  std::int64_t cells = 0;           ///< boxes that the certified sets took
  /// True only when every part is verified, and there is something beside the design and the verdict.
  [[nodiscard]] bool verified() const;
};

/// A kind of tracker. A new one is a folder beside the others and an entry of the registry.
struct TrackerKind {
  const char* name;  ///< the `tracker` of its design files
  /// Adds a part for everything that the certificate says. Throws Malformed for what is not a certificate of
  /// this kind. `all_boxes`: see checker/verification.hpp.
  void (*verify)(const Tree& certificate, bool all_boxes, Verification& result);
};

/// Adds a part for each claim, checked by `check`, which returns the finding on it, and one for the verdict
/// of the certificate: the claims that are marked as required are those that [require] asks for (`asked`),
/// and the verdict is that of all of these together, UNDECIDED where a claim is missing.
void check_claims(const Tree& certificate, std::vector<Requirement> asked,
                  const std::function<Claim(const Tree& claim, Objections& objections)>& check,
                  Verification& result);

}  // namespace veritrack::checker
