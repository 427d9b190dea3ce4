#include "checker/quadrature/start_boxes.hpp"

#include <cmath>

namespace veritrack::checker {

namespace {

bool contains(const StartBox& box, const StartBox& region) {
  bool all = true;
  for (std::size_t i = 0; i < 3; ++i) {
    all =
        all && certainly_at_most(box.low[i], region.low[i]) && certainly_at_most(region.high[i], box.high[i]);
  }
  return all;
}

bool is_apart(const StartBox& box, const StartBox& region) {
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    any = any || certainly_less(box.high[i], region.low[i]) || certainly_less(region.high[i], box.low[i]);
  }
  return any;
}

}  // namespace

// What no box contains as a whole is cut along a side of a box, the one nearest to its middle, and both parts
// are covered, or it is not covered.
bool covers(const StartBox& region, const std::vector<StartBox>& boxes) {
  std::vector<StartBox> near;
  double best = HUGE_VAL;
  std::size_t direction = 0;
  Ball cut;
  for (const StartBox& box : boxes) {
    if (contains(box, region)) {
      return true;
    }
    if (is_apart(box, region)) {
      continue;
    }
    near.push_back(box);
    for (std::size_t i = 0; i < 3; ++i) {
      for (const Ball& side : {box.low[i], box.high[i]}) {
        const Ball off = (side - region.low[i]) / (region.high[i] - region.low[i]);
        if (certainly_less(region.low[i], side) && certainly_less(side, region.high[i]) &&
            std::fabs(off.near() - 0.5) < best) {
          best = std::fabs(off.near() - 0.5);
          direction = i;
          cut = side;
        }
      }
    }
  }
  if (std::isinf(best)) {
    return false;
  }
  StartBox lower = region;
  StartBox upper = region;
  lower.high[direction] = cut;
  upper.low[direction] = cut;
  return covers(lower, near) && covers(upper, near);
}

}  // namespace veritrack::checker
