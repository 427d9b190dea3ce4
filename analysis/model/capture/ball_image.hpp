// The reach of a ball of deviations, and of noise, after a linear step, over a cell of starts and phases.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/taylor_model.hpp"

namespace veritrack::model {

/// The effect of a step on small deviations, as a polynomial in the place in a cell of phases and starts.
using SlopeModel = rigor::TaylorModel<3, 2>;

/// A matrix of at most four rows and columns; entries beyond them are 0.
struct SlopeMatrix {
  static constexpr std::size_t kMost = 4;

  std::size_t rows = 0;
  std::size_t columns = 0;
  std::array<std::array<SlopeModel, kMost>, kMost> entries{};

  SlopeMatrix() = default;
  /// A matrix of zeros. Throws std::invalid_argument when it is not small.
  SlopeMatrix(std::size_t row_count, std::size_t column_count);

  [[nodiscard]] SlopeModel& operator()(std::size_t i, std::size_t j) { return entries[i][j]; }
  [[nodiscard]] const SlopeModel& operator()(std::size_t i, std::size_t j) const { return entries[i][j]; }
};

/// Throws std::invalid_argument unless the sizes fit.
[[nodiscard]] SlopeMatrix operator*(const SlopeMatrix& a, const SlopeMatrix& b);

/// An upper bound of |A x + B v| for all A in `a`, B in `b`, |x| <= radius and |v| <= noise, anywhere in the
/// cell; NaN when nothing is known. Needs the upward rounding mode. For every t in (0, 1) it is at most the
/// root of the largest eigenvalue of radius^2 A A'/t + noise^2 B B'/(1 - t) (S-procedure), which is expanded
/// as a polynomial: a verified bound for its constant part, and the norms of the others.
[[nodiscard]] double ball_image(const SlopeMatrix& a, double radius, const SlopeMatrix& b, double noise);

}  // namespace veritrack::model
