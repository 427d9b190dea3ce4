// A symmetric matrix over a box: affine in the displacement from the middle, and a bound on the remainder.
#pragma once

#include <array>

#include "checker/numbers/chord.hpp"
#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

/// The lower triangles of symmetric matrices: anywhere in the box, at c + d, the matrix is
/// centre + sum (d_k/h_k) ways_k + E with |E_ij| <= rest_ij.
template <std::size_t Size>
struct OverBox {
  SquareMatrix<Size> centre;
  std::array<SquareMatrix<Size>, kSides> ways;
  SquareMatrix<Size> rest;
};

template <std::size_t Size>
using ChordMatrix = std::array<std::array<Chord, Size>, Size>;

/// The matrix value + away slope, over the box c +- half_widths.
template <std::size_t Size>
OverBox<Size> over_box(const ChordMatrix<Size>& value, const ChordMatrix<Size>& slope, const Ball& away,
                       const std::array<Ball, kSides>& half_widths) {
  OverBox<Size> m;
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      m.centre[i][j] = value[i][j].centre + away * slope[i][j].centre;
      for (std::size_t k = 0; k < kSides; ++k) {
        const Ball by = value[i][j].by[k] + away * slope[i][j].by[k];
        m.ways[k][i][j] = half_widths[k] * by.middle();
        m.rest[i][j] += half_widths[k] * by.radius();
      }
    }
  }
  return m;
}

/// The i-th entry of a diagonal D with D + E >= 0 and D - E >= 0 for all E with |E_ij| <= rest_ij, for any
/// weights w > 0: |2 v_i v_j| <= (w_j/w_i) v_i^2 + (w_i/w_j) v_j^2.
template <std::size_t Size>
Ball rest_on_diagonal(const OverBox<Size>& m, const std::array<double, Size>& weights, std::size_t i) {
  Ball sum;
  for (std::size_t j = 0; j < Size; ++j) {
    sum += Ball(weights[j]) * (j <= i ? m.rest[i][j] : m.rest[j][i]);
  }
  return sum / Ball(weights[i]);
}
/// The centre then represents a matrix that is not above the one over the box, or not below it.
template <std::size_t Size>
void take_rest(OverBox<Size>& m, const std::array<double, Size>& weights) {
  for (std::size_t i = 0; i < Size; ++i) {
    m.centre[i][i] -= rest_on_diagonal(m, weights, i);
  }
}
template <std::size_t Size>
void give_rest(OverBox<Size>& m, const std::array<double, Size>& weights) {
  for (std::size_t i = 0; i < Size; ++i) {
    m.centre[i][i] += rest_on_diagonal(m, weights, i);
  }
}

/// At the corner c +- h, + where the bit of the variable is set.
template <std::size_t Size>
SquareMatrix<Size> at_corner(const OverBox<Size>& m, std::size_t corner) {
  SquareMatrix<Size> x = m.centre;
  for (std::size_t k = 0; k < kSides; ++k) {
    const bool forward = ((corner >> k) & 1U) != 0U;
    for (std::size_t i = 0; i < Size; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        if (forward) {
          x[i][j] += m.ways[k][i][j];
        } else {
          x[i][j] -= m.ways[k][i][j];
        }
      }
    }
  }
  return x;
}

}  // namespace veritrack::checker
