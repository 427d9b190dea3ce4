// The values of a set at each frequency, where it has tubes for several parts of the amplitudes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/model/set/tube_set.hpp"

namespace veritrack::reports {

/// Something of a tube, over its frequencies in rad/sample.
struct OverTube {
  double low = 0.0;
  double high = 0.0;
  double value = 0.0;
};

/// Over its frequencies what each tube of a set has; with parts of the amplitudes, at each frequency the
/// least of all parts.
template <typename Value>
[[nodiscard]] std::vector<OverTube> least_of_parts(const model::TubeSet& set, const Value& value_of) {
  std::vector<OverTube> each;
  for (const model::ProvedTube& proved : set.tubes) {
    const double width = proved.tube.half_width;
    each.push_back({proved.tube.frequency - width, proved.tube.frequency + width, value_of(proved)});
  }
  if (set.amplitudes.size() <= 1) {
    return each;
  }
  std::vector<double> ends;
  for (const OverTube& tube : each) {
    ends.insert(ends.end(), {tube.low, tube.high});
  }
  std::sort(ends.begin(), ends.end());
  std::vector<OverTube> least;
  constexpr double kNothing = 1e-9;  // of the band: what neighbours have in common
  const double narrow = kNothing * (ends.back() - ends.front());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    OverTube here{ends[i], ends[i + 1], INFINITY};
    for (const OverTube& tube : each) {
      here.value = tube.low <= middle && middle <= tube.high ? std::min(here.value, tube.value) : here.value;
    }
    if (here.high - here.low > narrow && std::isfinite(here.value)) {
      least.push_back(here);
    }
  }
  return least;
}

}  // namespace veritrack::reports
