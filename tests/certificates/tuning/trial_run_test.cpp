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

TEST_CASE("one run has no scatter") {
  const Design design = read_design(testing::kTunedText, "design.toml");
  CHECK(simulated_rms(design, quadrature_tables(design).assume, {1, 400})->deviation == 0.0);
}

}  // namespace
}  // namespace veritrack::certificates
