// Proposals by golden sections. Not evidence.
#pragma once

namespace veritrack::checker {

/// Approximately where a function that falls and then rises on [low, high] is least, by `sections` golden
/// sections.
template <typename Function>
double place_of_least(double low, double high, int sections, const Function& function) {
  constexpr double kRatio = 0.6180339887498949;
  double left = high - kRatio * (high - low);
  double right = low + kRatio * (high - low);
  double at_left = function(left);
  double at_right = function(right);
  for (int i = 0; i < sections; ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kRatio * (high - low);
      at_left = function(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kRatio * (high - low);
      at_right = function(right);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace veritrack::checker
