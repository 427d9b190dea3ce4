#include "certificates/tuning/shortfall.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "certificates/tuning/design_values.hpp"
#include "tests/certificates/tuning/tuning_example.hpp"

namespace veritrack::certificates {
namespace {

Assumptions assumed(const std::string& text) {
  return quadrature_tables(read_design(text, "design.toml")).assume;
}

CertifiedValues good() {
  CertifiedValues values;
  values.long_run = 0.01;
  values.for_ever = 0.02;
  values.radius = 0.1;
  values.noise = 0.05;
  values.slew = 0.001;
  values.settles = 80.0;
  return values;
}

TEST_CASE("nothing is missing where everything is certified, and what is missing counts") {
  const rigor::NearestRounding nearest;
  const Assumptions assume = assumed(testing::kTunedText);
  Requirements require;
  CHECK(shortage(good(), assume, require) == 0.0);
  CHECK(shortage(CertifiedValues{}, assume, require) > 1.0);
  require.frequency_error_below = number_of("0.02");  // not below itself
  CHECK(shortage(good(), assume, require) > 0.0);
  require.frequency_error_below = number_of("0.021");
  CHECK(shortage(good(), assume, require) == 0.0);
  require.settled_below = number_of("0.005");
  require.settles_within = number_of("100");
  CHECK(shortage(good(), assume, require) == doctest::Approx(std::log(2.0)));
  require.settled_below = number_of("0.011");
  CHECK(shortage(good(), assume, require) == 0.0);
  require.settles_within = number_of("40");
  CHECK(shortage(good(), assume, require) == doctest::Approx(std::log(2.0)));
  require.settles_within.reset();
  require.largest_noise_at_least = number_of("0.1");
  CHECK(shortage(good(), assume, require) == doctest::Approx(std::log(2.0)));
}

TEST_CASE("a NaN is never as good as required") {
  const rigor::NearestRounding nearest;
  const Assumptions assume = assumed(testing::kTunedText);
  Requirements require;
  require.frequency_error_below = number_of("0.05");
  CertifiedValues values = good();
  values.for_ever = NAN;
  CHECK(shortage(values, assume, require) > 0.0);
  const Assumptions gaussian = assumed(testing::kTunedTextAt20Decibels);
  values.lock_margin = NAN;
  CHECK_FALSE(shortage(values, gaussian, {}) == 0.0);
}

TEST_CASE("what would do is found: less noise by a factor that the oracle knows, and no less slew") {
  const rigor::NearestRounding nearest;
  const Assumptions assume = assumed(testing::kTunedText);
  Requirements require;
  require.frequency_error_below = number_of("0.011");
  const auto certify = [](const Assumptions& less, const Number&) {
    CertifiedValues values = good();
    values.for_ever = less.noise.nearest + 0.001;  // met below a noise of 0.01, half of what is assumed
    return values;
  };
  const auto sentences = changes_that_would_do(certify, assume, require, number_of("0"));
  REQUIRE(sentences.size() == 1);
  CAPTURE(sentences.front());
  CHECK(sentences.front().find("noise of at most 0.00") != std::string::npos);
  CHECK(sentences.front().find("(in place of 0.02)") != std::string::npos);
  CHECK(sentences.front().find("slew") == std::string::npos);
  const auto start = sentences.front().find("0.00");
  const double found = std::stod(sentences.front().substr(start));
  CHECK(found < 0.01);
  CHECK(found > 0.009);
}

TEST_CASE("nothing by itself would do") {
  const rigor::NearestRounding nearest;
  const auto sentences =
      changes_that_would_do([](const Assumptions&, const Number&) { return CertifiedValues{}; },
                            assumed(testing::kTunedText), {}, number_of("0"));
  REQUIRE(sentences.size() == 1);
  CHECK(sentences.front().find("each by itself, would do") != std::string::npos);
  CHECK(sentences.front().starts_with("No less"));
}

TEST_CASE("Gaussian noise: the ratio, the walk and the leak that would do, as far as they count") {
  const rigor::NearestRounding nearest;
  const Assumptions assume = assumed(testing::kTunedTextAt20Decibels);
  // Possible from 26 dB on, whatever the walk, and only without a leak.
  const auto certify = [](const Assumptions& less, const Number& leak) {
    CertifiedValues values;
    values.lock_margin = less.gaussian->snr_db->nearest >= 26.0 && leak.nearest == 0.0 ? 0.1 : -0.1;
    return values;
  };
  const auto sentences = changes_that_would_do(certify, assume, {}, number_of("0"));
  REQUIRE(sentences.size() == 1);
  CAPTURE(sentences.front());
  const std::string words =
      "As far as can be estimated, with these values everything required could be certified "
      "with an SNR of at least ";
  REQUIRE(sentences.front().starts_with(words));
  const double found = std::stod(sentences.front().substr(words.size()));
  CHECK(found >= 26.0);
  CHECK(found < 27.0);
  CHECK(sentences.front().find("(in place of 20 dB).") != std::string::npos);
  CHECK(changes_that_would_do(certify, assume, {}, number_of("0.01")).front() ==
        "No less noise, walk or leak, each by itself, would do for these values, as far as was tried.");
  CHECK(unmet_requirements(certify(assume, number_of("0")), assume, {}).size() == 1);
}

TEST_CASE("a leak: less of it, or none where only that does") {
  const rigor::NearestRounding nearest;
  const Assumptions assume = assumed(testing::kTunedText);
  double most = 0.004;
  const auto certify = [&](const Assumptions&, const Number& leak) {
    return leak.nearest <= most ? good() : CertifiedValues{};
  };
  const auto sentence = [&] { return changes_that_would_do(certify, assume, {}, number_of("0.01")).front(); };
  const std::string words =
      "With these values everything required would be certified with a leak of at most 0.00";
  CHECK(sentence().starts_with(words));
  CHECK(sentence().find("(in place of 0.01)") != std::string::npos);
  most = 0.0;
  CHECK(sentence() ==
        "With these values everything required would be certified with no leak (in place of 0.01).");
}

TEST_CASE("what is not met is said with what is certified in its place") {
  const rigor::NearestRounding nearest;
  Requirements require;
  require.frequency_error_below = number_of("0.01");
  require.largest_noise_at_least = number_of("0.1");
  const auto sentences = unmet_requirements(good(), assumed(testing::kTunedText), require);
  REQUIRE(sentences.size() == 2);
  CHECK(sentences[0] == "Required: 0.01 rad/sample for ever; certified: 0.0201 rad/sample.");
  CHECK(sentences[1] == "Required: noise of 0.1 signal units; certified: 0.05 of the amplitude.");
  CHECK(unmet_requirements(CertifiedValues{}, assumed(testing::kTunedText), {})
            .front()
            .find("No certified set covers the assumed starts") == 0);
}

}  // namespace
}  // namespace veritrack::certificates
