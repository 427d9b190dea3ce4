// The infimum (10) and where it is attained, against the tracker's own code.
#include "checker/kkl_observer/kkl_ell.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

/// The least |M T|^2 / |T|^2 over many phases of one frequency.
double sampled_ratio(const Eigen::Vector4d& lambda, double frequency) {
  constexpr int kPhases = 4000;
  double least = HUGE_VAL;
  for (int k = 0; k < kPhases; ++k) {
    const auto x = trackers::oscillator_state(1.0, 3.15 * k / kPhases, frequency);
    const Eigen::Vector4d transformed = trackers::kkl_transform<double, 4>(x, lambda);
    least =
        std::min(least, trackers::kkl_excitation<double, 4>(transformed, lambda) / transformed.squaredNorm());
  }
  return least;
}

/// Objections to the enclosure and to where the infimum is said to be attained, of rates 1 to 4 and 2 to 4
/// rad/s.
std::string objections_to(const std::string& low, const std::string& high, const std::string& first,
                          const std::string& last) {
  checker::KklDesign design;
  for (const double rate : {1.0, 2.0, 3.0, 4.0}) {
    design.lambda.emplace_back(rate);
  }
  design.frequency_low = Ball(2.0);
  design.frequency_high = Ball(4.0);
  const auto enclosure = [](const std::string& lo, const std::string& hi) {
    return R"({"lo": ")" + lo + R"(", "hi": ")" + hi + R"("})";
  };
  const checker::Tree derivation =
      checker::read_json(R"({"conditions": [], "quantities": {"ell": )" + enclosure(low, high) +
                         R"(, "argmin_omega": )" + enclosure(first, last) + "}}");
  checker::Objections objections;
  checker::check_kkl_ell(derivation, design, objections);
  std::string text;
  for (const std::string& objection : objections) {
    text += objection + "\n";
  }
  return text;
}

