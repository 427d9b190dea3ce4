// The bounds that a certificate proves on the frequency error for every tone that its design assumes: a
// system that runs on the estimate may rely on them.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "analysis/rigor/interval.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

struct FrequencyPromise {
  // The assumptions on the tone.
  Number amplitude;                 ///< constant, signal units
  std::array<Number, 2> frequency;  ///< [lowest, highest], rad/sample
  Number noise;                     ///< at most, signal units; empty where there is no bound
  Number slew;                      ///< at most, rad/sample per sample
  bool two_channels = false;        ///< the noise is a vector in the plane

  std::string sentence;   ///< the guarantee with all hypotheses; empty when nothing is proved
  std::string objection;  ///< the reason why nothing is proved; empty otherwise
  // Upper bounds on |frequency error|, rad/sample; empty unless there is a sentence.
  std::optional<rigor::Interval> for_ever;
  std::optional<double> settling_samples;  ///< from then on at most settled_error
  std::optional<rigor::Interval> settled_error;
  std::optional<rigor::Interval> ultimate;  ///< in the long run
};

/// The promise of an extended Kalman filter's certificate: its claim "ekf/guarantee". Needs the upward mode.
[[nodiscard]] FrequencyPromise ekf_frequency_promise(const Certificate& certificate,
                                                     const Assumptions& assume, bool two_channels);

}  // namespace veritrack::certificates
