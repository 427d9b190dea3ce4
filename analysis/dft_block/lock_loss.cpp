#include "analysis/dft_block/lock_loss.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "analysis/dft_block/lock_search.hpp"
#include "analysis/dft_block/loss_proposals.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Derivation;
using theorems::Sense;

Interval determinant_of(const rigor::IntervalMatrix<3>& a) {
  return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) -
         a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
         a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}

void add_loss(Derivation& derivation, const char* name, const char* symbol, const char* words,
              const Interval& value) {
  theorems::add_quantity(derivation, {name, symbol, "", "docs/block-tracker.md", words, Sense::at_most},
                         value);
}

}  // namespace

std::optional<LossBound> loss_bound(const LossQuestion& question, const LockFrame& frame,
                                    const LockDrift& drift, double slew_share) {
  // theta = tilt r / deviation^2
  const Interval theta = Interval(drift.tilt) * question.problem.r / square(question.deviation);
  const Interval half(0.5);
  const rigor::IntervalMatrix<3> floor = rigor::to_interval(drift.floor);
  const Interval determinant = determinant_of(floor);
  const auto inverse = rigor::inverse(floor);
  // cannot bind (determinant, question.deviation): below 0 its logarithm is empty, and of the deviation only
  // the square is used, whose reciprocal at 0 is not finite.
  if (!inverse || !rigor::certainly_positive(determinant) || !rigor::certainly_positive(question.deviation)) {
    return std::nullopt;
  }
  Interval power(drift.growth);
  Interval log_factor = -half * rigor::log(determinant);  // in logarithms: a slew in little noise overflows
  if (!(question.problem.slew == Interval(0.0))) {
    if (!(slew_share > 0.0)) {
      return std::nullopt;
    }
    const rigor::IntervalVector<3> s = frame.slew_direction();
    const Interval length = (s.transpose() * *inverse * s)(0, 0);
    power *= Interval(1.0) + Interval(slew_share);
    log_factor += half * theta * (Interval(1.0) + Interval(1.0) / Interval(slew_share)) *
                  square(question.problem.slew) * length;
  }
  // cannot bind (power): elsewhere the logarithm of it or of 1/power - 1 is empty or has no end.
  if (!rigor::certainly_less(power, Interval(1.0)) || !rigor::certainly_positive(power)) {
    return std::nullopt;
  }
  rigor::IntervalVector<3> bounds;
  bounds << question.amplitude_error, question.phase_error, question.offset_error;
  const Interval start = frame.length_of(bounds);
  if (!rigor::certainly_less_equal(start, Interval(drift.radius))) {
    return std::nullopt;
  }
  LossBound found;
  found.level = half * theta * square(Interval(drift.radius));
  found.start_level = half * theta * square(start);
  // factor W^power - W is largest where W = (power factor)^(1/(1 - power)).
  const Interval log_constant = (rigor::log(power) + log_factor) / (Interval(1.0) - power) +
                                rigor::log(Interval(1.0) / power - Interval(1.0));
  found.probability =
      rigor::exp(found.start_level - found.level) + question.blocks * rigor::exp(log_constant - found.level);
  // E log W+ <= log factor + power log W: it stays below the larger of its limit and its start.
  const Interval tends_to = max(log_factor, Interval(0.0)) / (Interval(1.0) - power);
  found.mean_square = Interval(2.0) * max(found.start_level, tends_to) / theta;
  found.mean_square_without_start = Interval(2.0) * tends_to / theta;
  if (!rigor::is_finite(found.probability) || !rigor::is_finite(found.level) ||
      !rigor::is_finite(found.mean_square)) {
    return std::nullopt;
  }
  return found;
}

