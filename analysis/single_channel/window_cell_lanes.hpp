// The conditions in a cell of phase and frequency, for one cell or for several in the lanes of registers:
// part of window_cells.hpp. Each unit that includes this one for more lanes than two is compiled for one set
// of instructions; all types that depend on the set have the number of lanes as a parameter, so that the
// linker cannot replace a function of one unit by that of another. One cell and several do the same
// operations, so they give the same bits.
#pragma once

#include <cmath>
#include <cstddef>

#include "analysis/rigor/call_site.hpp"
#include "analysis/rigor/small_definiteness.hpp"
#include "analysis/rigor/taylor_lanes.hpp"
#include "analysis/single_channel/window_cells.hpp"

namespace veritrack::single_channel::detail {

// ---- what follow_window needs of its scalar

template <int Lanes>
struct WindowScalar<rigor::TaylorLanes<2, 4, Lanes>> {
  using R = rigor::Registers<Lanes>;
  using Model = rigor::TaylorLanes<2, 4, Lanes>;
  using Range = rigor::IntervalLanes<Lanes>;
  static Range range(const Model& x) { return x.range(); }
  static Range kept_within(const Range& value, const Range& limit) {
    const Range within = -max(-max(value, Range(0.0)), -limit);
    const auto known = is_finite(value);
    return Range::from_bounds(R::select(known, within.lower(), limit.lower()),
                              R::select(known, within.upper(), limit.upper()));
  }
  static Model upper_end(const Range& range) { return Model::at(range.upper()); }
  static Range remainder(const Model& x) { return Range::at(x.remainder()); }
  static PhaseCovariance<Model> without_remainder(const PhaseCovariance<Model>& p, double sign,
                                                  double /*drift*/) {
    return remainder_on_diagonal(p, sign);
  }
};

// ---- one cell and several, under the same names

template <int Lanes>
struct WindowNumbers {
  using R = rigor::Registers<Lanes>;
  using Model = rigor::TaylorLanes<2, 4, Lanes>;
  using Set = rigor::IntervalLanes<Lanes>;
  using Numbers = typename R::Numbers;
  using Mask = typename R::Mask;

  static Numbers all(double x) { return R::all(x); }
  static Numbers sqrt(const Numbers& x) { return R::sqrt(x); }
  static Set point(const Numbers& x) { return Set::at(x); }
  static Set side(const double (&ends)[2][WindowCells::kMost], int first) {
    return Set::load(ends[0] + first, ends[1] + first);
  }
  static Mask both(const Mask& a, const Mask& b) { return R::both(a, b); }
  static bool any(const Mask& mask) { return R::any(mask); }
  static Mask none() { return R::less(R::all(1.0), R::all(0.0)); }
  static Mask every() { return R::less(R::all(0.0), R::all(1.0)); }
  static void store(bool* to, const Mask& mask) {
    const unsigned bits = R::bits(mask);
    for (int lane = 0; lane < Lanes; ++lane) {
      to[lane] = ((bits >> static_cast<unsigned>(lane)) & 1U) != 0U;
    }
  }
  static void store(double* to, const Numbers& x) { R::store(to, x); }

  /// As rigor::certainly_positive_definite.
  static Mask certainly_definite(rigor::LowerTriangle<3, Set> a) {
    Mask definite = certainly_positive(a[0][0]);
    for (std::size_t k = 0; k < 2; ++k) {
      const Set reciprocal = Set(1.0) / a[k][k];
      for (std::size_t i = k + 1; i < 3; ++i) {
        const Set factor = a[i][k] * reciprocal;
        for (std::size_t j = k + 1; j < i; ++j) {
          a[i][j] -= factor * a[j][k];
        }
        a[i][i] -= a[i][k] * a[i][k] * reciprocal;
      }
      definite = both(definite, certainly_positive(a[k + 1][k + 1]));
    }
    return definite;
  }
};

template <>
struct WindowNumbers<1> {
  using Model = OverPhaseAndFrequency;
  using Set = rigor::Interval;
  using Numbers = double;
  using Mask = bool;

  static double all(double x) { return x; }
  static double sqrt(double x) { return std::sqrt(x); }
  static Set point(double x) { return Set(x); }
  static Set side(const double (&ends)[2][WindowCells::kMost], int first) {
    return Set::from_bounds(ends[0][first], ends[1][first]);
  }
  static bool both(bool a, bool b) { return a && b; }
  static bool any(bool mask) { return mask; }
  static bool none() { return false; }
  static bool every() { return true; }
  template <typename T>
  static void store(T* to, const T& x) {
    *to = x;
  }
  static bool certainly_definite(const rigor::LowerTriangle<3>& a) {
    return rigor::certainly_positive_definite(a);
  }
};

/// `Lanes` columns of the cells, from `first` on.
template <int Lanes>
class WindowCheck {
 public:
  using N = WindowNumbers<Lanes>;
  using Model = typename N::Model;
  using Set = typename N::Set;
  using Numbers = typename N::Numbers;
  using Mask = typename N::Mask;
  using Bound = PhaseCovariance<Model>;

  WindowCheck(const WindowTask& task, const WindowCells& cells, int first)
      : task_(task),
        first_(first),
        phase_(Model::variable(N::side(cells.phase, first), 0)),
        frequency_(Model::variable(N::side(cells.frequency, first), 1)) {}

