// The values of sums of waves where these do not depend on the phase of the signal: angles and linear values
// (docs/gain-proof.md, section 2).
#pragma once

#include <optional>

#include "checker/model/gain/linear_frame.hpp"
#include "checker/model/gain/waves.hpp"

namespace veritrack::checker {

/// x + j y = g e^(j quarters pi/2) M, or its conjugate, with a positive g.
struct TurnedWave {
  Wave wave;
  int quarters = 0;
  bool is_conjugate = false;
};
/// Whether x + j y is such a number, with a factor that is certainly not 0.
std::optional<TurnedWave> turned_wave(LinearFrame& frame, const Waves& y, const Waves& x);
/// The value of the argument of x + j y, modulo 2 pi.
int argument(LinearFrame& frame, const TurnedWave& wave);

/// Whether all lengths in it are above 0, which is a limit from now on.
bool keeps_positive(LinearFrame& frame, const Wave& wave);
/// Of two channels: whether some wave depends on the phase of the signal.
bool turns_with_signal(LinearFrame& frame, const Waves& waves);

/// The value turns (phi + omega) + sum of times L of a wave.
int angle_of(LinearFrame& frame, const Wave& wave);
/// The angles of the first wave, not a real one, with this length as a factor, a positive real weight and
/// these turns, none of them of the sample.
std::optional<Wave> own_wave(LinearFrame& frame, const Waves& waves, int length, long turns);

/// As a linear value. Throws NotCovered where a wave depends on the phase; in one channel it is a ripple
/// then.
int linear_value(LinearFrame& frame, const Waves& waves);

}  // namespace veritrack::checker
