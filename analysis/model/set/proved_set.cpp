#include "analysis/model/set/proved_set.hpp"

#include <algorithm>
#include <utility>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/tube/false_lock.hpp"
#include "analysis/model/tube/tube_errors.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

/// A thousandth more; infinity when nothing is known.
double with_thousandth(double bound) {
  constexpr double kMore = 1.001;
  return std::isfinite(bound) ? (Interval(bound) * Interval(kMore)).upper() : INFINITY;
}

/// The largest absolute value; infinity when nothing is known.
double largest_size(const Interval& range) {
  return rigor::is_finite(range) ? std::max(std::fabs(range.lower()), std::fabs(range.upper())) : INFINITY;
}

/// Bias and ripple at the lowest level, with room for rounding and a tenth of the uncertainty where that is
/// least.
void add_bias_and_ripple(ProvedSet& set, const TubeErrors& settled) {
  double unknown = INFINITY;
  for (const TubeErrors::Slice& slice : settled.slices) {
    unknown = std::min(unknown, slice.mean.upper() - slice.mean.lower());
  }
  const double room = rigor::is_finite(settled.mean) ? 0.05 * unknown + 1e-12 : INFINITY;
  const Interval mean =
      rigor::is_finite(settled.mean) ? settled.mean + Interval::from_bounds(-room, room) : Interval::empty();
  set.bias = rigor::is_finite(mean) ? mean : Interval::empty();
  constexpr double kOfRipple = 2e-5;
  const double of_ripple = std::min(0.01 * settled.ripple, kOfRipple * settled.ripple + 0.05 * unknown);
  set.ripple = larger_bound(0.0, settled.ripple + of_ripple);
}

/// The consequences of one tube, without the distance to false locks.
ProvedSet bounds_of(const TrackerModel& tracker, const ProvedTube& proved,
                    const std::vector<Interval>& deviations, std::vector<FrequencySlice>* slices) {
  constexpr ErrorGrid kGrid;
  constexpr ErrorGrid kFine{128, 16, 16};  // the bias changes with the frequency
  const double radius = proved.levels.front();
  ProvedSet set;
  set.half_distance = INFINITY;
  set.reach = bound_reach(tracker, proved.tube, radius, kGrid) * 0.999;
  // For a filter whose covariance is bounded, those of the estimate.
  const std::vector<Interval> of_tube(
      deviations.begin(), deviations.begin() + static_cast<std::ptrdiff_t>(proved.tube.curve.size()));
  const double start = bound_start(tracker, proved.tube, of_tube, kGrid);
  set.start_share = larger_bound(0.0, (Interval(with_thousandth(start)) / Interval(radius)).upper());
  const TubeErrors settled =
      bound_errors(tracker, proved.tube, proved.levels.back(), slices != nullptr ? kFine : kGrid);
  const Interval whole = bound_errors(tracker, proved.tube, radius, kGrid).error;
  set.frequency_error = larger_bound(0.0, with_thousandth(largest_size(whole)));
  set.settled_error = larger_bound(0.0, with_thousandth(largest_size(settled.error)));
  add_bias_and_ripple(set, settled);
  if (slices != nullptr) {
    for (const TubeErrors::Slice& slice : settled.slices) {
      slices->push_back({slice.low, slice.high, slice.mean, slice.ripple, set.reach});
    }
  }
  return set;
}

/// Bounds that are valid for both sets.
void include(ProvedSet& worst, const ProvedSet& set) {
  worst.frequency_error = larger_bound(worst.frequency_error, set.frequency_error);
  worst.half_distance = std::min(worst.half_distance, set.half_distance);
  worst.settled_error = larger_bound(worst.settled_error, set.settled_error);
  worst.ripple = larger_bound(worst.ripple, set.ripple);
  worst.start_share = larger_bound(worst.start_share, set.start_share);
  worst.reach = set.reach < worst.reach ? set.reach : worst.reach;
  const bool is_known = rigor::is_finite(worst.bias) && rigor::is_finite(set.bias);
  worst.bias = is_known ? hull(worst.bias, set.bias) : Interval::empty();
}

