#include "checker/single_channel/covariance_window.hpp"

#include <algorithm>
#include <cstdlib>

#include "checker/numbers/cell_series.hpp"

namespace veritrack::checker {

namespace {

const Ball zero(0.0);
const Ball half(0.5);
const Ball one(1.0);
const Ball two(2.0);

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

/// True only when the matrix is positive definite all over the cell: its pivots are positive there.
bool definite(const Covariance& a) {
  if (!certainly_positive(a.p11.range())) {
    return false;
  }
  const CellSeries over1 = reciprocal(a.p11);
  const CellSeries l21 = a.p21 * over1;
  const CellSeries l31 = a.p31 * over1;
  const CellSeries pivot2 = a.p22 - l21 * a.p21;
  const CellSeries p32 = a.p32 - l31 * a.p21;
  return certainly_positive(pivot2.range()) &&
         certainly_positive((a.p33 - l31 * a.p31 - p32 * p32 * reciprocal(pivot2)).range());
}

/// keep F P F' + diag(q1 + added, q1 + added, q2), F = [[1, 0, 0], [0, 1, 1], [0, 0, 1]].
Covariance predicted(const Covariance& p, const Ball& keep, const Ball& added, const SingleChannelDesign& d) {
  const CellSeries p32 = p.p32 + p.p33;
  const CellSeries noise = d.q1 + added;
  return {keep * p.p11 + noise, keep * (p.p21 + p.p31), keep * (p.p22 + p.p32 + p32) + noise, keep * p.p31,
          keep * p32,           keep * p.p33 + d.q2};
}

/// After a measurement of variance r in the direction h = (cos phase, -sin phase, 0). A bound on P gives one
/// on the updated P, whatever its sign, only where h'Ph + r > 0: nothing is known of the result elsewhere.
Covariance updated(const Covariance& p, const SineCosine& phase, const Ball& r) {
  const CellSeries b1 = p.p11 * phase.cosine - p.p21 * phase.sine;
  const CellSeries b2 = p.p21 * phase.cosine - p.p22 * phase.sine;
  const CellSeries b3 = p.p31 * phase.cosine - p.p32 * phase.sine;
  const CellSeries variance = b1 * phase.cosine - b2 * phase.sine + r;
  const CellSeries over = certainly_positive(variance.range()) ? reciprocal(variance) : Ball::everything();
  const CellSeries k1 = b1 * over;
  const CellSeries k2 = b2 * over;
  return {p.p11 - k1 * b1, p.p21 - k1 * b2, p.p22 - k2 * b2,
          p.p31 - k1 * b3, p.p32 - k2 * b3, p.p33 - b3 * b3 * over};
}

/// A matrix without remainders, at least (sign 1) or at most (sign -1) every one that `p` holds: a symmetric
/// matrix with entries of at most s_ij lies between -D and D, D the diagonal of the sums of the rows of s.
Covariance without_remainder(Covariance p, const Ball& sign) {
  const Ball s21 = p.p21.take_remainder();
  const Ball s31 = p.p31.take_remainder();
  const Ball s32 = p.p32.take_remainder();
  p.p11 += sign * (p.p11.take_remainder() + s21 + s31).upper();
  p.p22 += sign * (p.p22.take_remainder() + s21 + s32).upper();
  p.p33 += sign * (p.p33.take_remainder() + s31 + s32).upper();
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
  /// the phases should be known best.
  [[nodiscard]] bool holds(const CellSeries& phase, const CellSeries& frequency) const {
    constexpr int kSettling = 12;  // samples before those of which the lower bound is made
    const int window = static_cast<int>(s_.shares.size());
    const int known = std::max(0, window - 2);
    // [[A, x], [x', c]] <= 2 diag(A, c).
    Covariance upper = diagonal(two * s_.signal_variance, two * s_.frequency_variance);
    Covariance lower = diagonal(zero, zero);
    for (int sample = 1 - kSettling; sample <= window; ++sample) {
      // The frequency was, or will be, another: by at most one more slew with each sample.
      const int away = std::abs(sample - known);
      const Ball drift = half * s_.slew * Ball(away * (away + 1));
      const SineCosine here(phase + Ball(sample - known) * frequency + Ball::within(drift));
      upper = without_remainder(updated(above(upper), here, d_.r), one);
      if (sample < 1) {
        continue;
      }
      lower = without_remainder(updated(beneath(lower), here, d_.r), -one);
      if (!definite(less(lower, s_.shares[static_cast<std::size_t>(sample - 1)], upper))) {
        return false;
      }
    }
    return keeps_variances(upper) && is_large(lower) && curves_little(upper) && holds_starts(lower);
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
  [[nodiscard]] Covariance above(const Covariance& p) const {
    return predicted(p, one + s_.loosening, (one / s_.loosening + one) * disturbance(p), d_);
  }
  [[nodiscard]] Covariance beneath(const Covariance& p) const {
    return predicted(p, one - s_.loosening, -((one / s_.loosening - one) * disturbance(p)), d_);
  }

  [[nodiscard]] bool keeps_variances(const Covariance& upper) const {
    const CellSeries room1 = s_.signal_variance - upper.p11;
    const CellSeries room2 = s_.signal_variance - upper.p22;
    return certainly_less(upper.p33.range(), s_.frequency_variance) && certainly_positive(room1.range()) &&
           certainly_positive((room1 * room2 - upper.p21 * upper.p21).range());
  }
  [[nodiscard]] bool is_large(const Covariance& lower) const {
    return definite(less(beneath(lower), one, diagonal(s_.signal_uncertainty, zero))) &&
           certainly_less(s_.least_p11, lower.p11.range()) &&
           certainly_less(s_.least_p22, lower.p22.range()) && certainly_less(s_.least_p33, lower.p33.range());
  }
  /// 2 curvature I - C P C' > 0, C with the rows sqrt(weight) e3, (1, 0, 0) / sqrt(weight), (0, 1, 1/2) /
  /// sqrt(weight): 2 |nu| |delta + i nu/2| <= |C e|^2.
  [[nodiscard]] bool curves_little(const Covariance& p) const {
    const Ball over = one / s_.curvature_weight;
    const CellSeries p32 = p.p32 + half * p.p33;
    return definite(less(diagonal(two * s_.curvature, two * s_.curvature), one,
                         {s_.curvature_weight * p.p33, p.p31, over * p.p11, p32,
                          over * (p.p21 + half * p.p31), over * (p.p22 + half * (p.p32 + p32))}));
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

/// Bisects cells of phases and frequencies until the window holds in each, or there are too many.
class Cover {
 public:
  Cover(const Window& window, std::int64_t& cells) : window_(window), cells_(cells) {}

  bool holds(double phase, double next_phase, double frequency, double next_frequency) {
    ++cells_;
    const Ball middle_phase = half * (Ball(phase) + Ball(next_phase));
    const Ball middle_frequency = half * (Ball(frequency) + Ball(next_frequency));
    if (window_.holds({middle_phase, Ball(next_phase) - middle_phase, zero},
                      {middle_frequency, zero, Ball(next_frequency) - middle_frequency})) {
      return true;
    }
    if (--left_ < 0) {
      return false;
    }
    // The phases of a window are uncertain by a few times the uncertainty of the frequency.
    constexpr double kMemory = 6.0;  // samples
    if (next_phase - phase > kMemory * (next_frequency - frequency)) {
      const double middle = middle_phase.near();
      return holds(phase, middle, frequency, next_frequency) &&
             holds(middle, next_phase, frequency, next_frequency);
    }
    const double middle = middle_frequency.near();
    return holds(phase, next_phase, frequency, middle) && holds(phase, next_phase, middle, next_frequency);
  }

 private:
  const Window& window_;
  std::int64_t& cells_;
  int left_ = 30000;
};

bool is_sensible(const WindowStatement& s, const SingleChannelDesign& d) {
  constexpr std::size_t kLongest = 64;  // samples
  bool sensible = certainly_equal(d.epsilon, zero) && certainly_positive(d.q1) && certainly_positive(d.q2) &&
                  certainly_positive(d.r) && !s.shares.empty() && s.shares.size() <= kLongest &&
                  certainly_less(s.loosening, one) && certainly_at_most(zero, s.slew);
  for (const Ball* number : {&s.radius, &s.frequency_variance, &s.signal_variance, &s.loosening, &s.curvature,
                             &s.curvature_weight, &s.signal_uncertainty}) {
    sensible = sensible && certainly_positive(*number);
  }
  for (const Ball& share : s.shares) {
    sensible = sensible && certainly_at_most(zero, share) && certainly_less(share, one);
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
  return Cover(window, cells).holds(0.0, period, lowest, highest);
}

}  // namespace veritrack::checker
