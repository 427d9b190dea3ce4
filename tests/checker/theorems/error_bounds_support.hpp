// A tube that is verified.
#pragma once

#include <array>
#include <map>
#include <string>

#include "checker/theorems/design.hpp"

namespace veritrack::test::tube {

using checker::Ball;
using checker::Design;

using Rows = std::array<std::array<std::string, 3>, 3>;

/// For La Scala's Figure 3.5 without its leak.
struct WrittenBounds {
  std::map<std::string, std::string> numbers{{"window", "0x0p+0"},
                                             {"plane_error", "0x1.46e2d35c182f2p-8"},
                                             {"frequency_error", "0x1.6a2ca93ff07adp-9"},
                                             {"one_minus_alpha", "0x1.39ab73862d9fdp-6"},
                                             {"curvature", "0x1.85104abba9a95p-3"},
                                             {"process_gain", "0x1.c300f1eb1aafbp+3"},
                                             {"measurement_gain", "0x1.9e4880005914ep+1"},
                                             {"s", "0x1.f0d5d276ca15dp-5"},
                                             {"radius", "0x1.ef498e0a0fa9bp-6"}};
  Rows upper{{{"0x1.703909e649cap-7", "0x0p+0", "0x0p+0"},
              {"0x0p+0", "0x1.ba8525cf3716ap-6", "0x1.10ae74717165p-7"},
              {"0x0p+0", "0x1.10ae74717165p-7", "0x1.11c5fa57b7c43p-7"}}};
  Rows information{{{"0x1.e8aa2994bd472p+6", "0x0p+0", "0x0p+0"},
                    {"0x0p+0", "0x1.f20ca156ca566p+5", "-0x1.ecd95cbbe6e26p+5"},
                    {"0x0p+0", "-0x1.ecd95cbbe6e26p+5", "0x1.9bfe69f3607dp+7"}}};
};

inline std::string json_of(const Rows& rows) {
  std::string text;
  for (const auto& row : rows) {
    text += (text.empty() ? "[\"" : ",[\"") + row[0] + "\",\"" + row[1] + "\",\"" + row[2] + "\"]";
  }
  return "[" + text + "]";
}

inline Design the_design() {
  Design design;
  design.q1 = design.q2 = Ball(0.0023);
  design.r = Ball(0.05);
  design.epsilon = checker::zero;
  return design;
}

/// An item of evidence of this name.
inline std::string evidence_of(const WrittenBounds& tube, const std::string& name) {
  std::string text = R"({"name": ")" + name + R"(", "matrices": {"covariance_upper": )" +
                     json_of(tube.upper) + R"(, "information_upper": )" + json_of(tube.information) +
                     R"(}, "numbers": {"of": "0x0p+0")";
  for (const auto& [key, number] : tube.numbers) {
    text += ", \"" + key + "\": \"" + number + "\"";
  }
  return text + "}}";
}

}  // namespace veritrack::test::tube
