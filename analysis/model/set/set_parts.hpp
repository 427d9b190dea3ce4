// The parts of a band for which tubes were proved.
#pragma once

#include <string>
#include <vector>

#include "analysis/model/set/tube_set.hpp"

namespace veritrack::model {

/// Which tubes form one part: numbers from `first` up to, without it, `end`.
struct TubeRun {
  std::size_t first = 0;
  std::size_t end = 0;
  FrequencyRange range;  ///< what they cover of the band, rounded inward
};

/// The parts of low <= omega <= high, rad/sample, that tubes in the order of their frequencies cover without
/// gaps, as far as they are of any width; tubes of one part turn alike.
[[nodiscard]] std::vector<TubeRun> runs_of(const std::vector<ProvedTube>& tubes, double low, double high);

/// The widest one, of equals the first. Throws std::invalid_argument when there is none.
[[nodiscard]] const TubeRun& widest(const std::vector<TubeRun>& runs);

/// Says what the tubes of a set, in any order, cover of the band, and whether that is all of it. Otherwise
/// keeps those of the widest part alone.
void keep_widest_part(TubeSet& set, double low, double high);

/// Cells for which nothing was found, and why; neighbours with equal reasons are told together.
class FailedCells {
 public:
  void add(const std::string& reason, double low, double high);
  /// "no radius was proved between 0.1 and 0.2 rad/sample", one for each.
  [[nodiscard]] std::vector<std::string> reasons() const;

 private:
  struct Failure {
    std::string reason;
    FrequencyRange range;
  };
  std::vector<Failure> failures_;
};

}  // namespace veritrack::model
