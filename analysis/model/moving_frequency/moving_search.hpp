// The search for levels that all cells of a band have in common, for a frequency that moves: see
// moving_set.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/model/moving_frequency/border.hpp"
#include "analysis/model/set/set_search.hpp"
#include "analysis/model/step/place_store.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model::detail {

using rigor::Verdict;

/// The search for levels that all cells of a band have in common. `progress` receives the share of the cells
/// in which the first level is proved.
class MovingSearch {
 public:
  MovingSearch(const TrackerModel& model, std::span<const TubeProposal> cells,
               const search::Deadline& deadline, TubeSet& set, SetProgress progress = {})
      : model_(&model), deadline_(&deadline), set_(&set), progress_(std::move(progress)) {
    double rate = 0.0;
    for (const TubeProposal& cell : cells) {
      ProvedTube proved;
      proved.tube = *cell.tube;
      proved.grid.deadline = deadline;
      widen(proved.tube);
      set.tubes.push_back(std::move(proved));
      rate = std::max(rate, cell.worth.rate);
      // Errors have to be smaller than the frequency.
      const double share = std::min(1.0, cell.frequency / std::max(cell.worth.reach, cell.frequency));
      const double level = share * cell.worth.level;
      level_ = level_ > 0.0 ? std::min(level_, level) : level;
      // For a shape that was not made for a slew: the slew that adds up to the reach.
      const double slew =
          share * (cell.worth.slew > 0.0 ? cell.worth.slew : cell.worth.reach * (1.0 - cell.worth.rate));
      most_slew_ = most_slew_ > 0.0 ? std::min(most_slew_, slew) : slew;
    }
    constexpr double kLittleRoom = 0.02;
    for (ProvedTube& proved : set.tubes) {
      proved.grid.phases = 1.0 - rate < kLittleRoom ? 64 : 32;
    }
    if (set.tubes.front().tube.bounds_covariance()) {
      set.covariance_margin = margin_at_borders();
    }
    constexpr int kFirstPhases = 16;
    grids_.assign(set.tubes.size(), {kFirstPhases, 1, 2 * static_cast<std::size_t>(kMostForFilter)});
    slow_ = 1.0 - 0.05 * (1.0 - rate);
    fast_ = 1.0 - 0.5 * (1.0 - rate);
    // All tubes are searched together.
    constexpr double kBytesOfPlaces = 2e8;
    constexpr std::size_t kMostPlaces = 192;
    const double bytes = kBytesOfPlaces / static_cast<double>(set.tubes.size());
    for (const ProvedTube& proved : set.tubes) {
      places_.push_back(std::make_unique<PlaceStore>(model, proved.tube,
                                                     std::min(kMostPlaces, places_in(proved.tube, bytes))));
    }
  }

  /// Levels for the noise and slew of the set.
  [[nodiscard]] bool find_levels() {
    kept_slew_ = set_->slew;
    const double radius = largest_radius(level_, [&](double tried) { return may_hold(tried, set_->slew); });
    if (!(radius > 0.0)) {
      find_failures();
    }
    for (const double factor : kFactors) {
      if (radius > 0.0 && proves(factor * radius, set_->slew)) {
        while (step_down()) {
        }
        return true;
      }
    }
    return false;
  }

  /// The largest slew, for the noise of the set, with one level. `known_slew`: what another set tolerates, or
  /// 0; the search begins with it where it finds nothing else.
  [[nodiscard]] bool find_slew(double known_slew = 0.0) {
    double slew = 0.0;
    double radius = 0.0;
    const auto try_radius = [&](double tried_radius, double least) {
      double tried = std::max(1.02 * slew, least);
      if (!(tried > 0.0) || !may_hold(tried_radius, tried)) {
        return;
      }
      for (double step = 1.6; step > 1.02; step = std::sqrt(step)) {
        while (may_hold(tried_radius, tried * step)) {
          tried *= step;
        }
      }
      slew = tried;
      radius = tried_radius;
    };
    constexpr double kHalf = 0.5;
    for (const double factor : {1.0, 0.75, kHalf, 0.3, 0.15, 0.07}) {
      if (factor < kHalf && slew > 0.0) {
        break;  // smaller ones are for where the guess was far too large
      }
      try_radius(factor * level_, 0.02 * most_slew_);
    }
    if (!(slew > 0.0)) {
      const double widest = largest_radius(level_, [&](double tried) { return may_hold(tried, known_slew); });
      try_radius(widest, known_slew);
      constexpr double kShare = 0.7;
      for (double least = 0.02; widest > 0.0 && !(slew > 0.0) && least > 1e-4; least *= kHalf) {
        try_radius(kShare * widest, least * most_slew_);
      }
    }
    // The first radius that works need not be the best.
    constexpr double kSmaller = 0.85;
    for (double before = 0.0; slew > before;) {
      before = slew;
      try_radius(kSmaller * radius, 0.0);
    }
    return std::any_of(kFactors.begin(), kFactors.end(),
                       [&](double factor) { return slew > 0.0 && proves(radius, factor * slew); });
  }

