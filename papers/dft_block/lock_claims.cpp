#include "papers/dft_block/lock_claims.hpp"

#include <array>
#include <string>

#include "analysis/dft_block/block_lock.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;

/// A row of Table 4.1: Q = diag(q1, q2, q3), R = r_d / (2T) I. At the nearest range the tone has amplitude 1.
struct PrintedDesign {
  const char *set, *q1, *q2, *q3, *r_d, *snr;
};
constexpr std::array kDesigns{PrintedDesign{"set-1", "5e-5", "1e-3", "2.5e-3", "12.5", "0"},
                              PrintedDesign{"set-2", "1e-4", "1e-3", "4.5e-3", "20", "-10"},
                              PrintedDesign{"set-3", "1e-4", "1e-3", "1e-2", "125", "-20"}};
constexpr const char* kOffset = "0.3";  // bins

/// A tone of amplitude 1; L = 2, T = 2048.
BlockProblem<Interval> problem_of(const PrintedDesign& design) {
  // amplitude^2 / (4 r) with r = r_d / 4096
  return {parse_decimal(design.q1) * Interval(4.0) * rigor::pi(),
          parse_decimal(design.q2),
          parse_decimal(design.q3),
          Interval(1024.0) / parse_decimal(design.r_d),
          parse_decimal(kOffset),
          rigor::pi(),
          2};
}

theorems::Statement false_lock(const PrintedDesign& design) {
  const BlockProblem<Interval> problem = problem_of(design);
  // From here a run ends one bin below the tone.
  rigor::Vector<kStates> start;
  start << -0.72, 0.55, -0.944, 0.005, 0.0, 0.0, 0.7, 0.0, 0.006;
  const auto found = find_lock(problem, start);
  const bool is_proved = found && rigor::certainly_less(found->offset_error, Interval(-0.9)) &&
                         rigor::certainly_less(Interval(-1.1), found->offset_error);
  return theorems::make_statement(
      std::string("chapter-4/initial-estimate/") + design.set,
      std::string("The start decides: with these Q and R at an SNR of ") + design.snr +
          " dB, L = 2, a tone 0.3 bins off and no noise, a set of starts is never left whose estimates are "
          "one bin too "
          "low.",
      is_proved ? Verdict::proved : Verdict::undecided,
      is_proved ? "The set has a fixed point with an offset error of " +
                      rigor::to_decimal(found->fixed_offset_error, 4) + " bins and " +
                      rigor::upper_decimal(found->amplitude, 3) +
                      " of the amplitude; in the metric of the set, each block multiplies the distance from "
                      "it by at most " +
                      rigor::upper_decimal(Interval(found->set.rate), 5) + "."
                : "No such set was found.",
      {});
}

}  // namespace

std::vector<theorems::Statement> lock_claims() {
  std::vector<theorems::Statement> statements;
  statements.reserve(kDesigns.size());
  for (const PrintedDesign& design : kDesigns) {
    statements.push_back(false_lock(design));
  }
  return statements;
}

}  // namespace veritrack::dft_block
