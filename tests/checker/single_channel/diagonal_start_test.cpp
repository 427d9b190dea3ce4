#include "checker/single_channel/diagonal_start.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace veritrack::checker;

namespace {

/// An amplitude of 2, and a start that may be off by 0.001 + 0.002 of it and by 0.004 rad/sample.
SingleChannelDesign design() {
  SingleChannelDesign design;
  design.amplitude = Ball(2.0);
  design.amplitude_error = Ball(0.001);
  design.phase_error = Ball(0.002);
  design.frequency_error = Ball(0.004);
  return design;
}

std::optional<DiagonalStart> read(const std::string& p11, const std::string& p12, const std::string& p22,
                                  const std::string& p33, const std::string& from, const std::string& to,
                                  Objections& objections) {
  const auto member = [](const char* name, const std::string& text) {
    return std::string("\"") + name + R"(": ")" + text + "\"";
  };
  const std::string decimals = member("p11", p11) + "," + member("p12", p12) + "," + member("p13", "0") +
                               "," + member("p22", p22) + "," + member("p23", "0") + "," +
                               member("p33", p33) + "," + member("from", from) + "," + member("to", to);
  const Tree derivation =
      read_json(R"({"evidence": [{"name": "start-covariance", "decimals": {)" + decimals + "}}]}");
  return read_diagonal_start(derivation, design(), objections);
}

}  // namespace

TEST_CASE("the start covariance is read in signal units, and the starts have a level in the least of it") {
  Objections objections;
  const auto start = read("0.02", "0", "0.02", "0.01", "0.5", "2", objections);
  REQUIRE(start.has_value());
  CHECK(objections.empty());
  CHECK(start->words == "and with P(0|0) from 0.5 M to 2 M, M = [0.02, 0, 0; 0, 0.02, 0; 0, 0, 0.01]");
  CHECK(start->signal.near() == doctest::Approx(0.005));
  const double expected = std::sqrt(0.003 * 0.003 / 0.0025 + 0.004 * 0.004 / 0.005);
  CHECK(level_of(*start, design()).near() == doctest::Approx(expected));
}

TEST_CASE("what is no covariance, not the same in every frame, or does not contain M is refused") {
  const auto is_refused = [](const auto&... texts) {
    Objections objections;
    const bool found = read(texts..., objections).has_value();
    return !found && objections.size() == 1;
  };
  CHECK(is_refused("-0.02", "0", "-0.02", "0.01", "0.5", "2"));
  CHECK(is_refused("0.02", "0", "0.02", "0", "0.5", "2"));
  CHECK(is_refused("0.02", "0.001", "0.02", "0.01", "0.5", "2"));
  CHECK(is_refused("0.02", "0", "0.021", "0.01", "0.5", "2"));
  CHECK(is_refused("0.02", "0", "0.02", "0.01", "1.1", "2"));
  CHECK(is_refused("0.02", "0", "0.02", "0.01", "0.5", "0.9"));
  CHECK(is_refused("0.02", "0", "0.02", "0.01", "-1", "2"));
}

TEST_CASE("without the evidence there is none, and nothing is wrong") {
  Objections objections;
  CHECK_FALSE(read_diagonal_start(read_json(R"({"evidence": []})"), design(), objections).has_value());
  CHECK(objections.empty());
}
