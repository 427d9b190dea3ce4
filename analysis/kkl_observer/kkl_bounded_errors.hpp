// The effect of a disturbance that is known only by a bound on the estimates of a KKL observer with four
// filters.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "analysis/kkl_observer/kernel_norm.hpp"
#include "analysis/kkl_observer/kkl_robustness.hpp"
#include "analysis/kkl_observer/kkl_search_box.hpp"
#include "analysis/rigor/dual.hpp"

namespace veritrack::kkl_observer {

/// The variables are (w, p, -, y1, y2), with (y1, y2) the move of N'xi / A. At each such point the errors are
/// linear in the filters' moves u, sums q_j v_j'(F^2 + s) u over the rows v_j of [lambda 1]^+ and N', whose
/// largest value KernelNorm bounds. The lowest amplitude is the worst for the effect of the disturbance, the
/// highest for the remaining effect of the start. The functions have no derivatives.
class BoundedErrors {
  using Interval = rigor::Interval;
  using Map = KklErrorMap<Interval>;
  using Filters = Map::Filters<Interval>;

 public:
  BoundedErrors(const KklRobustnessQuestion& question, const BoundedDisturbance& disturbance,
                const Filters& transient);

  [[nodiscard]] const KklSearchBox& box() const { return box_; }
  [[nodiscard]] static rigor::Vector<kKklSearchVariables> importance() {
    return rigor::Vector<kKklSearchVariables>::Ones();
  }

  /// The largest sizes of the errors, as numbers below zero.
  static constexpr std::array<double, 1> kSigns{1.0};
  template <typename Number>
  [[nodiscard]] Number frequency(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    const State at = state(values(v));
    // The error is largest in size when x3_hat is below s.
    const Interval error = Map::frequency_error(at.signal, Interval(-at.squared_error));
    return without_slopes<Number>(-Interval(rigor::magnitude(error)));
  }

  template <typename Number>
  [[nodiscard]] Number amplitude(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    return without_slopes<Number>(-Interval(amplitude_error(values(v))));
  }

  /// x3_hat / s.
  template <typename Number>
  [[nodiscard]] Number relative_square(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    const State at = state(values(v));
    return without_slopes<Number>(Interval(1.0) - Interval(at.squared_error) / at.signal.s);
  }

  template <typename Number>
  [[nodiscard]] Number ratio(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    const State at = state(values(v));
    return without_slopes<Number>(map_.excitation_ratio(at.signal, moves(), at.y));
  }

 private:
  static constexpr std::size_t kCells = 120;
  using Weights = std::array<Interval, 4>;

  /// The bounds at one cell of the search.
  struct State {
    Map::Signal<Interval> signal;
    std::array<Interval, 2> y;
    Interval norm;         ///< |y|^2
    double squared_error;  ///< the largest |x3_hat - s|
  };

  static KklSearchBox values(const KklSearchBox& v) { return v; }
  template <int N>
  static KklSearchBox values(const Eigen::Matrix<rigor::Dual<Interval, N>, kKklSearchVariables, 1>& v) {
    return v.unaryExpr([](const auto& x) { return x.value(); });
  }

  /// The lower end of a value, with unknown derivatives.
  template <typename Number>
  [[nodiscard]] static Number without_slopes(const Interval& value) {
    Interval lowest(value.lower());
    if constexpr (std::is_same_v<Number, Interval>) {
      return lowest;
    } else {
      std::array<Interval, kKklSearchVariables> slopes;
      slopes.fill(Interval::entire());
      return {lowest, slopes};
    }
  }

  /// The largest sum_j q_j v_j'(F^2 + s) u by the disturbance, relative to the lowest amplitude: its value at
  /// the middle of q and s, and its largest change from there.
  [[nodiscard]] Interval disturbed(const Weights& q, const Interval& s) const;

  /// The same for the remaining effect of the start, relative to the signal's amplitude.
  [[nodiscard]] Interval left_over(const Weights& q, const Map::Signal<Interval>& signal) const;

  [[nodiscard]] double largest(const Weights& q, const Map::Signal<Interval>& signal) const {
    return (disturbed(q, signal.s) + left_over(q, signal)).upper();
  }

  /// The filters one by one.
  [[nodiscard]] Filters moves() const;

  [[nodiscard]] State state(const KklSearchBox& box) const;

  /// |A_hat - A|: (A_hat / A)^2 - 1 is linear in u given the errors of x1, x2 and x3, which are bounded
  /// first.
  [[nodiscard]] double amplitude_error(const KklSearchBox& box) const;

  Map map_;
  KernelNorm<> norm_;
  Interval lowest_amplitude_;
  Interval highest_amplitude_;
  Interval relative_;  ///< disturbance over lowest amplitude
  Filters transient_;
  std::array<Filters, 4> rows_;
  Weights row_norms_;     ///< of v_j'u
  Weights driven_norms_;  ///< of v_j'(F^2 + s) u
  KklSearchBox box_;
};

}  // namespace veritrack::kkl_observer
