#include "certificates/model/loop_stability.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

TEST_CASE("each parameter alone: where the loop z^2 - (2 - kp) z + 1 - kp + ki becomes stable") {
  const Certificate certificate = test::two_channel_certificate("kp = 2.1, ki = 0.03");
  const rigor::UpwardRounding upward;
  const auto limits = stability_limits(model_tables(certificate.design));
  REQUIRE(limits.size() == 2);
  CHECK(limits[0].parameter == "kp");
  CHECK(limits[0].stable == StabilityLimit::Stable::below);
  CHECK(limits[0].limit == doctest::Approx(2.015).epsilon(1e-6));
  CHECK(limits[1].parameter == "ki");
  CHECK(limits[1].stable == StabilityLimit::Stable::above);
  CHECK(limits[1].limit == doctest::Approx(0.2).epsilon(1e-6));
}

TEST_CASE("a wrong sign") {
  const Certificate certificate = test::two_channel_certificate("kp = -0.25, ki = 0.03");
  const rigor::UpwardRounding upward;
  const auto limits = stability_limits(model_tables(certificate.design));
  REQUIRE(limits.size() == 1);  // no ki helps
  CHECK(limits[0].parameter == "kp");
  CHECK(limits[0].stable == StabilityLimit::Stable::at);
  CHECK(limits[0].limit == 0.25);
}

TEST_CASE("no time between samples runs backwards") {
  std::string text = test::two_channel_text("T = 0.5, kp = -0.5, ki = 0.12", "noise = 0.1\n");
  for (const auto& [from, to] :
       {std::pair("+ w + kp*e", "+ w*T + kp*T*e"), std::pair("w + ki*e", "w + ki*T*e"),
        std::pair("frequency = 'w'", "frequency = 'w*T'"), std::pair("w = 'omega'", "w = 'omega/T'")}) {
    text.replace(text.find(from), std::string_view(from).size(), to);
  }
  const Design design = test::loop_design(text);
  const rigor::UpwardRounding upward;
  const auto limits = stability_limits(model_tables(design));
  REQUIRE(limits.size() == 1);
  CHECK(limits[0].parameter == "kp");
  CHECK(limits[0].stable == StabilityLimit::Stable::at);
}

}  // namespace
}  // namespace veritrack::certificates
