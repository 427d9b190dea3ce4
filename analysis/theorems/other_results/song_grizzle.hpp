// Y. Song, J. W. Grizzle, "The extended Kalman filter as a local asymptotic observer for nonlinear
// discrete-time systems", 1993, theorem 3.2, as the thesis states it (theorem 2.5), for a design of the
// quadrature tracker. The thesis writes it for one output; the formulas are read as matrix formulas.
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// id "song-grizzle": its assumptions concern all states, and fail for the tracker: the Gramian is singular
/// at z = 0, and |F| is not bounded. Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_song_grizzle(const TrackerInput& input);

/// id "song-grizzle/local": the suprema over the states that the filter meets, p, q, r of theorem 2.4 from
/// sound bounds, and the largest |e_0| for which varphi <= -gamma < 0. Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_song_grizzle_local(const TrackerInput& input);

}  // namespace veritrack::theorems
