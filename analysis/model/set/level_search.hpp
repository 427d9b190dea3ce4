// The search for the levels of one tube: see tube_set.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "analysis/model/set/set_search.hpp"
#include "analysis/model/step/place_store.hpp"

namespace veritrack::model::detail {

/// The search for the levels of one tube.
class LevelSearch {
 public:
  /// `share`: the share of the band that this cell is, and of the effort that the curve may cost.
  LevelSearch(const TrackerModel& model, const TubeProposal& proposal, const SetTask& task,
              double share = 1.0)
      : model_(&model),
        proposal_(&proposal),
        task_(&task),
        share_(share),
        places_(model, *proposal.tube, places_in(*proposal.tube, kBytesOfPlaces)) {
    // Slow trackers have little room, so that cells are small.
    const double room = 1.0 - proposal.worth.rate;
    constexpr double kLittleRoom = 0.02;
    proved_.grid.phases = room < kLittleRoom ? 64 : 32;
    proved_.tube = *proposal.tube;
    proved_.parameters = proposal.shape.parameters;
    proved_.grid.deadline = task.deadline;
    slow_ = 1.0 - 0.05 * room;
    fast_ = 1.0 - 0.5 * room;
  }

  /// The largest radius near the proposal for this noise, with levels below; empty when none is proved.
  [[nodiscard]] std::optional<ProvedTube> with_noise(double noise) {
    double radius = largest_radius(level(), [&](double tried) { return may_hold(tried, noise); });
    for (int i = 0; i < 60 && radius > 0.0 && !is_locked(*model_, proved_.tube, radius); ++i) {
      radius *= 0.93;
    }
    if (radius > 0.0 && proved_.tube.bounds_covariance()) {
      // A little less than points allow takes a fraction of the cells.
      most_for_filter_ = kFewForFilter;
      for (const double factor : {kFactors[0], kFactors[1], kFactors[2]}) {
        if (proves_with_lower(factor * radius, noise)) {
          descend(noise);
          return proved_;
        }
      }
      most_for_filter_ = kMostForFilter;
    }
    std::optional<ProvedTube> largest;
    int tries = 0;
    for (const double factor : kFactors) {
      const bool is_proved =
          radius > 0.0 && (proves_with_lower(factor * radius, noise) || proves(factor * radius, noise));
      if (is_proved) {
        descend(noise);
        // Near the largest radius nothing may shrink; a little below it there are levels.
        if (proved_.levels.size() > 1) {
          return proved_;
        }
        largest = largest ? largest : proved_;
        constexpr int kMostTries = 3;
        if (++tries == kMostTries) {
          break;
        }
      }
    }
    return largest;
  }

  /// A tube for the largest noise that is found up to `most`, and a little less than that noise: room for the
  /// checker's arithmetic. (A proof for some noise is also one for less.)
  [[nodiscard]] std::optional<std::pair<ProvedTube, double>> with_largest_noise(double most) {
    double best_noise = 0.0;
    double best_radius = 0.0;
    // From `noise` up, as much as points allow.
    const auto improve = [&](double radius, double noise) {
      if (!(noise > 0.0) || !may_hold(radius, noise) || !is_locked(*model_, proved_.tube, radius)) {
        return;
      }
      for (double step = 1.6; step > 1.01; step = std::sqrt(step)) {
        while (noise * step <= most && may_hold(radius, noise * step)) {
          noise *= step;
        }
      }
      best_noise = noise;
      best_radius = radius;
    };
    // As a share of the guess: to be larger than the best so far.
    const double least = 0.05 * proposal_->worth.noise;
    const auto try_radius = [&](double radius, double noise) {
      improve(radius, std::min(most, std::max(best_noise * 1.02, noise)));
    };
    for (const double factor : {1.0, 0.8, 0.65, 0.5, 1.25}) {
      try_radius(factor * level(), least);
    }
    // Where the guess was far too large.
    const double guess = proposal_->worth.noise * level() / proposal_->worth.level;
    for (double factor = 0.35; factor > 0.02 && !(best_noise > 0.0); factor *= 0.7) {
      try_radius(factor * level(), 0.05 * factor * guess);
    }
    if (!(best_noise > 0.0) && task_->known_noise > 0.0) {
      try_radius(largest_radius(level(), [&](double tried) { return may_hold(tried, task_->known_noise); }),
                 task_->known_noise);
    }
    // The first radius that works need not be the best.
    constexpr double kSmaller = 0.85;
    for (double before = 0.0; best_noise > before && best_noise < most;) {
      before = best_noise;
      try_radius(kSmaller * best_radius, 0.0);
    }
    const auto is_proved = [&](double factor) { return proves(best_radius, factor * best_noise); };
    const auto found_among = [&](std::size_t so_many) -> std::optional<std::pair<ProvedTube, double>> {
      const auto last = kFactors.begin() + static_cast<std::ptrdiff_t>(so_many);
      const auto found = std::find_if(kFactors.begin(), last, is_proved);
      constexpr double kRoomOfChecker = 0.98;
      return found != last ? std::optional(std::pair(proved_, kRoomOfChecker * *found * best_noise))
                           : std::nullopt;
    };
    if (!(best_noise > 0.0)) {
      return std::nullopt;
    }
    if (proved_.tube.bounds_covariance()) {
      constexpr std::size_t kFirst = 2;
      for (const int cells : {kFewestForFilter, kUsualForFilter}) {
        most_for_filter_ = cells;
        if (auto found = found_among(kFirst)) {
          return found;
        }
      }
      most_for_filter_ = kMostForFilter;
    }
    return found_among(kFactors.size());
  }

