#include "checker/model/gain/wave_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace veritrack::checker {

namespace {

Ball product_of_constants(const LinearFrame& frame, const Wave& wave) {
  Ball product(1.0);
  for (const int constant : wave.constants) {
    product = product * frame.at(constant).constant;
  }
  return product;
}

Ball power(const Ball& x, int n) {
  Ball result(1.0);
  for (int i = 0; i < std::abs(n); ++i) {
    result = result * x;
  }
  return n < 0 ? one / result : result;
}

/// R(V): a bound on |(y/e^(j phase))^... - A^s| for a wave of this length and these turns.
Ball noise_in_wave(const Ball& least, const Ball& largest, int s, int m, const Ball& noise) {
  // The difference of powers grows with the amplitude for s > 0 and falls for s < 0.
  const Ball& worst = s >= 0 ? largest : least;
  const Ball of_amplitude = power(worst, s);
  Ball above = abs(power(worst + noise, s) - of_amplitude);
  if (s == std::abs(m)) {
    return above;
  }
  const Ball below = abs(power(worst - noise, s) - of_amplitude);
  const Ball angle = min(Ball(std::abs(m)) * arcsine(noise / least), pi());
  return max(above, below) + two * of_amplitude * sin(half * angle);
}

}  // namespace

int angle_of(LinearFrame& frame, const Wave& wave) {
  int result = frame.number(zero);
  if (wave.turns != 0) {
    result = frame.product(frame.number(Ball(wave.turns)), frame.sample_phase());
  }
  for (const auto& [angle, times] : wave.angles) {
    result = frame.sum(result, frame.product(frame.number(Ball(times)), angle));
  }
  return result;
}

std::optional<Wave> own_wave(LinearFrame& frame, const Waves& waves, int length, long turns) {
  for (const auto& [wave, gamma] : waves) {
    // A real wave has no direction.
    const bool is_own = !wave.is_real() && wave.turns == 0 && wave.noise == 0 && gamma[0] > 0 &&
                        gamma[1] == 0 &&
                        std::any_of(wave.lengths.begin(), wave.lengths.end(),
                                    [&](const auto& of) { return of.first == length; });
    if (is_own && frame.at(angle_of(frame, wave)).turns == turns) {
      return Wave{{}, 0, 0, wave.angles};
    }
  }
  return std::nullopt;
}

bool keeps_positive(LinearFrame& frame, const Wave& wave) {
  return std::all_of(wave.lengths.begin(), wave.lengths.end(), [&](const auto& length) {
    return length.first < 0 || frame.stays_positive(length.first);
  });
}

bool turns_with_signal(LinearFrame& frame, const Waves& waves) {
  return !frame.has_one_channel() && std::any_of(waves.begin(), waves.end(), [&](const auto& entry) {
    return frame.at(angle_of(frame, entry.first)).turns != 0;
  });
}

std::optional<TurnedWave> turned_wave(LinearFrame& frame, const Waves& y, const Waves& x) {
  if (x.size() != 1 || y.size() != 1 || x.begin()->first != y.begin()->first || has_noise(x)) {
    return std::nullopt;
  }
  const auto [real, imaginary] = x.begin()->second;
  const std::array<std::int64_t, 2> ahead{-imaginary, real};
  const std::array<std::int64_t, 2> behind{imaginary, -real};
  const std::array<std::int64_t, 2>& of_y = y.begin()->second;
  const Ball factor = product_of_constants(frame, x.begin()->first);
  const bool is_positive = certainly_positive(factor);
  if ((real != 0) == (imaginary != 0) || (of_y != ahead && of_y != behind) ||
      (!is_positive && !certainly_positive(-factor)) || !keeps_positive(frame, x.begin()->first)) {
    return std::nullopt;
  }
  // arg conj(gamma) of x, in quarter turns.
  const int quarters = (real > 0 ? 0 : real < 0 ? 2 : imaginary > 0 ? -1 : 1) + (is_positive ? 0 : 2);
  return TurnedWave{x.begin()->first, quarters, of_y == behind};
}

int argument(LinearFrame& frame, const TurnedWave& turned) {
  int result = angle_of(frame, turned.wave);
  if (turned.wave.turns != 0 && !frame.has_one_channel()) {
    result = frame.sum(result, frame.product(frame.number(Ball(turned.wave.turns)), frame.noise_angle()));
  }
  if (turned.quarters != 0) {
    result = frame.sum(result, frame.quarter_turns(turned.quarters));
  }
  return turned.is_conjugate ? frame.negated(result) : result;
}

