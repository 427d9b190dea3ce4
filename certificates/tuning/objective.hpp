// The objectives of `veritrack tune` for an extended Kalman filter.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

enum class Objective { long_run, for_ever, radius, noise, slew, lowest_snr, rms, simulated_rms };

/// The numbers that are certified for design values, or, where stated, estimated: for a search, whose result
/// is certified afterwards. Unknown numbers have the worst value.
struct CertifiedValues {
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  // Noise with a bound:
  double long_run = kInfinite;  ///< |frequency error| in the long run, rad/sample
  double for_ever = kInfinite;  ///< |frequency error| from the assumed starts on, rad/sample
  double radius = 0.0;          ///< in frequency, of the certified set, rad/sample
  double noise = 0.0;           ///< tolerated at a constant frequency, of the amplitude
  double slew = 0.0;            ///< tolerated without noise, rad/sample per sample
  double settles = kInfinite;   ///< samples after which `settled_below` of [require] is kept

  // Gaussian noise, estimated from sampled points:
  double lock_margin = -1.0;      ///< of the inequality behind a probability of losing lock, assumed noise
  double lowest_snr = kInfinite;  ///< at which the probability can be certified, dB
  double rms = kInfinite;         ///< of the frequency error in lock, rad/sample

  // Simulated:
  double simulated_rms = kInfinite;  ///< of the frequency error, rad/sample
  double simulated_deviation = 0.0;  ///< its standard error
};

/// With less of it at the sampled points, a probability of losing lock takes too long to be proved.
inline constexpr double kEnoughMargin = 0.03;

struct ObjectiveWords {
  Objective objective = Objective::long_run;
  std::string_view name;   ///< as the command line has it
  std::string_view words;  ///< its words in a sentence
  bool with_bound = true;  ///< makes sense for noise with a bound
  bool with_gaussian = false;
};

inline constexpr std::array<ObjectiveWords, 8> kObjectiveWords{{
    {Objective::long_run, "long-run", "the certified bound on the frequency error in the long run", true,
     false},
    {Objective::for_ever, "for-ever", "the certified bound on the frequency error for ever", true, false},
    {Objective::radius, "radius", "how far the certified set reaches in frequency", true, false},
    {Objective::noise, "noise", "the noise that is tolerated at a constant frequency", true, false},
    {Objective::slew, "slew", "the slew that is tolerated without noise", true, false},
    {Objective::rms, "rms", "the bound on the root mean square of the frequency error in lock", false, true},
    {Objective::lowest_snr, "lowest-snr",
     "the lowest signal-to-noise ratio at which the probability of losing lock can be certified", false,
     true},
    {Objective::simulated_rms, "simulated-rms", "the simulated root mean square of the frequency error", true,
     true},
}};

[[nodiscard]] const ObjectiveWords& words_of(Objective objective);
/// The objective of that name; empty when there is none.
[[nodiscard]] std::optional<Objective> objective_called(std::string_view name);

/// The value of an objective: rad/sample, of the amplitude, rad/sample per sample, or dB.
[[nodiscard]] double value_of(const CertifiedValues& values, Objective objective);
/// Whether less of it is better.
[[nodiscard]] bool is_to_be_small(Objective objective);
/// More is better: a logarithm of the value, where a factor of e counts 1, as do 8.7 dB. Minus infinity where
/// nothing is known.
[[nodiscard]] double merit_of(const CertifiedValues& values, Objective objective);
/// "0.0021 rad/sample (3.4 Hz)", "16.3 dB": rounded to the side that makes it true.
[[nodiscard]] std::string shown(const CertifiedValues& values, Objective objective,
                                const Assumptions& assume);
/// The same with the unit of noise; frequencies also in Hz where there is a rate (Hz), which must outlive the
/// call.
[[nodiscard]] std::string shown(const CertifiedValues& values, Objective objective,
                                const std::optional<Number>& sample_rate, std::string_view noise_unit);

/// Whether something has to be certified, or estimated, to judge values: simulations are compared as they are
/// where nothing is required.
[[nodiscard]] bool asks_for_proofs(Objective objective, const Requirements& require);

/// Everything that is needed to judge values: the objective, and the requirements of [require].
[[nodiscard]] std::set<Objective> needed(Objective objective, const Assumptions& assume,
                                         const Requirements& require);

}  // namespace veritrack::certificates
