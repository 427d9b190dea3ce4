#include "analysis/contraction/steady_certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "analysis/contraction/steady_proposal.hpp"
#include "analysis/contraction/steady_start.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Direction;
using rigor::Interval;
using rigor::IntervalVector;
using rigor::Verdict;
using theorems::Condition;
using theorems::Quantity;
using Tube = FixedPointTube<QuadraturePolarLoop::kStates>;

constexpr const char* kSource = "docs/leak.md";

std::string at_most(const Interval& x) {
  return rigor::to_decimal(x.upper(), 4, Direction::up);
}

SteadyRequest request_of(const LeakQuestion& question, const LockBranch& branch) {
  const ContractionQuestion& tracker = question.tracker;
  SteadyRequest request;
  request.design = {midpoint(tracker.design.q1), midpoint(tracker.design.q2), midpoint(tracker.design.r),
                    midpoint(tracker.design.epsilon)};
  const auto& cells = branch.cells;
  for (const std::size_t k : {std::size_t{0}, cells.size() / 2, cells.size() - 1}) {
    const rigor::Vector<9>& x = cells[k].center;
    request.steady.push_back({1.0 + x[0], x[1], x[2], {x[3], x[4], x[5], x[6], x[7], x[8]}});
    request.slopes.push_back(cells[k].slope);
  }
  request.noise = tracker.noise.upper();
  request.slew = tracker.slew.upper();
  request.start << tracker.initial_amplitude_error.upper(), tracker.initial_phase_error.upper(),
      tracker.initial_frequency_error.upper();
  request.evaluations = tracker.search_evaluations;
  return request;
}

/// The largest set on a ladder of fractions that verifies; the last failure when none does.
std::optional<SteadyVerification> largest_set(const LeakQuestion& question, const LockBranch& branch,
                                              const SteadyRequest& request, const SteadyShape& shape) {
  std::optional<SteadyVerification> last;
  for (const double fraction : {0.75, 0.65, 0.55, 0.45, 0.35, 0.25, 0.15, 0.08}) {
    const auto proposal = propose_steady_set(request, shape, fraction, false);
    if (!proposal) {
      continue;
    }
    last = verify_steady_set(question.tracker.design, branch.cells, *proposal);
    // A proposal is not to be believed, not even in the noise and slew that it was asked to bear.
    const bool bears_what_is_assumed =
        certainly_less_equal(question.tracker.noise, Interval(last->set.noise)) &&
        certainly_less_equal(question.tracker.slew, Interval(last->set.slew));
    if (last->verdict == Verdict::proved && bears_what_is_assumed) {
      return last;
    }
    last->verdict = Verdict::undecided;
  }
  return last;
}

/// The largest disturbance on a ladder for which a set of this shape verifies; at least `known`.
double largest_disturbance(const LeakQuestion& question, const LockBranch& branch, SteadyRequest request,
                           const SteadyShape& shape, double SteadyRequest::*size, double known) {
  constexpr double kStep = 0.8;
  request.noise = 0.0;
  request.slew = 0.0;
  double value = 0.3;  // relative to the amplitude, or rad/sample per sample: more than any tracker bears
  constexpr int kTries = 5;
  int tries = 0;
  while (tries < kTries && value > known) {
    request.*size = value;
    for (const double fraction : {0.7, 0.4}) {
      const auto proposal = propose_steady_set(request, shape, fraction, true);
      if (!proposal) {
        continue;
      }
      ++tries;
      if (verify_steady_set(question.tracker.design, branch.cells, *proposal).verdict == Verdict::proved) {
        return value;
      }
    }
    value *= kStep;
  }
  return known;
}

Quantity quantity(std::string name, std::string symbol, std::string formula,
                  const std::optional<Interval>& value, const std::string& why) {
  Quantity result{std::move(name), std::move(symbol), std::move(formula), kSource, Interval(), std::nullopt};
  if (value && is_finite(*value)) {
    result.value = *value;
  } else {
    result.not_applicable = why;
  }
  return result;
}

/// What a verified set says of the assumed start.
class Report {
 public:
  Report(const LeakQuestion& question, const LockBranch& branch, const SteadySet& set)
      : set_(set), lowest_(set.levels.back().low), start_(start_level(question.tracker, branch.cells, set)) {
    for (const Tube& cell : branch.cells) {
      bias_ = std::max(bias_, magnitude(steady_state_error(cell).frequency_error));
    }
    inside_ = start_ && certainly_less_equal(*start_, Interval(1.0));
  }

