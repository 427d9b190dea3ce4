// What a certificate with a leak says of its sets, changed one at a time: what is then not proved must not be
// verified.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/checker/mutation/changes.hpp"

namespace {

using namespace veritrack::test;

void multiply(Json& number, double factor) {
  number = hexadecimal(factor * number_of(number));
}

}  // namespace

TEST_CASE("with a leak: better numbers, flipped verdicts and dropped evidence are refused") {
  const Json certificate = accepted("steady-set");
  const std::string derivation = "/derivations/0";
  // In the direction that says more.
  const std::vector<std::pair<std::string, double>> quantities{
      {"contraction_rate", 0.999},       {"radius", 1.001},
      {"frequency_error_radius", 1.001}, {"phase_error_radius", 1.001},
      {"amplitude_error_radius", 1.001}, {"ultimate_frequency_error", 0.999},
      {"frequency_error_bound", 0.999},  {"largest_noise", 1.001}};
  Count count;
  for (const auto& [name, factor] : quantities) {
    Json changed = certificate;
    Json& quantity = changed[Pointer(derivation) / "quantities" / name];
    for (auto& end : quantity) {
      multiply(end, factor);
    }
    expect_refused(changed, name, count);
  }
  for (const char* end : {"lo", "hi"}) {
    Json changed = certificate;
    multiply(changed[Pointer(derivation + "/quantities/bias_frequency") / end],
             std::string(end) == "lo" ? 0.999 : 1.001);
    expect_refused(changed, std::string("bias_frequency ") + end, count);
  }
  for (const char* side : {"/conditions/1/lhs", "/conditions/2/lhs", "/conditions/1/rhs"}) {
    Json changed = certificate;
    for (auto& end : changed[Pointer(derivation + side)]) {
      multiply(end, 0.9);
    }
    expect_refused(changed, side, count);
  }
  for (const char* verdict : {"/conditions/0/verdict", "/conditions/1/verdict", "/conditions/2/verdict"}) {
    Json changed = certificate;
    changed[Pointer(derivation + verdict)] = "refuted";
    expect_refused(changed, verdict, count);
  }
  for (std::size_t i = 0; i < certificate[Pointer(derivation + "/evidence")].size(); ++i) {
    Json changed = certificate;
    changed[Pointer(derivation + "/evidence")].erase(i);
    expect_refused(changed, "without evidence " + std::to_string(i), count);
  }
  // Evidence that is another set: far enough from what the tracker does.
  const std::vector<std::pair<std::string, double>> evidence{{"/numbers/s_1", 0.8},
                                                             {"/numbers/noise", 40.0},
                                                             {"/matrices/covariance_above/0/0", 0.5},
                                                             {"/matrices/covariance_below/2/2", 0.5},
                                                             {"/matrices/metric/2/2", 0.5},
                                                             {"/numbers/s_0", 1.001}};
  const std::string first_set = derivation + "/evidence/0";
  for (const auto& [place, factor] : evidence) {
    Json changed = certificate;
    multiply(changed[Pointer(first_set + place)], factor);
    expect_refused(changed, place, count);
  }
  Json leak = certificate;
  leak[Pointer("/design/design/epsilon/text")] = "0.0101";
  expect_refused(leak, "another leak", count);
  MESSAGE(count.refused << " changes refused");
}
