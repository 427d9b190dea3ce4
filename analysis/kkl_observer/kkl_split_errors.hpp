// The effect of a disturbance on the estimates of a KKL observer with any number of filters: the part of the
// errors that is linear in its effect on the filters, and a bound on the rest.
#pragma once

#include <array>
#include <type_traits>
#include <variant>

#include "analysis/kkl_observer/kernel_norm.hpp"
#include "analysis/kkl_observer/kkl_error_map.hpp"
#include "analysis/kkl_observer/kkl_robustness.hpp"
#include "analysis/kkl_observer/response_norm.hpp"
#include "analysis/rigor/dual.hpp"

namespace veritrack::kkl_observer {

/// The largest size of a function of the filters' moves over the amplitude A: from the disturbance (at the
/// lowest A), and from the remaining effect of the start.
struct Reach {
  rigor::Interval driven, left;
  [[nodiscard]] rigor::Interval sum() const { return driven + left; }
};
inline Reach operator+(const Reach& x, const Reach& y) {
  return {x.driven + y.driven, x.left + y.left};
}
inline Reach operator*(const Reach& x, const rigor::Interval& factor) {
  return {x.driven * factor, x.left * factor};
}

/// With y = y0 + z, y0 = N'T, z = N'u, q = y0/|y0|^2, 1 + a = 1 + q'z and P the projection along y0 (the
/// formulas of kkl_error_map.hpp), e = x3_hat - s obeys, exactly,
///     e = -q'N'(F^2 + s + e) u - (Pz)'P N'(F^2 + s + e) u / ((1 + a) |y0|^2).
/// The variables are frequency (rad/s) and phase (rad) of the signal. At each cell the functions of u are
/// linear with known coefficients; their largest values are integrals of kernels or responses to sinusoids.
/// The values leave two percent of room for an independent bound that is a little cruder. Needs the upward
/// mode. The functions have no derivatives. For four to eight filters.
template <int M>
class SplitErrors {
  using Interval = rigor::Interval;
  using Map = KklErrorMap<Interval, M>;
  using Filters = KklFilters<M>;

 public:
  static constexpr int kVariables = 2;
  using Box = rigor::IntervalVector<kVariables>;
  template <typename Number>
  using Variables = Eigen::Matrix<Number, kVariables, 1>;

  SplitErrors(const KklRobustnessQuestionOf<M>& question, const Filters& transient);

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] static rigor::Vector<kVariables> importance() { return rigor::Vector<kVariables>::Ones(); }

  /// The largest sizes of the errors, as numbers below zero.
  static constexpr std::array<double, 1> kSigns{1.0};
  template <typename Number>
  [[nodiscard]] Number frequency(const Variables<Number>& v) const {
    return without_slopes<Number>(-frequency_error(values(v)));
  }
  template <typename Number>
  [[nodiscard]] Number amplitude(const Variables<Number>& v) const {
    return without_slopes<Number>(-amplitude_error(values(v)));
  }
  /// x3_hat / s.
  template <typename Number>
  [[nodiscard]] Number relative_square(const Variables<Number>& v) const {
    return without_slopes<Number>(least_relative_square(values(v)));
  }
  /// |M xi|^2 / |xi|^2.
  template <typename Number>
  [[nodiscard]] Number ratio(const Variables<Number>& v) const {
    return without_slopes<Number>(least_ratio(values(v)));
  }

 private:
  /// Weights of the rows of [lambda 1]^+, then of those of N'.
  using Weights = std::array<Interval, Map::kFilters>;
  static constexpr std::size_t kFirstAcross = 2;

  /// The bounds at one cell of the search.
  struct State {
    typename Map::template Signal<Interval> signal;
    Weights direction;      ///< q
    Interval squared_norm;  ///< |y0|^2
    Interval along;         ///< the least 1 + a
    Reach error;            ///< |e|
    Reach second;           ///< |e + q'N'(F^2 + s + e) u|
  };

  static Box values(const Box& v) { return v; }
  static Box values(const Variables<rigor::Dual<Interval, kVariables>>& v) {
    return v.unaryExpr([](const auto& x) { return x.value(); });
  }
  /// The lower end of a value, with unknown derivatives.
  template <typename Number>
  [[nodiscard]] static Number without_slopes(const Interval& value) {
    const Interval lowest(value.lower());
    if constexpr (std::is_same_v<Number, Interval>) {
      return lowest;
    } else {
      std::array<Interval, kVariables> slopes;
      slopes.fill(Interval::entire());
      return {lowest, slopes};
    }
  }

  [[nodiscard]] Interval norm_of(const Filters& coefficients) const;
  /// The reach of the sum of weights_j row_j'u.
  [[nodiscard]] Reach moved(const Weights& weights) const;
  /// The reach of the sum of weights_j row_j'(F^2 + s + shift) u.
  [[nodiscard]] Reach driven(const Weights& weights, const State& at, const Interval& shift) const;
  /// q over the cell, by the mean-value form.
  void find_direction(const Box& box, State& at) const;
  /// An orthonormal basis of the complement of a unit vector near y0/|y0|, that vector first.
  [[nodiscard]] std::array<Weights, Map::kAcross> frame(const State& at) const;
  [[nodiscard]] State state(const Box& box) const;

  [[nodiscard]] Interval frequency_error(const Box& box) const;
  [[nodiscard]] Interval amplitude_error(const Box& box) const;
  [[nodiscard]] Interval least_relative_square(const Box& box) const;
  [[nodiscard]] Interval least_ratio(const Box& box) const;

  Map map_;
  std::variant<std::monostate, KernelNorm<M>, ResponseNorm<M>> norm_;
  Interval relative_;  ///< disturbance over lowest amplitude
  Interval lowest_amplitude_, highest_amplitude_;
  Filters transient_;
  Filters moves_;  ///< the largest |u_i|
  std::array<Filters, Map::kFilters> rows_;
  Weights row_norms_;    ///< of row_j'u, by a disturbance of 1
  Weights norms_of_f2_;  ///< of row_j'F^2 u
  Box box_;
};

}  // namespace veritrack::kkl_observer
