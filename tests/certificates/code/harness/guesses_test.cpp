#include "certificates/code/harness/guesses.hpp"

#include <doctest/doctest.h>

namespace veritrack::certificates::code {

TEST_CASE("gains are guessed for the unit and the rate of the program, and unknown names are not") {
  GuessContext context;
  context.is_times_period = [](const std::string&) { return false; };
  CHECK(guessed_number("kp", context) == "0.16f");
  CHECK(guessed_number("ki", context) == "0.0002f");
  context.sample_rate = 10000;
  context.unit = FrequencyUnit::radians_per_second;
  CHECK(guessed_number("kp", context) == "0.16f");
  CHECK(guessed_number("ki", context) == "2.0f");
  context.is_times_period = [](const std::string&) { return true; };
  CHECK(guessed_number("kp", context) == "1600.0f");
  CHECK(guessed_number("ki", context) == "20000.0f");
  CHECK(guessed_number("dt", context) == "1.0f / 10000.0f");
  context.is_double = true;
  CHECK(guessed_number("sample_rate", context) == "10000.0");
  CHECK(guessed_number("zeta", context) == "0.7");
  CHECK_FALSE(guessed_number("gamma", context));
  CHECK(number_literal(1e-7, false) == "1e-07f");
}

}  // namespace veritrack::certificates::code
