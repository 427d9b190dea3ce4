// The result of `veritrack check` for a design file, small enough to be passed between processes and kept.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::reports {

/// A requirement of a design file, decided.
struct CheckedRequirement {
  std::string claim;        ///< id
  std::string requirement;  ///< in short
  std::string reason;       ///< one sentence
  rigor::Verdict verdict = rigor::Verdict::undecided;
  certificates::Position position;
};

/// Why there are no verdicts.
struct CheckObjection {
  enum class Kind {
    bad_input,         ///< the file cannot be used
    failure,           ///< the program could not go on with it
    time_limit,        ///< it was stopped; everything that is required is UNDECIDED
    not_verified,      ///< the checker refuses its certificate, and nothing is required
    nothing_required,  ///< and something has to be
    cannot_write       ///< a report, whose path stands in place of that of a design
  };
  Kind kind = Kind::bad_input;
  std::string message;              ///< one line
  certificates::Position position;  ///< in the file; line 0 without one
};

/// The result for a design file, with its path as the user gave it.
struct CheckedDesign {
  std::string path;
  std::vector<CheckedRequirement> requirements;  ///< none: nothing is required
  std::optional<CheckObjection> objection = {};  ///< then there are no requirements
  double seconds = 0.0;               ///< that it took, or took when it was done; not in every report
  std::optional<bool> verified = {};  ///< by the checker; nothing: it was not asked
  /// A search ended at the time limit: an UNDECIDED requirement may be decided without it.
  bool cut_short = false;
};

/// The joint verdict on all requirements of a design.
enum class CheckOutcome { proved, refuted, undecided, nothing_required, bad };
[[nodiscard]] CheckOutcome outcome_of(const CheckedDesign& design);

/// Whether a longer limit, or none, would give the same verdicts.
[[nodiscard]] bool is_final(const CheckedDesign& design);

/// The exit status that all of them make: 0 when everything required is PROVED, 1 when something is not, 2
/// for a design or a report that is bad.
[[nodiscard]] int exit_status_of(const std::vector<CheckedDesign>& designs);

/// "12 designs: 9 proved, 1 undecided, 2 bad".
[[nodiscard]] std::string summary_of(const std::vector<CheckedDesign>& designs);

/// The requirements with their verdicts.
[[nodiscard]] std::vector<CheckedRequirement> requirements_of(const certificates::Certificate& certificate);

/// Notes the checker's answer on the certificate: `refusal` is the reason why it does not verify it, in one
/// line, or empty. A refused requirement is UNDECIDED for this reason, whatever the certificate says.
void note_verification(CheckedDesign& design, const std::string& refusal);

/// "bad-input", "failure", "time-limit", "not-verified", "nothing-required" or "cannot-write".
[[nodiscard]] std::string to_string(CheckObjection::Kind kind);
/// "proved", "refuted", "undecided", "nothing-required" or "bad".
[[nodiscard]] std::string to_string(CheckOutcome outcome);

/// All but the path as one line of JSON, and back; nothing when the text is not what `to_text` writes.
[[nodiscard]] std::string to_text(const CheckedDesign& design);
[[nodiscard]] std::optional<CheckedDesign> checked_from_text(const std::string& text);

}  // namespace veritrack::reports