namespace {

/// The remainder of c0 cos(lambda) + c1 sin(lambda) beyond c0 + c1 lambda.
struct WaveRemainder {
  std::string name;
  int angle;
  Ball even, odd;  ///< |c0| and |c1|
};

void add_remainder(LinearFrame& frame, LinearValue& sum, const WaveRemainder& remainder, const Ball& factor) {
  if (certainly_equal(factor, zero)) {
    return;
  }
  const std::size_t input = frame.named_input(remainder.name, [&] {
    return FrameInput{nullptr,
                      {remainder.angle},
                      [even = remainder.even, odd = remainder.odd](const std::vector<Ball>& bounds) {
                        const Ball& y = bounds.at(0);
                        return even * (one - cos(min(y, pi()))) + odd * (y - sin(y));
                      }};
  });
  LinearValue unit;
  unit.deviations[input] = {one, zero};
  add_deviations(sum, unit, factor);
}

/// In one channel: adds Re(conj(gamma) M), M in a disc because there is noise in it, or a ripple.
void add_disc(LinearFrame& frame, LinearValue& sum, const Wave& wave, const LinearValue& phase,
              const InputFactor& gamma) {
  const Ball amplitude =
      Ball::hull(power(frame.least_amplitude(), wave.length), power(frame.largest_amplitude(), wave.length));
  LinearValue unit;
  if (wave.noise > 0) {
    const std::size_t noise = frame.named_input("noise in " + name_of(wave), [&] {
      return FrameInput{
          [amplitude, n = wave.noise](const Ball& bound) { return amplitude * power(bound, n); },
          {},
          nullptr};
    });
    unit.deviations[noise] = gamma;
    add_deviations(sum, unit, one);
    return;
  }
  FrameRipple ripple{phase.turns, {}, amplitude.upper()};
  for (const auto& [source, factor] : phase.deviations) {
    if (source >= frame.states()) {
      throw NotCovered("the angle of a ripple depends on more than the states");
    }
    ripple.angle[source] = factor.first;
  }
  const std::size_t input = frame.named_input("ripple " + name_of(wave), [&] {
    return FrameInput{[size = ripple.size](const Ball& /*bound*/) { return size; }, {}, nullptr, ripple};
  });
  unit.deviations[input] = gamma;
  add_deviations(sum, unit, one);
}

/// Adds Re(conj(gamma) M), where M has linear values as factors.
void add_scaled(LinearFrame& frame, LinearValue& sum, const Wave& wave, const InputFactor& gamma) {
  if (wave.has_unknown_length()) {
    throw NotCovered("the length of a vector of states matters");
  }
  Wave bare = wave;
  bare.lengths.clear();
  const std::array<std::pair<Ball, std::array<std::int64_t, 2>>, 2> parts{
      {{gamma.first, {kExactUnit, 0}}, {gamma.second, {0, kExactUnit}}}};
  for (const auto& [factor, unit] : parts) {
    if (certainly_equal(factor, zero)) {
      continue;
    }
    int value = linear_value(frame, {{bare, unit}});
    for (const auto& [length, power] : wave.lengths) {
      const int scale = power > 0 ? length : frame.function("reciprocal", length);
      for (int i = 0; i < std::abs(power); ++i) {
        value = frame.product(value, scale);
      }
    }
    const LinearValue part = frame.at(value);
    sum.constant += factor * part.constant;
    sum.per_frequency += factor * part.per_frequency;
    add_deviations(sum, part, factor);
  }
}

/// At least what |1 + z|^s e^(j m arg(1 + z)) = (1 + z)^a (1 + z*)^b is off from 1 + s Re z + j m Im z, where
/// |z| <= share: no coefficient of its series is larger than that of one function of `share`.
Ball curvature_of_noise(int s, int m, const Ball& share) {
  const int order = std::max(std::abs(s), std::abs(m));
  const bool is_polynomial = s >= std::abs(m) && (s - m) % 2 == 0;
  if (!is_polynomial && !certainly_less(share, one)) {
    return Ball::everything();
  }
  const Ball whole = is_polynomial ? power(one + share, order) : power(one / (one - share), order);
  return abs(whole - one - Ball(order) * share);
}

/// Adds what noise does to Re(conj(gamma) M), with the noise as one input. `turned` is conj(gamma) e^(j b).
void add_one_noise(LinearFrame& frame, LinearValue& sum, const Wave& wave, const InputFactor& gamma,
                   const InputFactor& turned) {
  const int s = wave.length;
  const int m = wave.turns;
  const Ball least = frame.least_amplitude();
  const Ball largest = frame.largest_amplitude();
  const Ball slope = Ball::hull(power(least, s - 1), power(largest, s - 1));
  const int along = frame.noise_part(0);
  add_deviations(sum, frame.at(along), Ball(s) * slope * turned.first);
  add_deviations(sum, frame.at(frame.noise_part(1)), -(Ball(m) * slope * turned.second));
  const int angle = angle_of(frame, wave);
  const bool turns = !frame.at(angle).deviations.empty();
  if (s == 1 && std::abs(m) == 1 && !turns) {
    return;  // y itself
  }
  const Ball size = max(power(least, s), power(largest, s));
  const auto curved = [size, least, s, m](const Ball& noise) {
    return size * curvature_of_noise(s, m, noise / least);
  };
  const std::size_t rest = frame.named_input("one noise in " + name_of(wave), [&] {
    if (!turns) {
      return FrameInput{curved, {}, nullptr};
    }
    // |n| is at most the bound of its real part: that is the bound of the input itself.
    const Ball steepest = Ball(std::max(std::abs(s), std::abs(m))) * size / least;
    return FrameInput{nullptr, {angle, along}, [curved, steepest](const std::vector<Ball>& bounds) {
                        const Ball chord = two * sin(half * min(bounds.at(0), pi()));
                        return curved(bounds.at(1)) + steepest * bounds.at(1) * chord;
                      }};
  });
  LinearValue unit;
  unit.deviations[rest] = gamma;
  add_deviations(sum, unit, one);
}

/// Adds Re(conj(gamma) M) as a linear value; gamma = (real, imaginary).
void add_linear(LinearFrame& frame, LinearValue& sum, const Wave& wave, const Ball& real,
                const Ball& imaginary) {
  if (!wave.lengths.empty()) {
    add_scaled(frame, sum, wave, {real, imaginary});
    return;
  }
  const int s = wave.length;
  const int m = wave.turns;
  const int angle = angle_of(frame, wave);
  const LinearValue phase = frame.at(angle);
  if (frame.has_one_channel() && (wave.noise > 0 || phase.turns != 0)) {
    add_disc(frame, sum, wave, phase, {real, imaginary});
    return;
  }
  if (phase.turns != 0) {
    throw NotCovered("a value that depends on the phase of the signal is used other than in products");
  }
  const Ball amplitude = Ball::hull(power(frame.least_amplitude(), s), power(frame.largest_amplitude(), s));
  const Ball b = frame.base(phase);
  const Ball c0 = amplitude * (real * cos(b) + imaginary * sin(b));
  const Ball c1 = amplitude * (imaginary * cos(b) - real * sin(b));
  sum.constant += c0;
  add_deviations(sum, phase, c1);
  if (frame.has_one_noise() && (s != 0 || m != 0)) {
    add_one_noise(frame, sum, wave, {real, imaginary},
                  {real * cos(b) + imaginary * sin(b), real * sin(b) - imaginary * cos(b)});
  } else if (!frame.has_one_channel() && (s != 0 || m != 0)) {
    const std::size_t noise = frame.named_input("noise in " + name_of(wave), [&] {
      return FrameInput{[least = frame.least_amplitude(), largest = frame.largest_amplitude(), s,
                         m](const Ball& bound) { return noise_in_wave(least, largest, s, m, bound); },
                        {},
                        nullptr};
    });
    LinearValue unit;
    unit.deviations[noise] = {real, imaginary};
    add_deviations(sum, unit, one);
  }
  if (!phase.deviations.empty()) {
    frame.note_angle(angle);
    const Ball of_cosine = abs(amplitude * cos(b));
    const Ball of_sine = abs(amplitude * sin(b));
    add_remainder(frame, sum, {"real part of " + name_of(wave), angle, of_cosine, of_sine}, real);
    add_remainder(frame, sum, {"imaginary part of " + name_of(wave), angle, of_sine, of_cosine}, imaginary);
  }
}

}  // namespace

int linear_value(LinearFrame& frame, const Waves& waves) {
  return frame.made(name_of(waves), [&] {
    std::map<Wave, std::array<Ball, 2>> by_wave;
    for (const auto& [wave, gamma] : waves) {
      const Ball factor = product_of_constants(frame, wave) / Ball(static_cast<double>(kExactUnit));
      Wave alone = wave;
      alone.constants.clear();
      std::array<Ball, 2>& both = by_wave[alone];
      both[0] += factor * Ball(static_cast<double>(gamma[0]));
      both[1] += factor * Ball(static_cast<double>(gamma[1]));
    }
    LinearValue sum;
    for (const auto& [wave, gamma] : by_wave) {
      add_linear(frame, sum, wave, gamma[0], gamma[1]);
    }
    return sum;
  });
}

}  // namespace veritrack::checker