  /// The radius from which the search begins.
  [[nodiscard]] double guess() const { return level(); }

 private:
  static constexpr double kBytesOfPlaces = 6.4e7;
  /// The radii that are tried, as shares of the one that points allow.
  static constexpr double kDeep = 1e-3;  ///< of the first level
  static constexpr std::array<double, 8> kFactors{0.985, 0.96, 0.93, 0.89, 0.84, 0.77, 0.68, 0.55};

  /// The guess, unless errors were larger than the frequency: for a step that is nearly linear.
  [[nodiscard]] double level() const {
    const ShapeWorth& worth = proposal_->worth;
    return worth.reach > proposal_->frequency ? worth.level * proposal_->frequency / worth.reach
                                              : worth.level;
  }

  [[nodiscard]] bool may_hold(double radius, double noise) {
    constexpr int kPhases = 24;
    LevelQuestion question{radius, noise};
    // Bounds that are kept for a radius are kept for smaller ones.
    question.with_covariance = radius > kept_radius_;
    const bool may =
        !task_->deadline.is_over() && may_shrink(*model_, proved_.tube, question, kPhases, slow_, &places_);
    kept_radius_ = may ? std::max(kept_radius_, radius) : kept_radius_;
    return may;
  }

  bool proves(double radius, double noise) {
    if (!is_locked(*model_, proved_.tube, radius) || !holds({radius, noise, 1.0, slow_})) {
      return false;
    }
    proved_.levels = {radius};
    proved_.shrinking = {slow_};
    return true;
  }
  /// For a filter, whose cells are expensive: together with a level below.
  bool proves_with_lower(double radius, double noise) {
    if (!proved_.tube.bounds_covariance() || !is_locked(*model_, proved_.tube, radius)) {
      return false;
    }
    const auto begins = [&](double factor) {
      return may_be_below(radius, noise, {factor, slow_}) &&
             holds({radius, noise, factor * (1.0 - 1e-12), slow_});
    };
    const auto found = std::find_if(kNear.begin(), kNear.end(), begins);
    if (found == kNear.end()) {
      return false;
    }
    proved_.levels = {radius, *found * radius};
    proved_.shrinking = {slow_};
    return true;
  }

  bool holds(const LevelQuestion& question) {
    if (!proved_.tube.bounds_covariance()) {
      return holds(question, proved_.grid);
    }
    LevelQuestion verified = question;
    verified.shrinking = with_room(question.shrinking);
    grid_.deadline = proved_.grid.deadline;
    grid_.most_cells = 2 * static_cast<std::size_t>(most_for_filter_);
    const auto grid = coarsest_grid(*model_, proved_.tube, verified, grid_, most_for_filter_, &places_);
    if (!grid || !holds(question, *grid)) {
      return false;
    }
    grid_ = *grid;
    return true;
  }
  bool holds(LevelQuestion question, const VerificationBudget& grid) {
    question.shrinking = with_room(question.shrinking);
    const LevelResult result = verify_level(*model_, proved_.tube, question, grid, &places_);
    const bool is_proved = result.verdict == rigor::Verdict::proved;
    last_cells_ = is_proved ? result.cells : last_cells_;
    proved_.cells += is_proved ? result.cells : 0;
    return is_proved;
  }

  /// Adds lower levels, while they are proved.
  void descend(double noise) {
    const double least = task_->with_curve ? 1e-7 * proved_.levels.front() : 0.02 * proved_.levels.front();
    constexpr std::size_t kMostLevels = 24;
    // Where there are many cells, the models cannot resolve the curve itself.
    const std::size_t most_cells = 3 * last_cells_ + 1000;
    proved_.grid.most_cells = std::min(proved_.grid.most_cells, 2 * most_cells);
    if (proved_.tube.bounds_covariance()) {
      if (proved_.levels.size() < 2) {
        return;  // it was tried
      }
      most_for_filter_ = std::clamp(static_cast<int>(2 * last_cells_), kFewestForFilter, kMostForFilter);
    }
    while (proved_.levels.back() > least && proved_.levels.size() < kMostLevels && last_cells_ < most_cells) {
      if (is_for_curve() ? !step_to_curve() : !step_down(noise)) {
        break;
      }
    }
  }

