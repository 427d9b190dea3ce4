// The checker's own result for a derivation, and its comparison with the certificate.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

enum class Verdict { undecided, proved, refuted };

/// Is x < y, or x <= y? PROVED only when it is true of all points, REFUTED only when its negation is.
Verdict decide_less(const Ball& x, const Ball& y);
Verdict decide_at_most(const Ball& x, const Ball& y);
/// REFUTED when one is, PROVED when all are and there is at least one.
Verdict all_of(const std::vector<Verdict>& verdicts);
/// "proved" or "refuted". Throws Malformed for anything else.
Verdict verdict_from(const std::string& text);
inline Verdict proved_if(bool certain) {
  return certain ? Verdict::proved : Verdict::undecided;
}

/// The objections to a part of a certificate; empty when it is verified.
using Objections = std::vector<std::string>;

/// The forms of a certificate's statement on a value: it lies between lo and hi, is at most hi, or is at
/// least lo. Where both sides may be stated, one side alone may be, too.
enum class Sense { encloses, bounds_above, bounds_below };

struct Quantity {
  std::string name;
  Range value;
  Sense sense = Sense::encloses;
};

struct Condition {
  std::string id, statement;
  Verdict verdict = Verdict::undecided;
  std::optional<Range> lhs = std::nullopt, rhs = std::nullopt;
  Sense lhs_sense = Sense::encloses;
};

/// A derivation as the checker computes it.
struct Derivation {
  std::string title;
  std::vector<Quantity> quantities;
  std::vector<Condition> conditions;
};

/// A claim as the checker computes it.
struct Claim {
  std::string statement;  ///< one sentence with all its hypotheses
  Verdict verdict = Verdict::undecided;
  std::vector<Quantity> evidence;
  bool is_summary = false;      ///< belongs to the block at the top of the document
  std::string hypotheses = {};  ///< its beginning, if it belongs to the block at the top
  std::string finding = {};     ///< in short, where the headline names it once it is refuted
};

/// [lo, hi] as a ball.
Ball read_enclosure(const Tree& enclosure, const std::string& name, Objections& objections);
/// Objects unless the statement on the value, in `lo` and `hi`, is true of it. An enclosure that shares no
/// point with the value is an alarm.
void check_enclosure(const Tree& enclosure, const Quantity& quantity, Objections& objections);
/// Objects unless the checker came to this verdict as well. A certificate does not state what is undecided.
void check_verdict(const std::string& claimed, Verdict found, const std::string& name,
                   Objections& objections);

/// Compares all quantities, all conditions and the verdict of `claimed` with `found`. A certificate may state
/// less than was found, but a derivation is PROVED only when all of its conditions are there. Returns the
/// title of the derivation.
std::string check_derivation(const Tree& claimed, const Derivation& found, Objections& objections);
/// The verdict of a derivation: UNDECIDED when the certificate does not state it.
Verdict verdict_of(const Tree& derivation);

/// The same for a claim.
void check_claim(const Tree& claimed, const Claim& found, Objections& objections);

}  // namespace veritrack::checker
