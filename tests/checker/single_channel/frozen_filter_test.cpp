// Poles of the frozen filter, at a gain and a frequency that the certificate chose.
#include "checker/single_channel/frozen_filter.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack::checker;

TEST_CASE("real poles have the larger of two radii") {
  // z^2 - 1.5 z + 0.5: 1 and a half.
  const auto objections_to = [](const std::string& radius) {
    Objections objections;
    check_transfer_function(
        read_json(
            R"({"quantities": {"gain_1": {"lo": "0x1p-1", "hi": "0x1p-1"}, "gain_2": {"lo": "0x0p+0",)"
            R"("hi": "0x0p+0"}, "zero_angle": {"lo": "0x0p+0", "hi": "0x0p+0"}, "pole_radius": {"lo": "0x0p+0",)"
            R"("hi": ")" +
            radius + R"("}}, "conditions": []})"),
        objections);
    return objections.size();
  };
  CHECK(objections_to("0x1.1p+0") == 0);
  CHECK(objections_to("0x1.8p-1") == 1);
}

TEST_CASE("what is chosen is one number") {
  const auto objections_to = [](const std::string& low, const std::string& high) {
    const auto quantity = [](const std::string& lo, const std::string& hi) {
      return R"({"lo": ")" + lo + R"(", "hi": ")" + hi + "\"}";
    };
    const std::string half = quantity("0x1p-1", "0x1p-1");
    Objections objections;
    check_transfer_function(
        read_json(R"({"quantities": {"gain_1": )" + half + R"(, "gain_2": )" + half + R"(, "zero_angle": )" +
                  quantity(low, high) + R"(}, "conditions": []})"),
        objections);
    return objections.size();
  };
  CHECK(objections_to("0x1p+0", "0x1p+0") == 0);
  CHECK(objections_to("0x1p+0", "0x1.8p+0") == 1);
}
