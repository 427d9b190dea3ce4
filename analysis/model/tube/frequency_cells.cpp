#include "analysis/model/tube/frequency_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

/// Cells from the left to the right, halved where they fail.
class Division {
 public:
  Division(const TrackedTone& tone, const BandSettings& settings, double narrowest, double coarse)
      : tone_(&tone), settings_(&settings), narrowest_(narrowest), coarse_(coarse) {}

  void divide(double low, double high) {
    // A stack, the next cell on top.
    std::vector<std::pair<double, double>> waiting{{low, high}};
    while (!waiting.empty()) {
      const auto [from, to] = waiting.back();
      waiting.pop_back();
      const double middle = 0.5 * (from + to);
      if (settings_->deadline.is_over()) {
        TubeProposal untried;
        untried.outcome = TubeOutcome::time_limit;
        untried.frequency = middle;
        untried.half_width = 0.5 * (to - from);
        (void)decide(std::move(untried), false);
        continue;
      }
      TubeProposal proposal = propose_tube(*tone_, middle, 0.5 * (to - from), settings_->tube, nearby_,
                                           settings_->one_shape && nearby_.has_value());
      const bool is_proposed = proposal.outcome == TubeOutcome::proposed;
      // Where the tracker does not settle, narrow cells show no more than wide ones.
      const bool settles = proposal.outcome != TubeOutcome::no_steady_state;
      // Far from the last tube, cells need not be as narrow as where tubes end.
      constexpr double kShare = 1.0 / 6.0;
      const double narrowest =
          std::max({narrowest_, settles ? 0.0 : coarse_, kShare * (from - failing_from_.value_or(from))});
      if (!is_proposed && to - from > 2.0 * narrowest) {
        waiting.emplace_back(middle, to);
        waiting.emplace_back(from, middle);
        continue;
      }
      // A wide cell that is not proved may be in two parts, unless the last one was not, either.
      constexpr double kProofs = 9.0;
      const bool may_be_halved = is_proposed && !settings_->one_shape && !failing_from_ &&
                                 to - from > std::max(settings_->widest / kProofs, 2.0 * narrowest);
      if (is_proposed && !(settings_->one_shape && nearby_)) {
        nearby_ = proposal.shape.parameters;
      }
      const bool is_good = decide(std::move(proposal), may_be_halved) && is_proposed;
      if (!is_good && may_be_halved) {
        cells_.pop_back();
        waiting.emplace_back(middle, to);
        waiting.emplace_back(from, middle);
        continue;
      }
      failing_from_ = is_good ? std::nullopt : std::optional(failing_from_.value_or(from));
    }
  }

  void begin_with(const std::optional<ShapeParameters>& parameters) { nearby_ = parameters; }
  [[nodiscard]] std::vector<TubeProposal> take() { return std::move(cells_); }

 private:
  /// Whether the cell is good.
  bool decide(TubeProposal cell, bool may_be_halved) {
    const bool is_good = !settings_->decided || settings_->decided(cell, may_be_halved);
    cells_.push_back(std::move(cell));
    return is_good;
  }

  const TrackedTone* tone_;
  const BandSettings* settings_;

  double narrowest_;
  double coarse_;                       ///< for cells where the tracker does not settle
  std::optional<double> failing_from_;  ///< where the cells without a tube begin that were the last ones
  std::optional<ShapeParameters> nearby_;
  std::vector<TubeProposal> cells_;
};

}  // namespace

BandProposal propose_band(const TrackedTone& tone, double low, double high, const BandSettings& settings) {
  const rigor::NearestRounding nearest;
  if (!(0.0 < low && low < high && high < std::numbers::pi)) {
    throw std::invalid_argument("a band of frequencies must be within (0, pi)");
  }
  constexpr double kMostCells = 1024.0;
  const double narrowest = std::max(settings.narrowest, (high - low) / kMostCells);
  constexpr double kCoarseParts = 8.0;
  Division division(tone, settings, narrowest, (high - low) / kCoarseParts);
  const int first = std::max(1, static_cast<int>(std::ceil((high - low) / settings.widest)));
  if (settings.one_shape) {
    const double half_width = std::max(narrowest, 1e-3 * (high - low));
    // Parameters of the middle are for all frequencies of the band.
    TubeSettings tube = settings.tube;
    constexpr int kPlaces = 9;
    for (int place = 0; place < kPlaces; ++place) {
      const double frequency = low + (high - low) * (place + 0.5) / kPlaces;
      const SteadyState steady = find_steady_state(tone, frequency, tube.steady_state);
      const bool is_settled = steady.outcome == SteadyStateOutcome::settled;
      tube.shape.largest_rate = std::max(tube.shape.largest_rate, is_settled ? steady.rate : 0.0);
    }
    TubeProposal middle = propose_tube(tone, 0.5 * (low + high), half_width, tube);
    if (middle.outcome == TubeOutcome::proposed && tone.filter != nullptr) {
      // The parameters of the place where tubes are smallest.
      const TubeProposal at_middle = middle;
      for (const double place : {low + half_width, high - half_width}) {
        TubeProposal end = propose_tube(tone, place, half_width, tube, at_middle.shape.parameters);
        if (end.outcome == TubeOutcome::proposed && end.worth.reach < middle.worth.reach) {
          middle = std::move(end);
        }
      }
    }
    if (middle.outcome == TubeOutcome::proposed) {
      division.begin_with(middle.shape.parameters);
    }
  }
  const auto end_of = [&](int cell) {
    return cell == first ? high : low + (high - low) * static_cast<double>(cell) / static_cast<double>(first);
  };
  for (int cell = 0; cell < first; ++cell) {
    division.divide(end_of(cell), end_of(cell + 1));
  }
  BandProposal band;
  band.cells = division.take();
  band.is_complete = !band.cells.empty() && std::ranges::all_of(band.cells, [&](const TubeProposal& cell) {
    return cell.outcome == TubeOutcome::proposed &&
           cell.steady_state.turns == band.cells.front().steady_state.turns;
  });
  return band;
}

}  // namespace veritrack::model
