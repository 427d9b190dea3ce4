// How the verified linear algebra takes and returns matrices: it works on dynamic sizes, compiled once,
// behind thin templates that keep the sizes known at compile time.
#pragma once

#include <optional>
#include <type_traits>

#include "analysis/rigor/matrix.hpp"

namespace veritrack::rigor::detail {

/// The argument, evaluated. A matrix of doubles is refused at compile time: to_interval says that its entries
/// are exact.
template <typename Derived>
[[nodiscard]] DynamicIntervalMatrix to_dynamic(const Eigen::MatrixBase<Derived>& matrix) {
  static_assert(std::is_same_v<typename Derived::Scalar, Interval>, "an interval matrix: see to_interval");
  return matrix;
}

/// The result with its sizes known again.
template <typename Fixed>
[[nodiscard]] std::optional<Fixed> to_fixed(const std::optional<DynamicIntervalMatrix>& matrix) {
  if (!matrix) {
    return std::nullopt;
  }
  return std::optional<Fixed>(std::in_place, *matrix);
}

}  // namespace veritrack::rigor::detail
