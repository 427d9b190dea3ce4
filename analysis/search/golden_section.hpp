// The golden section: a proposal for the minimum of a function of one variable that has one valley.
#pragma once

#include <algorithm>
#include <limits>

namespace veritrack::search {

/// Where the search ended, and the cost there.
struct GoldenPoint {
  double point = 0.0;
  double cost = 0.0;
};

/// Narrows [low, high] by 0.618 a step around the smaller of two costs, until one is at most `enough`: the
/// smaller one only falls. In double, without any claim: where the cost has several valleys it ends in one of
/// them.
template <typename Cost>
[[nodiscard]] GoldenPoint golden_section(double low, double high, int steps, const Cost& cost,
                                         double enough = -std::numeric_limits<double>::infinity()) {
  constexpr double kGolden = 0.6180339887498949;
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  double at_left = cost(left);
  double at_right = cost(right);
  for (int i = 0; i < steps && !(std::min(at_left, at_right) <= enough); ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = cost(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = cost(right);
    }
  }
  return at_left < at_right ? GoldenPoint{left, at_left} : GoldenPoint{right, at_right};
}

}  // namespace veritrack::search
