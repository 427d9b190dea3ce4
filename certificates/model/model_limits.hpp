// The largest numbers that are proved for a model, by any of its sets: a set for some noise shows that this
// noise is tolerated, one for a slew that this slew is, and each of them, without either, its reach. All of
// this concerns only sets that are a lock.
#pragma once

#include <optional>

#include "certificates/model/band_part.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

/// The largest number that some set proves, and the set; 0 and null where there is none. Among equal ones it
/// is the set that was made for it.
struct LargestOfSets {
  double size = 0.0;
  const model::ProvedSet* set = nullptr;
};

/// At a constant frequency, for the whole band or, where no noise is proved for all of it, for the widest
/// part for which some is.
struct ModelLimits {
  LargestOfSets noise;           ///< signal units
  LargestOfSets reach;           ///< rad/sample; none with a bias: no set has errors of both signs
  std::optional<BandPart> part;  ///< none: the whole band
};
/// Empty where no noise is proved.
[[nodiscard]] std::optional<ModelLimits> limits_of(const ModelSets& sets, const ModelAssumptions& assume);

/// For a frequency that moves within the band, or the part.
struct SlewLimit {
  LargestOfSets slew;  ///< rad/sample per sample, together with the noise of its set
  std::optional<BandPart> part;
};
/// Empty where no slew is proved.
[[nodiscard]] std::optional<SlewLimit> slew_limit_of(const ModelSets& sets, const ModelAssumptions& assume);

/// Over the whole band.
[[nodiscard]] LargestOfSets largest_noise(const ModelSets& sets);
[[nodiscard]] LargestOfSets largest_slew(const ModelSets& sets);

}  // namespace veritrack::certificates
