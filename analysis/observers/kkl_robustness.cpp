#include "analysis/observers/kkl_robustness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/observers/kernel_norm.hpp"
#include "analysis/observers/kkl_error_map.hpp"
#include "analysis/observers/kkl_settling.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/search/branch_and_bound.hpp"

namespace veritrack::observers {

namespace {

using rigor::Interval;
using Map = KklErrorMap<Interval>;
using Filters = Map::Filters<Interval>;

/// Signal frequency (rad/s), its phase (rad), its amplitude, and two numbers that say where the disturbance
/// is.
constexpr int kVariables = 5;
using Box = rigor::IntervalVector<kVariables>;

/// [0, upper end of a turn times `turns`].
Interval turns(double turns) {
  return Interval::from_bounds(0.0, (Interval(turns) * Interval(2.0) * rigor::pi()).upper());
}

/// The same number, as a scalar of the search.
template <typename Number>
Number constant(const Interval& value) {
  return Number(value);
}

// ---- a sinusoidal disturbance, or none
// -------------------------------------------------------------------------------

/// The variables are (w, p, A, q, r): the signal is A sin p, and the disturbance sin q of period 2 pi r.
class SinusoidalErrors {
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

  [[nodiscard]] const Box& box() const { return box_; }
  /// The signal decides where y may vanish.
  [[nodiscard]] static rigor::Vector<kVariables> importance() {
    rigor::Vector<kVariables> weights;
    weights << 1.0, 1.0, 0.05, 0.05, 0.05;
    return weights;
  }

  /// The errors have two signs, each to be bounded.
  static constexpr std::array<double, 2> kSigns{1.0, -1.0};

  /// w_hat - w.
  template <typename Number>
  [[nodiscard]] Number frequency(const Eigen::Matrix<Number, kVariables, 1>& v) const {
    const Disturbed<Number> at = disturbed(v);
    return Map::frequency_error(at.signal, at.squared_error());
  }

  /// A_hat - A.
  template <typename Number>
  [[nodiscard]] Number amplitude(const Eigen::Matrix<Number, kVariables, 1>& v) const {
    const Disturbed<Number> at = disturbed(v);
    return v(2) * map_.amplitude_error(at.signal, at.u, at.squared_error());
  }

  /// x3_hat / s.
  template <typename Number>
  [[nodiscard]] Number relative_square(const Eigen::Matrix<Number, kVariables, 1>& v) const {
    const Disturbed<Number> at = disturbed(v);
    return Number(1.0) + at.squared_error() / at.signal.s;
  }

  /// |M xi|^2 / |xi|^2.
  template <typename Number>
  [[nodiscard]] Number ratio(const Eigen::Matrix<Number, kVariables, 1>& v) const {
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
    [[nodiscard]] Number squared_error() const {
      return (y[0] * pull[0] + y[1] * pull[1]) / Map::squared_norm(y);
    }
  };

  template <typename Number>
  [[nodiscard]] Disturbed<Number> disturbed(const Eigen::Matrix<Number, kVariables, 1>& v) const {
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
  Box box_;
};

// ---- a bounded disturbance
// -------------------------------------------------------------------------------------------

/// The variables are (w, p, -, y1, y2), with (y1, y2) the move of N'xi / A. At each such point the errors are
/// linear in the filters' moves u, sums q_j v_j'(F^2 + s) u over the rows v_j of [lambda 1]^+ and N', whose
/// largest value KernelNorm bounds. The lowest amplitude is the worst for what the disturbance does, the
/// highest for what is left of the start. The functions have no derivatives.
class BoundedErrors {
 public:
  BoundedErrors(const KklRobustnessQuestion& question, const BoundedDisturbance& disturbance,
                const Filters& transient)
      : map_(question.range.lambda),
        norm_(map_.lambda(), kCells),
        lowest_amplitude_(question.amplitude.lower()),
        highest_amplitude_(question.amplitude.upper()),
        relative_(disturbance.bound / lowest_amplitude_),
        transient_(transient),
        rows_{map_.pseudoinverse_1(), map_.pseudoinverse_2(), map_.basis()[0], map_.basis()[1]} {
    const Interval largest_s = square(question.range.frequency);
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      row_norms_[j] = norm_.upper_bound(rows_[j]);
      Filters driven;
      for (std::size_t i = 0; i < driven.size(); ++i) {
        driven[i] = rows_[j][i] * square(map_.lambda()[i]);
      }
      driven_norms_[j] = norm_.upper_bound(driven) + row_norms_[j] * Interval(largest_s.upper());
    }
    box_(0) = question.range.frequency;
    box_(1) = turns(0.5);
    box_(2) = Interval(0.0);
    for (std::size_t j = 0; j < 2; ++j) {
      const Interval left = abs(Map::along(transient_, map_.basis()[j]));
      box_(static_cast<Eigen::Index>(3 + j)) =
          rigor::symmetric((relative_ * row_norms_[2 + j] + left).upper());
    }
  }

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] static rigor::Vector<kVariables> importance() { return rigor::Vector<kVariables>::Ones(); }

