#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/model/border.hpp"
#include "analysis/model/set_search.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::Verdict;

/// The search for levels that all cells of a band have in common.
class MovingSearch {
 public:
  MovingSearch(const TrackerModel& model, std::vector<TubeProposal>& cells, TubeSet& set)
      : model_(&model), set_(&set) {
    double rate = 0.0;
    for (TubeProposal& cell : cells) {
      widen(*cell.tube);
      ProvedTube proved;
      proved.tube = *std::move(cell.tube);
      set.tubes.push_back(std::move(proved));
      rate = std::max(rate, cell.worth.rate);
      level_ = level_ > 0.0 ? std::min(level_, cell.worth.level) : cell.worth.level;
      most_slew_ = most_slew_ > 0.0 ? std::min(most_slew_, cell.worth.slew) : cell.worth.slew;
    }
    constexpr double kLittleRoom = 0.02;
    for (ProvedTube& proved : set.tubes) {
      proved.grid.phases = 1.0 - rate < kLittleRoom ? 64 : 32;
    }
    slow_ = 1.0 - 0.05 * (1.0 - rate);
    fast_ = 1.0 - 0.5 * (1.0 - rate);
  }

  /// Levels for the noise and slew of the set.
  [[nodiscard]] bool find_levels() {
    const double radius = largest_radius(level_, [&](double tried) { return may_hold(tried, set_->slew); });
    for (const double factor : kFactors) {
      if (radius > 0.0 && proves(factor * radius, set_->slew)) {
        while (step_down()) {
        }
        return true;
      }
    }
    return false;
  }

  /// The largest slew, for the noise of the set, with one level.
  [[nodiscard]] bool find_slew() {
    double slew = 0.0;
    double radius = 0.0;
    for (const double factor : {1.0, 0.75, 0.5}) {
      double tried = std::max(1.02 * slew, 0.02 * most_slew_);
      if (!(tried > 0.0) || !may_hold(factor * level_, tried)) {
        continue;
      }
      for (double step = 1.6; step > 1.02; step = std::sqrt(step)) {
        while (may_hold(factor * level_, tried * step)) {
          tried *= step;
        }
      }
      slew = tried;
      radius = factor * level_;
    }
    return std::any_of(kFactors.begin(), kFactors.end(),
                       [&](double factor) { return slew > 0.0 && proves(radius, factor * slew); });
  }

 private:
  static constexpr std::array<double, 8> kFactors{0.98, 0.95, 0.91, 0.86, 0.8, 0.72, 0.62, 0.5};

  [[nodiscard]] bool may_hold(double radius, double slew) const {
    constexpr int kPhases = 16;
    return std::all_of(set_->tubes.begin(), set_->tubes.end(), [&](const ProvedTube& proved) {
      return sampled_growth(*model_, proved.tube, {radius, set_->noise, 1.0, 1.0, slew}, kPhases) <= slow_;
    });
  }

  /// Whether levels from `scale` radius to radius shrink by the factor in every cell.
  [[nodiscard]] bool shrinks(double radius, double scale, double factor, double slew) {
    return std::all_of(set_->tubes.begin(), set_->tubes.end(), [&](ProvedTube& proved) {
      const LevelResult result = verify_level(
          *model_, proved.tube, {radius, set_->noise, scale, with_room(factor), slew}, proved.grid);
      proved.cells += result.cells;
      return result.verdict == Verdict::proved;
    });
  }

  /// How levels change at borders, a little more than what was proved: at most 1, or 2 when nothing was.
  [[nodiscard]] double crossing_of(double radius, double scale, double factor, double slew) const {
    const rigor::UpwardRounding upward;
    double largest = 0.0;
    for (std::size_t i = 0; i + 1 < set_->tubes.size(); ++i) {
      const ProvedTube& a = set_->tubes[i];
      const ProvedTube& b = set_->tubes[i + 1];
      for (const bool is_up : {true, false}) {
        const BorderResult result = verify_border(*model_, is_up ? a.tube : b.tube, is_up ? b.tube : a.tube,
                                                  {factor * radius, radius, slew, scale}, a.grid);
        if (result.verdict != Verdict::proved || !(result.largest < 1.0)) {
          return 2.0;
        }
        largest = std::max(largest, result.largest);
      }
    }
    return largest + 0.1 * (1.0 - largest);
  }

  bool proves(double radius, double slew) {
    const bool is_known = std::all_of(set_->tubes.begin(), set_->tubes.end(), [&](const ProvedTube& proved) {
      return is_locked(*model_, proved.tube, radius);
    });
    if (!is_known || !shrinks(radius, 1.0, slow_, slew)) {
      return false;
    }
    const double crossing = crossing_of(radius, 1.0, slow_, slew);
    if (!(crossing < 1.0)) {
      return false;
    }
    set_->slew = slew;
    set_->crossing = {crossing};
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
  TubeSet* set_;
  double level_ = 0.0;
  double most_slew_ = 0.0;
  double slow_ = 1.0;
  double fast_ = 1.0;
};

}  // namespace

TubeSet prove_moving_set(const TrackedTone& tone, const TrackerModel& model, double low, double high,
                         const SetTask& task, const SetProgress& progress) {
  const rigor::NearestRounding nearest;
  BandSettings settings = settings_of(task, low, high);
  settings.one_shape = true;
  BandProposal band = propose_band(tone, low, high, settings);
  TubeSet set;
  set.name = task.name;
  set.noise = task.noise;
  set.slew = task.slew;
  set.reasons = reasons_of(band);
  if (!band.is_complete) {
    return set;
  }
  MovingSearch search(model, band.cells, set);
  const bool is_found = task.largest_slew ? search.find_slew() : search.find_levels();
  if (!is_found) {
    set.tubes.clear();
    set.reasons.push_back(
        task.largest_slew
            ? "no slew was proved"
            : fmt::format("no radius was proved for noise {:.4g} and slew {:.4g} rad/sample per sample",
                          task.noise, task.slew));
  }
  if (progress) {
    progress(1.0);
  }
  set.is_complete = is_found && covers(set.tubes, low, high);
  return set;
}

}  // namespace veritrack::model
