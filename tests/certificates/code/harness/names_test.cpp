#include "certificates/code/harness/names.hpp"

#include <doctest/doctest.h>

namespace veritrack::certificates::code {

TEST_CASE("names have words") {
  CHECK(words_of_name("pll_runFast2") == std::vector<std::string>{"pll", "run", "fast", "2"});
  CHECK(words_of_name("kDt") == std::vector<std::string>{"k", "dt"});
  CHECK(words_of_name("w_") == std::vector<std::string>{"w"});
  CHECK(last_name("ns::Loop::feed") == "feed");
  CHECK(last_name("feed") == "feed");
}

TEST_CASE("names suggest what a function or a number is") {
  CHECK(step_likeness("foc_pll_run") == 2);
  CHECK(step_likeness("pll") == 1);
  CHECK(step_likeness("wrapped") == 0);
  CHECK(is_named_like_init("pll_init"));
  CHECK(is_named_like_init("reset"));
  CHECK_FALSE(is_named_like_init("start_step"));
  CHECK(is_named_like_period("dt"));
  CHECK(is_named_like_period("sample_time"));
  CHECK_FALSE(is_named_like_period("width"));
  CHECK(is_named_like_sample_rate("sampleRate"));
  CHECK(is_named_like_sample_rate("fs_"));
  CHECK(is_named_like_angle("theta_hat"));
  CHECK(frequency_likeness("omega_hat") > frequency_likeness("w"));
  CHECK(frequency_likeness("w") > frequency_likeness("rate"));
  CHECK(frequency_likeness("sample_rate") == 0);
  CHECK(frequency_likeness("freq_max") == 0);
  CHECK(frequency_likeness("phase") == 0);
}

}  // namespace veritrack::certificates::code
