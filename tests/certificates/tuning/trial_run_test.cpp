#include "certificates/tuning/trial_run.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/tuning/tuning_example.hpp"

namespace veritrack::certificates {
namespace {

Design with(const std::string& from, const std::string& to, std::string text = testing::kTunedText) {
  text.replace(text.find(from), from.size(), to);
  return read_design(text, "design.toml");
}

TEST_CASE("a tracker with less process noise takes longer") {
  const Design fast = read_design(testing::kTunedText, "design.toml");
  const Design slow = with("q2 = 0.0023", "q2 = 1e-7");
  const Assumptions& assume = quadrature_tables(fast).assume;
  const auto few = response_samples(fast, assume);
  const auto many = response_samples(slow, assume);
  REQUIRE(few);
  REQUIRE(many);
  CHECK(*few > 1);
  CHECK(*many > 3 * *few);
}

TEST_CASE("the simulated root mean square: the same twice, more in more noise, of the linear filter's size") {
  const Design design = read_design(testing::kTunedTextAt20Decibels, "design.toml");
  const Assumptions& assume = quadrature_tables(design).assume;
  const TrialLength few{8, 2000};
  const auto found = simulated_rms(design, assume, few);
  REQUIRE(found);
  CHECK(found->rms == simulated_rms(design, assume, few)->rms);
  CHECK(found->deviation > 0.0);
  CHECK(found->deviation < 0.1 * found->rms);
  const Design louder = with("snr_db = 20", "snr_db = 14", testing::kTunedTextAt20Decibels);
  CHECK(simulated_rms(louder, quadrature_tables(louder).assume, few)->rms > 1.5 * found->rms);
  // More runs agree within the errors that both state.
  const auto more = simulated_rms(design, assume, {32, 2000});
  CHECK(std::abs(more->rms - found->rms) < 4.0 * (more->deviation + found->deviation));
}

TEST_CASE("a filter that does not get rid of the assumed start error has it in its root mean square") {
  const std::string slow = "q2 = 1e-14";
  const auto rms = [](const Design& design) {
    return simulated_rms(design, quadrature_tables(design).assume, {8, 400})->rms;
  };
  std::string text = testing::kTunedText;
  text.replace(text.find("q1 = 0.0023"), 11, "q1 = 1e-14");
  text.replace(text.find("slew = 1e-4"), 11, "slew = 0");
  const double off = rms(with("q2 = 0.0023", slow, text));
  text.replace(text.find("initial_frequency_error = 0.005"), 31, "initial_frequency_error = 0    ");
  CHECK(off > 0.004);
  CHECK(off > 5.0 * rms(with("q2 = 0.0023", slow, text)));
}

TEST_CASE("one run has no scatter") {
  const Design design = read_design(testing::kTunedText, "design.toml");
  CHECK(simulated_rms(design, quadrature_tables(design).assume, {1, 400})->deviation == 0.0);
}

}  // namespace
}  // namespace veritrack::certificates