  /// The largest sizes of the errors, as numbers below zero.
  static constexpr std::array<double, 1> kSigns{1.0};
  template <typename Number>
  [[nodiscard]] Number frequency(const Eigen::Matrix<Number, kVariables, 1>& v) const {
    const State at = state(values(v));
    // The error is largest in size when x3_hat is below s.
    const Interval error = Map::frequency_error(at.signal, Interval(-at.squared_error));
    return without_slopes<Number>(-Interval(rigor::magnitude(error)));
  }

  template <typename Number>
  [[nodiscard]] Number amplitude(const Eigen::Matrix<Number, kVariables, 1>& v) const {
    return without_slopes<Number>(-Interval(amplitude_error(values(v))));
  }

  /// x3_hat / s.
  template <typename Number>
  [[nodiscard]] Number relative_square(const Eigen::Matrix<Number, kVariables, 1>& v) const {
    const State at = state(values(v));
    return without_slopes<Number>(Interval(1.0) - Interval(at.squared_error) / at.signal.s);
  }

  template <typename Number>
  [[nodiscard]] Number ratio(const Eigen::Matrix<Number, kVariables, 1>& v) const {
    const State at = state(values(v));
    return without_slopes<Number>(map_.excitation_ratio(at.signal, moves(), at.y));
  }

 private:
  static constexpr std::size_t kCells = 120;
  using Weights = std::array<Interval, 4>;

  /// What is known at one cell of the search.
  struct State {
    Map::Signal<Interval> signal;
    std::array<Interval, 2> y;
    Interval norm;         ///< |y|^2
    double squared_error;  ///< the largest |x3_hat - s|
  };

  static Box values(const Box& v) { return v; }
  template <int N>
  static Box values(const Eigen::Matrix<rigor::Dual<Interval, N>, kVariables, 1>& v) {
    return v.unaryExpr([](const auto& x) { return x.value(); });
  }

  /// The lower end of a value, with nothing known of derivatives.
  template <typename Number>
  [[nodiscard]] static Number without_slopes(const Interval& value) {
    Interval lowest(value.lower());
    if constexpr (std::is_same_v<Number, Interval>) {
      return lowest;
    } else {
      std::array<Interval, kVariables> slopes;
      slopes.fill(Interval::entire());
      return {lowest, slopes};
    }
  }

  /// The largest sum_j q_j v_j'(F^2 + s) u by the disturbance, relative to the lowest amplitude: at the
  /// middle of q and s, and by how much it can change from there.
  [[nodiscard]] Interval disturbed(const Weights& q, const Interval& s) const {
    const Interval middle_s(rigor::midpoint(s));
    const Interval radius_s(rigor::radius(s));
    Filters coefficients;
    coefficients.fill(Interval(0.0));
    Interval change(0.0);
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      const Interval middle(rigor::midpoint(q[j]));
      change += Interval(rigor::radius(q[j])) * driven_norms_[j] + radius_s * abs(middle) * row_norms_[j];
      for (std::size_t i = 0; i < coefficients.size(); ++i) {
        coefficients[i] += middle * rows_[j][i] * (square(map_.lambda()[i]) + middle_s);
      }
    }
    return relative_ * (norm_.upper_bound(coefficients) + change);
  }

  /// The same for what is left of the start, relative to the signal's amplitude.
  [[nodiscard]] Interval left_over(const Weights& q, const Map::Signal<Interval>& signal) const {
    Interval sum(0.0);
    for (std::size_t i = 0; i < transient_.size(); ++i) {
      Interval weight(0.0);
      for (std::size_t j = 0; j < rows_.size(); ++j) {
        weight += q[j] * rows_[j][i];
      }
      sum += abs(weight * signal.denominators[i] * transient_[i]);
    }
    return sum;
  }

  [[nodiscard]] double largest(const Weights& q, const Map::Signal<Interval>& signal) const {
    return (disturbed(q, signal.s) + left_over(q, signal)).upper();
  }

