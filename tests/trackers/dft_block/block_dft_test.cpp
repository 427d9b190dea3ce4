#include "trackers/dft_block/block_dft.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using Real = long double;
using Complex = std::complex<Real>;
constexpr Real kTurn = 2 * std::numbers::pi_v<Real>;

/// (4.4), term by term.
Complex direct(const std::vector<double>& samples, long bin) {
  Complex sum = 0;
  for (std::size_t t = 0; t < samples.size(); ++t) {
    sum += Real(samples[t]) * std::polar(Real(1), -kTurn * static_cast<Real>(bin) * static_cast<Real>(t) /
                                                      static_cast<Real>(samples.size()));
  }
  return sum / static_cast<Real>(samples.size());
}

std::vector<double> tone(std::size_t length, double amplitude, double phase, double cycles) {
  std::vector<double> samples;
  for (std::size_t t = 0; t < length; ++t) {
    samples.push_back(amplitude * static_cast<double>(std::cos(kTurn * Real(cycles) * static_cast<Real>(t) /
                                                                   static_cast<Real>(length) +
                                                               Real(phase))));
  }
  return samples;
}

std::vector<DftBin<double>> transformed(BlockDft<double>& transform, const std::vector<double>& samples) {
  bool complete = false;
  for (const double sample : samples) {
    CHECK_FALSE(complete);
    complete = transform.push(sample);
  }
  CHECK(complete);
  return {transform.bins().begin(), transform.bins().end()};
}

Complex as_complex(const DftBin<double>& bin) {
  return {bin.real, bin.imaginary};
}

TEST_CASE("the streamed bins are the sums (4.4), block after block") {
  Random random(411);
  BlockDft<double> transform(257, 30, 3);
  for (int block = 0; block < 3; ++block) {
    std::vector<double> samples;
    for (int t = 0; t < 257; ++t) {
      samples.push_back(random.uniform(-1.0, 1.0));
    }
    const auto bins = transformed(transform, samples);
    REQUIRE(bins.size() == 7);
    for (long i = 0; i < 7; ++i) {
      CHECK(std::abs(as_complex(bins[static_cast<std::size_t>(i)]) - direct(samples, 27 + i)) <= 1e-14L);
    }
  }
}

TEST_CASE("a tone's bins: (4.5) with the conjugate in its second term, and (4.9) within O(1/T)") {
  Random random(412);
  for (int k = 0; k < 20; ++k) {
    const std::size_t length = 2048;
    const long centre = 300;
    const double amplitude = random.uniform(0.5, 2.0);
    const double phase = random.uniform(-3.0, 3.0);
    const double offset = random.uniform(-1.5, 1.5);
    const auto samples = tone(length, amplitude, phase, static_cast<double>(centre) + offset);
    BlockDft<double> transform(length, centre, 2);
    const auto bins = transformed(transform, samples);
    Real printed_gap = 0;
    Real wrong_sign = 0;
    for (long i = 0; i < 5; ++i) {
      const long m = centre - 2 + i;
      const Complex y = as_complex(bins[static_cast<std::size_t>(i)]);
      const auto term = [&](Real d, Real sign) {
        const Real half_turn = kTurn / 2;
        return std::polar(Real(amplitude / (2.0 * length)),
                          sign * (Real(phase) + half_turn * (length - 1) / length * d)) *
               std::sin(half_turn * d) / std::sin(half_turn * d / length);
      };
      const Real near = static_cast<Real>(centre - m) + Real(offset);
      const Real far = static_cast<Real>(centre + m) + Real(offset);
      CHECK(std::abs(y - (term(near, 1) + term(far, -1))) <= 1e-11L);
      printed_gap = std::max(printed_gap, std::abs(y - (term(near, 1) + term(far, 1))));
      const auto model = [&](Real sign) {
        return std::polar(Real(amplitude) / (2 * kTurn), Real(phase)) *
               (std::polar(Real(1), sign * kTurn * Real(offset)) - Real(1)) / (Complex(0, 1) * near);
      };
      CHECK(std::abs(y - model(1)) <= 3 * Real(amplitude) / length);
      wrong_sign = std::max(wrong_sign, std::abs(y - model(-1)));
    }
    CHECK(printed_gap > 1e-10L);
    if (std::abs(std::sin(kTurn * Real(offset))) > 0.3L) {  // at half bins the sign does not show
      CHECK(wrong_sign > 0.02L * Real(amplitude));
    }
  }
}