void conclude_loss(Derivation& derivation, const LossQuestion& question,
                   const std::optional<InNoise>& found) {
  const auto frame = found ? LockFrame::make(question.problem, found->set) : std::nullopt;
  const bool starts = frame && (!question.covariance || frame->holds(*question.covariance));
  const auto condition = [&](const char* id, const char* statement, bool is_proved, const char* ground,
                             const char* objection) {
    derivation.conditions.push_back({id, statement, is_proved ? Verdict::proved : Verdict::undecided,
                                     Interval::empty(), Interval::empty(), is_proved ? ground : objection});
  };
  condition("drift", "E[W_{k+1}] \\le W_k + c", frame.has_value(),
            "Verified over cells of errors, offsets and amplitudes.",
            "No set was found that contains the assumed starts and in which this could be verified.");
  condition("start", "|e_1| \\le \\rho", starts, "All starts, and the covariance, are in the set.",
            frame ? "The covariance at the start is not certainly between the bounds of the set."
                  : "There is no set.");
  theorems::conclude(derivation);
  if (!frame) {
    return;
  }
  derivation.evidence.push_back({"drift",
                                 {{"above", found->set.above},
                                  {"below", found->set.below},
                                  {"radius", found->drift.radius},
                                  {"tilt", found->drift.tilt},
                                  {"growth", found->drift.growth},
                                  {"weight", found->drift.weight},
                                  {"floor_weight", found->drift.floor_weight},
                                  {"slew_share", found->slew_share}},
                                 {{"frame", found->set.frame}, {"floor", found->drift.floor}}});
  if (derivation.verdict != Verdict::proved) {
    return;
  }
  const Interval radius(found->drift.radius);
  add_loss(derivation, "probability_of_losing_lock", "p", "the probability of leaving the set",
           min(found->bound.probability, Interval(1.0)));
  // An estimate is the next prediction before the slew.
  add_loss(derivation, "offset_error_bound", "\\sup_{k < \\tau} |\\tilde\\delta_k|",
           "the offset error until then, bins", radius * frame->reach(2) + question.problem.slew);
  add_loss(derivation, "rms_offset_error", "\\sup_k E[\\tilde\\delta_k^2;\\, k < \\tau]^{1/2}",
           "the root mean square of the offset error in lock, bins",
           sqrt(found->bound.mean_square) * frame->reach(2));
  add_loss(derivation, "rms_offset_error_without_start", "", "the same from an exact start, bins",
           sqrt(found->bound.mean_square_without_start) * frame->reach(2));
  derivation.notes.push_back(
      std::string(found->bound.mean_square_without_start.upper() < found->bound.mean_square.upper()
                      ? "The assumed start dominates the root mean square in lock, which is for every block, "
                        "the first ones included."
                      : "The noise, and not the assumed start, dominates the root mean square in lock.") +
      " From an exact start it would be at most " +
      rigor::upper_decimal(sqrt(found->bound.mean_square_without_start) * frame->reach(2), 3) + " bins.");
  add_loss(derivation, "phase_error_bound", "\\sup_{k < \\tau} |\\tilde\\varphi_k|",
           "the phase error of the prediction at the middle of every block until then, rad",
           radius * frame->reach(1));
  add_loss(derivation, "amplitude_error_bound", "\\sup_{k < \\tau} |\\hat x_1/x_1 - 1|",
           "the error of x1 until then, relative to the tone's", radius * frame->reach(0));
}

Derivation derive_loss(const LossQuestion& question) {
  const LockSearch search(question.problem);
  const rigor::UpwardRounding upward;
  constexpr double kStep = 1.1;
  std::vector<InNoise> proposed;
  for (const ProposedDrift& one : propose_drifts(question.problem, search, kStep)) {
    const auto frame = LockFrame::make(question.problem, one.set);
    for (const double share : kSlewShares) {
      if (const auto bound = frame ? loss_bound(question, *frame, one.drift, share) : std::nullopt) {
        proposed.push_back({one.set, one.drift, share, *bound});
      }
    }
  }
  std::stable_sort(proposed.begin(), proposed.end(), [](const InNoise& a, const InNoise& b) {
    return a.bound.probability.upper() < b.bound.probability.upper();
  });
  Derivation derivation;
  derivation.id = "lock-in-noise";
  derivation.title = "A set about the exact lock and the probability of leaving it";
  conclude_loss(derivation, question, first_verified(question, proposed));
  return derivation;
}

}  // namespace veritrack::dft_block
