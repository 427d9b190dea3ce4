#include "analysis/model/set/frequency_slices.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace veritrack::model {

using rigor::Interval;

namespace {

constexpr double kOverlap = 1e-9;  // of neighbouring slices, as a share of the frequency

/// The worst of all lists between these frequencies; empty unless each list covers them.
std::optional<FrequencySlice> worst_between(const std::vector<std::vector<FrequencySlice>>& lists, double low,
                                            double high) {
  FrequencySlice worst{low, high, Interval::empty(), 0.0, INFINITY};
  bool is_known = true;
  bool is_first = true;
  for (const std::vector<FrequencySlice>& list : lists) {
    bool is_here = false;
    for (const FrequencySlice& slice : list) {
      // Where slices of a list meet here, up to the overlap, both count.
      if (slice.low < high - 0.5 * kOverlap * high && slice.high > low + 0.5 * kOverlap * high) {
        is_here = true;
        is_known = is_known && rigor::is_finite(slice.bias);
        worst.bias = is_first ? slice.bias : hull(worst.bias, slice.bias);
        worst.ripple = larger_bound(worst.ripple, slice.ripple);
        worst.reach = slice.reach < worst.reach ? slice.reach : worst.reach;
        is_first = false;
      }
    }
    if (!is_here) {
      return std::nullopt;
    }
  }
  if (!is_known) {
    worst.bias = Interval::empty();
  }
  return worst;
}

}  // namespace

double larger_bound(double a, double b) {
  return std::isfinite(a) && std::isfinite(b) ? std::max(a, b) : INFINITY;
}

std::vector<FrequencySlice> worst_of(const std::vector<std::vector<FrequencySlice>>& lists) {
  std::vector<double> ends;
  for (const std::vector<FrequencySlice>& list : lists) {
    for (const FrequencySlice& slice : list) {
      ends.insert(ends.end(), {slice.low, slice.high});
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<FrequencySlice> all;
  double low = ends.empty() ? 0.0 : ends.front();
  for (const double high : ends) {
    if (!(high - low > kOverlap * high)) {
      continue;
    }
    if (const auto worst = worst_between(lists, low, high)) {
      all.push_back(*worst);
    }
    low = high;
  }
  return all;
}

}  // namespace veritrack::model