  [[nodiscard]] Condition start_in_set() const {
    Condition condition{"start-in-set",
                        "|T (e(0) - e^*)| \\le 1,\\ -\\Delta_{lo} \\le P(0) - P^* \\le \\Delta_{hi}",
                        inside_ ? Verdict::proved : Verdict::undecided,
                        start_ ? *start_ : Interval::empty(),
                        Interval(1.0),
                        {}};
    condition.reason =
        inside_ ? "every assumed start lies in the certified set around the steady state of its frequency."
        : start_
            ? "the assumed starts reach " + at_most(*start_) +
                  " in a metric where the set ends at 1, measured from the steady state, which is up to " +
                  at_most(Interval(bias_)) +
                  " rad/sample off the truth: a smaller leak epsilon, a narrower [assume] frequency or "
                  "smaller start errors would do."
            : "the initial covariance is not certainly between the bounds of the certified set.";
    return condition;
  }

  [[nodiscard]] std::optional<Interval> radius(Eigen::Index i) const {
    return error_bounds(set_, Interval(1.0))[i];
  }
  [[nodiscard]] Interval ultimate() const { return bound_at(lowest_); }
  /// Level k + 1 is at most the larger of level k and the lowest.
  [[nodiscard]] std::optional<Interval> bound() const {
    return inside_ ? std::optional(bound_at(std::max(start_->upper(), lowest_))) : std::nullopt;
  }

  /// Steps from the start, or from level 1, to the lowest level.
  [[nodiscard]] std::optional<Interval> settling() const {
    const double from = inside_ ? start_->upper() : 1.0;
    Interval total(0.0);
    for (const LevelRange& range : set_.levels) {
      const double high = std::min(range.high, from);
      if (!(high > range.low)) {
        continue;
      }
      const Interval steps =
          rigor::log(Interval(range.low) / Interval(high)) / rigor::log(Interval(range.rate));
      total += Interval(std::ceil(steps.upper()));
    }
    return is_finite(total) ? std::optional(total) : std::nullopt;
  }

 private:
  [[nodiscard]] Interval bound_at(double level) const {
    return Interval((Interval(bias_) + error_bounds(set_, Interval(level))[2]).upper());
  }

  SteadySet set_;
  double lowest_;
  std::optional<Interval> start_;
  double bias_ = 0.0;
  bool inside_ = false;
};

bool is_sensible(const LeakQuestion& question) {
  const ContractionQuestion& t = question.tracker;
  const Interval zero(0.0);
  return certainly_positive(t.design.r) && certainly_positive(t.design.q2) && is_finite(question.band) &&
         certainly_less_equal(zero, t.noise) && certainly_less_equal(zero, t.slew) &&
         certainly_less_equal(zero, t.initial_amplitude_error) &&
         certainly_less_equal(zero, t.initial_phase_error) &&
         certainly_less_equal(zero, t.initial_frequency_error);
}

}  // namespace

