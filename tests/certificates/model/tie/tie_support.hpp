// Sources of C, their listings, and programs that are made of them.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "certificates/code/compilation.hpp"
#include "certificates/model/tie/build.hpp"
#include "certificates/model/tie/comparison.hpp"
#include "certificates/model/tie/drawn_steps.hpp"
#include "tests/support/scratch_folder.hpp"

namespace veritrack::certificates::tie {

/// A text as the only file of [code], and its listing.
class OneFile {
 public:
  explicit OneFile(const std::string& text, const std::string& name = "loop.c",
                   const std::vector<std::string>& flags = {}) {
    std::ofstream(folder_ / name) << text;
    table_.files.push_back({name, {1, 1}});
    for (const std::string& flag : flags) {
      table_.flags.push_back({flag, {1, 1}});
    }
    listing_ = code::compiled(table_, design()).listing;
  }

  [[nodiscard]] std::filesystem::path design() const { return folder_ / "design.toml"; }
  [[nodiscard]] const trackers::code::Listing& listing() const { return listing_; }
  [[nodiscard]] Sources sources() const { return sources_of(table_, listing_, design()); }

 private:
  test::ScratchFolder folder_;
  code::CodeTable table_;
  trackers::code::Listing listing_;
};

/// States from -4 to 4, samples of a tone of amplitude 1 and some noise.
[[nodiscard]] inline DrawnSteps some_steps(const trackers::code::Listing& listing, int count = 1000) {
  DrawRanges ranges;
  ranges.states.assign(listing.states.size(), {-4.0, 4.0});
  ranges.noise = 0.5;
  return drawn_steps(listing, ranges, count, 1);
}

/// A loop with a wrap, a limit and a function of the library.
inline constexpr const char* kLoop = R"(#include <math.h>
#ifndef GAIN
#define GAIN 0.1f
#endif
#ifndef PLUS
#define PLUS +
#endif
#ifndef LIMIT
#define LIMIT w > 1.0f
#endif
#ifndef ORDER
#define ORDER (theta + w) + GAIN * e
#endif
static float theta, w, past[2];
void setup(void) { w = 0.3f; }
void step(float y) {
  const float e = y * cosf(theta) + 0.01f * past[1];
  w = w PLUS 0.01f * e;
  if (LIMIT) w = 1.0f;
  theta = ORDER;
  if (theta > 3.14159265f) theta -= 6.28318531f;
  past[1] = past[0];
  past[0] = y;
}
float frequency(void) { return w; }
)";

}  // namespace veritrack::certificates::tie
