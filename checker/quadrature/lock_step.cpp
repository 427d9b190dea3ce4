#include "checker/quadrature/lock_step.hpp"

namespace veritrack::checker {

const Ball& lock_room() {
  static const Ball room(0x1p-14);
  return room;
}

LockCovariance operator+(const LockCovariance& x, const LockCovariance& y) {
  return {x.p11 + y.p11, x.p22 + y.p22, x.p23 + y.p23, x.p33 + y.p33, x.p12 + y.p12, x.p13 + y.p13};
}
LockCovariance operator*(const Ball& factor, const LockCovariance& x) {
  return {factor * x.p11, factor * x.p22, factor * x.p23, factor * x.p33, factor * x.p12, factor * x.p13};
}
LockCovariance inverse(const LockCovariance& p) {
  // By cofactors.
  const Ball c11 = p.p22 * p.p33 - square(p.p23);
  const Ball c12 = p.p13 * p.p23 - p.p12 * p.p33;
  const Ball c13 = p.p12 * p.p23 - p.p13 * p.p22;
  const Ball over = one / (p.p11 * c11 + p.p12 * c12 + p.p13 * c13);
  return {over * c11,
          over * (p.p11 * p.p33 - square(p.p13)),
          over * (p.p12 * p.p13 - p.p11 * p.p23),
          over * (p.p11 * p.p22 - square(p.p12)),
          over * c12,
          over * c13};
}

Matrix3 whole(const LockCovariance& p) {
  Matrix3 m = diagonal(p.p11, p.p22, p.p33);
  m[0][1] = m[1][0] = p.p12;
  m[0][2] = m[2][0] = p.p13;
  m[1][2] = m[2][1] = p.p23;
  return m;
}
LockCovariance lock_covariance(const Matrix3& p) {
  return {p[0][0], p[1][1], p[2][1], p[2][2], p[1][0], p[2][0]};
}

LockCovariance upper_covariance(const LockSet& set, const Ball& s) {
  return set.centre + s * set.above;
}
LockCovariance lower_covariance(const LockSet& set, const Ball& s) {
  return inverse(inverse(set.centre) + s * set.below);
}

namespace {

/// -x d x: the slope of (... + s d)^-1 where its value is x.
LockCovariance slope_of_inverse(const LockCovariance& x, const LockCovariance& d) {
  return Ball(-1.0) * lock_covariance(congruent(whole(x), whole(d)));
}

/// The prediction z = (1 + e1, e2), seen from the true phase; the half widths of the box.
struct Place {
  Chord z1, z2, z1_squared, z2_squared, z1_z2;
  std::array<Ball, kSides> half_widths;

