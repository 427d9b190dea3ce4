// The part of a band in which tubes are searched for.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// From low to high, rad/sample, and the reasons why not in the rest of the band: one sentence without a full
/// stop for each end that is out of reach.
struct SearchedBand {
  double low = 0.0;
  double high = 0.0;
  std::vector<std::string> out_of_reach;

  [[nodiscard]] bool is_empty() const { return !(low < high); }
};

/// Empty unless the band, rad/sample, is of some width and in [0, pi], which may be rounded to 3.142. Needs
/// the upward rounding mode.
[[nodiscard]] SearchedBand searched_band(const rigor::Interval& band, std::size_t channels);

}  // namespace veritrack::model
