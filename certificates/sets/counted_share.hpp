// Estimates of a probability from a count over independent trials. Nothing here is proved.
#pragma once

#include <cstdint>

namespace veritrack::certificates {

/// A count, and the limits of C. J. Clopper and E. S. Pearson (Biometrika 26, 1934) for the probability, each
/// of which it misses with a probability of at most 0.005.
struct CountedShare {
  std::int64_t count = 0;
  double low = 0.0, high = 1.0;
};

/// 0 <= count <= trials, trials at least 1; with round-to-nearest. To about ten digits, without directed
/// rounding.
[[nodiscard]] CountedShare counted_share(std::int64_t count, std::int64_t trials);

}  // namespace veritrack::certificates
