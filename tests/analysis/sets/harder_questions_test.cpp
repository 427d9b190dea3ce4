#include "analysis/sets/harder_questions.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::sets {
namespace {

using rigor::Interval;

}  // namespace

TEST_CASE("a number is raised to one that does not depend on it") {
  const rigor::UpwardRounding upward;
  test::Random random(1);
  for (std::int64_t k = 0; k < test::effort(1000); ++k) {
    const double x = std::exp2(random.uniform(-60.0, 20.0));
    const Interval first = raised(Interval(x), 0);
    const Interval second = raised(Interval(x), 1);
    CAPTURE(x);
    CHECK(certainly_less_equal(Interval(x), first));
    CHECK(certainly_less(first, second));
    CHECK(first.upper() < 1.05 * x);
    // The same of what lies between, but for the hair next to a power.
    CHECK(raised(Interval(x + 0.5 * (first.upper() - x)), 0).upper() == doctest::Approx(first.upper()));
  }
  CHECK(raised(Interval(0.0), 3) == Interval(0.0));
  CHECK_FALSE(certainly_less_equal(Interval(0.0), raised(Interval(-1.0), 0)));
  CHECK_FALSE(is_finite(raised(Interval(), 0)));
  CHECK_FALSE(is_finite(raised(Interval::from_bounds(-1.0, 1.0), 0)));
}

TEST_CASE("harder questions are for at least what is asked, and for no slew where there is none") {
  const rigor::UpwardRounding upward;
  ContractionQuestion question;
  question.noise = Interval(0.013);
  question.initial_amplitude_error = Interval(0.001);
  question.initial_phase_error = Interval(0.02);
  question.initial_frequency_error = Interval(0.3);
  for (const double slew : {0.0, 1e-4}) {
    question.slew = Interval(slew);
    const auto questions = harder_questions(question);
    CHECK(questions.size() > 10);
    CHECK(questions.front().search_evaluations > question.search_evaluations);
    for (const ContractionQuestion& harder : questions) {
      CHECK(certainly_less_equal(question.noise, harder.noise));
      CHECK(certainly_less_equal(question.slew, harder.slew));
      CHECK(certainly_less_equal(question.initial_amplitude_error, harder.initial_amplitude_error));
      CHECK(certainly_less_equal(question.initial_phase_error, harder.initial_phase_error));
      CHECK(certainly_less_equal(question.initial_frequency_error, harder.initial_frequency_error));
      CHECK((slew > 0.0 || harder.slew == Interval(0.0)));
    }
  }
}

TEST_CASE("a band is widened to one that does not depend on it, and not beyond what there is") {
  const rigor::UpwardRounding upward;
  const Interval wide = aligned_band(Interval::from_bounds(0.4, 2.6));
  CHECK(wide.lower() == 0.375);
  CHECK(wide.upper() == 2.625);
  const Interval all = Interval::from_bounds(0.4, 3.13);
  CHECK(identical(aligned_band(all), all));
  const Interval both = Interval::from_bounds(-0.4, 1.0);
  CHECK(identical(aligned_band(both), both));
}

}  // namespace veritrack::sets