TEST_CASE("what docs/block-tracker.md says that a tone of samples adds to (4.9), as a length of its bins") {
  Random random(414);
  Real least_room = 1;
  for (int run = 0; run < 200; ++run) {
    const std::size_t length = run % 2 == 0 ? 64 : 501;
    const long centre = 4 + static_cast<long>(random.below(length / 2 - 8));
    const double amplitude = random.uniform(0.5, 2.0);
    const double phase = random.uniform(-3.0, 3.0);
    const double offset = random.uniform(-0.5, 0.5);
    const double slew = random.uniform(0.0, 0.05);
    const auto samples = tone(length, amplitude, phase, static_cast<double>(centre) + offset);
    Real transform = 0;
    Real transform_bound = 0;
    Real motion = 0;
    for (long m = centre - 2; m <= centre + 2; ++m) {
      const Real near = static_cast<Real>(centre - m) + Real(offset);
      const Complex model = std::polar(Real(amplitude) / (2 * kTurn), Real(phase)) *
                            (std::polar(Real(1), kTurn * Real(offset)) - Real(1)) / (Complex(0, 1) * near);
      transform += std::norm(direct(samples, m) - model);
      const Real x = kTurn * near / static_cast<Real>(length);
      const Real image = kTurn * (static_cast<Real>(centre + m) + Real(offset)) / static_cast<Real>(length);
      const Real bound =
          Real(amplitude) / (2 * static_cast<Real>(length)) * std::abs(std::sin(kTurn / 2 * Real(offset))) *
          (std::hypot(Real(1), 1 / std::tan(x / 2) - 2 / x) + 1 / std::abs(std::sin(image / 2)));
      transform_bound += bound * bound;
      // The frequency rises by `slew` bins from the start of the block to its end.
      std::vector<double> moved(length);
      for (std::size_t t = 0; t < length; ++t) {
        const Real share = static_cast<Real>(t) / static_cast<Real>(length);
        const Real turned = kTurn * (static_cast<Real>(centre) + Real(offset)) * share + Real(phase);
        moved[t] = static_cast<double>(
            Real(amplitude) *
            (std::cos(turned - kTurn / 2 * Real(slew) * share * (1 - share)) - std::cos(turned)));
      }
      motion += std::norm(direct(moved, m));
    }
    CHECK(transform <= transform_bound);
    least_room = std::min(least_room, 1 - std::sqrt(transform / transform_bound));
    CHECK(std::sqrt(motion) <= kTurn / 2 * Real(amplitude) * Real(slew) / std::sqrt(Real(60)));
  }
  CHECK(least_room <= 0.05L);
}

TEST_CASE("the printed taps of the filter bank give the conjugate of the bin, turned") {
  Random random(413);
  std::vector<double> samples;
  for (int t = 0; t < 64; ++t) {
    samples.push_back(random.uniform(-1.0, 1.0));
  }
  for (long m = 0; m < 32; ++m) {
    Complex printed = 0;
    Complex right = 0;
    for (std::size_t i = 0; i < 64; ++i) {
      const Real sample = samples[63 - i];
      printed += sample * std::polar(Real(1) / 64, -kTurn * static_cast<Real>(m) * static_cast<Real>(i) / 64);
      right +=
          sample * std::polar(Real(1) / 64, kTurn * static_cast<Real>(m) * static_cast<Real>(i + 1) / 64);
    }
    const Complex bin = direct(samples, m);
    CHECK(std::abs(right - bin) <= 1e-15L);
    CHECK(std::abs(printed - std::polar(Real(1), kTurn * static_cast<Real>(m) / 64) * std::conj(bin)) <=
          1e-15L);
  }
}

TEST_CASE("the start (4.35)-(4.36) finds a tone without noise, at integers too") {
  Random random(414);
  for (int k = 0; k < 60; ++k) {
    const double offset = k % 5 == 0 ? static_cast<double>(random.below(3)) - 1.0 : random.uniform(-1.9, 1.9);
    const double phase = random.uniform(-3.0, 3.0);
    const double amplitude = random.uniform(0.1, 5.0);
    std::vector<DftBin<double>> bins;
    for (int i = 0; i < 5; ++i) {
      const Real d = static_cast<Real>(2 - i) + Real(offset);
      const Complex g = std::abs(d) < 1e-15L
                            ? Complex(kTurn)
                            : (std::polar(Real(1), kTurn * d) - Real(1)) / (Complex(0, 1) * d);
      const Complex y = std::polar(Real(amplitude) / (2 * kTurn), Real(phase)) * g;
      bins.push_back({static_cast<double>(y.real()), static_cast<double>(y.imag())});
    }
    const auto start = dft_block_start<double>(bins);
    CHECK(std::fabs(start.offset - offset) <= 1e-7);
    CHECK(std::fabs(std::remainder(start.phase - phase, 2.0 * std::numbers::pi)) <= 1e-6);
    CHECK(start.root_amplitude ==
          doctest::Approx(std::sqrt(amplitude / (4.0 * std::numbers::pi))).epsilon(1e-7));
  }
}

TEST_CASE("the fit explains what least squares over the printed d_m explains") {
  Random random(415);
  for (int k = 0; k < 200; ++k) {
    std::vector<DftBin<double>> bins(7);
    for (auto& bin : bins) {
      bin = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    }
    const double offset = random.uniform(-2.9, 2.9);
    Complex sum = 0;
    Real weight = 0;
    for (int i = 0; i < 7; ++i) {
      const Real d = static_cast<Real>(3 - i) + Real(offset);
      const Complex g = (std::polar(Real(1), kTurn * Real(offset)) - Real(1)) / (Complex(0, 1) * d);
      sum += as_complex(bins[static_cast<std::size_t>(i)]) * std::conj(g);
      weight += std::norm(g);
    }
    const auto fit = dft_block_fit<double>(bins, offset);
    CHECK(fit.explained == doctest::Approx(static_cast<double>(std::norm(sum) / weight)).epsilon(1e-9));
    CHECK(std::abs(as_complex(fit.factor) - sum / weight) <= 1e-9L);
    // No offset of a fine scan explains more than the start.
    if (k < 10) {
      const double most = dft_block_fit<double>(bins, dft_block_start<double>(bins).offset).explained;
      for (int i = -3000; i <= 3000; ++i) {
        CHECK(dft_block_fit<double>(bins, i / 1000.0).explained <= most + 1e-4);
      }
    }
  }
}

TEST_CASE("impossible blocks are refused") {
  CHECK_THROWS_AS(BlockDft<double>(0, 0, 0), std::invalid_argument);
  CHECK_THROWS_AS(BlockDft<double>(2048, 1, 2), std::invalid_argument);
  CHECK_THROWS_AS(BlockDft<double>(604, 300, 2), std::invalid_argument);
  CHECK_NOTHROW(BlockDft<double>(605, 300, 2));
}

}  // namespace
}  // namespace veritrack::trackers
