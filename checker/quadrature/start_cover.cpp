#include "checker/quadrature/start_cover.hpp"

#include <cmath>
#include <cstdint>

#include "checker/document/evidence.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr double kMostSamplesOfBox = 1000;

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

using BoxList = std::vector<const StartBox*>;

/// A region that no box contains as a whole is cut along a side of a box, the one nearest to its middle, and
/// both parts are covered, or it is not covered. `cuts` is the number of cuts left: boxes of an engineer's
/// starts need a few dozen, and a list made to need thousands would fill the memory.
bool is_covered(const StartBox& region, const BoxList& boxes, int cuts) {
  spend(static_cast<std::int64_t>(boxes.size() * sizeof(const StartBox*)));
  BoxList near;
  double best = HUGE_VAL;
  std::size_t direction = 0;
  Ball cut;
  for (const StartBox* box : boxes) {
    if (contains(*box, region)) {
      return true;
    }
    if (is_apart(*box, region)) {
      continue;
    }
    near.push_back(box);
    for (std::size_t i = 0; i < 3; ++i) {
      for (const Ball& side : {box->low[i], box->high[i]}) {
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
  if (std::isinf(best) || cuts == 0) {
    return false;
  }
  StartBox lower = region;
  StartBox upper = region;
  lower.high[direction] = cut;
  upper.low[direction] = cut;
  return is_covered(lower, near, cuts - 1) && is_covered(upper, near, cuts - 1);
}

}  // namespace

bool covers(const StartBox& region, const std::vector<StartBox>& boxes CHECKER_DECLARED_PLACE) {
  CHECKER_IF_FORCED
  constexpr int kMostCuts = 200;
  BoxList all;
  for (const StartBox& box : boxes) {
    all.push_back(&box);
  }
  return is_covered(region, all, kMostCuts);
}

std::pair<StartBox, StartBox> halves(const StartBox& box) {
  constexpr std::array<double, 3> kWeights{1.0, 1.0, 4.0};
  std::size_t direction = 0;
  double longest = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = kWeights[i] * (box.high[i] - box.low[i]).near();
    if (length > longest) {
      longest = length;
      direction = i;
    }
  }
  std::pair<StartBox, StartBox> parts{box, box};
  const Ball middle((half * (box.low[direction] + box.high[direction])).near());
  parts.first.high[direction] = middle;
  parts.second.low[direction] = middle;
  return parts;
}

Cover read_cover(const Tree& evidence) {
  Cover cover;
  for (const Tree& row : evidence.at("matrices").at("boxes").elements()) {
    const auto number = [&](std::size_t i) { return exact_number(row.at(i)); };
    cover.boxes.push_back({{number(0), number(2), number(4)}, {number(1), number(3), number(5)}});
    const double samples = number(6).near();
    if (!(samples >= 0.0) || samples > kMostSamplesOfBox || samples != std::floor(samples)) {
      throw Malformed("not a number of samples");
    }
    cover.samples.push_back(static_cast<int>(samples));
    cover.levels.push_back(number(7));
  }
  if (evidence.at("name").text() == "witness") {
    cover.turns = exact_number(evidence.at("numbers").at("turns"));
    if (!certainly_equal(cover.turns, Ball(std::floor(cover.turns.near())))) {
      throw Malformed("not a number of turns");
    }
  }
  return cover;
}

std::size_t mirror_image(const Cover& cover, std::size_t index) {
  spend(static_cast<std::int64_t>(cover.boxes.size()));
  const StartBox& box = cover.boxes[index];
  for (std::size_t i = 0; i < cover.boxes.size(); ++i) {
    const StartBox& other = cover.boxes[i];
    bool same = cover.samples[i] == cover.samples[index] && certainly_equal(box.low[0], other.low[0]) &&
                certainly_equal(box.high[0], other.high[0]);
    for (const std::size_t j : {std::size_t{1}, std::size_t{2}}) {
      same =
          same && certainly_equal(box.low[j], -other.high[j]) && certainly_equal(box.high[j], -other.low[j]);
    }
    if (same) {
      return i;
    }
  }
  return index;
}

}  // namespace veritrack::checker
