#include "analysis/single_channel/phase_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/single_channel/set_rounding.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;

constexpr double kUsualSlack = 0.025;
constexpr std::size_t kTries = 8;

/// The largest level of starts that stay within the radius; 0 when none was found.
double largest_start(const WindowErrors& errors, double radius) {
  if (!errors.keeps_radius()) {
    return 0.0;
  }
  constexpr double kStep = 0.97;
  constexpr int kSteps = 120;
  double level = radius;
  for (int i = 0; i < kSteps; ++i) {
    if (errors.levels(level, errors.window())) {
      return level;
    }
    level *= kStep;
  }
  return 0.0;
}

/// A bound on all levels of `levels` and on all that follow them.
double supremum(const WindowErrors& errors, const std::vector<double>& levels, double radius) {
  const double all = *std::max_element(levels.begin(), levels.end());
  const double late = *std::max_element(levels.end() - errors.window(), levels.end());
  const double kept = std::max(late, errors.ultimate());
  return errors.keeps(kept) ? std::max(all, kept) : radius;
}

/// An upper bound on |nu| for errors of that level.
Interval frequency_error(const PhaseSet& set, double level) {
  return Interval((Interval(level) * sqrt(Interval(set.claim.assumption.frequency_variance))).upper());
}

constexpr int kFollowed = 4000;  // samples

}  // namespace

WindowErrors errors_of(const PhaseQuestion& question, const PhaseSet& set) {
  return {question.tracker.design, set.claim, set.noise, set.slew};
}

Interval frequency_error_bound(const PhaseQuestion& question, const PhaseSet& set, double level) {
  const WindowErrors errors = errors_of(question, set);
  const auto levels = errors.levels(level, kFollowed);
  return levels ? frequency_error(set, supremum(errors, *levels, set.claim.assumption.radius))
                : Interval::empty();
}

Interval ultimate_frequency_error(const PhaseQuestion& question, const PhaseSet& set) {
  return frequency_error(set, errors_of(question, set).ultimate());
}

PhaseSearch::PhaseSearch(const PhaseQuestion& question) : question_(question) {
  const rigor::UpwardRounding upward;
  const sets::ContractionQuestion& tracker = question.tracker;
  const Interval signal = tracker.initial_amplitude_error + tracker.initial_phase_error;
  box_ = {signal.upper(), tracker.initial_frequency_error.upper()};
  request_ = {{midpoint(tracker.design.q1), midpoint(tracker.design.q2), midpoint(tracker.design.r), 0.0},
              question.band.lower(),
              question.band.upper(),
              tracker.slew.upper()};
  proposals_ = propose_windows(request_);
  still_proposals_ = proposals_;
  if (!(request_.slew == 0.0)) {
    WindowRequest still = request_;
    still.slew = 0.0;
    still_proposals_ = propose_windows(still);
  }
}

std::optional<PhaseSet> PhaseSearch::verified(const WindowClaim& proposal, const Interval& noise,
                                              const Interval& slew) const {
  for (const double slack : {0.012, kUsualSlack, 0.05, 0.1}) {
    PhaseSet set{with_slack(proposal, slack), {}, noise, slew, 0.0, std::nullopt};
    set.claim.slew = slew.upper();
    StepRounding& rounding = set.claim.assumption.rounding;
    rounding = allowed_rounding(question_, set.claim, noise);
    if (!rounding.is_bounded()) {
      return std::nullopt;
    }
    set.start_level = largest_start(errors_of(question_, set), set.claim.assumption.radius);
    if (!(set.start_level > 0.0)) {
      return std::nullopt;
    }
    if (const auto floor = verify_window(question_.tracker.design, question_.band, set.claim)) {
      set.floor = *floor;
      return set;
    }
  }
  return std::nullopt;
}

/// The proposals of positive value, with the usual slack, the most valuable ones first, a few of them.
template <typename Value>
std::vector<WindowClaim> PhaseSearch::best_first(const std::vector<WindowClaim>& proposals,
                                                 const Value& value) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const double found = value(with_slack(proposals[i], kUsualSlack));
    if (found > 0.0) {
      order.emplace_back(found, i);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  order.resize(std::min(order.size(), kTries));
  std::vector<WindowClaim> best;
  best.reserve(order.size());
  for (const auto& [unused, i] : order) {
    best.push_back(proposals[i]);
  }
  return best;
}

std::optional<PhaseSet> PhaseSearch::largest_set() const {
  const rigor::UpwardRounding upward;
  const sets::ContractionQuestion& tracker = question_.tracker;
  const auto start_of = [&](const WindowClaim& claim) {
    return largest_start({tracker.design, claim, tracker.noise, tracker.slew}, claim.assumption.radius);
  };
  for (const WindowClaim& proposal : best_first(proposals_, start_of)) {
    if (auto set = verified(proposal, tracker.noise, tracker.slew)) {
      return set;
    }
  }
  return std::nullopt;
}

