#include "analysis/dft_block/lock_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "analysis/dft_block/lock_search.hpp"
#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/theorems/derivation_builder.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Derivation;
using theorems::Sense;

/// The verified data and their consequences.
struct Found {
  LockBounds set;
  LockRate rate;
  std::optional<LockRate> late;  ///< for a smaller radius, below which every error comes
  Interval start;                ///< |e| of all starts, at most
  Interval disturbance;
};

Interval start_length(const LockFrame& frame, const LockQuestion& question) {
  rigor::IntervalVector<3> bounds;
  bounds << question.amplitude_error, question.phase_error, question.offset_error;
  return frame.length_of(bounds);
}

/// The level at which noise and slew balance the rate.
Interval invariant_length(const Interval& disturbance, const LockRate& rate) {
  return disturbance / (Interval(1.0) - Interval(rate.rate));
}

/// The smallest set of a ladder that contains the starts and that noise and slew cannot make errors leave.
struct LadderResult {
  std::optional<Found> found;
  bool had_rate = false;  ///< some set contracts
  bool had_room = false;  ///< and tolerates noise and slew
};

LadderResult climb(const LockQuestion& question, const LockSearch& search) {
  LadderResult result;
  constexpr double kSmallest = 0.05;
  constexpr double kStep = 1.12;
  constexpr double kRoom = 1.02;
  constexpr double kLargest = 4.0;
  double radius = kSmallest;
  while (radius < kLargest) {
    const auto set = search.set_for(radius);
    const auto rate = set ? search.rate_for(*set, radius) : std::nullopt;
    const auto frame = rate ? LockFrame::make(question.problem, *set) : std::nullopt;
    if (!frame) {
      break;
    }
    const Interval start = start_length(*frame, question);
    const Interval disturbance = frame->disturbance();
    const Interval rest = invariant_length(disturbance, *rate);
    if (!rigor::is_finite(start) || !rigor::is_finite(rest)) {
      break;
    }
    const bool is_covered = rigor::certainly_less_equal(start, Interval(radius));
    const bool tolerates = rigor::certainly_less_equal(Interval(kRoom) * rest, Interval(radius));
    if (is_covered && tolerates && frame->verify(*rate, question.most_cells)) {
      result.had_rate = true;
      result.had_room = true;
      result.found = Found{*set, *rate, std::nullopt, start, disturbance};
      return result;
    }
    result.had_rate = true;
    result.had_room = result.had_room || tolerates;
    // Continues to the needed radius, at least by a step.
    radius = std::max(radius * kStep, std::min(kRoom * start.upper(), radius * 2.0));
  }
  return result;
}

/// A smaller radius with a better rate, for the long run.
std::optional<LockRate> late_rate(const Found& found, const LockFrame& frame, const LockQuestion& question,
                                  const LockSearch& search) {
  constexpr double kRoom = 1.05;
  const double radius = kRoom * invariant_length(found.disturbance, found.rate).upper();
  if (!(radius > 0.0) || !(radius < 0.95 * found.rate.radius)) {
    return std::nullopt;
  }
  const auto rate = search.rate_for(found.set, radius);
  if (!rate || !(rate->rate < found.rate.rate) || !frame.verify(*rate, question.most_cells)) {
    return std::nullopt;
  }
  return rate;
}

/// The first block from which |e| is at most that for ever; empty when it takes longer than can be counted.
std::optional<double> blocks_until(const Interval& length, const Found& found) {
  Interval e = found.start;
  constexpr int kMost = 100'000;
  for (int block = 1; block < kMost; ++block) {
    // Once below the late radius errors stay there.
    const bool is_late = found.late && rigor::certainly_less_equal(e, Interval(found.late->radius));
    const LockRate& rate = is_late ? *found.late : found.rate;
    const bool stays = rigor::certainly_less_equal(invariant_length(found.disturbance, rate), length);
    if (stays && rigor::certainly_less_equal(e, length)) {
      return block;
    }
    e = Interval((Interval(rate.rate) * e + found.disturbance).upper());
  }
  return std::nullopt;
}

struct Text {
  const char *name, *symbol, *words;
  Sense sense = Sense::at_most;
};

void add(Derivation& derivation, const Text& text, const Interval& value) {
  theorems::add_quantity(
      derivation, {text.name, text.symbol, "", "docs/block-tracker.md", text.words, text.sense}, value);
}

void add_condition(Derivation& derivation, const char* id, const char* statement, bool is_proved,
                   const char* ground, const char* objection) {
  derivation.conditions.push_back({id, statement, is_proved ? Verdict::proved : Verdict::undecided,
                                   Interval::empty(), Interval::empty(), is_proved ? ground : objection});
}

