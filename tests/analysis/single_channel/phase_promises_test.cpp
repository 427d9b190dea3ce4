#include "analysis/single_channel/phase_promises.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "analysis/single_channel/phase_certificate.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;

PhaseQuestion question() {
  PhaseQuestion asked;
  asked.tracker.design = {Interval(0.005), Interval(0.005), Interval(0.01), Interval(0.0)};
  asked.tracker.initial_amplitude_error = Interval(0.0005);
  asked.tracker.initial_phase_error = Interval(0.0005);
  asked.tracker.initial_frequency_error = Interval(0.0005);
  asked.tracker.with_limits = false;
  asked.band = Interval::from_bounds(1.2, 1.3);
  return asked;
}

TEST_CASE("what is required is satisfied up to what the set proves, and no further") {
  const rigor::UpwardRounding upward;
  PhaseQuestion asked = question();
  const std::optional<PhaseSet> set = PhaseSearch(asked).least_bound();
  REQUIRE(set);
  const double level = *set->assumed_level;
  const double bound = frequency_error_bound(asked, *set, level).upper();
  REQUIRE(bound > 0.0);
  // The recursion of the levels, one after the other.
  const double settled = 0.5 * bound;
  const auto levels = errors_of(asked, *set).levels(level, 4000);
  REQUIRE(levels);
  const double scale = std::sqrt(set->claim.assumption.frequency_variance);
  int last_above = -1;
  for (int k = 0; k <= 4000; ++k) {
    if ((*levels)[static_cast<std::size_t>(k)] * scale > settled) {
      last_above = k;
    }
  }
  REQUIRE(last_above >= 0);
  const double samples = last_above + 1;
  CHECK(settling_samples(asked, *set, level, settled).upper() == samples);

  sets::RequiredBounds& required = asked.tracker.required;
  CHECK(satisfies(asked, *set));
  required.frequency_error = bound * (1.0 + 1e-9);
  CHECK(satisfies(asked, *set));
  required.frequency_error = bound;  // never reached
  CHECK_FALSE(satisfies(asked, *set));
  required.frequency_error = std::nan("");
  CHECK_FALSE(satisfies(asked, *set));
  required.frequency_error.reset();

  required.samples = samples;
  CHECK_FALSE(satisfies(asked, *set));  // after which nothing is said to be settled
  asked.tracker.settled_frequency_error = settled;
  CHECK(satisfies(asked, *set));
  required.samples = samples - 1.0;
  CHECK_FALSE(satisfies(asked, *set));
  required.samples = samples;
  required.frequency_error = 0.5 * bound;
  CHECK_FALSE(satisfies(asked, *set));  // one of two is not enough
}

TEST_CASE("of a set for no assumed starts nothing is promised of them") {
  const rigor::UpwardRounding upward;
  const PhaseQuestion asked = question();
  const std::optional<PhaseSet> set = PhaseSearch(asked).largest_set();
  REQUIRE(set);
  CHECK_FALSE(set->assumed_level.has_value());
  CHECK_FALSE(satisfies(asked, *set));
}

}  // namespace
}  // namespace veritrack::single_channel
