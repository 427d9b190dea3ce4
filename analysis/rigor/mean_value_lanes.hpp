// mean_value_definiteness.hpp for several cells side by side: lane by lane the same answers, to the bit.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/rigor/interval_lanes.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::rigor {

/// Symmetric matrices, one a lane.
template <std::size_t Size, int Lanes>
using LaneTriangle = LowerTriangle<Size, IntervalLanes<Lanes>>;

namespace detail {

/// As inverse_cholesky; `definite` loses the lanes that have none.
template <std::size_t Size, int Lanes>
[[nodiscard]] LowerTriangle<Size, LaneNumbers<Lanes>> inverse_cholesky_lanes(
    const LowerTriangle<Size, LaneNumbers<Lanes>>& a, typename Registers<Lanes>::Mask& definite) {
  using R = Registers<Lanes>;
  using Numbers = typename R::Numbers;
  LowerTriangle<Size, LaneNumbers<Lanes>> l;
  LowerTriangle<Size, LaneNumbers<Lanes>> inverse;
  const Numbers zero = R::all(0.0);
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      Numbers sum = a[i][j].at;
      for (std::size_t k = 0; k < j; ++k) {
        sum = sum - l[i][k].at * l[j][k].at;
      }
      if (i == j) {
        definite = R::both(definite, R::less(zero, sum));
        l[i][j].at = R::sqrt(sum);
      } else {
        l[i][j].at = sum / l[j][j].at;
      }
    }
  }
  for (std::size_t j = 0; j < Size; ++j) {
    for (std::size_t i = j; i < Size; ++i) {
      Numbers sum = i == j ? R::all(1.0) : zero;
      for (std::size_t k = j; k < i; ++k) {
        sum = sum - l[i][k].at * inverse[k][j].at;
      }
      inverse[i][j].at = sum / l[i][i].at;
    }
  }
  return inverse;
}

/// As congruent, C being of real numbers.
template <std::size_t Size, int Lanes, typename Entry>
[[nodiscard]] LaneTriangle<Size, Lanes> congruent_lanes(const LowerTriangle<Size, LaneNumbers<Lanes>>& c,
                                                        const Entry& a) {
  using Set = IntervalLanes<Lanes>;
  LaneTriangle<Size, Lanes> half;
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      Set sum = scaled(a(j, 0), c[i][0].at);
      for (std::size_t k = 1; k <= i; ++k) {
        sum += scaled(k < j ? a(j, k) : a(k, j), c[i][k].at);
      }
      half[i][j] = sum;
    }
  }
  LaneTriangle<Size, Lanes> result;
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      Set sum = scaled(half[i][0], c[j][0].at);
      for (std::size_t k = 1; k <= j; ++k) {
        sum += scaled(half[i][k], c[j][k].at);
      }
      result[i][j] = sum;
    }
  }
  return result;
}

/// As certainly_dominant.
template <std::size_t Size, int Lanes, std::size_t N>
[[nodiscard]] typename Registers<Lanes>::Mask certainly_dominant_lanes(
    const LaneTriangle<Size, Lanes>& sum, const std::array<LaneTriangle<Size, Lanes>, N>& ways) {
  using R = Registers<Lanes>;
  using Numbers = typename R::Numbers;
  const auto add_up = [](const Numbers& a, const Numbers& b) { return R::opaque(R::opaque(a) + b); };
  std::array<LaneNumbers<Lanes>, Size> rest;
  rest.fill({R::all(0.0)});
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Numbers most = magnitude(sum[i][j]);
      for (const LaneTriangle<Size, Lanes>& way : ways) {
        most = add_up(most, magnitude(way[i][j]));
      }
      rest[i].at = add_up(rest[i].at, most);
      rest[j].at = add_up(rest[j].at, most);
    }
  }
  typename R::Mask holds = R::less(R::all(0.0), R::all(1.0));
  for (std::size_t i = 0; i < Size; ++i) {
    for (const LaneTriangle<Size, Lanes>& way : ways) {
      rest[i].at = add_up(rest[i].at, magnitude(way[i][i]));
    }
    holds = R::both(holds, certainly_less(IntervalLanes<Lanes>::at(rest[i].at), sum[i][i]));
  }
  return holds;
}

