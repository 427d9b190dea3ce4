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
/// "proved", "refuted" or "undecided". Throws Malformed for anything else.
Verdict verdict_from(const std::string& text);
inline Verdict proved_if(bool certain) {
  return certain ? Verdict::proved : Verdict::undecided;
}

/// What is wrong with a part of a certificate; nothing when it is verified.
using Objections = std::vector<std::string>;

/// The meaning of [lo, hi] for a value: it lies in it, is at most hi, or is at least lo.
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
  std::string statement;
  Verdict verdict = Verdict::undecided;
  std::vector<Quantity> evidence;
};

/// The decimal between the two ends of a sentence; nothing when it has other ends.
std::optional<Ball> decimal_between(const std::string& text, const std::string& before,
                                    const std::string& after);

/// A number of the design file, from its decimal text, which [lo, hi] must contain.
Ball read_number(const Tree& number, Objections& objections);
/// [lo, hi] as a ball. Objects when the decimals beside it are narrower than it is.
Ball read_enclosure(const Tree& enclosure, const std::string& name, Objections& objections);
/// Objects unless the enclosure is true of `value`. An enclosure that shares no point with `value` is an
/// alarm.
void check_enclosure(const Tree& enclosure, const Quantity& quantity, Objections& objections);
/// Objects unless the checker came to this verdict as well; UNDECIDED claims nothing.
void check_verdict(const std::string& claimed, Verdict found, const std::string& name,
                   Objections& objections);

/// Compares the title, all quantities, all conditions and the verdict of `claimed` with `found`. Quantities
/// that are said not to be proved, and those that are said not to be applicable, claim nothing.
void check_derivation(const Tree& claimed, const Derivation& found, Objections& objections);

/// The same for a claim. Evidence that is not known is an objection; the words of an UNDECIDED claim claim
/// nothing.
void check_claim(const Tree& claimed, const Claim& found, Objections& objections);

}  // namespace veritrack::checker
