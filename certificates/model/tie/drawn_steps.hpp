// States and samples that steps are compared from.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "certificates/model/tie/evaluation.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::tie {

/// Random numbers that are the same on every platform: only the engine's words are used.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}
  /// Any 64 bits.
  std::uint64_t word() { return engine_(); }
  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(word() >> 11U) * 0x1p-53);
  }
  /// In {0, ..., count - 1}.
  std::uint64_t below(std::uint64_t count) { return word() % count; }

 private:
  std::mt19937_64 engine_;
};

/// Where to draw.
struct DrawRanges {
  struct Range {
    double low = 0.0;
    double high = 0.0;
  };
  std::vector<Range> states;  ///< one for each state of the listing, in its order
  Range amplitude{1.0, 1.0};  ///< of the tone that samples are of
  double noise = 0.0;         ///< of each sample, at most
};

/// Steps, and how they were found.
struct DrawnSteps {
  std::vector<StepInput> steps;
  int beside_branches = 0;      ///< so many of the steps are beside a point where a comparison changes
  int comparisons = 0;          ///< of the listing
  int changed_comparisons = 0;  ///< beside whose points some steps are
  std::map<int, int> left_out;  ///< how many did not keep an obligation, by the number of the obligation
};

/// `count` steps, or as many as are found, for which all obligations of the listing are kept. Nine of ten
/// begin near the start, in the ranges, or at numbers such as 0; the others are pairs of neighbouring inputs
/// between which a comparison of the listing changes.
[[nodiscard]] DrawnSteps drawn_steps(const trackers::code::Listing& listing, const DrawRanges& ranges,
                                     int count, std::uint64_t seed);

}  // namespace veritrack::certificates::tie
