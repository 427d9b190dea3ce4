// The output and the input of a plant under the minimum-variance law at a tracker's frequencies: the
// derivation "regulator" (docs/regulator.md).
#pragma once

#include <optional>
#include <vector>

#include "checker/sets/frequency_promise.hpp"

namespace veritrack::checker {

/// A_1 x(k+1) = B_1 u(k), in the delay.
struct DelayPlant {
  std::vector<Ball> a;  ///< 1, a_1, ...
  std::vector<Ball> b;  ///< b_0, b_1, ..., as many as a_1, ...
};

/// The derivation as the checker finds it; `promise` is empty when nothing about the tracker is verified.
/// `settling`: the sample from which on the output has settled, if the certificate states one.
Derivation output_bound(const DelayPlant& plant, const std::optional<FrequencyPromise>& promise,
                        const std::optional<Ball>& settling);

}  // namespace veritrack::checker
