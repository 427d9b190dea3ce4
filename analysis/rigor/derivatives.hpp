// Derivatives of functions of vectors, by dual numbers: exact up to rounding over double, enclosed over
// intervals.
//
// A function here is anything that can be called with an Eigen column vector of fixed size over any scalar,
// such as
//     [](const auto& x) { using std::sin; return sin(x[0]) * x[1]; }
// Over intervals the enclosures are valid at every point of the box x, and the promise of dual.hpp applies;
// the caller sets the rounding mode.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "analysis/rigor/dual.hpp"

namespace veritrack::rigor {

/// The independent variable number `index` of N, at `value`: its derivative is one in its own direction, zero
/// in others.
template <int N, typename Scalar>
[[nodiscard]] Dual<Scalar, N> variable(const Scalar& value, int index) {
  std::array<Scalar, static_cast<std::size_t>(N)> derivatives;
  for (int i = 0; i < N; ++i) {
    derivatives[static_cast<std::size_t>(i)] = detail::known_with(Scalar(i == index ? 1.0 : 0.0), value);
  }
  return Dual<Scalar, N>(value, derivatives);
}

/// The independent variables at x, each differentiated once in all N directions. Apply it twice for second
/// derivatives, d2f/dx_i dx_j = f.derivative(i).derivative(j), and so on.
template <typename Derived>
[[nodiscard]] auto variables(const Eigen::MatrixBase<Derived>& x) {
  constexpr int kSize = Derived::RowsAtCompileTime;
  static_assert(kSize > 0 && Derived::ColsAtCompileTime == 1, "a column vector of fixed size");
  Eigen::Matrix<Dual<typename Derived::Scalar, kSize>, kSize, 1> result;
  for (int i = 0; i < kSize; ++i) {
    result[i] = variable<kSize>(x[i], i);
  }
  return result;
}

/// f(x) and the matrix of first derivatives, rows x columns = outputs x inputs.
template <typename Scalar, int Outputs, int Inputs>
struct Linearization {
  Eigen::Matrix<Scalar, Outputs, 1> value;
  Eigen::Matrix<Scalar, Outputs, Inputs> jacobian;
};

/// The linearization of a vector-valued function at x (a fixed-size vector, so is its result).
template <typename Function, typename Derived>
[[nodiscard]] auto linearize(const Function& function, const Eigen::MatrixBase<Derived>& x) {
  const auto result = function(variables(x)).eval();
  constexpr int kOutputs = decltype(result)::RowsAtCompileTime;
  constexpr int kInputs = Derived::RowsAtCompileTime;
  static_assert(kOutputs > 0 && decltype(result)::ColsAtCompileTime == 1, "a column vector of fixed size");
  Linearization<typename Derived::Scalar, kOutputs, kInputs> linearization;
  for (int row = 0; row < kOutputs; ++row) {
    linearization.value[row] = result[row].value();
    for (int column = 0; column < kInputs; ++column) {
      linearization.jacobian(row, column) = result[row].derivative(column);
    }
  }
  return linearization;
}

/// The matrix of first derivatives of a vector-valued function at x, outputs x inputs.
template <typename Function, typename Derived>
[[nodiscard]] auto jacobian(const Function& function, const Eigen::MatrixBase<Derived>& x) {
  return linearize(function, x).jacobian;
}

/// The gradient, a column, of a scalar-valued function at x.
template <typename Function, typename Derived>
[[nodiscard]] auto gradient(const Function& function, const Eigen::MatrixBase<Derived>& x) {
  constexpr int kInputs = Derived::RowsAtCompileTime;
  const auto result = function(variables(x));
  Eigen::Matrix<typename Derived::Scalar, kInputs, 1> slopes;
  for (int i = 0; i < kInputs; ++i) {
    slopes[i] = result.derivative(i);
  }
  return slopes;
}

/// The symmetric matrix of second derivatives of a scalar-valued function at x, inputs x inputs. (Over
/// intervals the two orders of differentiation may give different enclosures; the entries here are d/dx_j
/// (df/dx_i).)
template <typename Function, typename Derived>
[[nodiscard]] auto hessian(const Function& function, const Eigen::MatrixBase<Derived>& x) {
  constexpr int kInputs = Derived::RowsAtCompileTime;
  const auto result = function(variables(variables(x)));
  Eigen::Matrix<typename Derived::Scalar, kInputs, kInputs> second;
  for (int i = 0; i < kInputs; ++i) {
    for (int j = 0; j < kInputs; ++j) {
      second(i, j) = result.derivative(i).derivative(j);
    }
  }
  return second;
}

/// The Hessian of each output of a vector-valued function at x.
template <typename Function, typename Derived>
[[nodiscard]] auto hessians(const Function& function, const Eigen::MatrixBase<Derived>& x) {
  constexpr int kInputs = Derived::RowsAtCompileTime;
  const auto result = function(variables(variables(x))).eval();
  constexpr int kOutputs = decltype(result)::RowsAtCompileTime;
  static_assert(kOutputs > 0 && decltype(result)::ColsAtCompileTime == 1, "a column vector of fixed size");
  std::array<Eigen::Matrix<typename Derived::Scalar, kInputs, kInputs>, static_cast<std::size_t>(kOutputs)>
      second;
  for (int output = 0; output < kOutputs; ++output) {
    for (int i = 0; i < kInputs; ++i) {
      for (int j = 0; j < kInputs; ++j) {
        second[static_cast<std::size_t>(output)](i, j) = result[output].derivative(i).derivative(j);
      }
    }
  }
  return second;
}

}  // namespace veritrack::rigor
