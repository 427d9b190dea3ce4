// From a bound on a tracker's frequency error to bounds on the output and the input of the regulator that
// uses it.
//
// trackers/regulator/frequency_regulator.hpp: A_1 y_{k+1} = 2 (cos omega - c_k) A_1 v_k with c_k = cos of the
// estimate, for a tone v; the contributions of frequency changes, measurement noise and the first samples,
// and the proof, are in docs/regulator.md, sections 1 to 4.
#pragma once

#include <optional>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::regulator {

/// From that sample on |frequency error| is at most this, rad/sample.
struct SettledFrequency {
  double samples;
  rigor::Interval error;
};

/// The proved bounds on the tracker's |frequency error|, rad/sample; empty where nothing is proved.
struct FrequencyBounds {
  std::optional<rigor::Interval> for_ever;
  std::optional<SettledFrequency> settled;
  std::optional<rigor::Interval> ultimate;  ///< of the limes superior
};

/// The plant, the disturbance and the tracker. Lengths in units of the output.
struct RegulatorQuestion {
  std::vector<rigor::Interval> a;   ///< 1, a_1, ..., a_p
  std::vector<rigor::Interval> b;   ///< b_0, ..., b_{p-1}
  rigor::Interval amplitude;        ///< of the disturbance
  rigor::Interval noise;            ///< |n_k| at most
  rigor::Interval lowest, highest;  ///< the frequencies at every sample, rad/sample
  rigor::Interval slew;             ///< |omega_{k+1} - omega_k| at most, rad/sample
  FrequencyBounds tracker;
};

/// The derivation "regulator": bounds on the output and the input for ever, from some sample on and in the
/// long run, and the resulting attenuation. Its conditions: A_1 and B_1 are Schur, and the tracker has a
/// bound. Needs the upward mode.
[[nodiscard]] theorems::Derivation derive_output_bound(const RegulatorQuestion& question);

}  // namespace veritrack::regulator
