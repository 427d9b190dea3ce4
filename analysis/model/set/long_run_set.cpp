// The search for tubes of a filter in the long run.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "analysis/model/filter/filter_proposal.hpp"
#include "analysis/model/filter/long_run_entry.hpp"
#include "analysis/model/set/set_search.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "analysis/model/step/place_store.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

/// The search inside one tube.
class LongRunLevels {
 public:
  LongRunLevels(const TrackerModel& model, const ProvedTube& around, const TubeProposal& proposal,
                double noise)
      : model_(&model),
        around_(&around),
        noise_(noise),
        places_(model, *proposal.tube, places_in(*proposal.tube, kBytesOfPlaces)) {
    const double room = 1.0 - proposal.worth.rate;
    proved_.tube = *proposal.tube;
    proved_.parameters = proposal.shape.parameters;
    proved_.grid = around.grid;
    grid_.deadline = around.grid.deadline;
    grid_.most_cells = 2 * static_cast<std::size_t>(kMostCells);
    slow_ = 1.0 - 0.05 * room;
    fast_ = 1.0 - 0.5 * room;
  }

  [[nodiscard]] std::optional<ProvedTube> find() {
    constexpr int kPhases = 48;
    const double radius = around_->levels.back();
    const SampledEntry sampled = sampled_long_run_entry(around_->tube, radius, proved_.tube, kPhases);
    constexpr double kRoomOfLevel = 1.02;
    constexpr double kRoomOfRatio = 1.02;
    const double into = kRoomOfLevel * sampled.level;
    LongRunEntry entry{0.0, kRoomOfRatio * sampled.ratio};
    if (!std::isfinite(into) || !std::isfinite(entry.ratio)) {
      return std::nullopt;
    }
    bool is_entered = false;
    for (const double margin : {0.006, 0.004, 0.002, 0.001}) {
      entry.margin = margin;
      is_entered = is_entered || verify_long_run_entry(*model_, around_->tube, radius, proved_.tube, into,
                                                       entry, proved_.grid)
                                     .is_proved;
      if (is_entered) {
        break;
      }
    }
    if (!is_entered) {
      return std::nullopt;
    }
    proved_.entry = entry;
    proved_.levels = {into};
    constexpr std::size_t kMostLevels = 20;
    while (proved_.levels.size() < kMostLevels && step_down()) {
    }
    return proved_.levels.size() > 1 ? std::optional(proved_) : std::nullopt;
  }

 private:
  static constexpr double kBytesOfPlaces = 6.4e7;
  static constexpr int kMostCells = 8192;
  static constexpr int kFewerCells = 2048;
  struct Step {
    double factor, shrinking;
  };

  [[nodiscard]] bool step_down() {
    const std::array<Step, 8> steps{{{0.25, fast_},
                                     {0.5, fast_},
                                     {0.5, slow_},
                                     {0.7, slow_},
                                     {0.85, slow_},
                                     {0.93, slow_},
                                     {0.97, slow_},
                                     {0.99, slow_}}};
    // The last levels are close to the limit, and would take most of the time.
    constexpr int kMany = 1024;
    constexpr std::size_t kWideSteps = 6;
    const bool is_dear = grid_.phases * grid_.frequencies > kMany;
    const auto last = steps.begin() + static_cast<std::ptrdiff_t>(is_dear ? kWideSteps : steps.size());
    return std::any_of(steps.begin(), last, [&](const Step& step) { return takes(step); });
  }
  [[nodiscard]] bool takes(const Step& step) {
    const double radius = proved_.levels.back();
    const double next = step.factor * radius;
    constexpr int kPhases = 16;
    LevelQuestion below{next, noise_};
    below.with_covariance = false;
    if (proved_.grid.deadline.is_over() ||
        !may_shrink(*model_, proved_.tube, below, kPhases, with_room(step.shrinking), &places_)) {
      return false;
    }
    // Levels are verified from this one up.
    LevelQuestion between{radius, noise_, step.factor * (1.0 - 1e-12), with_room(step.shrinking)};
    between.with_covariance = false;
    const bool is_first = proved_.levels.size() == 1;
    const int most = is_first ? kMostCells : std::max(kFewerCells, grid_.phases * grid_.frequencies);
    const auto grid = coarsest_grid(*model_, proved_.tube, between, grid_, most, &places_);
    if (!grid) {
      return false;
    }
    const LevelResult result = verify_level(*model_, proved_.tube, between, *grid, &places_);
    if (result.verdict != rigor::Verdict::proved) {
      return false;
    }
    grid_ = *grid;
    proved_.cells += result.cells;
    proved_.levels.push_back(next);
    proved_.shrinking.push_back(step.shrinking);
    return true;
  }

  const TrackerModel* model_;
  const ProvedTube* around_;
  double noise_;
  ProvedTube proved_;
  PlaceStore places_;
  VerificationBudget grid_{16, 1};  ///< the grid from which the next verification begins
  double slow_ = 1.0;
  double fast_ = 1.0;
};

}  // namespace

std::optional<TubeSet> prove_long_run_set(const TrackedTone& tone, const TrackerModel& model,
                                          const TubeSet& set, const search::Deadline& deadline) {
  const rigor::NearestRounding nearest;
  TubeSet inner;
  inner.name = "long-run";
  inner.noise = set.noise;
  inner.part = set.part;
  inner.is_complete = set.is_complete;
  std::optional<ShapeParameters> nearby;
  for (const ProvedTube& around : set.tubes) {
    if (deadline.is_over() || !around.tube.bounds_covariance()) {
      return std::nullopt;
    }
    const TubeProposal proposal =
        propose_long_run_tube(tone, around.tube, around.levels.back(), set.noise + error_from_amplitude(tone),
                              around.parameters, nearby);
    if (proposal.outcome != TubeOutcome::proposed) {
      return std::nullopt;
    }
    auto found = LongRunLevels(model, around, proposal, set.noise).find();
    if (!found) {
      return std::nullopt;
    }
    nearby = proposal.shape.parameters;
    inner.tubes.push_back(*std::move(found));
  }
  return inner.tubes.empty() ? std::nullopt : std::optional(std::move(inner));
}

}  // namespace veritrack::model
