#include "analysis/single_channel/phase_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/single_channel/phase_promises.hpp"
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
}

const std::vector<WindowClaim>& PhaseSearch::still_proposals() const {
  if (!still_proposals_) {
    WindowRequest still = request_;
    still.slew = 0.0;
    still_proposals_ = request_.slew == 0.0 ? proposals_ : propose_windows(still);
  }
  return *still_proposals_;
}

template <typename StartsOf>
std::optional<PhaseSet> PhaseSearch::verified(const WindowClaim& proposal, const Interval& noise,
                                              const Interval& slew, const StartsOf& starts_of) const {
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
    const std::optional<std::vector<PhaseSet>> started = starts_of(set);
    if (started && started->empty()) {
      return std::nullopt;
    }
    std::vector<StartVariances> starts;
    for (const PhaseSet& one : started.value_or(std::vector<PhaseSet>())) {
      starts.push_back(one.start->times(one.start->to, question_.tracker.amplitude));
    }
    const auto window = verify_window(question_.tracker.design, question_.band, set.claim, starts);
    if (!window) {
      continue;
    }
    if (!started) {
      set.floor = window->floor;
      return set;
    }
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (window->is_below[i]) {
        set = (*started)[i];
        set.floor = window->floor;
        return set;
      }
    }
    return std::nullopt;
  }
  return std::nullopt;
}

std::optional<PhaseSet> PhaseSearch::verified(const WindowClaim& proposal, const Interval& noise,
                                              const Interval& slew) const {
  return verified(proposal, noise, slew,
                  [](const PhaseSet& /*set*/) { return std::optional<std::vector<PhaseSet>>(); });
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

template <typename Accept>
std::optional<PhaseSet> PhaseSearch::set_for_starts(const Accept& accept) const {
  const rigor::UpwardRounding upward;
  const sets::ContractionQuestion& tracker = question_.tracker;
  // With matrices below all covariances, up to the resolution of the grid, in which the level of the assumed
  // starts is small, a little smaller than that by each margin; and that level.
  const auto with_starts = [&](const PhaseSet& set, std::initializer_list<double> margins) {
    std::vector<PhaseSet> started;
    const StartProposal seen = propose_start(request_, set.claim, shape_of(box_));
    for (const double margin : margins) {
      PhaseSet one = set;
      one.start = diagonal_start(seen, box_, margin, midpoint(tracker.amplitude));
      one.assumed_level = level_of(*one.start, box_, tracker.amplitude);
      if (one.assumed_level && errors_of(question_, one).levels(*one.assumed_level, kFollowed)) {
        started.push_back(one);
      }
    }
    return started;
  };
  const auto promise = [&](const WindowClaim& claim) {
    const PhaseSet set{claim, {}, tracker.noise, tracker.slew, 0.0, std::nullopt};
    if (!errors_of(question_, set).keeps_radius()) {
      return 0.0;
    }
    const std::vector<PhaseSet> started = with_starts(set, {1.0});
    return started.empty()
               ? 0.0
               : 1.0 / frequency_error_bound(question_, started[0], *started[0].assumed_level).upper();
  };
  // Every predicted covariance is above Q, those of a start from any covariance too.
  std::vector<WindowClaim> proposals = proposals_;
  for (WindowClaim& claim : proposals) {
    claim.signal_uncertainty = std::min(claim.signal_uncertainty, tracker.design.q1.lower());
  }
  std::vector<WindowClaim> candidates = best_first(proposals, promise);
  // Small sets promise more, but large ones are easier to verify.
  std::vector<WindowClaim> large(proposals.rbegin(), proposals.rend());
  large.resize(std::min(large.size(), kTries));
  candidates.insert(candidates.end(), large.begin(), large.end());
  for (const WindowClaim& proposal : candidates) {
    auto set = verified(proposal, tracker.noise, tracker.slew, [&](const PhaseSet& one) {
      std::vector<PhaseSet> started = with_starts(one, {1.02, 1.1, 1.3});
      std::erase_if(started, [&](const PhaseSet& start) {
        return !certainly_less_equal(Interval(start.claim.signal_uncertainty), tracker.design.q1) ||
               !covers_start(question_, start) || !accept(start);
      });
      return std::optional(started);
    });
    if (set) {
      return set;
    }
  }
  return std::nullopt;
}

std::optional<PhaseSet> PhaseSearch::least_bound() const {
  return set_for_starts([](const PhaseSet& /*set*/) { return true; });
}

std::optional<PhaseSet> PhaseSearch::sufficient_set() const {
  return set_for_starts([&](const PhaseSet& set) { return satisfies(question_, set); });
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
  for (const WindowClaim& proposal : best_first(still_proposals(), noise_of)) {
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
  const std::vector<WindowClaim> still = best_first(still_proposals(), room_for);
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
