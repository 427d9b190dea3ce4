#include "checker/quadrature/lowest_snr.hpp"

#include <doctest/doctest.h>

#include <string>

#include "checker/document/json_tree.hpp"
#include "tests/checker/quadrature/lock_support.hpp"

namespace veritrack::checker {

TEST_CASE("decibels of a deviation, as a ball around the value") {
  // 10 log10(50).
  const Ball tenth = decibels_of(Ball(1.0) / Ball(10.0));
  CHECK(certainly_less(from_decimal("16.98970004336018"), tenth));
  CHECK(certainly_less(tenth, from_decimal("16.98970004336019")));
  // More noise is a lower ratio.
  CHECK(certainly_less(decibels_of(Ball(0.2)), tenth));
}

TEST_CASE("a set for another noise is proved for its own, whatever the design assumes") {
  const lock_test::WrittenSet written;
  Design design;
  design.q1 = design.q2 = from_decimal("0.0013");
  design.r = from_decimal("0.01");
  design.epsilon = design.slew = zero;
  design.amplitude = one;
  design.largest_frequency = Ball(3.0);
  // Far more than the set is for.
  GaussianNoise noise{Ball(0.5), zero, Ball(1000.0)};
  std::int64_t cells = 0;
  Objections objections;
  const LockSet set = check_lowest_snr_set(written.tree(), design, noise, cells, objections);
  CHECK(objections.empty());
  CHECK(cells > 0);
  CHECK(certainly_equal(set.deviation, from_hexadecimal(written.numbers.at("noise_deviation"))));
  // Its walk must be that of the design, or more.
  noise.walk = Ball(0.01);
  static_cast<void>(check_lowest_snr_set(written.tree(), design, noise, cells, objections));
  CHECK(objections.size() == 1);
  lock_test::WrittenSet none = written;
  none.numbers["noise_deviation"] = "0x0p+0";
  objections.clear();
  noise.walk = zero;
  static_cast<void>(check_lowest_snr_set(none.tree(), design, noise, cells, objections));
  CHECK(objections.size() == 1);
}

TEST_CASE("with a leak a set is for a part of the band, and none is for the lowest ratio") {
  const lock_test::WrittenSet written;
  Design design;
  design.q1 = design.q2 = design.r = design.epsilon = from_decimal("0.01");
  design.slew = zero;
  design.amplitude = one;
  design.largest_frequency = Ball(3.0);
  const GaussianNoise noise{Ball(0.01), zero, Ball(1000.0)};
  std::int64_t cells = 0;
  Objections objections;
  static_cast<void>(check_lowest_snr_set(written.tree(), design, noise, cells, objections));
  REQUIRE_FALSE(objections.empty());
  CHECK(objections.front().find("without a leak") != std::string::npos);
}

}  // namespace veritrack::checker
