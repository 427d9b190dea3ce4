#include "certificates/model/root_locus.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "certificates/design/request_error.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

TEST_CASE("modes over a gain: those of z^2 - (2 - kp) z + 1 - kp + ki, stable below kp = 2 + ki/2") {
  const Design design = test::loop_design(test::two_channel_text("kp = 0.06, ki = 0.03", "noise = 0.1\n"));
  const RootLocus locus = root_locus(model_tables(design), {"kp", 0.01, 4.0});
  CHECK(locus.is_in_frame);
  CHECK_FALSE(locus.is_average);
  CHECK(locus.given == 0.06);
  REQUIRE(locus.points.size() == 61);
  CHECK(locus.points.front().value == 0.01);
  CHECK(locus.points.back().value == 4.0);
  for (const RootLocus::Point& point : locus.points) {
    REQUIRE(point.multipliers.size() == 2);
    for (const std::complex<double>& z : point.multipliers) {
      CHECK(std::abs(z * z - (2.0 - point.value) * z + 1.0 - point.value + 0.03) < 1e-9);
    }
  }
  REQUIRE(locus.stable.size() == 1);
  CHECK(locus.stable[0].from ==
        doctest::Approx(0.03).epsilon(1e-4));  // complex below, of the size 1 - kp + ki
  CHECK(locus.stable[0].to == doctest::Approx(2.015).epsilon(1e-4));
}

TEST_CASE("values on both sides of 0 are evenly spaced, and none may be stable") {
  const Design design = test::loop_design(test::two_channel_text("kp = 0.06, ki = 0.001", "noise = 0.1\n"));
  const RootLocus locus = root_locus(model_tables(design), {"kp", -1.0, -0.4});
  CHECK(locus.points[30].value == doctest::Approx(-0.7));
  CHECK(locus.stable.empty());
}

TEST_CASE("of a loop that keeps samples the modes are those in the frame of the signal") {
  const RootLocus locus = root_locus(model_tables(test::turn_certificate("0.2").design), {"g", 0.1, 3.0});
  CHECK(locus.is_in_frame);
  REQUIRE(locus.stable.size() == 1);
  CHECK(locus.stable[0].to == doctest::Approx(2.0).epsilon(1e-4));
}

TEST_CASE("an unknown parameter is refused") {
  const Design design = test::loop_design(test::two_channel_text("kp = 0.06, ki = 0.001", "noise = 0.1\n"));
  CHECK_THROWS_WITH_AS((void)root_locus(model_tables(design), {"kq", 1.0, 2.0}),
                       "--over kq: no such parameter; allowed: kp, ki", RequestError);
}

}  // namespace
}  // namespace veritrack::certificates
