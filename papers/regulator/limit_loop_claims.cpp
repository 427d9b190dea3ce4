#include <string>

#include "analysis/statements/comparison.hpp"
#include "papers/regulator/limit_claims.hpp"
#include "papers/regulator/printed_limits.hpp"

namespace veritrack::regulator {

namespace {

using rigor::conjunction;
using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

/// One of the loops with the decimals that the sentences about it say.
struct Case {
  std::string id, name;
  FrozenLoop exact;    ///< with the parameters as printed
  FrozenLoop rounded;  ///< with all that are printed so
  const char *radius, *lowest, *highest, *too_low, *too_high, *peak;
};

Interval gains(const char* lowest, const char* highest) {
  return hull(parse_decimal(lowest), parse_decimal(highest));
}

Verdict is_unstable(const FrozenLoop& loop, const char* gain) {
  return loop.has_poles_within(Interval(1.0), parse_decimal(gain)) == Verdict::refuted ? Verdict::proved
                                                                                       : Verdict::undecided;
}

/// Stable with the plant as it is.
Statement stability(const Case& each) {
  const Verdict verdict = each.rounded.has_poles_within(parse_decimal(each.radius), Interval(1.0));
  const bool is_printed = each.id.starts_with("chapter-5/limits/");
  return make_statement(each.id + "/stable",
                        "The loop of section 5.4's plant and " + each.name +
                            " is stable: all its poles lie within |z| < " + each.radius +
                            (is_printed ? ", whatever the printed parameters are rounded from." : "."),
                        verdict,
                        std::string("Recursion of Schur and Cohn on A1 D + 3 N/z") +
                            (is_printed ? ", the parameters as intervals of half a unit of the last digit to "
                                          "either side."
                                        : ", 2 cos(omega) as an interval."),
                        {});
}

/// Stable for other plant gains, and where no more.
Statement gain_margin(const Case& each) {
  const bool has_lower_end = each.too_low != nullptr;
  std::vector<Verdict> verdicts{each.rounded.is_stable_for_gains(gains(each.lowest, each.highest)),
                                is_unstable(each.rounded, each.too_high)};
  if (has_lower_end) {
    verdicts.push_back(is_unstable(each.rounded, each.too_low));
  }
  return make_statement(
      each.id + "/gain-margin",
      "With " + each.name + " the loop stays stable when the plant's gain is " + each.lowest + " to " +
          each.highest + " times the nominal one; with " + each.too_high + " times it is not" +
          (has_lower_end ? std::string(", nor with ") + each.too_low + " times: less gain is no safer."
                         : "."),
      conjunction(verdicts),
      "The same recursion on A1 D + 3 g N/z, the range of g in parts; at the other gains one of its numbers "
      "is at least 1 in size.",
      {});
}

Statement peak(const Case& each) {
  const Interval found = each.exact.peak_sensitivity();
  return make_statement(
      each.id + "/peak-sensitivity",
      "With " + each.name + " some frequency reaches the output " + each.peak +
          " times as large as without control (to the digits shown).",
      decide(abs(found - parse_decimal(each.peak)), parse_decimal("0.005"), Strictness::weak),
      "Branch and bound over all frequencies: max |S| is " + enclosed(found) + ".", {});
}

/// How much of the vibration is left.
Statement regulation(const Case& each) {
  const Interval left = each.exact.sensitivity(vibration());
  return make_statement(each.id + "/regulates",
                        "With " + each.name +
                            " as printed, the vibration reaches the output at 2e-5 of its size or less: the "
                            "controller drives the output to zero, to the printed digits.",
                        conjunction({each.exact.has_poles_within(Interval(1.0), Interval(1.0)),
                                     decide(left, parse_decimal("2e-5"), Strictness::weak)}),
                        "|S| at pi/6 rad/sample is " + enclosed(left) + ".", {});
}

/// |S| of the limits where the ideal loop has another.
Statement other_frequencies(const Case& first, const Case& second) {
  const Interval at = rigor::pi() / Interval(2.0);
  const Interval ideal = ideal_loop().sensitivity(at);
  const Interval one = first.rounded.sensitivity(at);
  const Interval two = second.rounded.sensitivity(at);
  const auto differs = [&](const Interval& size) {
    return decide(parse_decimal("0.1"), abs(size - ideal), Strictness::strict);
  };
  return make_statement(
      "chapter-5/limits/other-frequencies",
      "A disturbance with power at other frequencies would find the limits of Tables 5.1 and 5.2 different "
      "from the ideal controller (section 5.3.2).",
      conjunction({differs(one), differs(two)}),
      "|S| at pi/2 rad/sample: " + enclosed(ideal) + " with the ideal controller, " + enclosed(one) +
          " and " + enclosed(two) + " with the limits.",
      {});
}

}  // namespace

std::vector<Statement> limit_loop_claims() {
  const Case ideal{"chapter-5/ideal-controller/loop",
                   "the ideal controller",
                   ideal_loop(),
                   ideal_loop(),
                   "0.51",
                   "0.01",
                   "1.36",
                   nullptr,
                   "1.37",
                   "3.73"};
  const Case first{"chapter-5/limits/table-5.1",
                   "the limit of Table 5.1",
                   table_5_1_loop(Printed::exactly),
                   table_5_1_loop(Printed::rounded),
                   "0.48",
                   "0.02",
                   "1.43",
                   nullptr,
                   "1.45",
                   "3.29"};
  const Case second{"chapter-5/limits/table-5.2",
                    "the limit of Table 5.2",
                    table_5_2_loop(Printed::exactly),
                    table_5_2_loop(Printed::rounded),
                    "0.52",
                    "0.25",
                    "1.26",
                    "0.1",
                    "1.27",
                    "5.04"};
  std::vector<Statement> statements;
  for (const Case& each : {ideal, first, second}) {
    statements.push_back(stability(each));
    statements.push_back(gain_margin(each));
    statements.push_back(peak(each));
  }
  statements.push_back(regulation(first));
  statements.push_back(regulation(second));
  statements.push_back(other_frequencies(first, second));
  return statements;
}

}  // namespace veritrack::regulator
