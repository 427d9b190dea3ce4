// The single-channel tracker with its frequency estimate and its gain frozen: a linear filter of the
// measurement, the object of Proposition 1 of Bittanti and Savaresi (2000). Equation numbers are theirs.
//
// With R = Rot(x3) and h = (1, 0), (3) reads x(t) = R x(t-1) + K (y(t) - h R x(t-1)). Its characteristic
// polynomial is det(zI - (I - K h) R) = z^2 - z (K2 s + 2c - K1 c) + 1 - K1, c = cos x3, s = sin x3; and
// since (I - K h) R + K h R = R, the transfer function from y to the innovation is
//     G(z) = det(zI - R) / det(zI - (I - K h) R) = (z^2 - 2 c z + 1) / (z^2 - z (K2 s + 2c - K1 c) + 1 - K1).
// The printed (4) and (6) have another denominator, and (6) a factor z that makes it improper: see
// proposition_1.hpp.
#pragma once

#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/statements/derivation.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::single_channel {

/// The gain of z and the frequency at which the filter is frozen.
template <typename Scalar>
struct FrozenGain {
  Scalar k1;         ///< K1, of the measured channel
  Scalar k2;         ///< K2, of the other one
  Scalar frequency;  ///< x3, rad/sample
};

/// |G(e^{j theta})|, the corrected G, for every gain in `gain` and theta in `theta` (rad/sample). Not finite
/// where the denominator cannot be shown to stay away from zero. Needs the upward mode.
[[nodiscard]] rigor::Interval response_magnitude(const FrozenGain<rigor::Interval>& gain,
                                                 const rigor::Interval& theta);

/// The mean gain of the filter (2) in the frame of the signal plane, over the phases of a noise-free tone of
/// this frequency (rad/sample), after it has settled: a choice, made in double, at which to freeze it.
[[nodiscard]] FrozenGain<double> mean_gain(const trackers::ToneModel<double>& design, double frequency);

/// "single-channel/transfer-function": zeros, poles and the Jury conditions of the corrected G, at a gain
/// that is taken exactly. Needs the upward mode.
[[nodiscard]] theorems::Derivation transfer_function(const FrozenGain<double>& gain);

}  // namespace veritrack::single_channel
