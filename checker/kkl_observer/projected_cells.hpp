// Signals in five to eight filters of a KKL observer (any number from four on), cut into cells of frequency
// and phase alone, on which the errors of the estimates are bounded.
//
// The filters are at xi = A (T + u), T at amplitude 1, and N is an orthonormal basis of what is orthogonal to
// lambda and 1. With e = x3_hat - w^2, v = NN'T, q = v / |v|^2 and Q = NN' - v q' (docs/kkl-observer.md,
// Robustness of more than four filters),
//     e = -q'(F^2 + w^2 + e) u - (Q u)'Q (F^2 + w^2 + e) u / ((1 + q'u) |v|^2)
// as long as mu of (9) vanishes. No N is needed: NN' is what [lambda 1]^+ leaves. With w_i and p_i the length
// and the angle of lambda_i + jw, T_i = sin(p - p_i) / w_i, and the determinant of T, lambda and 1 for three
// filters is their Vandermonde determinant times sin(p - p_i - p_j - p_k) / (w_i w_j w_k). Signals and moves
// may change sign together, so that half a turn of p is enough.
#pragma once

#include <functional>

#include "checker/kkl_observer/moves.hpp"
#include "checker/numbers/gradient.hpp"

namespace veritrack::checker {

/// A signal of amplitude 1 in the filters.
template <typename S>
struct ProjectedSignal {
  S frequency, sine, cosine;
  std::vector<S> transformed;  ///< T
  std::vector<S> across;       ///< v
  std::vector<S> direction;    ///< q
  S squared_norm;              ///< |v|^2
};

/// A cell of frequency and phase: at its middle, with the derivatives over it, and half its widths.
struct ProjectedCell {
  using Slope = Gradient<Ball, 2>;
  ProjectedSignal<Ball> middle;
  ProjectedSignal<Slope> over;
  std::array<Ball, 2> radius;
};

class ProjectedCells {
 public:
  ProjectedCells(const KklDesign& design, const Ball& settling_time);

  using Statement = std::function<bool(const ProjectedCell& cell)>;
  /// True only when the statement is true of each of some cells that cover all signals.
  [[nodiscard]] bool always(const Statement& statement) const;

  // Statements about all points of a cell.
  /// 2 |M xi|^2 / |xi|^2 >= bound.
  [[nodiscard]] bool ratio_at_least(const ProjectedCell& cell, const Ball& bound) const;
  /// x3_hat / w^2 >= bound.
  [[nodiscard]] bool relative_square_at_least(const ProjectedCell& cell, const Ball& bound) const;
  /// |w_hat - w| <= bound, rad/s.
  [[nodiscard]] bool frequency_error_at_most(const ProjectedCell& cell, const Ball& bound) const;
  /// |A_hat - A| <= bound, signal units, where |w_hat - w| <= frequency_error, rad/s, is known.
  [[nodiscard]] bool amplitude_error_at_most(const ProjectedCell& cell, const Ball& bound,
                                             const Ball& frequency_error) const;

 private:
  using Slope = ProjectedCell::Slope;
  /// The rows of [lambda 1]^+, then those of NN'.
  enum Row : std::size_t { kFirst, kSecond, kAcross };
  template <typename S>
  using Weights = std::vector<S>;
  struct Triple {
    std::array<std::size_t, 3> at;
    Ball vandermonde;
  };
  using Box = std::array<Range, 2>;

  template <typename S>
  [[nodiscard]] ProjectedSignal<S> signal(const S& frequency, const S& phase) const;
  [[nodiscard]] bool is_true(const Statement& statement, const Box& box, int depth, int& cells) const;
  /// The largest size of the sum of weights_j row_j'(F^2 + w^2 + shift) u over a cell; without F^2 + w^2 +
  /// shift for `of_moves`.
  template <typename Function>
  [[nodiscard]] Size largest(const ProjectedCell& cell, const Function& weights, const Ball& shift) const;
  template <typename Function>
  [[nodiscard]] Size of_moves(const ProjectedCell& cell, const Function& weights) const;
  [[nodiscard]] Size sum_of(const std::vector<std::array<Ball, 2>>& coefficients) const;
  /// At least q'(F^2 + w^2 + e) u for all |e| <= error.
  [[nodiscard]] Size first_order(const ProjectedCell& cell, const Ball& error) const;
  /// The factors of the other term of e: the entries of Q u and of Q (F^2 + w^2) u, and 1 / ((1 + q'u)
  /// |v|^2).
  struct Across {
    std::vector<Size> move;
    std::vector<Ball> pull;
    Ball over, along;  ///< the latter 1 + q'u, at least
    /// At least that term, for all |e| <= error.
    [[nodiscard]] Size second_order(const Ball& error) const;
    /// At least |e| = |y'(F^2 + w^2) u| / |y|^2, y = (1 + q'u) v + Q u, from `first`, at least q'(F^2 + w^2)
    /// u.
    [[nodiscard]] Size outright(const Size& first) const;
  };
  [[nodiscard]] Across across(const ProjectedCell& cell) const;
  /// Is |e| <= error, for exactly this error, at all points? By continuity from u = 0 on.
  [[nodiscard]] bool error_at_most(const ProjectedCell& cell, const Ball& error) const;

  Filters lambda_;
  Moves moves_;
  Ball amplitude_low_, amplitude_high_;
  std::vector<Filters> rows_;
  std::vector<Triple> triples_;
  Ball gram_;                          ///< |lambda|^2 |1|^2 - (lambda'1)^2
  std::vector<Size> row_, row_of_f2_;  ///< of row'u and row'F^2 u
  Filters longest_;                    ///< at least |u_i|
  Box box_;
};

}  // namespace veritrack::checker
