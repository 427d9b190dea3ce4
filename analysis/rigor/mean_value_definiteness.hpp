// Is a matrix that depends on a few variables positive definite everywhere in a cell?
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::rigor {

/// L^-1 of a = L L', roughly; nothing when `a` is not definite.
template <std::size_t Size>
[[nodiscard]] std::optional<LowerTriangle<Size, double>> inverse_cholesky(
    const LowerTriangle<Size, double>& a) {
  LowerTriangle<Size, double> l{};
  LowerTriangle<Size, double> inverse{};
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= l[i][k] * l[j][k];
      }
      if (i == j && !(sum > 0.0)) {
        return std::nullopt;
      }
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
  }
  for (std::size_t j = 0; j < Size; ++j) {
    for (std::size_t i = j; i < Size; ++i) {
      double sum = i == j ? 1.0 : 0.0;
      for (std::size_t k = j; k < i; ++k) {
        sum -= l[i][k] * inverse[k][j];
      }
      inverse[i][j] = sum / l[i][i];
    }
  }
  return inverse;
}

/// C A C' of a lower triangular C and a symmetric A(i, j), j <= i.
template <std::size_t Size, typename Entry>
[[nodiscard]] LowerTriangle<Size> congruent(const LowerTriangle<Size>& c, const Entry& a) {
  LowerTriangle<Size> half;
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {  // no more of it is needed
      Interval sum = c[i][0] * a(j, 0);
      for (std::size_t k = 1; k <= i; ++k) {
        sum += c[i][k] * (k < j ? a(j, k) : a(k, j));
      }
      half[i][j] = sum;
    }
  }
  LowerTriangle<Size> result;
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      Interval sum = half[i][0] * c[j][0];
      for (std::size_t k = 1; k <= j; ++k) {
        sum += half[i][k] * c[j][k];
      }
      result[i][j] = sum;
    }
  }
  return result;
}

namespace detail {

/// True only when every symmetric matrix with entries in sum + t way, |t| <= 1, for each of the ways, has
/// positive diagonal entries that exceed the rest of their rows: it is positive definite then.
template <std::size_t Size, std::size_t N>
[[nodiscard]] bool certainly_dominant(const LowerTriangle<Size>& sum,
                                      const std::array<LowerTriangle<Size>, N>& ways VERITRACK_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  std::array<double, Size> rest{};
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double most = magnitude(sum[i][j]);
      for (const LowerTriangle<Size>& way : ways) {
        most = add_up(most, magnitude(way[i][j]));
      }
      rest[i] = add_up(rest[i], most);
      rest[j] = add_up(rest[j], most);
    }
  }
  for (std::size_t i = 0; i < Size; ++i) {
    for (const LowerTriangle<Size>& way : ways) {
      rest[i] = add_up(rest[i], magnitude(way[i][i]));
    }
    if (!certainly_less(Interval(rest[i]), sum[i][i])) {
      return false;
    }
  }
  return true;
}

