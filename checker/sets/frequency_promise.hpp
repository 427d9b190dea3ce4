// The promises of a frequency tracker's certificate, once verified, to a program that runs on its estimate.
#pragma once

#include <optional>
#include <string>

#include "checker/document/design_number.hpp"
#include "checker/document/parts.hpp"
#include "checker/sets/guarantee.hpp"

namespace veritrack::checker {

/// Every number is an upper bound, except those that are assumed about the tone.
struct FrequencyPromise {
  Ball amplitude, noise,
      slew;   ///< constant; at most, for a sample; at most, for the frequency, rad/sample per sample
  Band band;  ///< rad/sample
  bool two_channels = false;  ///< the noise is a vector in the plane
  std::string between;        ///< "0.4 and 2.7 rad/sample"

  std::string sentence;  ///< the verified guarantee with all its hypotheses
  Ball for_ever;         ///< |frequency error|, rad/sample
  std::optional<Settled> settled;
  std::optional<Ball> ultimate;
};

/// The promises of a tracker's certificate whose verification is `found`. Empty unless all of it is verified,
/// its guarantee is PROVED for the whole band, and the tracker sees the tone alone, with noise that has a
/// bound.
std::optional<FrequencyPromise> frequency_promise(const Tree& certificate, const Verification& found,
                                                  Objections& objections);

}  // namespace veritrack::checker
