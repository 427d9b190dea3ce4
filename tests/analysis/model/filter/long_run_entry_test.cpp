#include "analysis/model/filter/long_run_entry.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model {
namespace {

/// A tube about 0 of the scalar filter, constant up to some of its shape.
Tube tube_of_entry(double low, double high, double shape) {
  Tube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.03125;
  tube.turns = {0};
  tube.curve = {{}};
  tube.shape = {{{{shape}, {0.125 * shape}}}};
  tube.covariance_low = {{{{low}}}};
  tube.covariance_high = {{{{high}}}};
  return tube;
}

TEST_CASE("an entry takes as many samples as its ratio has to shrink") {
  const rigor::UpwardRounding upward;
  for (const double margin : {0.01, 0.3}) {
    for (const double ratio : {1.5, 40.0}) {
      int samples = 0;
      for (double left = ratio; left > 1.0; left *= 1.0 - margin) {
        ++samples;
      }
      CHECK(LongRunEntry{margin, ratio}.samples() == samples);
    }
  }
  CHECK(LongRunEntry{0.1, 1.0}.samples() == 0.0);
  for (const LongRunEntry& none : {LongRunEntry{0.0, 2.0}, LongRunEntry{1.0, 2.0}, LongRunEntry{0.1, 0.9},
                                   LongRunEntry{0.1, std::numeric_limits<double>::infinity()},
                                   LongRunEntry{std::numeric_limits<double>::quiet_NaN(), 2.0}}) {
    CHECK(none.samples() == std::numeric_limits<double>::infinity());
  }
}

TEST_CASE("the levels and the ratio that are sampled are the largest ones") {
  const Tube from = tube_of_entry(0.01, 0.06, 0.3);
  Tube into = tube_of_entry(0.02, 0.04, 0.2);
  into.shape = {{{{0.2, 0.05}}}};  // narrowest at z = -1
  const SampledEntry sampled = sampled_long_run_entry(from, 0.7, into, 8);
  CHECK(sampled.level == doctest::Approx(0.7 * 0.3 * 1.125 / 0.15));
  CHECK(sampled.ratio == doctest::Approx(2.0));
  Tube lower = from;
  lower.covariance_low = {{{{0.005}}}};
  CHECK(sampled_long_run_entry(lower, 0.7, into, 8).ratio == doctest::Approx(4.0));
  CHECK(sampled_long_run_entry(into, 0.7, from, 8).ratio == 1.0);
}

TEST_CASE("an entry is proved when levels, ratio and margin are what they have to be, and not otherwise") {
  const test::ScalarFilter scalar;
  const test::FilterExample filter(scalar.filter());
  const double settled = scalar.settled(scalar.a * scalar.a, scalar.q);
  const Tube from = tube_of_entry(0.5 * settled, 1.8 * settled, 0.3);
  const Tube into = tube_of_entry(0.9 * settled, 1.2 * settled, 0.2);
  const auto after = [&scalar](double covariance) {
    return scalar.a * scalar.a * scalar.updated(covariance) + scalar.q;
  };
  const double margin =
      std::min(1.0 - after(1.2 * settled) / (1.2 * settled), 1.0 - 0.9 * settled / after(0.9 * settled));
  const double ratio = 0.9 / 0.5;
  const double level = 0.7 * 0.3 / 0.2;
  const VerificationBudget budget{8, 1, 200};
  const auto is_proved = [&](const Tube& outer, const Tube& inner, double into_radius, double share,
                             double times) {
    return verify_long_run_entry(filter.example.model, outer, 0.7, inner, into_radius,
                                 {share * margin, times * ratio}, budget)
        .is_proved;
  };
  CHECK(is_proved(from, into, 1.01 * level, 0.97, 1.01));
  CHECK_FALSE(is_proved(from, into, 0.99 * level, 0.97, 1.01));
  CHECK_FALSE(is_proved(from, into, 1.01 * level, 1.03, 1.01));
  CHECK_FALSE(is_proved(from, into, 1.01 * level, 0.97, 0.99));
  CHECK_FALSE(is_proved(from, into, 1.01 * level, 0.0, 1.01));  // never
  // The ratio of the upper bounds decides, too.
  Tube higher = from;
  higher.covariance_high = {{{{1.2 * 1.02 * ratio * settled}}}};
  CHECK_FALSE(is_proved(higher, into, 1.01 * level, 0.97, 1.01));
  CHECK(is_proved(higher, into, 1.01 * level, 0.97, 1.03));
  // A curve beside the other one.
  Tube beside = into;
  beside.curve = {{{{0.02 * level * 0.2}}}};
  CHECK_FALSE(is_proved(from, beside, 1.01 * level, 0.97, 1.01));
  CHECK(is_proved(from, beside, 1.03 * level, 0.97, 1.01));
  Tube elsewhere = into;
  elsewhere.frequency = 0.31;
  CHECK_FALSE(is_proved(from, elsewhere, 1.01 * level, 0.97, 1.01));
  Tube without = from;
  without.covariance_low.clear();
  without.covariance_high.clear();
  CHECK_THROWS_AS(is_proved(without, into, 1.01 * level, 0.97, 1.01), std::invalid_argument);
}

TEST_CASE("an entry's bounds are kept for all estimates of the tube it begins in") {
  const test::ScalarFilter scalar{.bend = 0.4};
  const test::FilterExample filter(scalar.filter());
  const double settled = scalar.settled(scalar.a * scalar.a, scalar.q);
  const Tube into = tube_of_entry(0.6 * settled, 1.6 * settled, 0.05);
  const auto is_proved = [&](double shape) {
    const Tube from = tube_of_entry(0.5 * settled, 1.8 * settled, shape);
    return verify_long_run_entry(filter.example.model, from, 1.0, into, 1.01 * shape / 0.05, {0.001, 1.3},
                                 {8, 1, 200})
        .is_proved;
  };
  // The largest shape: (a + 1.125 bend shape)^2 updated(high) + q is the upper bound.
  const double most = (std::sqrt((1.6 * settled - scalar.q) / scalar.updated(1.6 * settled)) - scalar.a) /
                      (1.125 * scalar.bend);
  const double least = (scalar.a - std::sqrt((0.6 * settled - scalar.q) / scalar.updated(0.6 * settled))) /
                       (1.125 * scalar.bend);
  const double largest = std::min(most, least);
  REQUIRE(largest > 0.05);
  CHECK(is_proved(0.85 * largest));
  CHECK_FALSE(is_proved(1.02 * largest));
}

}  // namespace
}  // namespace veritrack::model
