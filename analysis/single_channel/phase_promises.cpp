#include "analysis/single_channel/phase_promises.hpp"

#include <cstddef>
#include <optional>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::single_channel {

using rigor::Interval;

Interval settling_samples(const PhaseQuestion& question, const PhaseSet& set, double start,
                          double frequency_error) {
  const WindowErrors errors = errors_of(question, set);
  constexpr int kFollowed = 4000;  // samples
  const double target =
      (Interval(frequency_error) / sqrt(Interval(set.claim.assumption.frequency_variance))).lower();
  const auto levels = errors.levels(start, kFollowed);
  if (!levels || !(target > 0.0) || !errors.keeps(target) || !(errors.ultimate() <= target)) {
    return Interval::empty();
  }
  int below = 0;
  for (int k = 0; k <= kFollowed; ++k) {
    below = (*levels)[static_cast<std::size_t>(k)] <= target ? below + 1 : 0;
    if (below == errors.window()) {
      return Interval(k + 1 - below);
    }
  }
  return Interval::empty();
}

bool satisfies(const PhaseQuestion& question, const PhaseSet& set VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  if (!set.assumed_level) {
    return false;
  }
  const sets::RequiredBounds& required = question.tracker.required;
  if (required.frequency_error && !certainly_less(frequency_error_bound(question, set, *set.assumed_level),
                                                  Interval(*required.frequency_error))) {
    return false;
  }
  if (!required.samples) {
    return true;
  }
  const std::optional<double>& settled = question.tracker.settled_frequency_error;
  return settled && certainly_less_equal(settling_samples(question, set, *set.assumed_level, *settled),
                                         Interval(*required.samples));
}

}  // namespace veritrack::single_channel
