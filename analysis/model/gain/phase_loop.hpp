// A loop over its whole band, for bounds that are resolved over the phases: cells of frequencies with their
// bases, and how finely they are cut.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/phase_gains.hpp"
#include "analysis/search/deadline.hpp"

namespace veritrack::model {

/// The deadline was over before a basis and its bounds were found.
class NoTime : public NoFrame {
 public:
  using NoFrame::NoFrame;
};

class PhaseLoop {
 public:
  /// `with_slew`: for bounds with a slew, too, which needs one cell. Throws NoFrame, with the reason, where
  /// the rules do not cover the loop, there is no steady state or no basis, or errors decay too slowly or
  /// not; NoTime where the deadline is over before all was tried. Tracker and tone must outlive it. Needs the
  /// upward rounding mode.
  [[nodiscard]] static PhaseLoop make(const TrackerModel& tracker, const TrackedTone& tone,
                                      const rigor::Interval& band, bool with_slew,
                                      const search::Deadline& deadline);

  [[nodiscard]] const std::vector<FloquetCell>& cells() const { return cells_; }
  [[nodiscard]] const PhaseGridding& gridding() const { return gridding_; }

  /// With the rounding of the tracker's program from now on. Throws NoRounding. False where errors may not
  /// decay.
  bool round(ProgramRounding rounding);

  /// At a constant frequency: the bounds of some part of the frequencies, for a search.
  [[nodiscard]] const PhaseGains& probe() const { return *probe_; }
  /// Works on the bounds of every part by itself, at a constant frequency, in parallel; with the part's
  /// number. False where some part has none, or the task says so.
  using PartTask = std::function<bool(std::size_t part, const PhaseGains& gains)>;
  [[nodiscard]] bool for_each_part(const PartTask& task) const;
  [[nodiscard]] std::size_t parts() const { return cells_.size() * gridding_.parts; }
  /// For slews up to this one; empty where errors may not decay.
  [[nodiscard]] std::optional<PhaseGains> with_slew(double slew) const;

 private:
  PhaseLoop() = default;
  /// How finely the loop was cut, and what share of the gain was missed.
  struct Fineness {
    double missed = std::numeric_limits<double>::infinity();
    PhaseGridding gridding;
  };
  /// `moves`: as one of several parts.
  [[nodiscard]] std::optional<PhaseGains> gains_of(std::size_t part, bool moves = false) const;
  void order_factors();
  /// How many lags, and which of them one by one. Empty, or why there is none.
  std::string find_horizon(bool with_slew);
  /// Empty, or why there is none.
  std::string find_gridding(bool with_slew);
  /// Whether it is fine enough with some number of parts.
  bool find_parts(bool with_slew, Fineness& best);

  const TrackerModel* given_ = nullptr;
  const TrackedTone* tone_ = nullptr;
  TrackerModel tracker_;
  std::shared_ptr<ProgramRounding> rounding_;
  std::shared_ptr<trackers::Recursion> recursion_;  ///< with factors in a better order
  std::vector<FloquetCell> cells_;
  PhaseGridding gridding_;
  std::shared_ptr<PhaseGains> probe_;
};

}  // namespace veritrack::model
