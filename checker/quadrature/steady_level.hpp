// Does every step from one level of a set around the steady state end in the next one? With a leak.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "checker/quadrature/disc_cell.hpp"
#include "checker/quadrature/steady_rate.hpp"
#include "checker/quadrature/steady_state.hpp"
#include "checker/quadrature/steady_step.hpp"

namespace veritrack::checker {

/// A level, and the disturbances of the tracker.
struct SteadyLevel {
  Ball level;
  /// Lower bounds on the remainder of next level / level after slew and rounding: for e+ - e* in the metric,
  /// and for P+ - P* as a share of its bounds.
  Ball error_rate, covariance_rate;
  Ball noise;  ///< |v| <= noise
};

/// Cells of (x, y) and of the frequencies of one cell of the branch.
class SteadyCover {
 public:
  /// Begins with this division.
  SteadyCover(const SteadySetting& setting, const SteadyCell& steady, DiscDivision division = {})
      : setting_(setting), steady_(steady), division_(std::move(division)) {}

  /// Proves it for all (x, y) of the unit disc, and all frequencies of the cell.
  bool maps_into_next(const SteadyLevel& level);
  /// So far.
  [[nodiscard]] std::int64_t cells() const { return cells_; }
  /// The division of the last level.
  [[nodiscard]] const DiscDivision& division() const { return division_; }

 private:
  bool is_proved(const SteadyLevel& level, const DiscCell& cell, std::size_t node, int depth);
  /// `side` is the side along which to cut a cell where it fails.
  bool proves(const SteadyLevel& level, const DiscCell& cell, std::size_t& side);

  const SteadySetting& setting_;
  const SteadyCell& steady_;
  DiscDivision division_;
  /// For this level, by the ranges of x and of the frequency; they depend on nothing else.
  std::map<std::array<double, 4>, SteadyUpdate<Chord>> updates_;
  Multipliers multipliers_;  ///< of the last cell: where to begin
  std::int64_t cells_ = 0;
  bool hopeless_ = false;  ///< a small cell fails in its middle
};

}  // namespace veritrack::checker
