#include "analysis/dft_block/lock_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "analysis/dft_block/late_errors.hpp"
#include "analysis/dft_block/late_proposal.hpp"
#include "analysis/dft_block/lock_search.hpp"
#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

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
  std::vector<LateStage> stages;  ///< nearer to the exact lock, each of which is reached
  Interval start;                 ///< |e| of all starts, at most
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
      result.found = Found{*set, *rate, {}, start, disturbance};
      return result;
    }
    result.had_rate = true;
    result.had_room = result.had_room || tolerates;
    // Continues to the needed radius, at least by a step.
    radius = std::max(radius * kStep, std::min(kRoom * start.upper(), radius * 2.0));
  }
  return result;
}

/// Stages for the long run: each a little larger than the errors that the one before leaves.
std::vector<LateStage> late_stages(const Found& found, const LockFrame& frame, const LockQuestion& question,
                                   const LockSearch& search) {
  constexpr double kRoom = 1.02;
  constexpr double kWorthwhile = 0.9;  // of the bound before
  constexpr double kFirstRoom = 0.03;  // covariances come sooner to the first
  constexpr int kMostStages = 4;
  std::vector<LateStage> stages;
  Timeline timeline = timeline_of(frame, found.set, found.rate, stages, found.start);
  while (stages.size() < kMostStages && rigor::certainly_positive(timeline.ultimate)) {
    const Interval before = timeline.ultimate;
    const double room = 1.0 + kFirstRoom / (1.0 + static_cast<double>(stages.size()));
    const auto stage = propose_stage(search, timeline.late.enlarged(kRoom), room);
    const auto own = stage ? LockFrame::make(question.problem, found.set.with(*stage)) : std::nullopt;
    if (!own) {
      break;
    }
    stages.push_back(*stage);
    timeline = timeline_of(frame, found.set, found.rate, stages, found.start);
    if (!rigor::certainly_less(timeline.ultimate, Interval(kWorthwhile) * before) ||
        !own->verify(*stage, question.most_cells)) {
      stages.pop_back();
      break;
    }
  }
  return stages;
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
  const Timeline timeline = timeline_of(frame, found.set, found.rate, found.stages, found.start);
  add(derivation,
      {"ultimate_offset_error", "\\limsup_k |\\tilde\\delta_k|", "the offset error in the long run, bins"},
      timeline.ultimate);
  const double wanted = question.settled_error ? *question.settled_error : 2.0 * timeline.ultimate.upper();
  if (!question.settled_error && !rigor::certainly_less(Interval(wanted), ever * frame.reach(2))) {
    return;
  }
  const auto settled = std::ranges::find_if(timeline.offset_error, [&](const Interval& error) {
    return rigor::certainly_less_equal(error, Interval(wanted));
  });
  if (settled != timeline.offset_error.end()) {
    const auto block = 1 + (settled - timeline.offset_error.begin());
    add(derivation, {"settling_blocks", "k_s", "the block from which the offset error has settled"},
        Interval(static_cast<double>(block)));
    add(derivation, {"settled_offset_error", "\\delta_s", "the offset error from then on, bins"},
        Interval(wanted));
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
  derivation.evidence.push_back(std::move(evidence));
  for (const LateStage& stage : found.stages) {
    derivation.evidence.push_back(
        {"late-" + std::to_string(derivation.evidence.size()),
         {{"radius", stage.errors.radius},
          {"limit_1", stage.errors.limits(0)},
          {"limit_2", stage.errors.limits(1)},
          {"limit_3", stage.errors.limits(2)},
          {"above", stage.above},
          {"below", stage.below},
          {"next_above", stage.next_above},
          {"next_below", stage.next_below},
          {"noise_weight", stage.noise_weight}},
         {{"reference", stage.reference}, {"excess", stage.excess}, {"noise", stage.noise}}});
  }
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
      result.found->stages = late_stages(*result.found, *frame, question, search);
    }
  }
  const bool is_found = result.found && frame;
  add_condition(
      derivation, "rate", "|e_{k+1}| \\le \\kappa |e_k| + d,\\ \\kappa < 1", is_found,
      "Verified over cells of errors, offsets and amplitudes.",
      !result.had_rate ? "No set about the exact lock was found in which errors fall."
      : !result.had_room
          ? "The noise or the slew pushes errors out of every set that was found."
          : "No set that was found contains the assumed starts, or the cells did not suffice to verify it.");
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
