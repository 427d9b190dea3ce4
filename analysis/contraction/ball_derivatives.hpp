// Second and third derivatives of a closed loop (fixed_point.hpp) over a box of states, and their spectral
// norms in a metric.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "analysis/contraction/fixed_point.hpp"
#include "analysis/rigor/norms.hpp"

namespace veritrack::contraction {

/// d2 G_output / dx_i dx_j in [output](i, j).
template <int N>
using SecondDerivatives = std::array<rigor::IntervalMatrix<N>, static_cast<std::size_t>(N)>;

/// d3 G_output / dx_i dx_j dx_k in [output][k](i, j).
template <int N>
using ThirdDerivatives = std::array<SecondDerivatives<N>, static_cast<std::size_t>(N)>;

namespace detail {

template <typename Variable, int Size>
[[nodiscard]] Column<Variable, Size> quiet_disturbance() {
  return Column<Variable, Size>::Constant(Variable(0.0));
}

}  // namespace detail

/// d2G/dX2 of the undisturbed loop over a box of states and of parameters; symmetric. Upward mode held by the
/// caller.
template <typename Loop>
[[nodiscard]] SecondDerivatives<Loop::kStates> second_derivatives(
    const Loop& loop, const rigor::IntervalVector<Loop::kStates>& box, const rigor::Interval& parameter) {
  constexpr int kSize = Loop::kStates;
  using Once = rigor::Dual<rigor::Interval, kSize>;
  using Twice = rigor::Dual<Once, kSize>;
  const Column<Twice, kSize> x = rigor::variables(rigor::variables(box));
  const Column<Twice, kSize> image =
      loop(x, Twice(Once(parameter)), detail::quiet_disturbance<Twice, Loop::kNoises + 1>());
  SecondDerivatives<kSize> result;
  for (int output = 0; output < kSize; ++output) {
    rigor::IntervalMatrix<kSize>& slice = result[static_cast<std::size_t>(output)];
    for (int i = 0; i < kSize; ++i) {
      for (int j = 0; j <= i; ++j) {
        // Both orders enclose the same number.
        slice(i, j) = intersection(image[output].derivative(i).derivative(j),
                                   image[output].derivative(j).derivative(i));
        slice(j, i) = slice(i, j);
      }
    }
  }
  return result;
}

/// d3G/dX3 over a box, symmetric in the inputs; direction by direction, to keep the numbers small. Upward
/// mode held by the caller.
template <typename Loop>
[[nodiscard]] ThirdDerivatives<Loop::kStates> third_derivatives(
    const Loop& loop, const rigor::IntervalVector<Loop::kStates>& box, const rigor::Interval& parameter) {
  constexpr int kSize = Loop::kStates;
  using Once = rigor::Dual<rigor::Interval, kSize>;
  using Twice = rigor::Dual<Once, kSize>;
  using Thrice = rigor::Dual<Twice, 1>;
  ThirdDerivatives<kSize> result;
  const Column<Twice, kSize> x = rigor::variables(rigor::variables(box));
  for (int k = 0; k < kSize; ++k) {
    Column<Thrice, kSize> moving;
    for (int i = 0; i < kSize; ++i) {
      moving[i] = Thrice(x[i], {Twice(i == k ? 1.0 : 0.0)});
    }
    const Column<Thrice, kSize> image =
        loop(moving, Thrice(Twice(Once(parameter))), detail::quiet_disturbance<Thrice, Loop::kNoises + 1>());
    for (int output = 0; output < kSize; ++output) {
      rigor::IntervalMatrix<kSize>& slice =
          result[static_cast<std::size_t>(output)][static_cast<std::size_t>(k)];
      for (int i = 0; i < kSize; ++i) {
        for (int j = 0; j < kSize; ++j) {
          slice(i, j) = image[output].derivative(0).derivative(i).derivative(j);
        }
      }
    }
  }
  // All six orders enclose the same number.
  for (SecondDerivatives<kSize>& output : result) {
    for (int i = 0; i < kSize; ++i) {
      for (int j = 0; j <= i; ++j) {
        for (int k = 0; k <= j; ++k) {
          const auto entry = [&output](int a, int b, int c) -> rigor::Interval& {
            return output[static_cast<std::size_t>(c)](a, b);
          };
          const rigor::Interval common =
              intersection(intersection(intersection(entry(i, j, k), entry(j, i, k)),
                                        intersection(entry(i, k, j), entry(k, i, j))),
                           intersection(entry(j, k, i), entry(k, j, i)));
          entry(i, j, k) = entry(j, i, k) = entry(i, k, j) = entry(k, i, j) = entry(j, k, i) =
              entry(k, j, i) = common;
        }
      }
    }
  }
  return result;
}

/// How DG and D2G change along a curve X(p): d/dp DG(X(p), p) and d/dp D2G(X(p), p).
template <int N>
struct DerivativeDrift {
  rigor::IntervalMatrix<N> first;
  SecondDerivatives<N> second;
};

/// Over a box of states, of parameters and of directions dX/dp. Upward mode held by the caller.
template <typename Loop>
[[nodiscard]] DerivativeDrift<Loop::kStates> derivative_drift(
    const Loop& loop, const rigor::IntervalVector<Loop::kStates>& box, const rigor::Interval& parameter,
    const rigor::IntervalVector<Loop::kStates>& direction) {
  constexpr int kSize = Loop::kStates;
  using Once = rigor::Dual<rigor::Interval, kSize>;
  using Twice = rigor::Dual<Once, kSize>;
  using Thrice = rigor::Dual<Twice, 1>;
  const Column<Twice, kSize> x = rigor::variables(rigor::variables(box));
  Column<Thrice, kSize> moving;
  for (int i = 0; i < kSize; ++i) {
    moving[i] = Thrice(x[i], {Twice(Once(direction[i]))});
  }
  const Thrice p(Twice(Once(parameter)), {Twice(1.0)});
  const Column<Thrice, kSize> image = loop(moving, p, detail::quiet_disturbance<Thrice, Loop::kNoises + 1>());
  DerivativeDrift<kSize> drift;
  for (int output = 0; output < kSize; ++output) {
    const Twice& slope = image[output].derivative(0);
    rigor::IntervalMatrix<kSize>& slice = drift.second[static_cast<std::size_t>(output)];
    for (int i = 0; i < kSize; ++i) {
      drift.first(output, i) = slope.derivative(i).value();
      for (int j = 0; j < kSize; ++j) {
        slice(i, j) = intersection(slope.derivative(i).derivative(j), slope.derivative(j).derivative(i));
      }
    }
  }
  return drift;
}

/// The linear map u (x) w -> D(S u, S w), S = `inverse`, seen in the metric: the N x N^2 matrix T D (S (x)
/// S).
template <int N>
[[nodiscard]] rigor::IntervalMatrix<N, N * N> unfolded(const SecondDerivatives<N>& second,
                                                       const rigor::IntervalMatrix<N>& metric,
                                                       const rigor::IntervalMatrix<N>& inverse) {
  rigor::IntervalMatrix<N, N * N> list;
  for (int output = 0; output < N; ++output) {
    const rigor::IntervalMatrix<N> slice =
        (inverse.transpose() * second[static_cast<std::size_t>(output)]).eval() * inverse;
    for (int j = 0; j < N; ++j) {
      for (int i = 0; i < N; ++i) {
        list(output, N * j + i) = slice(i, j);
      }
    }
  }
  return metric * list;
}

/// The same for third derivatives: N x N^3.
template <int N>
[[nodiscard]] rigor::DynamicIntervalMatrix unfolded(const ThirdDerivatives<N>& third,
                                                    const rigor::IntervalMatrix<N>& metric,
                                                    const rigor::IntervalMatrix<N>& inverse) {
  rigor::DynamicIntervalMatrix result(N, N * N * N);
  // First the two inputs within each slice and the output, then the third input.
  std::array<rigor::IntervalMatrix<N, N * N>, static_cast<std::size_t>(N)> slices;
  for (std::size_t k = 0; k < static_cast<std::size_t>(N); ++k) {
    SecondDerivatives<N> slice;
    for (std::size_t output = 0; output < static_cast<std::size_t>(N); ++output) {
      slice[output] = third[output][k];
    }
    slices[k] = unfolded<N>(slice, metric, inverse);
  }
  constexpr Eigen::Index kPairs = Eigen::Index{N} * N;
  for (Eigen::Index k = 0; k < N; ++k) {
    rigor::IntervalMatrix<N, N* N> sum = slices[0] * inverse(0, k);
    for (int l = 1; l < N; ++l) {
      sum += slices[static_cast<std::size_t>(l)] * inverse(l, k);
    }
    result.middleCols(k * kPairs, kPairs) = sum;
  }
  return result;
}

}  // namespace veritrack::contraction
