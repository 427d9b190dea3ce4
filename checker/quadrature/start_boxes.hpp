// Boxes of start errors: do they cover all that are assumed?
#pragma once

#include <array>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// Amplitude, phase and frequency errors between these exact numbers.
struct StartBox {
  std::array<Ball, 3> low, high;
};

/// Every point of the region lies in one of the boxes.
bool covers(const StartBox& region, const std::vector<StartBox>& boxes);

}  // namespace veritrack::checker
