// The parts of a band for which tubes were proved.
#pragma once

#include <string>
#include <vector>

#include "analysis/model/set/tube_set.hpp"

namespace veritrack::model {

/// The tubes of one part: numbers from `first` up to, but not including, `end`.
struct TubeRun {
  std::size_t first = 0;
  std::size_t end = 0;
  FrequencyRange range;  ///< the part of the band that they cover, rounded inward
};

/// The parts of low <= omega <= high, rad/sample, that tubes in the order of their frequencies cover without
/// gaps, as far as they are of any width; tubes of one part turn alike.
[[nodiscard]] std::vector<TubeRun> runs_of(const std::vector<ProvedTube>& tubes, double low, double high);

/// The widest one, the first among equals. Throws std::invalid_argument when there is none.
[[nodiscard]] const TubeRun& widest(const std::vector<TubeRun>& runs);

/// Records which part of the band the tubes of a set, in any order, cover, and whether that is all of it.
/// Otherwise keeps only those of the widest part.
void keep_widest_part(TubeSet& set, double low, double high);

/// Cells for which nothing was found, and the reasons; neighbours with equal reasons are reported together.
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
