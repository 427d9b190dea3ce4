#include "checker/single_channel/covariance_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "checker/single_channel/cell_covariance.hpp"

namespace veritrack::checker {

namespace {

/// Goes through the window over one cell.
class Window {
 public:
  Window(const WindowStatement& statement, const SingleChannelDesign& design)
      : s_(statement),
        d_(design),
        a_(sqrt(statement.frequency_variance)),
        b_(sqrt(statement.signal_variance)) {}

  /// `phase` and `frequency` of a sample that is among the last shares.size() samples of the window: there
  /// the phases should be known best. The lower bound is computed from those samples; before them the signal
  /// turns by `settling` radians.
  [[nodiscard]] bool is_proved(const CellSeries& phase, const CellSeries& frequency, double settling) const {
    constexpr double kMost = 50.0;
    const int before =
        static_cast<int>(std::ceil(std::clamp(settling / frequency.constant().near(), 1.0, kMost)));
    const int window = static_cast<int>(s_.shares.size());
    const int known = std::max(0, window - 1);
    const auto turn_into = [&](int sample) {
      // The frequency was, or will be, another: by at most one more slew with each sample.
      const int away = std::abs(sample - known);
      const Ball drift = half * s_.slew * Ball(away * (away + 1));
      const CellSeries turned = frequency + Ball::within(s_.slew * Ball(away + 1));
      return Turn{SineCosine(turned), SineCosine(two * turned),
                  SineCosine(phase + Ball(sample - known) * frequency + Ball::within(drift))};
    };
    // [[A, x], [x', c]] <= 2 diag(A, c).
    CellCovariance upper = diagonal(two * s_.signal_variance, two * s_.frequency_variance);
    CellCovariance lower = diagonal(zero, zero);
    // Increasing r keeps the upper bound valid; we do so at first, when updates are large.
    Ball r = four * d_.r;
    for (int sample = 1 - before; sample <= window; ++sample) {
      const Turn turn = turn_into(sample);
      upper = without_remainder(scaled(one + s_.covariance_rounding, updated(above(upper, turn), r)), one);
      r = max(half * r, d_.r);
      if (sample < 1) {
        continue;
      }
      lower = without_remainder(least_updated(lower, turn), -one);
      if (!definite(less(lower, s_.shares[static_cast<std::size_t>(sample - 1)], upper))) {
        return false;
      }
    }
    const SineCosine last = turn_into(window).here;
    if (!(keeps_variances(upper) && is_large(lower, last) && curves_little(upper, last) &&
          holds_starts(lower))) {
      return false;
    }
    // Every bound from below is one on all covariances; a longer window gives more than the claimed one.
    constexpr int kMore = 2;  // samples
    for (int sample = window + 1; s_.has_least && sample <= window + kMore; ++sample) {
      lower = without_remainder(least_updated(lower, turn_into(sample)), -one);
      if (!definite(lower)) {
        return false;  // the next prediction bounds nothing from below, as (F + E) X (F + E)' needs X >= 0
      }
    }
    return !s_.has_least || is_above_least(lower, turn_into(window + kMore).here);
  }

 private:
  /// At least |E x|^2 for E = U(nu) F(1 + delta) - F and all x with x' P^-1 x <= 1, P <= `bound`: |E x| <=
  /// |nu| |x_z| + (|delta| + |nu|) |x_3|, |nu| <= R a, |delta| <= R b.
  [[nodiscard]] Ball disturbance(const CellCovariance& bound) const {
    const Ball p11 = bound.p11.range();
    const Ball p22 = bound.p22.range();
    const Ball most =
        half * (p11 + p22) + root_of_non_negative(square(half * (p11 - p22)) + square(bound.p21.range()));
    const Ball signal = root_of_non_negative(min(max(most, zero), s_.signal_variance));
    const Ball frequency = root_of_non_negative(min(max(bound.p33.range(), zero), s_.frequency_variance));
    return square(s_.radius * (a_ * signal + (b_ + a_) * frequency)).upper();
  }
  /// The prediction, from above and from below: (F + E) P (F + E)' lies between (1 -+ eta) F P F' -+ (1/eta
  /// -+ 1) E P E'.
  [[nodiscard]] CellCovariance above(const CellCovariance& p, const Turn& turn) const {
    return predicted(p, turn, one + s_.loosening, (one / s_.loosening + one) * disturbance(p), d_);
  }
  [[nodiscard]] CellCovariance beneath(const CellCovariance& p, const Turn& turn) const {
    return predicted(p, turn, one - s_.loosening, -((one / s_.loosening - one) * disturbance(p)), d_);
  }

