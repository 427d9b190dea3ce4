// Sets of the single-channel tracker whose window is true, and of which one number claims too much.
#include "checker/single_channel/phase_contraction.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "tests/checker/single_channel/window_support.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::test::window;
using checker::Promises;

struct WrittenSet {
  std::map<std::string, double> numbers;
  double start_frequency = 0.0;  ///< of the start covariance diag(1e-6, 1e-6, that)

  WrittenSet() {
    WindowStatement window = true_statement(along_a_tone());
    const auto near = [](const Ball& value) { return value.near(); };
    numbers = {{"radius", near(window.radius)},
               {"frequency_variance", near(window.frequency_variance)},
               {"signal_variance", near(window.signal_variance)},
               {"loosening", near(window.loosening)},
               {"slew", near(window.slew)},
               {"curvature", near(window.curvature)},
               {"curvature_weight", near(window.curvature_weight)},
               {"signal_uncertainty", near(window.signal_uncertainty)},
               {"noise", 0.0},
               {"start_level", 5e-4}};
    start_frequency = near(window.start_frequency);
    for (std::size_t m = 0; m < window.shares.size(); ++m) {
      numbers["share_" + std::to_string(m + 1)] = near(window.shares[m]);
    }
  }
};

checker::SingleChannelDesign the_design() {
  checker::SingleChannelDesign design = design_of_the_tone();
  design.epsilon = design.noise = design.slew = design.amplitude_error = design.phase_error = Ball(0.0);
  design.frequency_error = Ball(1e-5);
  design.amplitude = Ball(1.0);
  return design;
}

struct Found {
  Promises promises;
  bool refused = false;
};
Found check(const WrittenSet& set, const checker::SingleChannelDesign& design = the_design(),
            const std::string& quantities = "") {
  std::string numbers;
  std::array<char, 40> p11{};
  const double amplitude = design.amplitude.near();
  std::snprintf(p11.data(), p11.size(), "%.17g", 1e-6 * amplitude * amplitude);
  std::array<char, 40> p33{};
  std::snprintf(p33.data(), p33.size(), "%.17g", set.start_frequency);
  for (const auto& [name, number] : set.numbers) {
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "%s\"%s\": \"%a\"", numbers.empty() ? "" : ",", name.c_str(),
                  number);
    numbers += text.data();
  }
  const checker::Tree derivation =
      checker::read_json(R"({"evidence": [{"name": "frequency-error-bound", "numbers": {)" + numbers +
                         R"(}}, {"name": "start-covariance", "decimals": {"p11": ")" + p11.data() +
                         R"(", "p22": ")" + p11.data() + R"(", "p33": ")" + p33.data() +
                         R"(", "p12": "0", "p13": "0", "p23": "0", "from": "1", "to": "1"}}],)" +
                         R"( "conditions": [], "quantities": {)" + quantities + "}}");
  std::int64_t cells = 0;
  checker::Objections objections;
  Found found{check_phase_contraction(derivation, design, cells, objections), false};
  for (const std::string& objection : objections) {
    found.refused = found.refused || objection.find("is not proved by its evidence") != std::string::npos;
  }
  return found;
}

}  // namespace

TEST_CASE("the set is verified as it stands, and holds the assumed starts") {
  const Found found = check({});
  CHECK_FALSE(found.refused);
  CHECK(found.promises.starts_inside);
}

TEST_CASE("noise and starts that errors leave the set with") {
  WrittenSet set;
  SUBCASE("negative noise, of which the square alone counts") {
    set.numbers.at("noise") = -1e-9;
  }
  SUBCASE("a negative start") {
    set.numbers.at("start_level") = -5e-4;
  }
  SUBCASE("a start beyond the radius that comes back") {
    set.numbers.at("start_level") = 1.002e-3;
  }
  SUBCASE("a start at the rim that noise pushes out in the first sample") {
    set.numbers.at("start_level") = 1e-3;
    set.numbers.at("noise") = 1e-6;
  }
  SUBCASE("noise that pushes errors out of the set in the long run, and not in the first window") {
    set.numbers.at("start_level") = 1e-5;
    set.numbers.at("noise") = 1e-5;
  }
  CHECK(check(set).refused);
}

TEST_CASE("a set of which the rounding cannot be bounded is refused") {
  checker::SingleChannelDesign design = the_design();
  design.amplitude = Ball(0x1p-61);
  CHECK(check({}, design).refused);
  design.amplitude = Ball(0x1p-60);
  CHECK_FALSE(check({}, design).refused);
}

TEST_CASE("without noise and slew rounding alone is left in the long run") {
  const Found found = check({});
  REQUIRE(found.promises.ultimate);
  const double ultimate = found.promises.ultimate->near();
  CHECK(ultimate > 1e-15);
  CHECK(ultimate < 1e-8);
}

TEST_CASE("a set is for its own noise and slew") {
  checker::SingleChannelDesign design = the_design();
  SUBCASE("noise") {
    design.noise = Ball(1e-9);
  }
  SUBCASE("slew") {
    design.slew = Ball(1e-9);
  }
  const Found found = check({}, design);
  CHECK_FALSE(found.refused);
  CHECK_FALSE(found.promises.starts_inside);
}

TEST_CASE("errors have settled below what they start with only later, and never below what noise leaves") {
  WrittenSet set;
  const double deviation = std::sqrt(set.numbers.at("frequency_variance"));
  checker::SingleChannelDesign design = the_design();
  const auto settles = [&](double samples, double level) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  R"("settling_samples": {"hi": "%a"}, "settled_frequency_error": {"hi": "%a"})", samples,
                  level * deviation);
    const Found found = check(set, design, text.data());
    CHECK(found.promises.starts_inside);
    return found.promises.settled.has_value();
  };
  const double start = the_design().frequency_error.near() / std::sqrt(set.start_frequency);
  CHECK(settles(0.0, 1.01 * start));
  CHECK_FALSE(settles(0.0, 0.5 * start));
  CHECK(settles(200.0, 0.5 * start));
  // After a few samples the noise has only begun to push.
  design.frequency_error = Ball(1e-8);
  set.numbers.at("noise") = 1e-6;
  CHECK(settles(0.0, 3e-4));
  CHECK_FALSE(settles(0.0, 1e-4));
}
