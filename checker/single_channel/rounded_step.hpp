// Bounds on the distance of a step of the single-channel tracker in double precision from the exact step: the
// checker's own transcription of the operations of trackers/single_channel/single_channel_ekf.hpp, a time
// update and a measurement update, with a bound on the size of each result (docs/rounding.md, "The
// single-channel tracker").
//
// Assumed of the program: checker/numbers/rounded_value.hpp, and sine and cosine within one unit in the last
// place. Lengths are relative to the true amplitude, which must be between 2^-60 and 2^60.
#pragma once

#include <optional>

#include "checker/single_channel/covariance_window.hpp"
#include "checker/single_channel/diagonal_start.hpp"

namespace veritrack::checker {

/// Bounds on the program's values before the step, in any orientation of the plane: P = [[M + d u u', d u],
/// [d u', d]].
struct HeldTone {
  Ball z;                ///< |z|
  Ball frequency;        ///< |x3|, rad/sample
  Ball measurement;      ///< |y|
  Ball least_m, most_m;  ///< eigenvalues of M; least_m >= 0
  Ball u;                ///< |u|
  Ball least_d, most_d;  ///< d; least_d > 0
};

/// Bounds on |program's step - exact step|: the length for z, the norms of the blocks for P. Balls of
/// everything when there is no bound.
struct ToneRounding {
  Ball z, frequency, p_zz, p_z3, p_33;
};
ToneRounding rounded_step(const SingleChannelDesign& design, const HeldTone& held);

/// The program's step is the exact step, followed by a change of e by at most `error` in the metric of the
/// program's P^-1, and a change of P by at most `covariance` times the result of the exact step, up or down
/// in the Loewner order. Balls of everything when there is no bound, or the share of P exceeds 2^-8.
struct StepRounding {
  Ball error, covariance;
  [[nodiscard]] bool finite() const { return error.finite() && covariance.finite(); }
};

/// In all states of the window under that noise (relative to the amplitude), and in the starts, when given.
StepRounding step_rounding(const SingleChannelDesign& design, const WindowStatement& window,
                           const Ball& noise, const std::optional<DiagonalStart>& start);

}  // namespace veritrack::checker
