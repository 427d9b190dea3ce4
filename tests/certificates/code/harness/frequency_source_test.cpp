#include "certificates/code/harness/frequency_source.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {
namespace {

struct Found {
  std::optional<SampleTime> time;
  std::vector<FrequencySource> sources;
};

std::string no_line(const DeclarationPlace& /*place*/) {
  return "";
}
std::string line_in_hertz(const DeclarationPlace& /*place*/) {
  return "float speed; // Hz";
}

Found found_in(const std::string& text, const std::string& object, LineReader line_of = no_line) {
  const WrittenCode code(text);
  const Declarations declarations = code.declarations();
  const StepCandidates candidates = step_candidates(declarations, code.file());
  const HarnessNames names{object, "result", "out_"};
  const std::optional<SampleTime> time =
      sample_time(declarations, candidates.taken.at(0), names, text, code.file());
  return {time, frequency_sources(declarations, candidates.taken.at(0), names, time, code.file(), line_of)};
}

}  // namespace

TEST_CASE(
    "a member that is multiplied by the time between samples is in rad/s, unless its comment says more") {
  const Found found = found_in(kLoop, "tracker");
  REQUIRE(found.time);
  CHECK(found.time->expression == "tracker.dt");
  CHECK_FALSE(found.time->hz);
  REQUIRE(found.sources.size() == 1);
  CHECK(found.sources[0].expression == "tracker.speed");
  CHECK(found.sources[0].unit == FrequencyUnit::radians_per_second);
  CHECK(found_in(kLoop, "tracker", line_in_hertz).sources[0].unit == FrequencyUnit::hertz);
}

TEST_CASE("a macro is the sample rate, and a turn makes hertz") {
  const Found found = found_in(
      "#define FS (8000.0f)\nstatic float freq, phase;\n"
      "void run(float y) { freq += y; phase += 6.28318531f * freq / FS; }\n",
      "");
  REQUIRE(found.time);
  CHECK(found.time->is_rate);
  CHECK(found.time->hz == 8000.0);
  CHECK(found.time->place.line == 1);
  REQUIRE(found.sources.size() == 1);
  CHECK(found.sources[0].unit == FrequencyUnit::hertz);
  CHECK(found_in("#define DT (1.0f / 50)\nstatic float w;\nvoid run(float y) { w += y * DT; }\n", "")
            .time->hz == 50.0);
}

TEST_CASE("without a time it is in rad/sample; a function that returns it comes first, a result last") {
  const Found found = found_in(
      "static float w, limit;\nfloat estimated_frequency(void) { return w; }\n"
      "float run(float y) { w += y; limit += y; return y; }\n",
      "");
  CHECK_FALSE(found.time);
  REQUIRE(found.sources.size() == 3);
  CHECK(found.sources[0].expression == "estimated_frequency()");
  CHECK(found.sources[1].expression == "w");
  CHECK(found.sources[1].unit == FrequencyUnit::radians_per_sample);
  CHECK(found.sources[2].is_result);
}

TEST_CASE("a function that multiplies by the time returns rad/sample") {
  const Found found = found_in(
      std::string(kLoop) + "float speed_of(const pll_t* p) { return p->speed * p->dt; }\n", "tracker");
  REQUIRE(found.sources.size() == 2);
  CHECK(found.sources[0].expression == "speed_of(&tracker)");
  CHECK(found.sources[0].unit == FrequencyUnit::radians_per_sample);
}

}  // namespace veritrack::certificates::code
