// Signals in the four filters of a KKL observer, cut into cells on which the errors of the estimates are
// bounded.
//
// The filters are at xi = A (T + u), T at amplitude 1, and N is an orthonormal basis of what is orthogonal to
// lambda and 1. With y = N'(T + u), as long as mu of (9) vanishes (docs/kkl-observer.md, Robustness),
//     e = x3_hat - w^2 = -y'N'(F^2 + w^2) u / |y|^2,
//     (x1, x2)_hat / A - (x1, x2) = [lambda 1]^+ ((F^2 + w^2) u + e (T + u)).
// A cell is a box of (w, p, z1, z2): the signal sin p, with x2 = -w cos p, and N'u = z. On it both errors are
// linear functions of u, whose coefficients are enclosed with their derivatives; Moves bounds those
// functions. Signals and moves may change sign together, so that half a turn of p is enough.
#pragma once

#include <functional>

#include "checker/kkl_observer/moves.hpp"
#include "checker/numbers/slope.hpp"

namespace veritrack::checker {

constexpr std::size_t kFilters = 4;

/// A signal of amplitude 1 in the filters.
template <typename S>
struct KklSignal {
  S frequency, sine, cosine;
  std::array<S, kFilters> transformed;  ///< T
  std::array<S, 2> y;
  S squared_norm;  ///< |y|^2
};

/// A cell: at its middle, with the derivatives over it, and half its widths.
struct KklCell {
  KklSignal<Ball> middle;
  KklSignal<Slope> over;
  std::array<Ball, kVariables> radius;
};

class SignalCells {
 public:
  /// Needs four filters.
  SignalCells(const KklDesign& design, const Ball& settling_time);

  using Statement = std::function<bool(const KklCell& cell)>;
  /// True only when the statement is true of each of some cells that cover all signals.
  [[nodiscard]] bool always(const Statement& statement) const;

  // Statements about all points of a cell.
  /// 2 |M xi|^2 / |xi|^2 >= bound.
  [[nodiscard]] bool ratio_at_least(const KklCell& cell, const Ball& bound) const;
  /// x3_hat / w^2 >= bound.
  [[nodiscard]] bool relative_square_at_least(const KklCell& cell, const Ball& bound) const;
  /// |w_hat - w| <= bound, rad/s.
  [[nodiscard]] bool frequency_error_at_most(const KklCell& cell, const Ball& bound) const;
  /// |A_hat - A| <= bound, signal units.
  [[nodiscard]] bool amplitude_error_at_most(const KklCell& cell, const Ball& bound) const;

 private:
  /// The rows of [lambda 1]^+ and of N'.
  enum Row : std::size_t { kFirst, kSecond, kAcross };
  static constexpr std::size_t kRows = 4;
  template <typename S>
  using Weights = std::array<S, kRows>;
  /// Three filters and the constants of their second divided difference.
  struct Triple {
    std::array<std::size_t, 3> at;
    Ball e1, e2, e3, vandermonde;
  };
  using Box = std::array<Range, kVariables>;

  void find_rows();
  [[nodiscard]] Triple triple(std::size_t first) const;
  template <typename S>
  [[nodiscard]] KklSignal<S> signal(const std::array<S, kVariables>& x) const;
  [[nodiscard]] bool is_true(const Statement& statement, const Box& box, int depth, int& cells) const;
  /// The largest size of the sum of weights_j row_j'(F^2 + w^2) u over a cell.
  template <typename Function>
  [[nodiscard]] Size largest(const KklCell& cell, const Function& weights) const;
  /// At least |e| / w over the cell.
  [[nodiscard]] Ball squared_error(const KklCell& cell) const;

  using FourFilters = std::array<Ball, kFilters>;
  FourFilters lambda_;
  Moves moves_;
  Ball amplitude_low_, amplitude_high_;
  std::array<FourFilters, kRows> rows_;
  std::array<Triple, 2> triples_;
  std::array<Ball, 3> normal_;               ///< from the two determinants to the orthonormal basis
  Ball gram_;                                ///< |lambda|^2 |1|^2 - (lambda'1)^2
  std::array<Size, kRows> row_, row_of_f2_;  ///< of row'u and row'F^2 u
  Ball longest_move_;                        ///< at least |u|
  Box box_;
};

}  // namespace veritrack::checker