  /// The same number, whose range its chords may make narrower.
  [[nodiscard]] Chord narrowed(Chord x) const {
    Ball reach;
    for (std::size_t k = 0; k < kSides; ++k) {
      reach += abs(x.by[k]) * half_widths[k];
    }
    const Ball by_chords = x.centre + Ball::within(reach);
    Ball both;
    if (x.range.finite() && by_chords.finite() &&
        arb_intersection(both.raw(), x.range.raw(), by_chords.raw(), precision()) != 0) {
      x.range = both;
    }
    return x;
  }
};

/// F P F', F = [[1, 0, -z2], [0, 1, z1], [0, 0, kept]].
Lower3<Chord> carried(const LockCovariance& p, const Place& at, const Ball& kept) {
  const Chord across = p.p33 * at.z1 + p.p23;
  Lower3<Chord> x;
  x[0][0] = p.p33 * at.z2_squared + p.p11;
  x[1][0] = -(p.p33 * at.z1_z2 + p.p23 * at.z2);
  x[1][1] = p.p33 * at.z1_squared + (two * p.p23) * at.z1 + p.p22;
  x[2][0] = -((kept * p.p33) * at.z2);
  x[2][1] = kept * across;
  x[2][2] = square(kept) * p.p33;
  if (!certainly_equal(p.p12, zero) || !certainly_equal(p.p13, zero)) {
    x[0][0] = x[0][0] - (two * p.p13) * at.z2;
    x[1][0] = x[1][0] + p.p13 * at.z1 + p.p12;
    x[2][0] = x[2][0] + kept * p.p13;
  }
  return x;
}

/// The quantities of a covariance, before the frame is turned to the next phase.
struct Image {
  std::array<Chord, 3> weight;     ///< r S^-1 = I - Phi_zz/r: 11, 12, 22
  std::array<Chord, 2> frequency;  ///< S^-1 Phi_z3 of the prediction = Phi_z3/r
  Chord variance;                  ///< Phi_33
  Lower3<Chord> slope;             ///< A d A', A = (I - K H) F
};

Image image_of(const LockFilter& f, const LockCovariance& p, const LockCovariance& d, const Place& at) {
  const auto narrow = [&](const Chord& number) { return at.narrowed(number); };
  const Ball kept = one - f.epsilon;
  const Lower3<Chord> x = carried(p, at, kept);
  const Lower3<Chord> y = carried(d, at, kept);
  const Chord s11 = x[0][0] + (f.q1 + f.r);
  const Chord s22 = x[1][1] + (f.q1 + f.r);
  const Chord over = narrow(f.r * reciprocal(narrow(s11 * s22 - square(x[1][0]))));
  const Chord w11 = narrow(s22 * over);
  const Chord w12 = narrow(-(x[1][0] * over));
  const Chord w22 = narrow(s11 * over);
  const Ball over_r = one / f.r;
  Image image;
  const Chord g1 = narrow(over_r * (w11 * x[2][0] + w12 * x[2][1]));
  const Chord g2 = narrow(over_r * (w12 * x[2][0] + w22 * x[2][1]));
  image.variance = narrow(x[2][2] + f.q2 - (g1 * x[2][0] + g2 * x[2][1]));
  // I - K H = [[r S^-1, 0], [-g', 1]].
  const Chord a11 = narrow(w11 * y[0][0] + w12 * y[1][0]);
  const Chord a12 = narrow(w11 * y[1][0] + w12 * y[1][1]);
  const Chord a21 = narrow(w12 * y[0][0] + w22 * y[1][0]);
  const Chord a22 = narrow(w12 * y[1][0] + w22 * y[1][1]);
  image.slope[0][0] = narrow(a11 * w11 + a12 * w12);
  image.slope[1][0] = narrow(a21 * w11 + a22 * w12);
  image.slope[1][1] = narrow(a21 * w12 + a22 * w22);
  const Chord c1 = narrow(y[2][0] - (y[0][0] * g1 + y[1][0] * g2));
  const Chord c2 = narrow(y[2][1] - (y[1][0] * g1 + y[1][1] * g2));
  image.slope[2][0] = narrow(w11 * c1 + w12 * c2);
  image.slope[2][1] = narrow(w12 * c1 + w22 * c2);
  image.slope[2][2] = narrow(y[2][2] - (g1 * (c1 + y[2][0]) + g2 * (c2 + y[2][1])));
  image.weight = {w11, w12, w22};
  image.frequency = {g1, g2};
  return image;
}

/// The turn by the frequency error.
struct Turn {
  Chord sine, cosine, sine_twice, cosine_twice;
};
std::array<Chord, 2> turned(const Chord& x, const Chord& y, const Turn& by) {
  return {x * by.cosine - y * by.sine, x * by.sine + y * by.cosine};
}
/// U X U', U = diag(Rot, 1).
Lower3<Chord> turned(const Lower3<Chord>& x, const Turn& by, const Place& at) {
  const Chord mean = at.narrowed(half * (x[0][0] + x[1][1]));
  const Chord off = at.narrowed(half * (x[0][0] - x[1][1]));
  const Chord moved = off * by.cosine_twice - x[1][0] * by.sine_twice;
  const std::array<Chord, 2> last = turned(x[2][0], x[2][1], by);
  Lower3<Chord> y;
  y[0][0] = mean + moved;
  y[1][0] = off * by.sine_twice + x[1][0] * by.cosine_twice;
  y[1][1] = mean - moved;
  y[2][0] = last[0];
  y[2][1] = last[1];
  y[2][2] = x[2][2];
  return y;
}

Lower3<Chord> covariance_of(const Image& image, const Ball& r) {
  Lower3<Chord> x;
  x[0][0] = r * (Chord(one) - image.weight[0]);
  x[1][0] = -(r * image.weight[1]);
  x[1][1] = r * (Chord(one) - image.weight[2]);
  x[2][0] = r * image.frequency[0];
  x[2][1] = r * image.frequency[1];
  x[2][2] = image.variance;
  return x;
}

}  // namespace

LockStep lock_step(const LockFilter& filter, const LockSet& set, const std::array<Chord, 3>& u,
                   const Ball& level) {
  std::array<Ball, kSides> half_widths;
  for (std::size_t k = 0; k < kSides; ++k) {
    half_widths[k] = abs(u[k].range - u[k].centre).upper();
  }
  const Metric& t = set.metric;
  const Chord e3 = (one / t.frequency) * u[2];
  const Chord frequency = e3 + set.bias[2];
  const Chord e2 = (one / t.phase) * (u[1] - t.coupling * e3) + set.bias[1];
  const Chord z1 = (one / t.amplitude) * u[0] + (one + set.bias[0]);
  const Place at{z1, e2, square(z1), square(e2), z1 * e2, half_widths};
  const LockCovariance low = lower_covariance(set, level);
  const Image lower = image_of(filter, low, slope_of_inverse(low, set.below), at);
  const Image upper = image_of(filter, upper_covariance(set, level), set.above, at);
  const Chord sine = sin(frequency);
  const Chord cosine = cos(frequency);
  const Turn turn{sine, cosine, two * (sine * cosine), Chord(one) - two * square(sine)};
  LockStep step;
  step.lower = turned(covariance_of(lower, filter.r), turn, at);
  step.upper = turned(covariance_of(upper, filter.r), turn, at);
  step.lower_slope = turned(lower.slope, turn, at);
  step.upper_slope = turned(upper.slope, turn, at);
  // The predicted estimate minus the signal, in the frame of this sample: z - e^-i nu.
  const Chord d1 = at.narrowed(z1 - turn.cosine);
  const Chord d2 = at.narrowed(e2 + sine);
  step.prediction = turned(d1, d2, turn);
  for (Chord& p : step.prediction) {
    p = at.narrowed(p);
  }
  std::array<Chord, 3> weight;
  for (std::size_t i = 0; i < 3; ++i) {
    weight[i] = at.narrowed(half * (lower.weight[i] + upper.weight[i]));
  }
  const std::array<Chord, 2> mean = turned(at.narrowed(weight[0] * d1 + weight[1] * d2),
                                           at.narrowed(weight[1] * d1 + weight[2] * d2), turn);
  // The leak takes a share of the frequency itself.
  const Ball taken = filter.epsilon * half * (set.lowest_frequency + set.highest_frequency);
  step.reach = filter.epsilon * half * (set.highest_frequency - set.lowest_frequency);
  step.mean = {mean[0] - set.bias[0], mean[1] - set.bias[1],
               (one - filter.epsilon) * frequency - (taken + set.bias[2]) -
                   half * ((lower.frequency[0] + upper.frequency[0]) * d1 +
                           (lower.frequency[1] + upper.frequency[1]) * d2)};
  return step;
}

}  // namespace veritrack::checker