  /// After `find_slew`: the slew that each cell tolerates on its own, with the radius of the set.
  void find_own_slews() {
    for (ProvedTube& proved : set_->tubes) {
      const double radius = proved.levels.front();
      double tried = set_->slew;
      for (double step = 1.6; step > 1.02; step = std::sqrt(step)) {
        while (may_hold(proved, radius, tried * step)) {
          tried *= step;
        }
      }
      proved.own_slew = set_->slew;
      for (const double factor : kFactors) {
        if (factor * tried <= set_->slew || shrinks(proved, radius, 1.0, slow_, factor * tried)) {
          proved.own_slew = std::max(set_->slew, factor * tried);
          break;
        }
      }
    }
  }

  /// The cells in which the search failed, by their numbers.
  [[nodiscard]] const std::vector<std::size_t>& failed() const { return failed_; }

 private:
  static constexpr int kMostForFilter = 4096;  ///< cells of a grid
  static constexpr std::array<double, 8> kFactors{0.98, 0.95, 0.91, 0.86, 0.8, 0.72, 0.62, 0.5};

  [[nodiscard]] bool may_hold(const ProvedTube& proved, double radius, double slew) const {
    constexpr int kPhases = 16;
    return !deadline_->is_over() &&
           may_shrink(*model_, proved.tube,
                      {radius, set_->noise, 1.0, 1.0, slew, proved.levels.empty(), set_->covariance_margin},
                      kPhases, slow_, places_of(proved, slew));
  }
  [[nodiscard]] bool may_hold(double radius, double slew) const {
    return std::all_of(set_->tubes.begin(), set_->tubes.end(),
                       [&](const ProvedTube& proved) { return may_hold(proved, radius, slew); });
  }

  /// Only for the slew of the set: another slew is needed only once.
  [[nodiscard]] PlaceStore* places_of(const ProvedTube& proved, double slew) const {
    const auto number = static_cast<std::size_t>(&proved - set_->tubes.data());
    return slew == kept_slew_ ? places_[number].get() : nullptr;
  }
  /// The cells in which there is no level at all, whatever the others need.
  void find_failures() {
    failed_.clear();
    for (std::size_t i = 0; i < set_->tubes.size(); ++i) {
      const double radius =
          largest_radius(level_, [&](double tried) { return may_hold(set_->tubes[i], tried, set_->slew); });
      if (!(radius > 0.0)) {
        failed_.push_back(i);
      }
    }
  }

  /// The least share of themselves that bounds of the covariance lose at a new fit; part of the slack of the
  /// proposals, whose rest is for the width of cells.
  [[nodiscard]] double margin_at_borders() const {
    constexpr std::array<double, 3> kMargins{0.005, 0.0075, 0.01};
    constexpr double kHalf = 0.5;  // of the level, so that the bounds decide
    constexpr double kSlow = 1e-3;
    const double slew = most_slew_ > 0.0 ? kSlow * most_slew_ : 1e-9;
    const auto fits = [&](const Tube& from, const Tube& to, double margin) {
      return verify_border(*model_, from, to, {kHalf * level_, level_, slew, 1.0, margin},
                           set_->tubes.front().grid)
                 .verdict == Verdict::proved;
    };
    for (const double margin : kMargins) {
      bool all = true;
      for (std::size_t i = 0; i + 1 < set_->tubes.size() && all; ++i) {
        const Tube& a = set_->tubes[i].tube;
        const Tube& b = set_->tubes[i + 1].tube;
        all = fits(a, b, margin) && fits(b, a, margin);
      }
      if (all) {
        return margin;
      }
    }
    return kMargins.front();
  }

  /// Whether levels from `scale` radius to radius shrink by the factor in a cell.
  [[nodiscard]] bool shrinks(ProvedTube& proved, double radius, double scale, double factor, double slew) {
    // For the largest radius, with the bounds of the covariance.
    const LevelQuestion question{
        radius, set_->noise, scale, with_room(factor), slew, scale == 1.0, set_->covariance_margin};
    PlaceStore* const places = places_of(proved, slew);
    std::optional<VerificationBudget> grid = proved.grid;
    VerificationBudget& begun = grids_[static_cast<std::size_t>(&proved - set_->tubes.data())];
    if (proved.tube.bounds_covariance()) {
      begun.deadline = proved.grid.deadline;
      grid = coarsest_grid(*model_, proved.tube, question, begun, kMostForFilter, places);
    }
    if (!grid) {
      return false;
    }
    const LevelResult result = verify_level(*model_, proved.tube, question, *grid, places);
    proved.cells += result.cells;
    if (result.verdict != Verdict::proved) {
      return false;
    }
    begun = *grid;
    return true;
  }
  [[nodiscard]] bool shrinks(double radius, double scale, double factor, double slew) {
    return std::all_of(set_->tubes.begin(), set_->tubes.end(),
                       [&](ProvedTube& proved) { return shrinks(proved, radius, scale, factor, slew); });
  }