  /// Whether levels are far below the first one, and the curve must be known as accurately as the cells are
  /// worth: for few states, whose cells are cheap.
  [[nodiscard]] bool is_for_curve() const {
    constexpr std::size_t kFewStates = 3;
    return task_->with_curve && !proved_.tube.bounds_covariance() &&
           proved_.tube.curve.size() <= kFewStates && proved_.levels.size() > 1 &&
           proved_.levels.back() < kDeep * proved_.levels.front();
  }
  /// Two levels that are far apart take no more cells than the lower one alone, and the lower one is where
  /// the curve has to be resolved: so it is as low as the cells that are allowed make it, in one step. The
  /// grid is found at some of its cells, since a verification that begins too coarse costs three times as
  /// much.
  bool step_to_curve() {
    // A bias is enclosed to about twice the level. Lower ones than this only where they are cheap.
    constexpr double kAsLowAsWanted = 4e-9;  // rad/sample
    constexpr double kLowest = 2.5e-10;
    const double radius = proved_.levels.back();
    LevelQuestion question{radius, 0.0};
    question.with_covariance = false;
    question.shrinking = fast_;
    int tries = 0;
    constexpr int kMostTries = 2;
    for (double next = kLowest; next < 0.5 * radius && tries < kMostTries; next *= 2.0) {
      question.least_scale = next / radius * (1.0 - 1e-12);
      const double most = next < kAsLowAsWanted ? 2048.0 : std::clamp(65536.0 * share_, 1024.0, 16384.0);
      VerificationBudget first = proved_.grid;
      first.most_cells = 2 * static_cast<std::size_t>(most);
      LevelQuestion verified = question;
      verified.shrinking = with_room(question.shrinking);
      const auto grid = task_->deadline.is_over()
                            ? std::nullopt
                            : coarsest_grid(*model_, proved_.tube, verified, first, static_cast<int>(most));
      if (!grid) {
        continue;
      }
      ++tries;
      if (holds(question, *grid)) {
        proved_.levels.push_back(next);
        proved_.shrinking.push_back(fast_);
        return true;
      }
    }
    return false;
  }
  struct Step {
    double factor, shrinking;
  };
  /// Whether points allow the level that is this step below. They are cheap, and where they fail nothing is
  /// verified.
  [[nodiscard]] bool may_be_below(double radius, double noise, const Step& step) {
    constexpr int kPhases = 16;
    LevelQuestion below{step.factor * radius, noise};
    below.with_covariance = false;  // shown with the largest radius
    return !task_->deadline.is_over() &&
           may_shrink(*model_, proved_.tube, below, kPhases, with_room(step.shrinking), &places_);
  }

  bool step_down(double noise) {
    const bool is_first = proved_.levels.size() == 1;
    // Near the largest radius levels hardly shrink.
    const std::array<Step, 5> far{{{0.125, fast_}, {0.25, fast_}, {0.5, fast_}, {0.7, slow_}, {0.9, slow_}}};
    // Far down, models cannot resolve the curve, and a step that fails has cost many cells.
    const std::array<Step, 2> deep{{{0.25, fast_}, {0.5, fast_}}};
    const bool is_deep = task_->with_curve && proved_.levels.back() < kDeep * proved_.levels.front();
    const std::array<Step, kNear.size()> near{{{kNear[0], slow_}, {kNear[1], slow_}, {kNear[2], slow_}}};
    const auto take = [&](const Step& step) {
      const double radius = proved_.levels.back();
      const double next = step.factor * radius;
      if (!may_be_below(radius, noise, step)) {
        return false;
      }
      // Levels are verified from this one up.
      const double scale = next / radius;
      LevelQuestion between{radius, noise, scale * (1.0 - 1e-12), step.shrinking};
      between.with_covariance = false;
      if (!holds(between)) {
        return false;
      }
      if (is_first) {
        proved_.shrinking.clear();
      }
      proved_.levels.push_back(next);
      proved_.shrinking.push_back(step.shrinking);
      return true;
    };
    return is_first  ? std::any_of(near.begin(), near.end(), take)
           : is_deep ? std::any_of(deep.begin(), deep.end(), take)
                     : std::any_of(far.begin(), far.end(), take);
  }

  /// For a filter, cells of a grid: for the first level; for lower ones, unless the first took more.
  static constexpr int kMostForFilter = 8192;
  static constexpr int kUsualForFilter = 2048;
  static constexpr int kFewForFilter = 512;
  static constexpr int kFewestForFilter = 1024;
  /// The distance of the second level below the first, at most.
  static constexpr std::array<double, 3> kNear{0.5, 0.7, 0.9};

  const TrackerModel* model_;
  const TubeProposal* proposal_;
  const SetTask* task_;
  double share_;
  ProvedTube proved_;
  PlaceStore places_;
  std::size_t last_cells_ = 0;      ///< of the last verification that succeeded
  VerificationBudget grid_{16, 1};  ///< for a filter: the grid from which the next verification begins
  int most_for_filter_ = kMostForFilter;
  double kept_radius_ = 0.0;  ///< a radius for which, at points, bounds of a covariance are kept
  double slow_ = 1.0;
  double fast_ = 1.0;
};

}  // namespace veritrack::model::detail
