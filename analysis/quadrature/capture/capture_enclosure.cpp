#include "analysis/quadrature/capture/capture_enclosure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace veritrack::quadrature {

namespace {

// The bounds below are sums of at most 200 non-negative terms, each with a relative error of at most a few
// times 2^-52 in any rounding mode (Eigen chooses the order): enlarging them by 2^-40 makes upper bounds of
// them, the smallest number takes care of underflow.
constexpr double kEnlargement = 1.0 + 0x1p-40;
constexpr double kSmallest = 1e-300;
/// The relative error of a scalar product of nine terms, in terms of the absolute values, generously.
constexpr double kRoundingOfProduct = 0x1p-47;

}  // namespace

StateVector Zonotope::radii() const {
  StateVector sums = generators_.cwiseAbs().rowwise().sum();
  return (sums * kEnlargement).array() + kSmallest;
}

void Zonotope::add_box(const StateVector& radii) {
  reduce(kStateSize);
  const Eigen::Index old = generators_.cols();
  generators_.conservativeResize(Eigen::NoChange, old + kStateSize);
  generators_.rightCols<kStateSize>() = radii.asDiagonal();
}

void Zonotope::add_image(const rigor::IntervalMatrix<kStateSize, kInputSize>& matrix,
                         const rigor::Vector<kInputSize>& radii) {
  // A = M + E as below; the columns of M, stretched, are generators.
  const rigor::Matrix<kStateSize, kInputSize> middle = rigor::midpoint(matrix);
  const rigor::Matrix<kStateSize, kInputSize> deviation = rigor::radius_around(matrix, middle);
  const StateVector rest = deviation * radii + kRoundingOfProduct * (middle.cwiseAbs() * radii);
  reduce(kInputSize);
  const Eigen::Index old = generators_.cols();
  generators_.conservativeResize(Eigen::NoChange, old + kInputSize);
  generators_.rightCols<kInputSize>() = middle * radii.asDiagonal();
  add_box((rest * kEnlargement).array() + kSmallest);
}

void Zonotope::transform(const StateMatrix& matrix) {
  // A = M + E with |E| <= D entry by entry: A G s = (M G) s + (E G) s, and |E G s| <= D (|G| 1).
  const rigor::Matrix<kStateSize> middle = rigor::midpoint(matrix);
  const rigor::Matrix<kStateSize> deviation = rigor::radius_around(matrix, middle);
  const StateVector size = radii();
  const Generators image = middle * generators_;
  const StateVector rest = deviation * size + kRoundingOfProduct * (middle.cwiseAbs() * size);
  generators_ = image;
  add_box((rest * kEnlargement).array() + kSmallest);
}

void Zonotope::reduce(Eigen::Index room) {
  const Eigen::Index count = generators_.cols();
  if (count + room <= kMostGenerators) {
    return;
  }
  // Sizes relative to the set's extent in each coordinate, so that units do not matter.
  const StateVector scale = radii().cwiseInverse();
  std::array<double, kMostGenerators> size{};
  std::array<Eigen::Index, kMostGenerators> order{};
  for (Eigen::Index j = 0; j < count; ++j) {
    const double sum = generators_.col(j).cwiseAbs().dot(scale);
    size[static_cast<std::size_t>(j)] = std::isfinite(sum) ? sum : 0.0;
  }
  std::iota(order.begin(), order.begin() + count, Eigen::Index{0});
  std::sort(order.begin(), order.begin() + count, [&](Eigen::Index a, Eigen::Index b) {
    const double size_a = size[static_cast<std::size_t>(a)];
    const double size_b = size[static_cast<std::size_t>(b)];
    return size_a > size_b || (size_a == size_b && a < b);
  });
  constexpr Eigen::Index kKept = kMostGenerators - Eigen::Index{3} * kStateSize;
  Generators kept(kStateSize, kKept + kStateSize);
  StateVector rest = StateVector::Zero();
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto generator = generators_.col(order[static_cast<std::size_t>(j)]);
    if (j < kKept) {
      kept.col(j) = generator;
    } else {
      rest += generator.cwiseAbs();
    }
  }
  const StateVector enlarged = (rest * kEnlargement).array() + kSmallest;
  kept.rightCols<kStateSize>() = enlarged.asDiagonal();
  generators_ = kept;
}

}  // namespace veritrack::quadrature
