// Random test inputs: a fixed seed, printed with every failure, and an effort multiplier from the
// environment.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace veritrack::test {

/// The seed of all property tests. Change it only here: a failure must be repeatable.
inline constexpr std::uint64_t kSeed = 20261121;

/// `count` times the environment variable VERITRACK_TEST_EFFORT (a positive real; 1 when unset or
/// unreadable).
inline std::int64_t effort(std::int64_t count) {
  const char* text = std::getenv("VERITRACK_TEST_EFFORT");
  const double factor = text != nullptr ? std::strtod(text, nullptr) : 1.0;
  return factor > 0.0 ? std::max<std::int64_t>(1, std::llround(static_cast<double>(count) * factor)) : count;
}

/// A generator whose stream is the same on every platform: only the engine's raw 64-bit words are used.
class Random {
 public:
  explicit Random(std::uint64_t stream = 0) : engine_(kSeed + stream) {}

  std::uint64_t word() { return engine_(); }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(word() >> 11) * 0x1p-53; }
  /// Uniform in [lower, upper).
  double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
  /// Uniform in {0, ..., count - 1}.
  std::uint64_t below(std::uint64_t count) { return word() % count; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace veritrack::test
