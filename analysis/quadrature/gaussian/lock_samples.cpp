#include "analysis/quadrature/gaussian/lock_samples.hpp"

#include <cmath>

namespace veritrack::quadrature {

std::vector<LevelPoint> sample_directions(int count) {
  // Kronecker's sequence, by the normal quantiles' rough shape.
  std::vector<LevelPoint> result;
  result.reserve(static_cast<std::size_t>(count));
  constexpr std::array<double, 4> kSteps{0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                         0.5385972572236101};
  for (int k = 1; k <= count; ++k) {
    LevelPoint direction{};
    double length = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      double part = 0.0;
      const double uniform = 2.0 * std::modf(0.5 + k * kSteps[i], &part) - 1.0;
      direction[i] = std::atanh(0.999 * uniform);
      length += direction[i] * direction[i];
    }
    for (std::size_t i = 0; i < 4; ++i) {
      direction[i] = (i < 2 ? direction[i] : std::fabs(direction[i])) / std::sqrt(length);
    }
    result.push_back(direction);
  }
  return result;
}

LevelPoint point_at(const LockSet& set, const LockSample& sample) {
  const double radius = std::sqrt(2.0 * sample.level);
  const LevelPoint& direction = sample.direction;
  return {radius * direction[0], radius * direction[1], radius * direction[2],
          radius * direction[3] / std::sqrt(set.weight)};
}

}  // namespace veritrack::quadrature
