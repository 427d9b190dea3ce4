#include "analysis/linear/loop_margins.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::linear {

namespace {

/// A, and b c: what the detector closes.
struct OpenedLoop {
  Eigen::MatrixXd closed;
  Eigen::MatrixXd feedback;

  explicit OpenedLoop(const DetectorLoop& loop) {
    const auto n = static_cast<Eigen::Index>(loop.a.size());
    closed.resize(n, n);
    feedback.resize(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto row = static_cast<std::size_t>(i);
        const auto column = static_cast<std::size_t>(j);
        closed(i, j) = rigor::midpoint(loop.a[row][column]);
        feedback(i, j) = rigor::midpoint(loop.effect[row]) * rigor::midpoint(loop.phase[column]);
      }
    }
  }
};

/// The open loop L by the roots of 1 + L: those of the closed loop over those of the open one.
class OpenLoop {
 public:
  explicit OpenLoop(const OpenedLoop& loop)
      : zeros_(rigor::eigenvalues_by_size(loop.closed)),
        poles_(rigor::eigenvalues_by_size(Eigen::MatrixXd(loop.closed + loop.feedback))) {}

  [[nodiscard]] std::complex<double> at(double omega) const {
    const std::complex<double> z = std::polar(1.0, omega);
    std::complex<double> product(1.0);
    for (std::size_t i = 0; i < zeros_.size(); ++i) {
      product *= (z - zeros_[i]) / (z - poles_[i]);
    }
    return product - 1.0;
  }

 private:
  std::vector<std::complex<double>> zeros_, poles_;
};

}  // namespace

GainMargin gain_margin(const DetectorLoop& loop) {
  constexpr double kStep = 1.02;
  constexpr double kMost = 1e3;
  constexpr int kHalvings = 40;
  const OpenedLoop opened(loop);
  const auto is_stable = [&](double factor) {
    const Eigen::MatrixXd changed = opened.closed - (factor - 1.0) * opened.feedback;
    return rigor::spectral_radius(changed) < 1.0;
  };
  // The first factor on the way that is not stable.
  const auto limit = [&](double step) {
    double stable = 1.0;
    while (stable < kMost && stable > 1.0 / kMost && is_stable(stable * step)) {
      stable *= step;
    }
    if (!(stable < kMost && stable > 1.0 / kMost)) {
      return step > 1.0 ? INFINITY : 0.0;
    }
    double unstable = stable * step;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (stable + unstable);
      (is_stable(middle) ? stable : unstable) = middle;
    }
    return stable;
  };
  return {limit(1.0 / kStep), limit(kStep)};
}

std::optional<DelayMargin> delay_margin(const DetectorLoop& loop) {
  constexpr double kLowest = 1e-7;  // rad/sample
  constexpr int kFrequencies = 4000;
  constexpr int kHalvings = 60;
  const OpenLoop open{OpenedLoop(loop)};
  const auto is_above = [&](double omega) { return std::abs(open.at(omega)) > 1.0; };
  std::optional<DelayMargin> least;
  double before = kLowest;
  for (int i = 1; i <= kFrequencies; ++i) {
    const double omega =
        kLowest * std::pow(std::numbers::pi / kLowest, static_cast<double>(i) / kFrequencies);
    if (is_above(before) != is_above(omega)) {
      double low = before;
      double high = omega;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        (is_above(middle) == is_above(before) ? low : high) = middle;
      }
      // A delay turns the open loop back; it does harm where this comes to half a turn.
      const double phase = std::numbers::pi + std::arg(open.at(low));
      if (!least || phase / low < least->samples) {
        least = DelayMargin{phase / low, phase, low};
      }
    }
    before = omega;
  }
  return least;
}

}  // namespace veritrack::linear