  void look(WindowAnswers& answers) const {
    const auto constant = [](const rigor::Interval& x) { return Model(Set(x)); };
    const trackers::ToneModel<Model> design{constant(task_.design.q1), constant(task_.design.q2),
                                            constant(task_.design.r), constant(task_.design.epsilon)};
    Mask holds = N::none();
    follow_window<Model>(design, task_.assumption, task_.length, phase_, frequency_,
                         [&](int m, const Bound& upper, const Bound& lower, const Bound& predicted_lower) {
                           const bool last = m == task_.length.window;
                           const Mask here = holds_here(m, upper, lower, predicted_lower);
                           holds = m == 1 ? here : N::both(holds, here);
                           if (last) {
                             report(lower, answers);
                           }
                           return N::any(holds);
                         });
    N::store(answers.holds + first_, holds);
  }

 private:
  Mask holds_here(int m, const Bound& upper, const Bound& lower, const Bound& predicted_lower) const {
    const bool last = m == task_.length.window;
    const Model share(task_.shares[m - 1]);
    const Model left(last ? task_.signal_uncertainty : 0.0);
    Mask holds = keeps_variances(upper);
    if (N::any(holds)) {
      holds = N::both(holds, certainly_positive_matrix(combined(lower, -share, upper)));
    }
    if (N::any(holds)) {
      holds = N::both(holds, certainly_positive_matrix(
                                 combined(predicted_lower, Model(-1.0), diagonal(left, Model(0.0)))));
    }
    if (last && N::any(holds)) {
      holds = N::both(holds, certainly_positive_matrix(curvature_room(upper)));
    }
    return holds;
  }

  void report(const Bound& lower, WindowAnswers& answers) const {
    N::store(answers.p11 + first_, lower.p11.range().lower());
    N::store(answers.p22 + first_, lower.p22.range().lower());
    N::store(answers.p33 + first_, lower.p33.range().lower());
    for (int i = 0; i < task_.starts; ++i) {
      const Bound start = diagonal(Model(Set(task_.start_signal[i])), Model(Set(task_.start_frequency[i])));
      N::store(answers.is_below[i] + first_, certainly_positive_matrix(combined(lower, Model(-1.0), start)));
    }
  }

  /// The two variances of the assumption hold again.
  Mask keeps_variances(const Bound& upper) const {
    const Model limit(task_.assumption.signal_variance);
    const Model room1 = limit - upper.p11;
    const Model room2 = limit - upper.p22;
    return N::both(certainly_less(upper.p33.range(), Set(task_.assumption.frequency_variance)),
                   N::both(certainly_positive(room1.range()),
                           certainly_positive((room1 * room2 - square(upper.p12)).range())));
  }

  /// 2 curvature I - C P C' with rows of C: sqrt(weight) e3, (1, 0, 0) / sqrt(weight), (0, 1, 1/2) /
  /// sqrt(weight).
  Bound curvature_room(const Bound& upper) const {
    const Model weight(task_.curvature_weight);
    const Model inverse = Model(Set(1.0) / Set(task_.curvature_weight));
    const Model limit(2.0 * task_.curvature);
    const Model half(0.5);
    return {limit - weight * upper.p33,
            -upper.p13,
            -(upper.p23 + half * upper.p33),
            limit - inverse * upper.p11,
            -(inverse * (upper.p12 + half * upper.p13)),
            limit - inverse * (upper.p22 + upper.p23 + Model(0.25) * upper.p33)};
  }

  /// True only where the matrix is positive definite all over the cell: so is C A C', C about the inverse of
  /// the Cholesky factor in its middle.
  static Mask certainly_positive_matrix(const Bound& a VERITRACK_CALL_SITE) {
    VERITRACK_MUTANT_RETURNS(N::every())
    const Numbers one = N::all(1.0);
    const Numbers l11 = N::sqrt(a.p11.constant());
    const Numbers l21 = a.p12.constant() / l11;
    const Numbers l31 = a.p13.constant() / l11;
    const Numbers l22 = N::sqrt(a.p22.constant() - l21 * l21);
    const Numbers l32 = (a.p23.constant() - l31 * l21) / l22;
    const Numbers l33 = N::sqrt(a.p33.constant() - l31 * l31 - l32 * l32);
    const Numbers c11 = one / l11;
    const Numbers c22 = one / l22;
    const Numbers c33 = one / l33;
    const Numbers zero = N::all(0.0);
    const Numbers c21 = zero - l21 * c11 * c22;
    const Numbers c32 = zero - l32 * c22 * c33;
    const Numbers c31 = zero - (l31 * c11 + l32 * c21) * c33;
    // Not finite where the middle is not definite, and then nothing is certain.
    const Set c[3][3] = {{N::point(c11), Set(0.0), Set(0.0)},  // NOLINT
                         {N::point(c21), N::point(c22), Set(0.0)},
                         {N::point(c31), N::point(c32), N::point(c33)}};
    const Model* entries[3][3] = {{&a.p11, &a.p12, &a.p13},  // NOLINT
                                  {&a.p12, &a.p22, &a.p23},
                                  {&a.p13, &a.p23, &a.p33}};
    rigor::LowerTriangle<3, Set> changed;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column <= row; ++column) {
        Model sum(0.0);
        for (std::size_t i = 0; i <= row; ++i) {
          for (std::size_t j = 0; j <= column; ++j) {
            sum += Model(c[row][i] * c[column][j]) * *entries[i][j];
          }
        }
        changed[row][column] = sum.range();
      }
    }
    return N::certainly_definite(changed);
  }

  const WindowTask& task_;
  int first_;
  Model phase_;
  Model frequency_;
};

/// All columns of the batch, which are filled up.
template <int Lanes>
void check_window(const WindowTask& task, const WindowCells& cells, WindowAnswers& answers) {
  for (int first = 0; first < cells.count; first += Lanes) {
    WindowCheck<Lanes>(task, cells, first).look(answers);
  }
}

}  // namespace veritrack::single_channel::detail
