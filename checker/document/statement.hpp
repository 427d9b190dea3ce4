// What the checker knows of a derivation, and how it is compared with what the certificate says.
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

/// Is x < y, or x <= y? PROVED or REFUTED only when it, or its negation, is true of all points.
Verdict decide_less(const Ball& x, const Ball& y);
Verdict decide_at_most(const Ball& x, const Ball& y);
/// REFUTED when one is, PROVED when all are, and there is one.
Verdict all_of(const std::vector<Verdict>& verdicts);
/// "proved" or "refuted". Throws Malformed for anything else.
Verdict verdict_from(const std::string& text);
inline Verdict proved_if(bool certain) {
  return certain ? Verdict::proved : Verdict::undecided;
}

/// What is wrong with a part of a certificate; nothing when it is verified.
using Objections = std::vector<std::string>;

/// What a certificate may say of a value: that it lies between lo and hi, that it is at most hi, or that it
/// is at least lo. What may be said of both sides may be said of one.
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
  std::string hypotheses = {};  ///< how it begins, of one that belongs to the block at the top
};

/// [lo, hi] as a ball.
Ball read_enclosure(const Tree& enclosure, const std::string& name, Objections& objections);
/// Objects unless what is said of the value, in `lo` and `hi`, is true of it. An enclosure that shares no
/// point with the value is an alarm.
void check_enclosure(const Tree& enclosure, const Quantity& quantity, Objections& objections);
/// Objects unless the checker came to this verdict as well. What is undecided is not said in a certificate.
void check_verdict(const std::string& claimed, Verdict found, const std::string& name,
                   Objections& objections);

/// Compares all quantities, all conditions and the verdict of `claimed` with `found`. A certificate may say
/// less than was found, but a derivation is PROVED only when all of its conditions are there. The title of
/// the derivation.
std::string check_derivation(const Tree& claimed, const Derivation& found, Objections& objections);
/// The verdict of a derivation: UNDECIDED when the certificate does not say it.
Verdict verdict_of(const Tree& derivation);

/// The same for a claim.
void check_claim(const Tree& claimed, const Claim& found, Objections& objections);

}  // namespace veritrack::checker
