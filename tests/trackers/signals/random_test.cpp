#include "trackers/signals/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

/// The largest distance between the empirical distribution of `values` and `distribution`, times sqrt(n):
/// above 2.5 with probability 2 exp(-2 * 2.5^2) = 7e-6 if the values have that distribution (Kolmogorov).
template <typename Distribution>
double kolmogorov_smirnov(std::vector<double> values, Distribution distribution) {
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = distribution(values[i]);
    distance = std::max(
        {distance, expected - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - expected});
  }
  return distance * std::sqrt(n);
}

double normal_distribution(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

TEST_CASE("normal deviates have the normal distribution") {
  RandomStream random(test::kSeed);
  const std::size_t count = static_cast<std::size_t>(test::effort(1000000));
  std::vector<double> values(count);
  std::array<double, 5> moment{};
  double beyond_three = 0.0;
  for (double& value : values) {
    value = random.normal();
    double power = 1.0;
    for (double& m : moment) {
      m += power;
      power *= value;
    }
    beyond_three += std::fabs(value) > 3.0 ? 1.0 : 0.0;
  }
  const double n = static_cast<double>(count);
  const double five_sigma = 5.0 / std::sqrt(n);
  CHECK(std::fabs(moment[1] / n) <= five_sigma);
  CHECK(std::fabs(moment[2] / n - 1.0) <= five_sigma * std::sqrt(2.0));
  CHECK(std::fabs(moment[3] / n) <= five_sigma * std::sqrt(15.0));
  CHECK(std::fabs(moment[4] / n - 3.0) <= five_sigma * std::sqrt(96.0));
  const double tail = std::erfc(3.0 / std::sqrt(2.0));
  CHECK(std::fabs(beyond_three / n - tail) <= five_sigma * std::sqrt(tail));
  CHECK(kolmogorov_smirnov(values, normal_distribution) <= 2.5);

  // Chi squared over bins of |x|, which sees ripples that the cumulative distribution smooths away. With 40
  // bins its mean is 40 and its standard deviation 9.
  constexpr std::size_t kBins = 40;
  constexpr double kWidth = 0.1;
  std::array<double, kBins> observed{};
  for (const double value : values) {
    const std::size_t bin = static_cast<std::size_t>(std::fabs(value) / kWidth);
    observed[std::min(bin, kBins - 1)] += 1.0;
  }
  double chi_squared = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const double low = kWidth * static_cast<double>(bin);
    const double above = bin + 1 < kBins ? std::erfc((low + kWidth) / std::sqrt(2.0)) : 0.0;
    const double expected = n * (std::erfc(low / std::sqrt(2.0)) - above);
    chi_squared += (observed[bin] - expected) * (observed[bin] - expected) / expected;
  }
  CHECK(chi_squared <= 85.0);
}

TEST_CASE("successive normal deviates are uncorrelated, in size and in sign") {
  RandomStream random(2);
  const std::size_t count = 200000;
  double product = 0.0;
  double product_of_squares = 0.0;
  double last = random.normal();
  for (std::size_t k = 0; k < count; ++k) {
    const double next = random.normal();
    product += last * next;
    product_of_squares += (last * last - 1.0) * (next * next - 1.0);
    last = next;
  }
  const double five_sigma = 5.0 * std::sqrt(static_cast<double>(count));
  CHECK(std::fabs(product) <= five_sigma);
  CHECK(std::fabs(product_of_squares) <= 2.0 * five_sigma);
}

TEST_CASE("uniform deviates are uniform in [0, 1)") {
  RandomStream random(3);
  std::vector<double> values(200000);
  for (double& value : values) {
    value = random.uniform();
    REQUIRE(value >= 0.0);
    REQUIRE(value < 1.0);
  }
  CHECK(kolmogorov_smirnov(values, [](double x) { return x; }) <= 2.5);
}

TEST_CASE("points in a disc stay in it, evenly") {
  RandomStream random(4);
  const double radius = 0.25;
  std::vector<double> radii;
  std::vector<double> angles;
  for (int k = 0; k < 200000; ++k) {
    const auto [x, y] = random.in_disc(radius);
    radii.push_back(std::hypot(x, y));
    REQUIRE(radii.back() <= radius);
    angles.push_back(std::atan2(y, x));
  }
  CHECK(kolmogorov_smirnov(radii, [radius](double x) { return x * x / (radius * radius); }) <= 2.5);
  const double pi = std::acos(-1.0);
  CHECK(kolmogorov_smirnov(angles, [pi](double x) { return (x + pi) / (2.0 * pi); }) <= 2.5);
  CHECK(random.in_disc(0.0) == std::pair<double, double>(0.0, 0.0));
}

TEST_CASE("the stream is pinned: any change of it is a change of every published simulation") {
  RandomStream random(1);
  const std::array<double, 6> normal{-0x1.ce0b479deb99p-2, -0x1.11b1c7962db13p+0, -0x1.97ee7085c36a8p-2,
                                     0x1.c5465293053f9p+1, -0x1.a4168a51b3cc4p-2, 0x1.3b701ffed4fcap+0};
  for (const double expected : normal) {
    CHECK(random.normal() == expected);
  }
  const std::array<double, 2> uniform{0x1.548ea90227b6cp-1, 0x1.54290b7d69e18p-1};
  for (const double expected : uniform) {
    CHECK(random.uniform() == expected);
  }
  const auto [x, y] = random.in_disc(1.0);
  CHECK(x == -0x1.8942609ff1d44p-2);
  CHECK(y == -0x1.1a1d233360482p-1);
}

TEST_CASE("equal seeds give equal streams, different seeds different ones") {
  RandomStream a(7);
  RandomStream b(7);
  RandomStream c(8);
  bool differs = false;
  for (int k = 0; k < 100; ++k) {
    const double value = a.normal();
    CHECK(value == b.normal());
    differs = differs || value != c.normal();
  }
  CHECK(differs);
}

}  // namespace
}  // namespace veritrack::trackers