bool mentions(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

TEST_CASE("the least ratio of a frequency is the least over its phases") {
  test::Random random(144);
  for (std::int64_t i = 0; i < test::effort(50); ++i) {
    CAPTURE(i);
    Eigen::Vector4d lambda;
    std::vector<Ball> rates;
    for (int j = 0; j < 4; ++j) {
      lambda(j) = j + random.uniform(0.5, 1.3);
      rates.emplace_back(lambda(j));
    }
    const double frequency = random.uniform(0.5, 6.0);
    const double sampled = sampled_ratio(lambda, frequency);
    const double found = checker::excitation_ratio(rates, Ball(frequency)).near();
    CHECK(found <= sampled * (1.0 + 1e-9));
    CHECK(found >= sampled * (1.0 - 1e-2));
  }
}

TEST_CASE("the least ratio of more filters, against a grid of directions") {
  test::Random random(145);
  for (const int filters : {5, 6, 8}) {
    for (std::int64_t trial = 0; trial < test::effort(5); ++trial) {
      CAPTURE(filters);
      CAPTURE(trial);
      std::vector<double> lambda;
      std::vector<Ball> rates;
      for (int j = 0; j < filters; ++j) {
        lambda.push_back(j + random.uniform(0.5, 1.3));
        rates.emplace_back(lambda.back());
      }
      const double frequency = random.uniform(0.5, 6.0);
      double sampled = HUGE_VAL;
      constexpr int kDirections = 2000;
      for (int k = 0; k < kDirections; ++k) {
        // The filters' complex responses; |M xi|^2 is det(L'L), L = (lambda, 1, xi).
        const std::complex<double> direction = std::polar(1.0, 3.15 * k / kDirections);
        Eigen::MatrixXd l(filters, 3);
        for (int i = 0; i < filters; ++i) {
          const double rate = lambda[static_cast<std::size_t>(i)];
          l.row(i) << rate, 1.0, (direction / std::complex<double>(rate, frequency)).imag();
        }
        sampled = std::min(sampled, (l.transpose() * l).determinant() / l.col(2).squaredNorm());
      }
      const double found = checker::excitation_ratio(rates, Ball(frequency)).near();
      // The oracle loses digits where the determinant is small.
      CHECK(found <= sampled * (1.0 + 1e-6) + 1e-11);
      CHECK(found >= sampled * (1.0 - 1e-2) - 1e-11);
    }
  }
}

TEST_CASE("the bound of more filters is the least of the range, and nothing above") {
  for (const int filters : {5, 6, 8}) {
    CAPTURE(filters);
    checker::KklDesign design;
    for (int i = 1; i <= filters; ++i) {
      design.lambda.emplace_back(static_cast<double>(i));
    }
    design.frequency_low = Ball(2.0);
    design.frequency_high = Ball(4.0);
    const double least = checker::excitation_ratio(design.lambda, Ball(4.0)).near();
    const auto is_enclosure = [&](double low, double high) {
      return checker::is_true({Ball(low), Ball(high), Ball(4.0)}, design);
    };
    CHECK(is_enclosure(least * (1.0 - 1e-10), least * (1.0 + 1e-10)));
    CHECK(!is_enclosure(least * (1.0 + 1e-10), least * (1.0 + 2e-10)));
    CHECK(!is_enclosure(least * (1.0 - 2e-10), least * (1.0 - 1e-10)));
  }
}

TEST_CASE("where the infimum is attained must be where it is, to the last bit") {
  const std::string low = "0x1.6a49ba732a35ep-11";
  const std::string high = "0x1.6a49ba7807062p-11";
  const std::string accepted = objections_to(low, high, "0x1p+2", "0x1p+2");
  CHECK(!mentions(accepted, "ell is"));
  CHECK(!mentions(accepted, "argmin_omega"));
  // 4e-12 rad/s below 4: the ratio there is still within the enclosure, but it is not the least.
  CHECK(mentions(objections_to(low, high, "0x1.fffffffff7p+1", "0x1.fffffffff7p+1"), "argmin_omega"));
  CHECK(!mentions(objections_to(low, high, "0x1.fffffffff7p+1", "0x1p+2"), "argmin_omega"));
  // Enclosures that lie above and below the infimum.
  CHECK(mentions(objections_to("0x1.6a49bap-11", "0x1.6a49ba7p-11", "0x1p+2", "0x1p+2"), "ell is"));
  CHECK(mentions(objections_to("0x1.6a49ba77p-11", high, "0x1p+2", "0x1p+2"), "ell is"));
}

namespace {

/// Is the infimum over [first, last] rad/s at least `low`, as far as the checker can tell, of rates 1 to 4?
bool is_bound(double low, double first, double last, double attained) {
  checker::KklDesign design;
  for (const double rate : {1.0, 2.0, 3.0, 4.0}) {
    design.lambda.emplace_back(rate);
  }
  design.frequency_low = Ball(first);
  design.frequency_high = Ball(last);
  return checker::is_true({Ball(low), Ball(1e9), Ball(attained)}, design);
}

double ratio(double frequency) {
  return checker::excitation_ratio({Ball(1.0), Ball(2.0), Ball(3.0), Ball(4.0)}, Ball(frequency)).near();
}

}  // namespace

TEST_CASE("a bound that one end of the range satisfies is none when the ratio falls to the other") {
  REQUIRE(ratio(4.0) < ratio(3.0));
  CHECK(is_bound(0.999 * ratio(4.0), 3.0, 4.0, 4.0));
  CHECK(!is_bound(1.001 * ratio(4.0), 3.0, 4.0, 4.0));
  CHECK(!is_bound(0.5 * (ratio(3.0) + ratio(4.0)), 3.0, 4.0, 4.0));
}

TEST_CASE("an enclosure is narrow and positive, or ell is not known") {
  checker::KklDesign design;
  for (const double rate : {1.0, 2.0, 3.0, 4.0}) {
    design.lambda.emplace_back(rate);
  }
  design.frequency_low = Ball(2.0);
  design.frequency_high = Ball(4.0);
  const auto accepts = [&](const std::string& low, const std::string& high, const std::string& condition) {
    const std::string at_4 = R"({"lo": "0x1p+2", "hi": "0x1p+2"})";
    const checker::Tree derivation =
        checker::read_json(R"({"conditions": [{"id": ")" + condition +
                           R"(", "verdict": "proved"}], "quantities": {"ell": {"lo": ")" + low +
                           R"(", "hi": ")" + high + R"("}, "argmin_omega": )" + at_4 + "}}");
    checker::Objections objections;
    const bool known = checker::check_kkl_ell(derivation, design, objections).has_value();
    return std::pair(objections.empty(), known);
  };
  const std::string low = "0x1.6a49ba732a35ep-11";
  const std::string high = "0x1.6a49ba7807062p-11";
  CHECK(accepts(low, high, "enclosed") == std::pair(true, true));
  CHECK(accepts(low, high, "positive") == std::pair(true, true));
  CHECK(accepts("0x1.6a49bp-11", high, "enclosed") == std::pair(false, false));
  CHECK(accepts("0x1.6a49bp-11", high, "positive") == std::pair(true, false));
  CHECK(accepts("-0x1p-11", high, "enclosed") == std::pair(false, false));
  CHECK(accepts("-0x1p-11", high, "positive") == std::pair(false, false));
}

TEST_CASE("the infimum is attained within the range") {
  const double low = 0.5 * ratio(4.0);
  CHECK(is_bound(low, 3.0, 4.0, 3.5));
  CHECK(!is_bound(low, 3.0, 4.0, 2.9));
  CHECK(!is_bound(low, 3.0, 4.0, 4.1));
}
