#include "checker/single_channel/covariance_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "checker/numbers/cell_series.hpp"
#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

namespace {

/// A symmetric matrix over a cell of phases and frequencies, by its lower triangle.
struct Covariance {
  CellSeries p11, p21, p22, p31, p32, p33;
};

Covariance diagonal(const Ball& signal, const Ball& frequency) {
  return {signal, zero, signal, zero, zero, frequency};
}

/// a - factor b.
Covariance less(const Covariance& a, const Ball& factor, const Covariance& b) {
  return {a.p11 - factor * b.p11, a.p21 - factor * b.p21, a.p22 - factor * b.p22,
          a.p31 - factor * b.p31, a.p32 - factor * b.p32, a.p33 - factor * b.p33};
}

/// D_ii = sum_j s_ij w_j / w_i: whatever w > 0, a symmetric matrix with entries of at most s_ij lies between
/// -D and D. The w are those of a matrix in the middle of the cell.
template <typename Size>
std::array<Ball, 3> row_sums(const Covariance& p, const Size& size) {
  const auto root = [](const CellSeries& x) {
    return Ball(std::sqrt(std::max(x.constant().near(), 1e-200)));
  };
  const Ball w1 = root(p.p11);
  const Ball w2 = root(p.p22);
  const Ball w3 = root(p.p33);
  const Ball s21 = size(p.p21);
  const Ball s31 = size(p.p31);
  const Ball s32 = size(p.p32);
  return {size(p.p11) + (s21 * w2 + s31 * w3) / w1, size(p.p22) + (s21 * w1 + s32 * w3) / w2,
          size(p.p33) + (s31 * w1 + s32 * w2) / w3};
}

/// True only when the matrix is positive definite all over the cell: where it is at the corners, less a bound
/// on what is quadratic, for what is linear is between its values there.
bool definite(const Covariance& a) {
  const auto [d1, d2, d3] = row_sums(a, [](const CellSeries& x) { return x.bend(); });
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      Matrix3 corner =
          checker::diagonal(a.p11.corner(x, y) - d1, a.p22.corner(x, y) - d2, a.p33.corner(x, y) - d3);
      corner[1][0] = a.p21.corner(x, y);
      corner[2][0] = a.p31.corner(x, y);
      corner[2][1] = a.p32.corner(x, y);
      if (!checker::definite(corner)) {
        return false;
      }
    }
  }
  return true;
}

/// How the signal comes to a sample: it turns by the frequency (once), into the phase `here`.
struct Turn {
  SineCosine once, twice, here;
};

/// keep A P A' + diag(q1 + added, q1 + added, q2): A turns the first two components by the frequency and adds
/// the third, times i e^{i here}.
Covariance predicted(const Covariance& p, const Turn& turn, const Ball& keep, const Ball& added,
                     const SingleChannelDesign& d) {
  const CellSeries mean = half * (p.p11 + p.p22);
  const CellSeries difference = half * (p.p11 - p.p22);
  const CellSeries turned = turn.twice.cosine * difference - turn.twice.sine * p.p21;
  const CellSeries t31 = turn.once.cosine * p.p31 - turn.once.sine * p.p32;
  const CellSeries t32 = turn.once.sine * p.p31 + turn.once.cosine * p.p32;
  const CellSeries g1 = -turn.here.sine;
  const CellSeries& g2 = turn.here.cosine;
  const CellSeries p31 = t31 + p.p33 * g1;
  const CellSeries p32 = t32 + p.p33 * g2;
  const CellSeries a1 = t31 + p31;
  const CellSeries a2 = t32 + p32;
  const CellSeries noise = d.q1 + added;
  return {keep * (mean + turned + a1 * g1) + noise,
          keep * (turn.twice.sine * difference + turn.twice.cosine * p.p21 + half * (a1 * g2 + a2 * g1)),
          keep * (mean - turned + a2 * g2) + noise,
          keep * p31,
          keep * p32,
          keep * p.p33 + d.q2};
}

/// After a measurement of the first component with variance r. A bound on P gives one on the updated P,
/// whatever its sign, only where P11 + r > 0: nothing is known of the result elsewhere.
Covariance updated(const Covariance& p, const Ball& r) {
  const CellSeries variance = p.p11 + r;
  const CellSeries over = certainly_positive(variance.range()) ? reciprocal(variance) : Ball::everything();
  const CellSeries left = r * over;
  const CellSeries k2 = p.p21 * over;
  const CellSeries k3 = p.p31 * over;
  return {left * p.p11, left * p.p21,       p.p22 - k2 * p.p21,
          left * p.p31, p.p32 - k2 * p.p31, p.p33 - k3 * p.p31};
}

