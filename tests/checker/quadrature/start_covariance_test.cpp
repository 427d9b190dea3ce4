// Ranges of start covariances: a claimed range is one of positive definite matrices around the printed one,
// and is between the bounds of a set with both its ends.
#include "checker/quadrature/start_covariance.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <string>

using namespace veritrack::checker;

namespace {

struct Written {
  std::string p11 = "0.25", p22 = "0.5", p23 = "0.125", p33 = "0.25", from = "0.5", to = "2";
};

std::optional<StartCovariance> read(const Written& w, Objections& objections) {
  const auto item = [](const char* name, const std::string& text) {
    return std::string("\"") + name + "\": \"" + text + "\",";
  };
  const Tree derivation =
      read_json(R"({"evidence": [{"name": "start-covariance", "decimals": {)" + item("p11", w.p11) +
                item("p22", w.p22) + item("p23", w.p23) + item("p33", w.p33) + item("from", w.from) +
                item("to", w.to) + R"("p12": "0", "p13": "0"}}]})");
  Design design;
  design.amplitude = one;
  return read_start_covariance(derivation, design, objections);
}

StartCovariance the_range() {
  Objections objections;
  const auto range = read({}, objections);
  REQUIRE(range.has_value());
  CHECK(objections.empty());
  return *range;
}

}  // namespace

TEST_CASE("a range is of positive definite matrices, and contains the printed one") {
  CHECK(the_range().words.find("from 0.5 M to 2 M, M = [0.25, 0, 0;") != std::string::npos);
  Written written;
  SUBCASE("a matrix that is not definite") {
    written.p23 = "0.5";
  }
  SUBCASE("multiples from below zero") {
    written.from = "-0.5";
  }
  SUBCASE("multiples from above 1") {
    written.from = "1.5";
  }
  SUBCASE("multiples to below 1") {
    written.to = "0.75";
  }
  Objections objections;
  CHECK_FALSE(read(written, objections).has_value());
  CHECK(objections.size() == 1);
}

TEST_CASE("a range is between two bounds with its least and with its largest matrix") {
  const StartCovariance range = the_range();
  const Covariance<Ball> printed{Ball(0.25), half, Ball(0.125), Ball(0.25)};
  const auto times = [&](double factor) {
    const Ball f(factor);
    return Covariance<Ball>{f * printed.p11, f * printed.p22, f * printed.p23, f * printed.p33};
  };
  CHECK(range.between(times(0.49), times(2.01)));
  CHECK_FALSE(range.between(times(0.51), times(2.01)));
  CHECK_FALSE(range.between(times(0.49), times(1.99)));
}

TEST_CASE("a range is enclosed, both ends of it") {
  const StartCovariance range = the_range();
  const Matrix3 all = range.enclosure();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (const Matrix3& end : {range.lowest, range.highest}) {
        CHECK(arb_contains(all[i][j].raw(), end[i][j].raw()) != 0);
      }
    }
  }
}