  /// The next sample's, rounded.
  [[nodiscard]] CellCovariance least_updated(const CellCovariance& p, const Turn& turn) const {
    return scaled(one - s_.covariance_rounding, updated(beneath(p, turn), d_.r));
  }

  [[nodiscard]] bool keeps_variances(const CellCovariance& upper) const {
    return definite({s_.signal_variance - upper.p11, -upper.p21, s_.signal_variance - upper.p22, zero, zero,
                     s_.frequency_variance - upper.p33});
  }
  [[nodiscard]] bool is_large(const CellCovariance& lower, const SineCosine& last) const {
    // The prediction turns the first two components as a whole, to which diag(1, 1, 0) is the same.
    const CellCovariance prediction = beneath(lower, {SineCosine(zero), SineCosine(zero), last});
    return definite(less(prediction, one, diagonal(s_.signal_uncertainty, zero)));
  }
  [[nodiscard]] bool is_above_least(const CellCovariance& lower, const SineCosine& last) const {
    // In the frame of the true phase, P11 and P22 are mean +- turned.
    const CellSeries& s = last.sine;
    const CellSeries& c = last.cosine;
    const CellSeries turned =
        (half * (c * c - s * s)) * (lower.p11 - lower.p22) + two * (s * (c * lower.p21));
    const CellSeries mean = half * (lower.p11 + lower.p22);
    return certainly_less(s_.least_p11, (mean + turned).range()) &&
           certainly_less(s_.least_p22, (mean - turned).range()) &&
           certainly_less(s_.least_p33, lower.p33.range());
  }
  /// 2 curvature I - C P C' > 0, C with the rows sqrt(weight) e3 and (I, g) / sqrt(weight), g = i e^{i phase}
  /// / 2: 2 |nu| |delta + i nu/2| <= |C e|^2.
  [[nodiscard]] bool curves_little(const CellCovariance& p, const SineCosine& last) const {
    const Ball over = one / s_.curvature_weight;
    const CellSeries g1 = -half * last.sine;
    const CellSeries g2 = half * last.cosine;
    const CellSeries p31 = p.p31 + g1 * p.p33;
    const CellSeries p32 = p.p32 + g2 * p.p33;
    return definite(less(diagonal(two * s_.curvature, two * s_.curvature), one,
                         {s_.curvature_weight * p.p33, p31, over * (p.p11 + g1 * (p.p31 + p31)), p32,
                          over * (p.p21 + g2 * p.p31 + g1 * p32), over * (p.p22 + g2 * (p.p32 + p32))}));
  }
  [[nodiscard]] bool holds_starts(const CellCovariance& lower) const {
    return !s_.has_starts || definite(less(lower, one, diagonal(s_.start_signal, s_.start_frequency)));
  }

  const WindowStatement& s_;
  const SingleChannelDesign& d_;
  Ball a_, b_;
};

/// Values of a variable.
struct ValueRange {
  double low, high;
  [[nodiscard]] Ball middle() const { return half * (Ball(low) + Ball(high)); }
  [[nodiscard]] Ball half_width() const { return half * (Ball(high) - Ball(low)); }
  [[nodiscard]] std::array<ValueRange, 2> halves() const {
    return {{{low, middle().near()}, {middle().near(), high}}};
  }
};

/// Bisects cells of phases and frequencies until the window is proved in each, or there are too many.
class WindowCover {
 public:
  WindowCover(const Window& window, std::int64_t& cells) : window_(window), cells_(cells) {}

