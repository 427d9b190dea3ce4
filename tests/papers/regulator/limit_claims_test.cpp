#include "papers/regulator/limit_claims.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "analysis/rigor/rounding.hpp"

namespace {

using namespace veritrack;
using rigor::Verdict;

/// The output of section 5.4's plant under the constant controller N/D, with noise or vibration v.
template <std::size_t N, typename Disturbance>
double largest_output(const std::array<double, N>& numerator, const std::array<double, N>& denominator,
                      double gain, int from, int samples, Disturbance&& disturbance) {
  std::array<double, N> outputs{};
  std::array<double, N> inputs{};
  double x = 0.0;
  double largest = 0.0;
  for (int k = 0; k < samples; ++k) {
    x = 0.5 * x + 3.0 * gain * inputs[0];
    for (std::size_t i = N - 1; i > 0; --i) {
      outputs.at(i) = outputs.at(i - 1);
    }
    outputs[0] = x + disturbance(k);
    double sum = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      sum -= numerator.at(i) * outputs.at(i);
    }
    for (std::size_t i = N - 1; i > 0; --i) {
      sum -= denominator.at(i) * inputs.at(i - 1);
      inputs.at(i) = inputs.at(i - 1);
    }
    inputs[0] = sum / denominator[0];
    if (k >= from) {
      largest = std::max(largest, std::fabs(outputs[0]));
    }
  }
  return largest;
}

constexpr std::array kNumerator51{1.7980, -1.6164, 0.4802};
constexpr std::array kDenominator51{3.0, -5.1962, 3.0};
constexpr std::array kNumerator52{2.2585, -1.9837, 0.4610, 0.2449, -0.0845};
constexpr std::array kDenominator52{2.9604, -5.5496, 3.2754, 0.2984, -0.4159};

double tone(double frequency, int k) {
  return std::cos(frequency * k);
}

}  // namespace

TEST_CASE(
    "what is said of the limits stands, but for the printed poles, the match and the plant's own poles") {
  const std::set<std::string> refuted{"chapter-5/limits/table-5.2/poles/printed",
                                      "chapter-5/limits/match/table-5.1", "chapter-5/limits/match/table-5.2",
                                      "chapter-5/internal-model/printed"};
  const rigor::UpwardRounding upward;
  std::set<std::string> found;
  for (const auto& part : {regulator::limit_loop_claims(), regulator::limit_polynomial_claims()}) {
    for (const theorems::Statement& statement : part) {
      CAPTURE(statement.id);
      CAPTURE(statement.witness);
      CHECK_FALSE(statement.witness.empty());
      CHECK(found.insert(statement.id).second);
      CHECK(statement.verdict == (refuted.contains(statement.id) ? Verdict::refuted : Verdict::proved));
    }
  }
  CHECK(found.size() == 22);
}

TEST_CASE(
    "the loops, run in double precision, are stable for the gains that are claimed, and for no others") {
  const auto start = [](int k) { return k == 0 ? 1.0 : 0.0; };
  const auto left = [&](const auto& numerator, const auto& denominator, double gain) {
    return largest_output(numerator, denominator, gain, 19'000, 20'000, start);
  };
  CHECK(left(kNumerator51, kDenominator51, 1.0) < 1e-9);
  CHECK(left(kNumerator51, kDenominator51, 0.02) < 1e-9);
  CHECK(left(kNumerator51, kDenominator51, 1.43) < 1e-9);
  CHECK(left(kNumerator51, kDenominator51, 1.45) > 1e3);
  CHECK(left(kNumerator52, kDenominator52, 1.0) < 1e-9);
  CHECK(left(kNumerator52, kDenominator52, 0.25) < 1e-9);
  CHECK(left(kNumerator52, kDenominator52, 1.26) < 1e-9);
  CHECK(left(kNumerator52, kDenominator52, 1.27) > 1e3);
  CHECK(left(kNumerator52, kDenominator52, 0.1) > 1e3);
}

TEST_CASE("the loops, run on tones, leave nothing of the vibration and have the peaks that are claimed") {
  const auto gain = [&](const auto& numerator, const auto& denominator, double frequency) {
    return largest_output(numerator, denominator, 1.0, 1'000, 20'000,
                          [&](int k) { return tone(frequency, k); });
  };
  constexpr double kVibration = std::numbers::pi / 6.0;
  CHECK(gain(kNumerator51, kDenominator51, kVibration) < 2e-5);
  CHECK(gain(kNumerator52, kDenominator52, kVibration) < 2e-5);
  CHECK(gain(kNumerator51, kDenominator51, std::numbers::pi) == doctest::Approx(3.29).epsilon(0.002));
  double largest = 0.0;
  for (double frequency = 2.5; frequency < 2.7; frequency += 0.01) {
    largest = std::max(largest, gain(kNumerator52, kDenominator52, frequency));
  }
  CHECK(largest == doctest::Approx(5.04).epsilon(0.002));
}

TEST_CASE("a plant that resonates at the vibration's frequency needs no pole in the controller") {
  const double c = 2.0 * std::cos(0.7);
  double x1 = 0.0, x2 = 0.0, u = 0.0, before = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double x = c * x1 - x2 + u;
    const double y = x + std::cos(0.7 * k + 0.3);
    u = -(c * y - before);
    before = y;
    x2 = x1;
    x1 = x;
    if (k >= 2) {
      REQUIRE(std::fabs(y) < 1e-9);
    }
  }
}