/// A matrix without remainders, at least (sign 1) or at most (sign -1) every one that `p` holds.
Covariance without_remainder(Covariance p, const Ball& sign) {
  const auto [d1, d2, d3] = row_sums(p, [](const CellSeries& x) { return x.remainder(); });
  for (CellSeries* entry : {&p.p11, &p.p21, &p.p22, &p.p31, &p.p32, &p.p33}) {
    entry->drop_remainder();
  }
  p.p11 += sign * d1.upper();
  p.p22 += sign * d2.upper();
  p.p33 += sign * d3.upper();
  return p;
}

/// Goes through the window over one cell.
class Window {
 public:
  Window(const WindowStatement& statement, const SingleChannelDesign& design)
      : s_(statement),
        d_(design),
        a_(sqrt(statement.frequency_variance)),
        b_(sqrt(statement.signal_variance)) {}

  /// `phase` and `frequency` of a sample that is among the last shares.size() samples of the window: there
  /// the phases should be known best. Before those samples, of which the lower bound is made, the signal
  /// turns by `settling` radians.
  [[nodiscard]] bool holds(const CellSeries& phase, const CellSeries& frequency, double settling) const {
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
    Covariance upper = diagonal(two * s_.signal_variance, two * s_.frequency_variance);
    Covariance lower = diagonal(zero, zero);
    // A bound from above is one with a larger r, too: so the first samples, which find so much, are smoothed.
    Ball r = four * d_.r;
    for (int sample = 1 - before; sample <= window; ++sample) {
      const Turn turn = turn_into(sample);
      upper = without_remainder(updated(above(upper, turn), r), one);
      r = max(half * r, d_.r);
      if (sample < 1) {
        continue;
      }
      lower = without_remainder(updated(beneath(lower, turn), d_.r), -one);
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
      lower = without_remainder(updated(beneath(lower, turn_into(sample)), d_.r), -one);
    }
    return !s_.has_least || is_above_least(lower, turn_into(window + kMore).here);
  }