  bool is_proved(const ValueRange& phase, const ValueRange& frequency, double settling, int level) {
    ++cells_;
    if (window_.is_proved({phase.middle(), phase.half_width(), zero},
                          {frequency.middle(), zero, frequency.half_width()}, settling)) {
      return true;
    }
    constexpr int kDeepest = 32;
    if (level == kDeepest || --left_ < 0) {
      return false;
    }
    // Where the middle alone also fails, the window is too short. At first this is checked now and then;
    // small cells allow a longer one.
    constexpr int kFirst = 12;
    constexpr int kNowAndThen = 4;
    constexpr double kLongest = 30.0;  // rad
    while (level <= kFirst && level % kNowAndThen == 0 && settling < kLongest &&
           !window_.is_proved(phase.middle(), frequency.middle(), settling)) {
      settling *= 2.0;
    }
    const double next = level < kFirst ? settling : 1.2 * settling;
    // The phases of a window are uncertain by a few times the uncertainty of the frequency.
    constexpr double kMemory = 4.0;  // samples
    if (phase.high - phase.low > kMemory * (frequency.high - frequency.low)) {
      const auto [first, second] = phase.halves();
      return is_proved(first, frequency, next, level + 1) && is_proved(second, frequency, next, level + 1);
    }
    const auto [first, second] = frequency.halves();
    return is_proved(phase, first, next, level + 1) && is_proved(phase, second, next, level + 1);
  }

 private:
  const Window& window_;
  std::int64_t& cells_;
  int left_ = 30000;
};

bool is_sensible(const WindowStatement& s, const SingleChannelDesign& d) {
  constexpr std::size_t kLongest = 64;  // samples
  // cannot bind (d.q1, d.q2, d.r): without q1 the lower bound begins at zero along the amplitude and stays
  // there, below signal_uncertainty; without q2 or r the inputs of the errors are not finite, and no set is
  // kept.
  bool sensible = d.without_leak() && certainly_positive(d.q1) && certainly_positive(d.q2) &&
                  certainly_positive(d.r) && !s.shares.empty() && s.shares.size() <= kLongest &&
                  certainly_less(s.loosening, one) && certainly_not_negative(s.slew) &&
                  certainly_not_negative(s.covariance_rounding);
  for (const Ball* number : {&s.radius, &s.frequency_variance, &s.signal_variance, &s.loosening, &s.curvature,
                             &s.curvature_weight, &s.signal_uncertainty}) {
    sensible = sensible && certainly_positive(*number);
  }
  for (const Ball& share : s.shares) {
    // cannot bind (one): a share of 1 or more of the upper bound is not below the lower one.
    sensible = sensible && certainly_not_negative(share) && certainly_less(share, one);
  }
  return sensible &&
         (!s.has_starts || (certainly_positive(s.start_signal) && certainly_positive(s.start_frequency)));
}

}  // namespace

bool window_is_proved(const WindowStatement& statement, const SingleChannelDesign& design,
                      std::int64_t& cells) {
  if (!is_sensible(statement, design)) {
    return false;
  }
  // A phase and its opposite give the same covariance; a frequency and pi minus it are mirror images.
  const double period = pi().upper_double();
  const Ball mirrored = pi() - design.highest;
  const double lowest = -(-min(design.lowest, mirrored)).upper_double();
  const double highest = min(half * pi(), min(design.highest, pi() - design.lowest)).upper_double();
  const Window window(statement, design);
  constexpr double kSettling = 3.4;  // rad
  return WindowCover(window, cells).is_proved({0.0, period}, {lowest, highest}, kSettling, 0);
}

}  // namespace veritrack::checker
