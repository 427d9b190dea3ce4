#include "analysis/sets/contraction_question.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "analysis/rigor/rounding.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using sets::ContractionQuestion;

ContractionQuestion question() {
  ContractionQuestion question;
  question.design = {Interval(0.01), Interval(0.01), Interval(0.1), Interval(0.0)};
  question.noise = Interval(0.5);
  question.slew = Interval(0.25);
  return question;
}

TEST_CASE("a question with a bound that is no number, or below zero, is not well posed") {
  const rigor::UpwardRounding upward;
  CHECK(sets::is_well_posed(question()));
  for (const Interval& odd :
       {Interval(-1.0), Interval::from_bounds(1.0, std::numeric_limits<double>::infinity()),
        Interval::from_bounds(-1e-300, 1.0), Interval::empty()}) {
    for (Interval ContractionQuestion::*bound :
         {&ContractionQuestion::noise, &ContractionQuestion::slew,
          &ContractionQuestion::initial_amplitude_error, &ContractionQuestion::initial_phase_error,
          &ContractionQuestion::initial_frequency_error}) {
      ContractionQuestion asked = question();
      asked.*bound = odd;
      CHECK_FALSE(sets::is_well_posed(asked));
    }
  }
  ContractionQuestion without_noise_model = question();
  without_noise_model.design.r = Interval(0.0);
  CHECK_FALSE(sets::is_well_posed(without_noise_model));
  ContractionQuestion still = question();
  still.design.q2 = Interval(0.0);
  CHECK_FALSE(sets::is_well_posed(still));
}

TEST_CASE("the reason names the limit that is exceeded, and only that") {
  const rigor::UpwardRounding upward;
  const std::string noise = sets::beyond_the_limits(question(), 0.25, 0.5);
  CHECK(noise.find("noise (without slew) is 0.25; 0.5 was assumed") != std::string::npos);
  CHECK(noise.find("slew (without noise)") == std::string::npos);
  const std::string slew = sets::beyond_the_limits(question(), 0.5, 0.125);
  CHECK(slew.find("is 0.125; 0.25 was assumed") != std::string::npos);
  CHECK(slew.find("noise (without slew)") == std::string::npos);
  const std::string both = sets::beyond_the_limits(question(), 0.25, 0.125);
  CHECK(both.find("0.25; 0.5 was") != std::string::npos);
  CHECK(both.find("0.125; 0.25 was") != std::string::npos);
  CHECK(sets::beyond_the_limits(question(), 0.5, 0.25).find("together") != std::string::npos);
  CHECK(sets::beyond_the_limits(question(), std::nullopt, std::nullopt).find("no set is certified") !=
        std::string::npos);
}

}  // namespace