/// True when settled(sum, ways) is, which decides all corners at once; otherwise calls visit(matrix,
/// determinant) with enclosures C A C' at each corner of a cell and of det C^2, until it returns false; false
/// when it does, or without a C. Every A in the cell is a convex combination of matrices out of these
/// enclosures.
template <std::size_t Size, int N, typename Settled, typename Visit>
[[nodiscard]] bool visit_corners(const LowerTriangle<Size>& middle,
                                 const LowerTriangle<Size, Dual<Interval, N>>& over,
                                 const std::array<double, static_cast<std::size_t>(N)>& half_widths,
                                 std::array<double, static_cast<std::size_t>(N)>& influence,
                                 const Settled& settled, const Visit& visit) {
  LowerTriangle<Size, double> rough{};
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      rough[i][j] = midpoint(middle[i][j]);
    }
  }
  const auto proposed = inverse_cholesky<Size>(rough);
  if (!proposed) {
    return false;
  }
  LowerTriangle<Size> c;
  Interval determinant(1.0);
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      c[i][j] = Interval((*proposed)[i][j]);
    }
    determinant *= square(c[i][i]);
  }
  LowerTriangle<Size> sum = congruent<Size>(c, [&](std::size_t i, std::size_t j) { return middle[i][j]; });
  std::array<LowerTriangle<Size>, static_cast<std::size_t>(N)> ways;
  for (int variable = 0; variable < N; ++variable) {
    const auto index = static_cast<std::size_t>(variable);
    const Interval half_width(half_widths[index]);
    const auto slope =
        congruent<Size>(c, [&](std::size_t i, std::size_t j) { return over[i][j].derivative(variable); });
    for (std::size_t i = 0; i < Size; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const Interval straight(midpoint(slope[i][j]));
        const double rest = (abs(slope[i][j] - straight) * half_width).upper();
        influence[index] += (abs(slope[i][j]) * half_width).upper();
        sum[i][j] += symmetric(rest);
        ways[index][i][j] = straight * half_width;
      }
    }
  }
  if (settled(sum, ways)) {
    return true;
  }
  // C A C' is definite with A, as C is triangular; a singular C would leave C A C' singular.
  for (unsigned corner = 0; corner < (1U << static_cast<unsigned>(N)); ++corner) {
    LowerTriangle<Size> there = sum;
    for (std::size_t index = 0; index < ways.size(); ++index) {
      const bool forward = ((corner >> index) & 1U) != 0U;
      for (std::size_t i = 0; i < Size; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          there[i][j] += forward ? ways[index][i][j] : -ways[index][i][j];
        }
      }
    }
    if (!visit(there, determinant)) {
      return false;
    }
  }
  return true;
}

}  // namespace detail

/// True only when the matrix is positive definite everywhere in the cell. By the mean value theorem it is its
/// value in the middle, plus derivatives out of those of `over` times the way, at most `half_widths`. With
/// the middles of these derivatives that is affine, so that the corners decide; the rest of them is added at
/// each. How far each variable moves the matrix is added to `influence`. Needs the upward mode.
template <std::size_t Size, int N>
[[nodiscard]] bool certainly_definite_over(const LowerTriangle<Size>& middle,
                                           const LowerTriangle<Size, Dual<Interval, N>>& over,
                                           const std::array<double, static_cast<std::size_t>(N)>& half_widths,
                                           std::array<double, static_cast<std::size_t>(N)>& influence) {
  return detail::visit_corners<Size, N>(
      middle, over, half_widths, influence,
      [](const auto& sum, const auto& ways) { return detail::certainly_dominant<Size>(sum, ways); },
      [](const LowerTriangle<Size>& there, const Interval&) {
        return certainly_positive_definite<Size>(there);
      });
}

/// A lower bound on the determinant everywhere in the cell; empty when the matrix is not proved positive
/// definite there. At the corners, because the logarithm of the determinant is concave. Needs the upward
/// mode.
template <std::size_t Size, int N>
[[nodiscard]] Interval least_determinant_over(
    const LowerTriangle<Size>& middle, const LowerTriangle<Size, Dual<Interval, N>>& over,
    const std::array<double, static_cast<std::size_t>(N)>& half_widths) {
  Interval least = Interval::empty();
  std::array<double, static_cast<std::size_t>(N)> influence{};
  const bool definite = detail::visit_corners<Size, N>(
      middle, over, half_widths, influence, [](const auto&, const auto&) { return false; },
      [&](LowerTriangle<Size> there, const Interval& determinant) {
        if (!eliminate(there, Size)) {
          return false;
        }
        Interval product(1.0);
        for (std::size_t k = 0; k < Size; ++k) {
          product *= there[k][k];
        }
        const Interval found = product / determinant;
        least = is_empty(least) ? found : min(least, found);
        return is_finite(least);
      });
  return definite ? Interval(least.lower()) : Interval::empty();
}

}  // namespace veritrack::rigor
