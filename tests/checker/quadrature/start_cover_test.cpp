// Boxes that cover a region of starts, and boxes that leave something out.
#include "checker/quadrature/start_cover.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/random.hpp"

using namespace veritrack;
using checker::Ball;
using checker::covers;
using checker::StartBox;

namespace {

using Point = std::array<double, 3>;

StartBox box(const Point& low, const Point& high) {
  StartBox result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.low[i] = Ball(low[i]);
    result.high[i] = Ball(high[i]);
  }
  return result;
}

const StartBox kRegion = box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});

/// Cuts the box at random until there are so many parts.
std::vector<std::pair<Point, Point>> random_parts(test::Random& random, std::size_t count) {
  std::vector<std::pair<Point, Point>> parts{{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}};
  while (parts.size() < count) {
    const std::size_t k = random.below(parts.size());
    const std::size_t i = random.below(3);
    auto other = parts[k];
    const double cut = random.uniform(parts[k].first[i], parts[k].second[i]);
    parts[k].second[i] = other.first[i] = cut;
    parts.push_back(other);
  }
  return parts;
}

std::vector<StartBox> boxes_of(const std::vector<std::pair<Point, Point>>& parts) {
  std::vector<StartBox> boxes;
  for (const auto& [low, high] : parts) {
    boxes.push_back(box(low, high));
  }
  return boxes;
}

}  // namespace

TEST_CASE("parts of a box cover it, whatever the cuts, and no longer when one is smaller") {
  test::Random random(211);
  for (std::int64_t trial = 0; trial < test::effort(200); ++trial) {
    CAPTURE(trial);
    auto parts = random_parts(random, 1 + random.below(12));
    CHECK(covers(kRegion, boxes_of(parts)));
    auto& [low, high] = parts[random.below(parts.size())];
    const std::size_t i = random.below(3);
    const double length = high[i] - low[i];
    (random.below(2) == 0 ? low[i] : high[i]) = low[i] + 0.5 * length;
    CHECK(!covers(kRegion, boxes_of(parts)));
  }
}

TEST_CASE("boxes beside a region do not cover it, though they touch it") {
  CHECK(!covers(kRegion, {}));
  for (std::size_t i = 0; i < 3; ++i) {
    Point low{-1.0, -1.0, -1.0};
    Point high{2.0, 2.0, 2.0};
    high[i] = 0.0;
    CHECK(!covers(kRegion, {box(low, high)}));
    high[i] = -0.5;
    CHECK(!covers(kRegion, {box(low, high)}));
    high[i] = 2.0;
    low[i] = 1.0;
    CHECK(!covers(kRegion, {box(low, high)}));
    low[i] = 1.5;
    CHECK(!covers(kRegion, {box(low, high)}));
    // All but a slice on one side, and all but one on the other.
    low[i] = 0x1p-30;
    CHECK(!covers(kRegion, {box(low, high)}));
    low[i] = -1.0;
    high[i] = 1.0 - 0x1p-30;
    CHECK(!covers(kRegion, {box(low, high)}));
  }
  CHECK(covers(kRegion, {box({-1.0, -1.0, -1.0}, {2.0, 2.0, 2.0})}));
}

TEST_CASE("a slit between two boxes is seen") {
  for (const double slit : {0.0, 0x1p-50}) {
    const std::vector<StartBox> boxes{box({0.0, 0.0, 0.0}, {0.5, 1.0, 1.0}),
                                      box({0.5 + slit, 0.0, 0.0}, {1.0, 1.0, 1.0})};
    CHECK(covers(kRegion, boxes) == (slit == 0.0));
  }
}

TEST_CASE("a mirror image is one in phase and frequency only, followed as long") {
  checker::Cover cover;
  cover.boxes = {box({0.0, 0.25, 0.5}, {1.0, 0.75, 1.0}), box({0.0, -0.75, -1.0}, {1.0, -0.25, -0.5})};
  cover.samples = {3, 3};
  CHECK(checker::mirror_image(cover, 0) == 1);
  CHECK(checker::mirror_image(cover, 1) == 0);
  SUBCASE("other samples") {
    cover.samples[1] = 4;
  }
  SUBCASE("another amplitude below") {
    cover.boxes[1].low[0] = Ball(0.125);
  }
  SUBCASE("another amplitude above") {
    cover.boxes[1].high[0] = Ball(1.125);
  }
  SUBCASE("less phase below") {
    cover.boxes[1].low[1] = Ball(-0.7);
  }
  SUBCASE("less phase above") {
    cover.boxes[1].high[1] = Ball(-0.3);
  }
  SUBCASE("less frequency below") {
    cover.boxes[1].low[2] = Ball(-0.9);
  }
  SUBCASE("less frequency above") {
    cover.boxes[1].high[2] = Ball(-0.6);
  }
  CHECK(checker::mirror_image(cover, 0) == 0);
}

TEST_CASE("a witness turns a whole number of times") {
  const auto turns = [](const std::string& number) {
    const checker::Tree evidence = checker::read_json(
        R"({"name": "witness", "matrices": {"boxes": []}, "numbers": {"turns": ")" + number + R"("}})");
    return checker::read_cover(evidence).turns;
  };
  CHECK(certainly_equal(turns("-0x1p+1"), Ball(-2.0)));
  CHECK_THROWS_AS(turns("0x1p-1"), checker::Malformed);
}

TEST_CASE("a list that needs hundreds of cuts is not followed") {
  // The part from 0 to each 2^-k lies between 0 and the one before.
  const auto slices = [](int count) {
    std::vector<StartBox> boxes;
    double high = 1.0;
    for (int k = 0; k < count; ++k, high *= 0.5) {
      boxes.push_back(box({k + 1 == count ? 0.0 : 0.5 * high, 0.0, 0.0}, {high, 1.0, 1.0}));
    }
    return boxes;
  };
  CHECK(covers(kRegion, slices(150)));
  CHECK_FALSE(covers(kRegion, slices(250)));
}
