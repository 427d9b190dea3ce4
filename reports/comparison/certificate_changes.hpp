// Two certificates compared: better and worse results, and changes of the design.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace veritrack::reports {

/// A difference between an old and a new certificate.
struct CertificateChange {
  enum class Kind {
    better,
    worse,
    accepted,  ///< worse, and meant
    easier,    ///< a result that is better while the contract asks for less, covers less, or is another one
    other      ///< of an engineer's choice, or of a published result
  };
  Kind kind = Kind::other;
  std::string text;  ///< one line: what, and from what to what
  std::string key;   ///< by which it is accepted: of the design, of a claim, or the name of a bound
};

struct CertificateChanges {
  std::vector<CertificateChange> list;
  /// The changes that make the contract easier, so that `easier` results do not count: "assume.noise covers
  /// less".
  std::vector<std::string> loosened;

  [[nodiscard]] int count(CertificateChange::Kind kind) const;
};

/// Thrown for a key that is to be accepted and is the key of nothing that is worse; what() says which are.
class NothingToAccept : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Throws std::invalid_argument, which names the error, for a text that is not a certificate.json.
void require_certificate(const std::string& text);

/// From certificate.json to certificate.json. Worse is a requirement that is gone or asks for less, an
/// assumption that covers less, another tracker, unit or recursion (contract_changes.hpp), a claim that is no
/// longer PROVED, a worse verdict or bound, and a bound that is missing, unless its key is in `accepted`.
/// Bounds whose relative change is at most `tolerance` are the same; contracts are compared exactly. The side
/// of a one-sided bound says which way is better. Verifies nothing. Throws std::invalid_argument for a text
/// that is not a certificate, and NothingToAccept. Opens its own rounding scope.
[[nodiscard]] CertificateChanges certificate_changes(const std::string& old_text, const std::string& new_text,
                                                     double tolerance,
                                                     std::span<const std::string> accepted = {});

}  // namespace veritrack::reports
