#include "analysis/dft_block/false_lock.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Derivation;
using theorems::Sense;

/// A short decimal within the range, at about that share of it; empty when that takes too many digits.
std::optional<std::string> decimal_within(const Interval& range, double share) {
  const double at = range.lower() + share * (range.upper() - range.lower());
  constexpr int kMostDigits = 17;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    std::array<char, 40> text{};
    (void)std::snprintf(text.data(), text.size(), "%.*g", digits, at);
    if (rigor::is_subset(rigor::parse_decimal(text.data()), range)) {
      return text.data();
    }
  }
  return std::nullopt;
}

struct FoundFalse {
  WitnessTone tone;
  BlockLock lock;
};

constexpr double kHalfBin = 0.5;

/// Whether every start of the set is more than half a bin off, on that side.
bool is_away(const BlockLock& lock, bool above) {
  return above ? rigor::certainly_less(Interval(kHalfBin), lock.offset_error)
               : rigor::certainly_less(lock.offset_error, Interval(-kHalfBin));
}

/// The nearest ends on either side, among those of many runs for one tone.
std::array<std::optional<FoundFalse>, 2> find_about(const LockProblem& problem, const WitnessTone& tone) {
  const BlockProblem<Interval> map = block_problem(problem, tone);
  std::array<std::optional<FoundFalse>, 2> nearest;
  for (const double side : {-1.0, 1.0}) {
    auto& best = nearest[side > 0.0 ? 1 : 0];
    for (const double bins : {0.95, 1.05, 2.0}) {
      for (int k = 0; k < 4; ++k) {
        rigor::Vector<kStates> start;
        start << -0.7, 0.5 * std::numbers::pi * k + 0.5, side * bins, 0.07, 0.0, 0.0, 0.7, 0.0, 0.01;
        auto lock = find_lock(map, start);
        if (lock && is_away(*lock, side > 0.0) &&
            (!best ||
             magnitude(lock->fixed_offset_error) < 0.99 * magnitude(best->lock.fixed_offset_error))) {
          best = FoundFalse{tone, std::move(*lock)};
        }
      }
      if (best) {
        break;
      }
    }
  }
  return nearest;
}

void add_value(Derivation& derivation, const char* name, const char* symbol, const char* words, Sense sense,
               const Interval& value) {
  theorems::add_quantity(derivation, {name, symbol, "", "docs/block-tracker.md", words, sense}, value);
}

Derivation derivation_of(const std::optional<FoundFalse>& found, bool above) {
  Derivation derivation;
  derivation.id = above ? "false-lock-above" : "false-lock-below";
  derivation.title = above ? "A set of estimates that stay too high for ever"
                           : "A set of estimates that stay too low for ever";
  const auto condition = [&](const char* id, const char* statement, const char* ground) {
    derivation.conditions.push_back({id, statement, found ? Verdict::proved : Verdict::undecided,
                                     Interval::empty(), Interval::empty(),
                                     found ? ground : "No such set was found."});
  };
  condition("set", "|G(s_0) - s_0|_S + \\kappa \\rho \\le \\rho,\\ \\kappa < 1",
            "The map of a block takes the set into itself and contracts it.");
  condition("away", above ? "\\tilde\\delta > 1/2" : "\\tilde\\delta < -1/2",
            "Every estimate of the set is more than half a bin off.");
  theorems::conclude(derivation);
  if (!found) {
    return derivation;
  }
  const BlockLock& lock = found->lock;
  add_value(derivation, "contraction_rate", "\\kappa",
            "factor by which a block brings the set closer together", Sense::at_most,
            Interval(lock.set.rate));
  add_value(derivation, "offset_error", "\\tilde\\delta",
            "the offset error of every prediction that starts in the set, in every block, bins",
            Sense::enclosure, lock.offset_error);
  add_value(derivation, "fixed_offset_error", "\\tilde\\delta_\\infty", "the one that it tends to, bins",
            Sense::enclosure, lock.fixed_offset_error);
  add_value(derivation, "phase_error", "\\tilde\\varphi",
            "the phase error at the middle of every block, modulo whole turns, rad", Sense::enclosure,
            lock.phase_error);
  add_value(derivation, "root_amplitude", "\\hat x_1/x_1",
            "the estimate of x1 in every block, relative to the tone's", Sense::enclosure,
            lock.root_amplitude);
  add_value(derivation, "amplitude", "(\\hat x_1/x_1)^2",
            "the amplitude that it tends to, relative to the tone's", Sense::at_most, lock.amplitude);
  theorems::Evidence evidence{
      "false-lock",
      {{"radius", lock.set.radius}, {"rate", lock.set.rate}, {"turns", static_cast<double>(lock.set.turns)}},
      {{"centre", lock.set.centre.transpose()}, {"metric", lock.set.metric}},
      {{"amplitude", found->tone.amplitude}, {"offset", found->tone.offset}}};
  derivation.evidence.push_back(std::move(evidence));
  return derivation;
}

}  // namespace

BlockProblem<Interval> block_problem(const LockProblem& problem, const WitnessTone& tone) {
  const Interval amplitude = rigor::parse_decimal(tone.amplitude);
  return {problem.q1 / squared_root_amplitude(amplitude),
          problem.q2,
          problem.q3,
          square(amplitude) / (Interval(4.0) * problem.r),
          rigor::parse_decimal(tone.offset),
          rigor::pi(),
          problem.half_width};
}

std::array<Derivation, 2> derive_false_locks(const LockProblem& problem) {
  std::array<std::optional<FoundFalse>, 2> nearest;
  const rigor::UpwardRounding upward;
  const auto amplitude = decimal_within(problem.amplitude, 0.0);
  for (const double share : {0.8, 0.2, 0.65, 0.35, 0.5}) {
    const auto offset = decimal_within(problem.offset, share);
    if (!amplitude || !offset || (nearest[0] && nearest[1])) {
      break;
    }
    auto found = find_about(problem, {*amplitude, *offset});
    for (std::size_t i = 0; i < 2; ++i) {
      if (!nearest.at(i)) {
        nearest.at(i) = std::move(found.at(i));
      }
    }
  }
  return {derivation_of(nearest[0], false), derivation_of(nearest[1], true)};
}

}  // namespace veritrack::dft_block
