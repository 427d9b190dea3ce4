// What veritrack tie says, for a design.
#include "certificates/model/tie/tie.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/model/tie/draw_ranges.hpp"
#include "tests/support/scratch_folder.hpp"

namespace veritrack::certificates::tie {

namespace {

constexpr const char* kDesign = R"(name = "a loop"
tracker = "model"
[code]
files = ['harness.c', 'loop.c']
[assume]
amplitude = 0.5
sample_rate = 1000
frequency = { hz = [50, 100] }
noise = 0.01
)";
constexpr const char* kHarness = R"(void loop_run(float y, float z);
extern float hertz;
void setup(void) { hertz = 80.0f; }
void step(float y, float z) { loop_run(y, z); }
float frequency(void) { return hertz * 0.00628318531f; }
)";
constexpr const char* kSource = R"(#include <math.h>
#ifndef GAIN
#define GAIN 2.0f
#endif
float hertz;
static float theta;
void loop_run(float y, float z) {
  float e = atan2f(z, y) - theta;
  if (e > 3.14159265f) e -= 6.28318531f;
  if (e < -3.14159265f) e += 6.28318531f;
  theta += hertz * 0.00628318531f + 0.2f * e;
  if (theta > 3.14159265f) theta -= 6.28318531f;
  if (theta < -3.14159265f) theta += 6.28318531f;
  hertz += GAIN * e;
}
)";

struct Folder {
  Folder() {
    std::ofstream(folder / "design.toml") << kDesign;
    std::ofstream(folder / "harness.c") << kHarness;
    std::ofstream(folder / "loop.c") << kSource;
  }
  test::ScratchFolder folder;
};

}  // namespace

TEST_CASE("states are drawn where the design says: the band with an eighth beyond, angles, the amplitude") {
  const Folder made;
  const Design design = read_design_file((made.folder / "design.toml").string());
  const auto& listing = listing_of(design);
  const DrawRanges ranges = draw_ranges(design);
  REQUIRE(listing.states.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    if (listing.states[i].name == "hertz") {
      CHECK(ranges.states[i].low == doctest::Approx(50.0 - 50.0 / 8));
      CHECK(ranges.states[i].high == doctest::Approx(100.0 + 50.0 / 8));
    } else {
      CHECK(listing.states[i].name == "theta");
      CHECK(ranges.states[i].low < -3.0);
      CHECK(ranges.states[i].low > -8.0);
      CHECK(ranges.states[i].high >= 3.14);
    }
  }
  CHECK(ranges.amplitude.low == 0.5);
  CHECK(ranges.amplitude.high == 0.5);
  CHECK(ranges.noise == 0.01);
}

TEST_CASE("equal builds, and one that differs: which state, both values, the inputs, and the line") {
  const Folder made;
  const std::string file = (made.folder / "design.toml").string();
  const Design design = read_design_file(file);
  TieRequest request;
  request.builds = {"gcc -O0", "gcc -O2"};
  request.states = 500;
  const TieResult same = tied(design, file, request);
  CHECK(same.is_equal());
  const std::string text = tie_text(design, request, same);
  CAPTURE(text);
  CHECK(text.rfind("EQUAL: 500 states, 2 builds: each bit of theta, hertz and the frequency\n", 0) == 0);
  CHECK(text.find("Drawn with seed 1: 500 states and samples, 50 of them in pairs") != std::string::npos);
  CHECK(text.find("Results of atan2f are those of each build's own library") != std::string::npos);

  request.builds.emplace_back("gcc -O2 -DGAIN=2.0000002f");
  const TieResult other = tied(design, file, request);
  CHECK_FALSE(other.is_equal());
  const std::string difference = tie_text(design, request, other);
  CAPTURE(difference);
  CHECK(difference.rfind("DIFFERENT: 1 of 3 builds\ngcc -O0: equal in 500 states\n", 0) == 0);
  CHECK(difference.find("first difference: hertz after a step, computed at loop.c:14:9\n    program: ") !=
        std::string::npos);
  CHECK(difference.find("    listing: ") != std::string::npos);
  CHECK(difference.find("  from\n    theta = ") != std::string::npos);
  CHECK(difference.find("    sample y = ") != std::string::npos);
  CHECK(difference.find(made.folder.path().string()) == std::string::npos);
}

TEST_CASE("a comparison of nothing is a failure") {
  const Folder made;
  const std::string file = (made.folder / "design.toml").string();
  const Design design = read_design_file(file);
  TieRequest request;
  request.builds = {"gcc -O2"};
  request.states = 0;
  CHECK_THROWS_AS((void)tied(design, file, request), NothingCompared);
}

TEST_CASE("a design without code has nothing to compare") {
  const std::string file = std::string(VERITRACK_SOURCE_DIR) + "/designs/models/sogi-fll.toml";
  CHECK_THROWS_AS((void)tie_model(read_design_file(file), file, {}), InputError);
}

}  // namespace veritrack::certificates::tie
