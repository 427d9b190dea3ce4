#include "analysis/single_channel/frozen_observer.hpp"

#include <cmath>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;

/// The denominator z^2 - trace z + determinant.
struct Denominator {
  Interval trace;
  Interval determinant;
};

Denominator denominator_of(const FrozenGain<Interval>& gain) {
  const auto [sine, cosine] = rigor::sin_cos(gain.frequency);
  return {gain.k2 * sine + (Interval(2.0) - gain.k1) * cosine, Interval(1.0) - gain.k1};
}

/// The largest modulus of a root.
Interval largest_root(const Denominator& polynomial) {
  const Interval half = Interval(0.5) * polynomial.trace;
  const Interval discriminant = rigor::square(half) - polynomial.determinant;
  if (rigor::certainly_negative(discriminant)) {
    return rigor::sqrt(polynomial.determinant);
  }
  return rigor::abs(half) + rigor::sqrt(discriminant);
}

}  // namespace

Interval response_magnitude(const FrozenGain<Interval>& gain, const Interval& theta) {
  // |z^2 - t z + d| on z = e^{j theta}: times e^{-j theta} it is (1 + d) cos theta - t + j (1 - d) sin theta,
  // and for the numerator, t = 2 cos x3 and d = 1, that is 2 (cos theta - cos x3).
  const auto [sine, cosine] = rigor::sin_cos(theta);
  const Denominator polynomial = denominator_of(gain);
  const Interval one(1.0);
  const Interval real = (one + polynomial.determinant) * cosine - polynomial.trace;
  const Interval imaginary = (one - polynomial.determinant) * sine;
  const Interval numerator = rigor::abs(Interval(2.0) * (cosine - rigor::cos(gain.frequency)));
  return numerator / rigor::sqrt(rigor::square(real) + rigor::square(imaginary));
}

FrozenGain<double> mean_gain(const trackers::ToneModel<double>& design, double frequency) {
  const rigor::NearestRounding nearest;
  constexpr int kSettling = 4000;
  constexpr int kMeanOver = 4000;
  trackers::SingleChannelEkf<double> tracker(
      trackers::single_channel_design(design),
      {1.0, 0.0, frequency, trackers::diagonal_process_noise(design.r + design.q1, design.q2)});
  FrozenGain<double> gain{0.0, 0.0, frequency};
  for (int k = 1; k <= kSettling + kMeanOver; ++k) {
    tracker.step(std::cos(frequency * k));
    if (k > kSettling) {
      const Eigen::Matrix3d predicted = tracker.predicted().covariance.matrix();
      const double variance = predicted(0, 0) + design.r;
      gain.k1 += predicted(0, 0) / variance / kMeanOver;
      gain.k2 += predicted(1, 0) / variance / kMeanOver;
    }
  }
  return gain;
}

theorems::Derivation transfer_function(const FrozenGain<double>& gain) {
  using theorems::compare;
  const FrozenGain<Interval> exact{Interval(gain.k1), Interval(gain.k2), Interval(gain.frequency)};
  const Denominator polynomial = denominator_of(exact);
  const Interval one(1.0);
  const std::string source = "IEEE Trans. Automatic Control 45(9), 2000, equation (6), corrected";
  theorems::Derivation derivation;
  derivation.id = "single-channel/transfer-function";
  derivation.title =
      "Stability of the tracker with frozen frequency and gain, from measurement to innovation";
  theorems::add_quantity(derivation, {"gain_1", "K_1", "", source, "gain of the measured channel"}, exact.k1);
  theorems::add_quantity(derivation, {"gain_2", "K_2", "", source, "gain of the other channel"}, exact.k2);
  theorems::add_quantity(derivation,
                         {"zero_angle", "\\angle z_0", "\\bar x_3", source, "angle of the zeros, rad/sample"},
                         exact.frequency);
  theorems::add_quantity(
      derivation,
      {"pole_radius", "\\max |z_p|", "z^2 - z(K_2 \\sin \\bar x_3 + (2 - K_1) \\cos \\bar x_3) + 1 - K_1 = 0",
       source, "largest modulus of a pole"},
      largest_root(polynomial));
  derivation.conditions.push_back(compare(
      "jury-product", "|1 - K_1| < 1", {"|1 - K_1|", rigor::abs(polynomial.determinant)}, theorems::one()));
  derivation.conditions.push_back(compare("jury-at-1", "0 < D(1)", theorems::zero(),
                                          {"D(1)", one - polynomial.trace + polynomial.determinant}));
  derivation.conditions.push_back(compare("jury-at-minus-1", "0 < D(-1)", theorems::zero(),
                                          {"D(-1)", one + polynomial.trace + polynomial.determinant}));
  derivation.notes.emplace_back(
      "The gain of the tracker is never constant, not even in its steady state: it varies with the phase of "
      "the signal. The frozen gain is its mean over the phase, from a simulation; the verdicts concern "
      "exactly these numbers. Stability of the frozen filter says nothing about the tracker itself.");
  theorems::conclude(derivation);
  return derivation;
}

}  // namespace veritrack::single_channel
