// Two certificates compared: what is better, what is worse, and what of the design is another.
#pragma once

#include <string>
#include <vector>

namespace veritrack::reports {

/// A difference between an old and a new certificate.
struct CertificateChange {
  enum class Kind {
    better,
    worse,
    other  ///< of the design, or of a published result
  };
  Kind kind = Kind::other;
  std::string text;  ///< one line: what, and from what to what
};

/// Throws std::invalid_argument, which says what is wrong, for a text that is no certificate.json.
void require_certificate(const std::string& text);

/// From certificate.json to certificate.json. A claim that is PROVED no more, a verdict or a bound that is
/// worse is worse; bounds whose relative change is at most `tolerance` are the same. A value that is known
/// from one side only says itself which way is better. Verifies nothing. Throws std::invalid_argument for a
/// text that is no certificate.
[[nodiscard]] std::vector<CertificateChange> certificate_changes(const std::string& old_text,
                                                                 const std::string& new_text,
                                                                 double tolerance);

}  // namespace veritrack::reports