void add_bounds(Derivation& derivation, const Found& found, const LockFrame& frame,
                const LockQuestion& question) {
  const Interval rest = invariant_length(found.disturbance, found.rate);
  const Interval ever = max(found.start, rest);
  add(derivation, {"contraction_rate", "\\kappa", "factor by which a block shortens errors"},
      Interval(found.rate.rate));
  add(derivation,
      {"offset_error_bound", "\\sup_k |\\tilde\\delta_k|", "the offset error in every block, bins"},
      ever * frame.reach(2));
  add(derivation,
      {"phase_error_bound", "\\sup_k |\\tilde\\varphi_k|",
       "the phase error of the prediction at the middle of every block, rad"},
      ever * frame.reach(1));
  add(derivation,
      {"amplitude_error_bound", "\\sup_k |\\hat x_1/x_1 - 1|",
       "the error of x1 in every prediction, relative to the tone's"},
      ever * frame.reach(0));
  const Interval last = found.late ? invariant_length(found.disturbance, *found.late) : rest;
  add(derivation,
      {"ultimate_offset_error", "\\limsup_k |\\tilde\\delta_k|", "the offset error in the long run, bins"},
      last * frame.reach(2));
  const double wanted =
      question.settled_error ? *question.settled_error : 2.0 * (last * frame.reach(2)).upper();
  const Interval length((Interval(wanted) / frame.reach(2)).lower());
  const bool says_more = question.settled_error || rigor::certainly_less(length, ever);
  if (says_more && rigor::certainly_positive(length)) {
    if (const auto blocks = blocks_until(length, found)) {
      add(derivation, {"settling_blocks", "k_s", "the block from which the offset error has settled"},
          Interval(*blocks));
      add(derivation, {"settled_offset_error", "\\delta_s", "the offset error from then on, bins"},
          Interval(wanted));
    }
  }
}

void add_evidence(Derivation& derivation, const Found& found) {
  theorems::Evidence evidence{"lock",
                              {{"above", found.set.above},
                               {"below", found.set.below},
                               {"floor", found.set.floor},
                               {"radius", found.rate.radius},
                               {"rate", found.rate.rate},
                               {"weight", found.rate.weight}},
                              {{"frame", found.set.frame}}};
  if (found.late) {
    evidence.numbers.insert(evidence.numbers.end(), {{"late_radius", found.late->radius},
                                                     {"late_rate", found.late->rate},
                                                     {"late_weight", found.late->weight}});
  }
  derivation.evidence.push_back(std::move(evidence));
}

/// The covariance with which to start, in floating point.
std::string steady_note(const LockSearch& search, const LockProblem& problem) {
  const rigor::NearestRounding nearest;
  const double amplitude = midpoint(problem.amplitude);
  rigor::Matrix<3> from_middle = rigor::Matrix<3>::Identity();
  from_middle(0, 0) = std::sqrt(amplitude / (4.0 * std::numbers::pi));
  from_middle(1, 2) = -std::numbers::pi;
  const rigor::Matrix<3> p = from_middle * search.steady() * from_middle.transpose();
  std::ostringstream text;
  text.precision(5);
  for (int i = 0; i < 3; ++i) {
    text << (i == 0 ? "[" : ", ") << "[" << p(i, 0) << ", " << p(i, 1) << ", " << p(i, 2) << "]";
  }
  text << "]";
  return "In exact lock in the middle of the offsets and amplitudes, the covariance of the prediction of "
         "(x1, phase at "
         "the start of the block, offset) settles at about " +
         text.str() + ".";
}

}  // namespace

Derivation derive_lock(const LockQuestion& question) {
  const LockSearch search(question.problem);
  const rigor::UpwardRounding upward;
  Derivation derivation;
  derivation.id = "lock-set";
  derivation.title = "A set about the exact lock that is never left";
  LadderResult result = climb(question, search);
  std::optional<LockFrame> frame;
  bool starts = false;
  if (result.found) {
    frame = LockFrame::make(question.problem, result.found->set);
    starts = frame && (!question.covariance || frame->holds(*question.covariance));
    if (frame) {
      result.found->late = late_rate(*result.found, *frame, question, search);
    }
  }
  const bool is_found = result.found && frame;
  add_condition(
      derivation, "rate", "|e_{k+1}| \\le \\kappa |e_k| + d,\\ \\kappa < 1", is_found,
      "Verified over cells of errors, offsets and amplitudes.",
      !result.had_rate ? "No set about the exact lock was found in which errors fall."
      : !result.had_room
          ? "The noise or the slew pushes errors out of every set that was found."
          : "No set that was found holds the assumed starts, or the cells did not suffice to verify it.");
  add_condition(derivation, "noise", "d \\le (1 - \\kappa) \\rho", is_found,
                "Noise and slew do not push errors out of the set.", "There is no set.");
  add_condition(derivation, "start", "|e_1| \\le \\rho", is_found && starts,
                "All starts, and the covariance, are in the set.",
                is_found ? "The covariance at the start is not certainly between the bounds of the set."
                         : "There is no set.");
  theorems::conclude(derivation);
  if (is_found) {
    add_evidence(derivation, *result.found);
  }
  if (derivation.verdict == Verdict::proved) {
    add_bounds(derivation, *result.found, *frame, question);
  }
  derivation.notes.push_back(steady_note(search, question.problem));
  return derivation;
}

}  // namespace veritrack::dft_block