LeakCertificate certify_with_leak(const LeakQuestion& question) {
  const rigor::UpwardRounding upward;
  LeakCertificate certificate;
  theorems::Derivation& derivation = certificate.derivation;
  derivation.id = "contraction";
  derivation.title = "Contraction in a set around the steady state of every frequency of the band";
  derivation.notes = {
      "Covers the tracker in exact arithmetic, for every frequency of the band, signal amplitude constant.",
      "With a leak the tracker settles off the truth: radii are about the steady state, error bounds about "
      "the "
      "truth. Amplitude error and noise are relative to the true amplitude."};
  // Wider cells are fewer, narrower ones give larger sets.
  constexpr double kCellWidth = 0.1;  // rad/sample
  const LockBranch branch =
      verify_lock_branch(question.tracker.design, question.band, {.largest = kCellWidth});
  double largest_noise = 0.0;
  double largest_slew = 0.0;
  std::string why = branch.reason;
  if (branch.verdict == Verdict::proved && is_sensible(question)) {
    SteadyRequest request = request_of(question, branch);
    const auto shape = propose_steady_shape(request);
    why = "no set was found in which the steps contract";
    if (shape) {
      certificate.set = largest_set(question, branch, request, *shape);
      const bool found = certificate.set && certificate.set->verdict == Verdict::proved;
      largest_noise = largest_disturbance(question, branch, request, *shape, &SteadyRequest::noise,
                                          found ? certificate.set->set.noise : 0.0);
      largest_slew = largest_disturbance(question, branch, request, *shape, &SteadyRequest::slew,
                                         found ? certificate.set->set.slew : 0.0);
    }
  }
  const bool proved = certificate.set && certificate.set->verdict == Verdict::proved;
  if (certificate.set) {
    why = certificate.set->reason;
  }
  Condition invariant{"invariant-set",
                      "\\Omega_s \\to \\Omega_{\\kappa s}",
                      proved ? Verdict::proved : Verdict::undecided,
                      Interval::empty(),
                      Interval(1.0),
                      why};
  if (!proved && branch.verdict == Verdict::proved) {
    invariant.reason = "no set could be certified for this noise and slew: " + why +
                       " The largest certified noise (without slew) is " +
                       rigor::to_decimal(largest_noise, 4, Direction::down) + "; " +
                       at_most(question.tracker.noise) +
                       " was assumed. The largest certified slew (without noise) is " +
                       rigor::to_decimal(largest_slew, 4, Direction::down) + "; " +
                       at_most(question.tracker.slew) + " was assumed.";
  }
  std::optional<Report> report;
  std::optional<Interval> rate;
  if (proved) {
    report.emplace(question, branch, certificate.set->set);
    double slowest = 0.0;
    for (const LevelRange& range : certificate.set->set.levels) {
      slowest = std::max(slowest, range.rate);
    }
    rate = Interval(slowest);
    invariant.lhs = *rate;
  }
  derivation.conditions = {{"steady-state", "X^*(\\omega) = G(X^*(\\omega)) \\text{ on the band}",
                            branch.verdict, Interval::empty(), Interval::empty(), branch.reason},
                           invariant};
  if (report) {
    derivation.conditions.push_back(report->start_in_set());
  }
  const auto said = [&](const auto& function) {
    return report ? std::optional<Interval>(function(*report)) : std::nullopt;
  };
  const auto radius = [&](Eigen::Index i) { return report ? report->radius(i) : std::nullopt; };
  const std::string outside = report ? "The assumed starts are not in the certified set." : why;
  derivation.quantities = {
      quantity("contraction_rate", "\\kappa", "\\Omega_s \\to \\Omega_{\\kappa s}", rate, why),
      quantity("radius", "R", "|T (e - e^*)| \\le 1", report ? std::optional(Interval(1.0)) : std::nullopt,
               why),
      quantity("frequency_error_radius", "\\nu_R", "|e_3' T^{-1}|", radius(2), why),
      quantity("phase_error_radius", "\\psi_R", "|e_2' T^{-1}|", radius(1), why),
      quantity("amplitude_error_radius", "a_R", "|e_1' T^{-1}|", radius(0), why),
      quantity("ultimate_frequency_error", "\\nu_\\infty", "\\sup_\\omega |\\nu^*| + s_0 |e_3' T^{-1}|",
               said([](const Report& r) { return r.ultimate(); }), why),
      quantity("frequency_error_bound", "\\sup_k |\\nu(k)|",
               "\\sup_\\omega |\\nu^*| + \\max(s(0), s_0) |e_3' T^{-1}|",
               report ? report->bound() : std::nullopt, outside),
      quantity("settling_samples", "k_s", "\\sum \\lceil \\log(s_{j+1} / s_j) / \\log \\kappa_j \\rceil",
               report ? report->settling() : std::nullopt, why),
      quantity("largest_noise", "V_{max}", "",
               largest_noise > 0.0 ? std::optional(Interval(largest_noise)) : std::nullopt, why),
      quantity("largest_slew", "W_{max}", "",
               largest_slew > 0.0 ? std::optional(Interval(largest_slew)) : std::nullopt, why),
      frequency_bias(branch)};
  std::vector<Verdict> verdicts;
  for (const Condition& condition : derivation.conditions) {
    verdicts.push_back(condition.verdict);
  }
  derivation.verdict = rigor::conjunction(verdicts);
  return certificate;
}

}  // namespace veritrack::contraction