 private:
  /// At least |E x|^2 for E = U(nu) F(1 + delta) - F and all x with x' P^-1 x <= 1, P <= `bound`: |E x| <=
  /// |nu| |x_z| + (|delta| + |nu|) |x_3|, |nu| <= R a, |delta| <= R b.
  [[nodiscard]] Ball disturbance(const Covariance& bound) const {
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
  [[nodiscard]] Covariance above(const Covariance& p, const Turn& turn) const {
    return predicted(p, turn, one + s_.loosening, (one / s_.loosening + one) * disturbance(p), d_);
  }
  [[nodiscard]] Covariance beneath(const Covariance& p, const Turn& turn) const {
    return predicted(p, turn, one - s_.loosening, -((one / s_.loosening - one) * disturbance(p)), d_);
  }

  [[nodiscard]] bool keeps_variances(const Covariance& upper) const {
    return definite({s_.signal_variance - upper.p11, -upper.p21, s_.signal_variance - upper.p22, zero, zero,
                     s_.frequency_variance - upper.p33});
  }
  [[nodiscard]] bool is_large(const Covariance& lower, const SineCosine& last) const {
    // The prediction turns the first two components as a whole, to which diag(1, 1, 0) is the same.
    const Covariance prediction = beneath(lower, {SineCosine(zero), SineCosine(zero), last});
    return definite(less(prediction, one, diagonal(s_.signal_uncertainty, zero)));
  }
  [[nodiscard]] bool is_above_least(const Covariance& lower, const SineCosine& last) const {
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
  [[nodiscard]] bool curves_little(const Covariance& p, const SineCosine& last) const {
    const Ball over = one / s_.curvature_weight;
    const CellSeries g1 = -half * last.sine;
    const CellSeries g2 = half * last.cosine;
    const CellSeries p31 = p.p31 + g1 * p.p33;
    const CellSeries p32 = p.p32 + g2 * p.p33;
    return definite(less(diagonal(two * s_.curvature, two * s_.curvature), one,
                         {s_.curvature_weight * p.p33, p31, over * (p.p11 + g1 * (p.p31 + p31)), p32,
                          over * (p.p21 + g2 * p.p31 + g1 * p32), over * (p.p22 + g2 * (p.p32 + p32))}));
  }
  /// P - e e' / level^2 > 0, e e' <= diag(|delta|^2/weight, |delta|^2/weight, nu^2/(1 - weight)).
  [[nodiscard]] bool holds_starts(const Covariance& lower) const {
    const Ball level = square(s_.start_level);
    return !s_.has_starts ||
           definite(less(lower, one,
                         diagonal(square(s_.start_signal) / (level * s_.start_weight),
                                  square(s_.start_frequency) / (level * (one - s_.start_weight)))));
  }

  const WindowStatement& s_;
  const SingleChannelDesign& d_;
  Ball a_, b_;
};

/// Values of a variable.
struct Part {
  double low, high;
  [[nodiscard]] Ball middle() const { return half * (Ball(low) + Ball(high)); }
  [[nodiscard]] Ball half_width() const { return half * (Ball(high) - Ball(low)); }
  [[nodiscard]] std::array<Part, 2> halves() const {
    return {{{low, middle().near()}, {middle().near(), high}}};
  }
};

/// Bisects cells of phases and frequencies until the window holds in each, or there are too many.
class Cover {
 public:
  Cover(const Window& window, std::int64_t& cells) : window_(window), cells_(cells) {}

  bool holds(const Part& phase, const Part& frequency, double settling, int level) {
    ++cells_;
    if (window_.holds({phase.middle(), phase.half_width(), zero},
                      {frequency.middle(), zero, frequency.half_width()}, settling)) {
      return true;
    }
    constexpr int kDeepest = 32;
    if (level == kDeepest || --left_ < 0) {
      return false;
    }
    // Where not even the middle alone does, the window is too short. At first this is looked at now and then;
    // small cells bear a longer one.
    constexpr int kFirst = 12;
    constexpr int kNowAndThen = 4;
    constexpr double kLongest = 30.0;  // rad
    while (level <= kFirst && level % kNowAndThen == 0 && settling < kLongest &&
           !window_.holds(phase.middle(), frequency.middle(), settling)) {
      settling *= 2.0;
    }
    const double next = level < kFirst ? settling : 1.2 * settling;
    // The phases of a window are uncertain by a few times the uncertainty of the frequency.
    constexpr double kMemory = 4.0;  // samples
    if (phase.high - phase.low > kMemory * (frequency.high - frequency.low)) {
      const auto [first, second] = phase.halves();
      return holds(first, frequency, next, level + 1) && holds(second, frequency, next, level + 1);
    }
    const auto [first, second] = frequency.halves();
    return holds(phase, first, next, level + 1) && holds(phase, second, next, level + 1);
  }

 private:
  const Window& window_;
  std::int64_t& cells_;
  int left_ = 30000;
};

bool is_sensible(const WindowStatement& s, const SingleChannelDesign& d) {
  constexpr std::size_t kLongest = 64;  // samples
  bool sensible = d.without_leak() && certainly_positive(d.q1) && certainly_positive(d.q2) &&
                  certainly_positive(d.r) && !s.shares.empty() && s.shares.size() <= kLongest &&
                  certainly_less(s.loosening, one) && certainly_not_negative(s.slew);
  for (const Ball* number : {&s.radius, &s.frequency_variance, &s.signal_variance, &s.loosening, &s.curvature,
                             &s.curvature_weight, &s.signal_uncertainty}) {
    sensible = sensible && certainly_positive(*number);
  }
  for (const Ball& share : s.shares) {
    sensible = sensible && certainly_not_negative(share) && certainly_less(share, one);
  }
  return sensible &&
         (!s.has_starts || (certainly_positive(s.start_level) && certainly_positive(s.start_weight) &&
                            certainly_less(s.start_weight, one)));
}

}  // namespace

bool window_holds(const WindowStatement& statement, const SingleChannelDesign& design, std::int64_t& cells) {
  if (!is_sensible(statement, design)) {
    return false;
  }
  // A phase and its opposite are the same to the covariance; a frequency and pi less it mirror each other.
  const double period = pi().upper_double();
  const Ball mirrored = pi() - design.highest;
  const double lowest = -(-min(design.lowest, mirrored)).upper_double();
  const double highest = min(half * pi(), min(design.highest, pi() - design.lowest)).upper_double();
  const Window window(statement, design);
  constexpr double kSettling = 3.4;  // rad
  return Cover(window, cells).holds({0.0, period}, {lowest, highest}, kSettling, 0);
}

}  // namespace veritrack::checker
