// The effect of a sinusoidal disturbance, or of none, on the estimates of a KKL observer with four filters.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/kkl_observer/kkl_robustness.hpp"
#include "analysis/kkl_observer/kkl_search_box.hpp"

namespace veritrack::kkl_observer {

/// The variables are (w, p, A, q, r): the signal is A sin p, and the disturbance sin q of period 2 pi r.
class SinusoidalErrors {
  using Interval = rigor::Interval;
  using Map = KklErrorMap<Interval>;
  using Filters = Map::Filters<Interval>;

 public:
  SinusoidalErrors(const KklRobustnessQuestion& question, const SinusoidalDisturbance& disturbance,
                   const Filters& transient)
      : map_(question.range.lambda), disturbance_(disturbance.amplitude), transient_(transient) {
    box_(0) = question.range.frequency;
    box_(1) = turns(0.5);  // signal and disturbance may change sign together
    box_(2) = question.amplitude;
    box_(3) = turns(1.0);
    box_(4) = Interval::from_bounds(0.0, (Interval(1.0) / disturbance.frequency).upper());
  }

  [[nodiscard]] const KklSearchBox& box() const { return box_; }
  /// The signal decides where y may vanish.
  [[nodiscard]] static rigor::Vector<kKklSearchVariables> importance() {
    rigor::Vector<kKklSearchVariables> weights;
    weights << 1.0, 1.0, 0.05, 0.05, 0.05;
    return weights;
  }

  /// The errors have two signs, each to be bounded.
  static constexpr std::array<double, 2> kSigns{1.0, -1.0};

  /// w_hat - w.
  template <typename Number>
  [[nodiscard]] Number frequency(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    const Disturbed<Number> at = disturbed(v);
    return Map::frequency_error(at.signal, at.squared_error());
  }

  /// A_hat - A.
  template <typename Number>
  [[nodiscard]] Number amplitude(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    const Disturbed<Number> at = disturbed(v);
    return v(2) * map_.amplitude_error(at.signal, at.u, at.squared_error());
  }

  /// x3_hat / s.
  template <typename Number>
  [[nodiscard]] Number relative_square(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    const Disturbed<Number> at = disturbed(v);
    return Number(1.0) + at.squared_error() / at.signal.s;
  }

  /// |M xi|^2 / |xi|^2.
  template <typename Number>
  [[nodiscard]] Number ratio(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    const Disturbed<Number> at = disturbed(v);
    return map_.excitation_ratio(at.signal, at.u, at.y);
  }

 private:
  /// The filters in a disturbed signal, relative to A.
  template <typename Number>
  struct Disturbed {
    Map::Signal<Number> signal;
    Map::Filters<Number> u;
    std::array<Number, 2> y, pull;

    /// x3_hat - s.
    [[nodiscard]] Number squared_error() const { return Map::product(y, pull) / Map::squared_norm(y); }
  };

  template <typename Number>
  [[nodiscard]] Disturbed<Number> disturbed(const Eigen::Matrix<Number, kKklSearchVariables, 1>& v) const {
    Disturbed<Number> at;
    at.signal = map_.signal(v(0), v(1));
    const auto response = map_.response(at.signal, v(4), v(3));
    const Number share = Number(disturbance_) / v(2);
    Map::Filters<Number> transient;
    for (std::size_t i = 0; i < transient.size(); ++i) {
      transient[i] = Number(transient_[i]);
      at.u[i] = share * response.filters[i] + transient[i];
    }
    const std::array<Number, 2> left = map_.pulled_by(at.signal, transient);
    for (std::size_t j = 0; j < 2; ++j) {
      at.y[j] =
          at.signal.projected[j] + share * response.projected[j] + Map::along(transient, map_.basis()[j]);
      at.pull[j] = share * response.pull[j] + left[j];
    }
    return at;
  }

  Map map_;
  Interval disturbance_;
  Filters transient_;
  KklSearchBox box_;
};

}  // namespace veritrack::kkl_observer
