// Boxes of start errors, each with the level that its starts reach: the evidence of a capture.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// Amplitude, phase and frequency errors between these exact numbers.
struct StartBox {
  std::array<Ball, 3> low, high;
};

/// Every point of the region lies in one of the boxes.
bool covers(const StartBox& region, const std::vector<StartBox>& boxes CHECKER_PLACE);

/// Two halves along the longest side, an error of the frequency counting four times as much as one of the
/// phase; any side is valid.
std::pair<StartBox, StartBox> halves(const StartBox& box);

/// Boxes of starts, each with the number of samples after which its starts are in the set, the turns by which
/// that set is shifted, and the level there.
struct Cover {
  std::vector<StartBox> boxes;
  std::vector<int> samples;
  std::vector<Ball> levels;
  Ball turns;
};

/// Throws Malformed.
Cover read_cover(const Tree& evidence);
/// The box of which this one is the mirror image, captured at the same sample, when there is one:
/// (psi, nu, P12, P13, v2, w) -> -(...) commutes with the step, and leaves the set and a P(0) with
/// P12 = P13 = 0 as they are.
std::size_t mirror_image(const Cover& cover, std::size_t index);

}  // namespace veritrack::checker