  /// The factor of levels at the border of the tubes number i and i + 1: at most 1, or 2 when nothing was
  /// proved.
  [[nodiscard]] double crossing_at(std::size_t i, double radius, double scale, double factor,
                                   double slew) const {
    const ProvedTube& a = set_->tubes[i];
    const ProvedTube& b = set_->tubes[i + 1];
    double largest = 0.0;
    const bool with_covariance = a.tube.bounds_covariance() && scale == 1.0;
    const auto margin = with_covariance ? std::optional(set_->covariance_margin) : std::nullopt;
    for (const bool is_up : {true, false}) {
      const BorderResult result = verify_border(*model_, is_up ? a.tube : b.tube, is_up ? b.tube : a.tube,
                                                {factor * radius, radius, slew, scale, margin}, a.grid);
      if (result.verdict != Verdict::proved || !(result.largest < 1.0)) {
        return 2.0;
      }
      largest = std::max(largest, result.largest);
    }
    return largest;
  }
  /// A little more than what was proved.
  [[nodiscard]] static double with_some_room(double crossing) {
    const rigor::UpwardRounding upward;
    return crossing + 0.1 * (1.0 - crossing);
  }
  /// At all borders; at most 1, or 2 when nothing was proved.
  [[nodiscard]] double crossing_of(double radius, double scale, double factor, double slew) const {
    double largest = 0.0;
    for (std::size_t i = 0; i + 1 < set_->tubes.size() && largest < 1.0; ++i) {
      largest = std::max(largest, crossing_at(i, radius, scale, factor, slew));
    }
    return largest < 1.0 ? with_some_room(largest) : 2.0;
  }

  /// The share of the first level that is proved, which takes most of the time.
  void tell(double share) {
    told_ = std::max(told_, share);
    if (progress_) {
      progress_(told_);
    }
  }

  /// One level for all tubes; when the time is over, for the first ones, without the others.
  bool proves(double radius, double slew) {
    for (std::size_t i = 0; i < set_->tubes.size(); ++i) {
      if (!is_locked(*model_, set_->tubes[i].tube, radius)) {
        failed_ = {i};
        return false;
      }
    }
    double crossing = 0.0;
    for (std::size_t i = 0; i < set_->tubes.size(); ++i) {
      double larger = crossing;
      const bool is_proved = shrinks(set_->tubes[i], radius, 1.0, slow_, slew);
      if (is_proved && i > 0) {
        larger = std::max(larger, crossing_at(i - 1, radius, 1.0, slow_, slew));
      }
      if (!is_proved || !(larger < 1.0)) {
        failed_ = {i};
        if (i == 0 || !deadline_->is_over()) {
          return false;
        }
        set_->tubes.erase(set_->tubes.begin() + static_cast<std::ptrdiff_t>(i), set_->tubes.end());
        break;
      }
      crossing = larger;
      tell(static_cast<double>(i + 1) / static_cast<double>(set_->tubes.size()));
    }
    set_->slew = slew;
    set_->crossing = {with_some_room(crossing)};
    for (ProvedTube& proved : set_->tubes) {
      proved.levels = {radius};
      proved.shrinking = {slow_};
    }
    return true;
  }

  bool step_down() {
    constexpr std::size_t kMostLevels = 16;
    const std::vector<double>& levels = set_->tubes.front().levels;
    const bool is_first = levels.size() == 1;
    struct Step {
      double factor, shrinking;
    };
    const std::array<Step, 6> steps{
        {{0.25, fast_}, {0.5, fast_}, {0.5, slow_}, {0.7, slow_}, {0.85, slow_}, {0.95, slow_}}};
    const double radius = levels.back();
    if (levels.size() > kMostLevels || radius < 0.02 * levels.front()) {
      return false;
    }
    return std::any_of(steps.begin(), steps.end(), [&](const Step& step) {
      const double next = step.factor * radius;
      const double scale = next / radius * (1.0 - 1e-12);
      if (!may_hold(next, set_->slew) || !shrinks(radius, scale, step.shrinking, set_->slew)) {
        return false;
      }
      const double crossing = crossing_of(radius, scale, step.shrinking, set_->slew);
      if (!(crossing < 1.0)) {
        return false;
      }
      if (is_first) {
        set_->crossing.clear();
      }
      set_->crossing.push_back(crossing);
      for (ProvedTube& proved : set_->tubes) {
        if (is_first) {
          proved.shrinking.clear();
        }
        proved.levels.push_back(next);
        proved.shrinking.push_back(step.shrinking);
      }
      return true;
    });
  }

  const TrackerModel* model_;
  const search::Deadline* deadline_;
  TubeSet* set_;
  std::vector<std::size_t> failed_;
  std::vector<VerificationBudget> grids_;            ///< for filters: the grids from which the next
                                                     ///< verification begins
  std::vector<std::unique_ptr<PlaceStore>> places_;  ///< of the tubes of the set
  double kept_slew_ = -1.0;                          ///< none
  double level_ = 0.0;
  double most_slew_ = 0.0;
  double slow_ = 1.0;
  double fast_ = 1.0;
  SetProgress progress_;
  double told_ = 0.0;
};

}  // namespace veritrack::model::detail