/// As eliminate, of all rows: the lanes whose pivots are all certainly positive.
template <std::size_t Size, int Lanes>
[[nodiscard]] typename Registers<Lanes>::Mask certainly_definite_lanes(LaneTriangle<Size, Lanes> a) {
  using R = Registers<Lanes>;
  using Set = IntervalLanes<Lanes>;
  typename R::Mask holds = R::less(R::all(0.0), R::all(1.0));
  for (std::size_t k = 0; k < Size; ++k) {
    holds = R::both(holds, certainly_positive(a[k][k]));
    if (!R::any(holds)) {
      return holds;
    }
    const Set reciprocal = Set(1.0) / a[k][k];
    for (std::size_t i = k + 1; i < Size; ++i) {
      const Set factor = a[i][k] * reciprocal;
      for (std::size_t j = k + 1; j < i; ++j) {
        a[i][j] -= factor * a[j][k];
      }
      a[i][i] -= a[i][k] * a[i][k] * reciprocal;
    }
  }
  return holds;
}

}  // namespace detail

/// As certainly_definite_over: the lanes of `asked` in which the matrix is positive definite everywhere in
/// the cell. Lanes that are not asked for, or have no C, move nothing in `influence`.
template <std::size_t Size, int Lanes, int N>
[[nodiscard]] typename Registers<Lanes>::Mask certainly_definite_over_lanes(
    const typename Registers<Lanes>::Mask& asked, const LaneTriangle<Size, Lanes>& middle,
    const LowerTriangle<Size, Dual<IntervalLanes<Lanes>, N>>& over,
    const std::array<LaneNumbers<Lanes>, static_cast<std::size_t>(N)>& half_widths,
    std::array<LaneNumbers<Lanes>, static_cast<std::size_t>(N)>& influence) {
  using R = Registers<Lanes>;
  using Set = IntervalLanes<Lanes>;
  using Numbers = typename R::Numbers;
  LowerTriangle<Size, LaneNumbers<Lanes>> rough;
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      rough[i][j].at = midpoint(middle[i][j]);
    }
  }
  typename R::Mask open = asked;
  const LowerTriangle<Size, LaneNumbers<Lanes>> c = detail::inverse_cholesky_lanes<Size, Lanes>(rough, open);
  LaneTriangle<Size, Lanes> sum = detail::congruent_lanes<Size, Lanes>(
      c, [&](std::size_t i, std::size_t j) -> const Set& { return middle[i][j]; });
  std::array<LaneTriangle<Size, Lanes>, static_cast<std::size_t>(N)> ways;
  const Numbers zero = R::all(0.0);
  for (int variable = 0; variable < N; ++variable) {
    const auto index = static_cast<std::size_t>(variable);
    const LaneTriangle<Size, Lanes> slope = detail::congruent_lanes<Size, Lanes>(
        c, [&](std::size_t i, std::size_t j) -> const Set& { return over[i][j].derivative(variable); });
    Numbers moved = zero;
    for (std::size_t i = 0; i < Size; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const Set straight = Set::at(midpoint(slope[i][j]));
        const Numbers rest = scaled(abs(slope[i][j] - straight), half_widths[index].at).upper();
        moved = R::opaque(moved + scaled(abs(slope[i][j]), half_widths[index].at).upper());
        sum[i][j] += Set::symmetric(rest);
        ways[index][i][j] = scaled(straight, half_widths[index].at);
      }
    }
    influence[index].at = R::select(open, moved, zero);
  }
  const typename R::Mask settled = R::both(open, detail::certainly_dominant_lanes<Size, Lanes>(sum, ways));
  // Those left over, corner by corner.
  open = R::without(open, settled);
  for (unsigned corner = 0; R::any(open) && corner < (1U << static_cast<unsigned>(N)); ++corner) {
    LaneTriangle<Size, Lanes> there = sum;
    for (std::size_t index = 0; index < ways.size(); ++index) {
      const bool forward = ((corner >> index) & 1U) != 0U;
      for (std::size_t i = 0; i < Size; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          there[i][j] += forward ? ways[index][i][j] : -ways[index][i][j];
        }
      }
    }
    open = R::both(open, detail::certainly_definite_lanes<Size, Lanes>(there));
  }
  return R::either(settled, open);
}

}  // namespace veritrack::rigor