std::optional<PhaseSet> PhaseSearch::least_bound() const {
  const rigor::UpwardRounding upward;
  const sets::ContractionQuestion& tracker = question_.tracker;
  // A matrix below all covariances, up to the resolution of the grid, in which the level of the assumed
  // starts is small; and that level.
  const auto within = [&](PhaseSet& set, double margin) {
    set.start = propose_diagonal_start(request_, set.claim, box_, margin, midpoint(tracker.amplitude));
    set.assumed_level = level_of(*set.start, box_, tracker.amplitude);
    return set.assumed_level && errors_of(question_, set).levels(*set.assumed_level, kFollowed).has_value();
  };
  // Every predicted covariance is above Q, those of a start from any covariance too.
  const auto from_any = [&](std::vector<WindowClaim> proposals) {
    for (WindowClaim& claim : proposals) {
      claim.signal_uncertainty = std::min(claim.signal_uncertainty, tracker.design.q1.lower());
    }
    return proposals;
  };
  const auto promise = [&](const WindowClaim& claim) {
    PhaseSet set{claim, {}, tracker.noise, tracker.slew, 0.0, std::nullopt};
    if (!errors_of(question_, set).keeps_radius() || !within(set, 1.0)) {
      return 0.0;
    }
    return 1.0 / frequency_error_bound(question_, set, *set.assumed_level).upper();
  };
  const std::vector<WindowClaim> proposals = from_any(proposals_);
  std::vector<WindowClaim> candidates = best_first(proposals, promise);
  // Small sets promise more, but large ones are easier to verify.
  std::vector<WindowClaim> large(proposals.rbegin(), proposals.rend());
  large.resize(std::min(large.size(), kTries));
  candidates.insert(candidates.end(), large.begin(), large.end());
  for (const WindowClaim& proposal : candidates) {
    auto set = verified(proposal, tracker.noise, tracker.slew);
    if (!set) {
      continue;
    }
    for (const double margin : {1.02, 1.1, 1.3}) {
      if (within(*set, margin) &&
          certainly_less_equal(Interval(set->claim.signal_uncertainty), tracker.design.q1) &&
          covers_start(question_, *set) &&
          certainly_below_covariances(tracker.design, question_.band, set->claim,
                                      set->start->times(set->start->to, tracker.amplitude))) {
        return set;
      }
    }
  }
  return std::nullopt;
}

std::optional<PhaseSet> PhaseSearch::largest_noise() const {
  const rigor::UpwardRounding upward;
  const auto& design = question_.tracker.design;
  const Interval zero(0.0);
  constexpr double kBelow = 1.0 - 1e-9;  // room for the start
  const auto noise_of = [&](const WindowClaim& claim) {
    const Interval input = WindowErrors(design, claim, zero, zero).largest_input();
    return kBelow * (input * sqrt(design.r)).lower();
  };
  for (const WindowClaim& proposal : best_first(still_proposals_, noise_of)) {
    for (const double slack : {0.012, kUsualSlack, 0.05}) {
      WindowClaim claim = with_slack(proposal, slack);
      // Rounding takes some of the room; it grows with the noise.
      claim.assumption.rounding = allowed_rounding(question_, claim, Interval(noise_of(claim)));
      const double noise = noise_of(claim);
      if (!(noise > 0.0)) {
        continue;
      }
      if (auto set = verified(proposal, Interval(noise), zero)) {
        return set;
      }
    }
  }
  return std::nullopt;
}

std::optional<PhaseSet> PhaseSearch::largest_slew() const {
  const rigor::UpwardRounding upward;
  const auto& design = question_.tracker.design;
  const Interval zero(0.0);
  const auto room_for = [&](const WindowClaim& claim) {
    const Interval input = WindowErrors(design, claim, zero, zero).largest_input();
    return (input * sqrt(design.q2)).lower();
  };
  // The slew that the recursion would tolerate if it did not blur the phases in the window, and parts of it.
  const std::vector<WindowClaim> still = best_first(still_proposals_, room_for);
  if (still.empty()) {
    return std::nullopt;
  }
  const double most = room_for(still.front());
  WindowRequest request = request_;
  for (const double part : {0.6, 0.35, 0.2, 0.1}) {
    request.slew = part * most;
    const auto spare = [&](const WindowClaim& claim) { return room_for(claim) - request.slew; };
    for (const WindowClaim& proposal : best_first(propose_windows(request), spare)) {
      if (auto set = verified(proposal, zero, Interval(request.slew))) {
        return set;
      }
    }
  }
  return std::nullopt;
}

double PhaseSearch::start_level_seen(const PhaseSet& set) const {
  return propose_start(request_, set.claim, box_).level;
}

}  // namespace veritrack::single_channel