  /// The filters one by one.
  [[nodiscard]] Filters moves() const {
    Filters u;
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] = rigor::symmetric((relative_ / map_.lambda()[i]).upper()) + transient_[i];
    }
    return u;
  }

  [[nodiscard]] State state(const Box& box) const {
    State at;
    at.signal = map_.signal(box(0), box(1));
    at.y = {at.signal.projected[0] + box(3), at.signal.projected[1] + box(4)};
    at.norm = Map::squared_norm(at.y);
    at.squared_error =
        largest({Interval(0.0), Interval(0.0), at.y[0] / at.norm, at.y[1] / at.norm}, at.signal);
    return at;
  }

  /// |A_hat - A|: (A_hat / A)^2 - 1 is linear in u given the errors of x1, x2 and x3, which are bounded
  /// first.
  [[nodiscard]] double amplitude_error(const Box& box) const {
    const State at = state(box);
    const Interval zero(0.0);
    const Interval x3 = at.signal.s + rigor::symmetric(at.squared_error);
    const std::array<Interval, 2> to_x3{at.y[0] / at.norm, at.y[1] / at.norm};
    const Filters u = moves();
    Interval pulled_1(0.0);
    Interval pulled_2(0.0);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const Interval filter = at.signal.transformed[i] + u[i];
      pulled_1 += map_.pseudoinverse_1()[i] * filter;
      pulled_2 += map_.pseudoinverse_2()[i] * filter;
    }
    const auto weights = [&](const Interval& first, const Interval& second,
                             const Interval& third) -> Weights {
      return {first, second, -(third * to_x3[0]), -(third * to_x3[1])};
    };
    const Interval one(1.0);
    const Interval k1 = rigor::symmetric(largest(weights(one, zero, pulled_1), at.signal));
    const Interval k2 = rigor::symmetric(largest(weights(zero, one, pulled_2), at.signal));
    const Interval x2 = -(at.signal.frequency * at.signal.cosine);
    const Interval from_1 = at.signal.sine + at.signal.sine + k1;
    const Interval from_2 = (x2 + x2 + k2) / x3;
    const Interval from_3 = pulled_1 * from_1 + pulled_2 * from_2 - square(at.signal.cosine) / x3;
    const Weights q = weights(from_1, from_2, from_3);
    const Interval by_disturbance = disturbed(q, at.signal.s);
    const Interval by_start = left_over(q, at.signal);
    // sqrt(1 + t) - 1 is largest in size at the lowest t.
    const Interval root = sqrt(Interval(1.0) - Interval((by_disturbance + by_start).upper()));
    const Interval change =
        (by_disturbance * lowest_amplitude_ + by_start * highest_amplitude_) / (root + Interval(1.0));
    return change.upper();
  }

  Map map_;
  KernelNorm norm_;
  Interval lowest_amplitude_;
  Interval highest_amplitude_;
  Interval relative_;  ///< disturbance over lowest amplitude
  Filters transient_;
  std::array<Filters, 4> rows_;
  Weights row_norms_;     ///< of v_j'u
  Weights driven_norms_;  ///< of v_j'(F^2 + s) u
  Box box_;
};

template <typename Errors>
KklRobustness search_errors(const Errors& errors, const KklRobustnessQuestion& question) {
  KklRobustness result;
  const auto minimize = [&](double tolerance, double sufficient, const auto& function) {
    search::BranchAndBoundSettings<kVariables> settings;
    settings.relative_tolerance = tolerance;
    settings.sufficient = sufficient;
    settings.cells = question.cells;
    settings.batch = 256;
    settings.importance = errors.importance();
    settings.of_lower_ends = true;  // what is left of the start is anywhere in its intervals
    auto minimum = search::minimize_globally<kVariables>(function, errors.box(), settings);
    result.cells += minimum.cells;
    return minimum;
  };
  // The largest size of an error: minus the least of both signs.
  const auto bound = [&](const auto& error, auto& worst) {
    double least = 0.0;
    double reached = 0.0;
    double sufficient = std::numeric_limits<double>::infinity();
    for (const double sign : Errors::kSigns) {
      const auto minimum = minimize(question.relative_tolerance, sufficient,
                                    [&](const auto& v) { return error(v) * Interval(sign); });
      least = std::min(least, minimum.lower);
      sufficient = least;
      if (minimum.upper < reached) {
        reached = minimum.upper;
        worst = minimum.best;
      }
    }
    return Interval(-least);
  };
  const auto ratio =
      minimize(0.2, std::numeric_limits<double>::infinity(), [&](const auto& v) { return errors.ratio(v); });
  result.largest_ell = Interval(2.0) * Interval(ratio.lower);
  const auto square = minimize(0.2, std::numeric_limits<double>::infinity(),
                               [&](const auto& v) { return errors.relative_square(v); });
  result.smallest_relative_square = Interval(square.lower);
  if (!certainly_positive(result.smallest_relative_square)) {
    return result;
  }
  rigor::Vector<kVariables> worst = rigor::Vector<kVariables>::Zero();
  result.amplitude_error_bound = bound([&](const auto& v) { return errors.amplitude(v); }, worst);
  result.frequency_error_bound = bound([&](const auto& v) { return errors.frequency(v); }, worst);
  for (int i = 0; i < kVariables; ++i) {
    result.worst[static_cast<std::size_t>(i)] = worst(i);
  }
  return result;
}

}  // namespace

KklRobustness bound_kkl_errors(const KklRobustnessQuestion& question) {
  const rigor::UpwardRounding upward;
  const Interval settling_time(propose_settling_time(question));
  const Filters transient = transient_at(question, settling_time);
  KklRobustness result;
  if (const auto* bounded = std::get_if<BoundedDisturbance>(&question.disturbance)) {
    result = search_errors(BoundedErrors(question, *bounded, transient), question);
  } else {
    // No disturbance is one of amplitude 0.
    const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&question.disturbance);
    const SinusoidalDisturbance none{Interval(0.0), Interval(1.0)};
    result = search_errors(SinusoidalErrors(question, sinusoidal != nullptr ? *sinusoidal : none, transient),
                           question);
    result.worst[4] = 1.0 / result.worst[4];
  }
  result.settling_time = settling_time;
  return result;
}

}  // namespace veritrack::observers