/// Without parts of the amplitudes, or for one of them.
ProvedSet conclude_of_tubes(const TrackerModel& tracker, TubeSet tubes,
                            const std::vector<Interval>& deviations, std::vector<FrequencySlice>* slices) {
  ProvedSet set;
  for (const ProvedTube& proved : tubes.tubes) {
    ProvedSet of_tube = bounds_of(tracker, proved, deviations, slices);
    if (&proved == &tubes.tubes.front()) {
      set = std::move(of_tube);
    } else {
      include(set, of_tube);
    }
  }
  if (!tubes.tubes.empty()) {
    const Tube& lowest = tubes.tubes.front().tube;
    const Tube& highest = tubes.tubes.back().tube;
    set.half_distance = half_distance_to_false_lock(
        tracker, hull(Interval(lowest.frequency) - Interval(lowest.half_width),
                      Interval(highest.frequency) + Interval(highest.half_width)));
  }
  set.tubes = std::move(tubes);
  return set;
}

}  // namespace

ProvedSet conclude(const TrackerModel& tracker, TubeSet tubes, const std::vector<Interval>& deviations,
                   std::vector<FrequencySlice>* slices) {
  const rigor::UpwardRounding upward;
  if (tubes.amplitudes.size() <= 1) {
    return conclude_of_tubes(tracker, std::move(tubes), deviations, slices);
  }
  ProvedSet worst;
  std::vector<std::vector<FrequencySlice>> of_parts;
  bool is_first = true;
  for (TubeSet& part : sets_of_amplitudes(tubes)) {
    std::vector<FrequencySlice>* of_part = slices != nullptr ? &of_parts.emplace_back() : nullptr;
    ProvedSet set = conclude_of_tubes(tracker, std::move(part), deviations, of_part);
    if (is_first) {
      worst = std::move(set);
      is_first = false;
    } else {
      include(worst, set);
    }
  }
  if (slices != nullptr) {
    *slices = worst_of(of_parts);
  }
  worst.tubes = std::move(tubes);
  return worst;
}

TubeSet from_level(TubeSet set, std::size_t level) {
  const auto drop = [&](std::vector<double>& factors) {
    // With a single level left, its factor is that of the last pair.
    const std::size_t kept = std::max<std::size_t>(factors.size(), level + 1) - level;
    factors.erase(factors.begin(),
                  factors.end() - static_cast<std::ptrdiff_t>(std::min(kept, factors.size())));
  };
  for (ProvedTube& proved : set.tubes) {
    proved.levels.erase(proved.levels.begin(), proved.levels.begin() + static_cast<std::ptrdiff_t>(level));
    drop(proved.shrinking);
  }
  drop(set.crossing);
  for (AmplitudePart& part : set.amplitudes) {
    drop(part.crossing);
  }
  return set;
}

ProvedSet lowered_to(const TrackerModel& tracker, ProvedSet set, const std::vector<Interval>& deviations,
                     const Interval& required) {
  std::size_t most = set.tubes.tubes.empty() ? 0 : SIZE_MAX;
  for (const ProvedTube& proved : set.tubes.tubes) {
    most = std::min(most, proved.levels.size());
  }
  const rigor::UpwardRounding upward;
  for (std::size_t level = 1; level < most; ++level) {
    if (rigor::certainly_less(Interval(set.frequency_error), required)) {
      break;
    }
    ProvedSet lower = conclude(tracker, from_level(set.tubes, level), deviations);
    if (!(lower.start_share <= 1.0)) {
      break;
    }
    if (rigor::certainly_less(Interval(lower.frequency_error), required)) {
      return lower;
    }
  }
  return set;
}

}  // namespace veritrack::model
