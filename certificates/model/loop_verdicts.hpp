// The requirements of [require] on a linear loop, decided, each with the best number that is proved.
#pragma once

#include <string>

#include "analysis/linear/detector_loop.hpp"
#include "analysis/linear/stability.hpp"
#include "analysis/model/gain/loop_network.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::certificates {

/// PROVED and REFUTED with a little room, so that the checker, which computes in another way, need not be as
/// sharp. All need the upward rounding mode.
struct LoopVerdict {
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string proved;  ///< a decimal: a bound that is proved, or empty
};

/// The damping ratio of every mode is at least this; `proved`: another one.
[[nodiscard]] LoopVerdict damping_verdict(const model::LoopNetwork& network, const rigor::Interval& least);
/// The gain of the detector may grow by this many dB; `proved`: another number.
[[nodiscard]] LoopVerdict gain_margin_verdict(const linear::DetectorLoop& loop,
                                              const rigor::Interval& decibels);

/// The slowest mode shrinks by e in at most so many samples.
[[nodiscard]] rigor::Verdict time_constant_verdict(const linear::RadiusBounds& radius,
                                                   const rigor::Interval& samples);
/// The bandwidth is below this.
[[nodiscard]] rigor::Verdict bandwidth_verdict(const linear::DetectorLoop& loop,
                                               const rigor::Interval& required);

}  // namespace veritrack::certificates
