#include "analysis/model/capture/start_capture.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "analysis/model/step/point_tube.hpp"
#include "analysis/model/tube/tube_verification.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

constexpr double kTurnOfSignal = 2.0 * std::numbers::pi;

bool is_start_question(const std::vector<TubeOfLevel>& tubes, const StartQuestion& question) {
  const auto is_tube = [](const TubeOfLevel& each) {
    return each.tube != nullptr && std::isfinite(each.level) && each.level > 0.0 &&
           !each.tube->bounds_covariance();
  };
  return !tubes.empty() && std::all_of(tubes.begin(), tubes.end(), is_tube) && !question.state.empty() &&
         std::all_of(question.state.begin(), question.state.end(),
                     [](const Interval& state) { return rigor::is_finite(state); }) &&
         question.most_samples > 0 && std::isfinite(question.noise) && question.noise >= 0.0;
}

}  // namespace

StartCapture prove_start_captured(const TrackerModel& model, const std::vector<TubeOfLevel>& tubes,
                                  const StartQuestion& question, const VerificationBudget& budget,
                                  const std::function<void(double)>& progress) {
  StartCapture result;
  const rigor::UpwardRounding upward;
  if (!is_start_question(tubes, question) || !is_grid(budget)) {
    result.reason = "no start, set or budget that could be followed";
    return result;
  }
  std::atomic<std::size_t> samples{0};
  std::atomic<bool> is_error_known{true};
  for (std::size_t number = 0; number < tubes.size(); ++number) {
    const TubeOfLevel& target = tubes[number];
    if (result.reason = objection_to_phases(model, *target.tube); !result.reason.empty()) {
      return result;
    }
    const auto ask = [&](const TubeCell& cell) -> CellAnswer {
      const FollowedStart followed = follow_start(model, target, cell, question);
      const bool is_cell = cell.half_turn > 0.0;  // not a point, which only shows whether to go on
      if (followed.is_captured && is_cell) {
        std::size_t known = samples.load();
        while (followed.samples > known && !samples.compare_exchange_weak(known, followed.samples)) {
        }
        if (!rigor::is_finite(followed.frequency_error)) {
          is_error_known.store(false);
        }
      }
      // The phase of a late sample is known to the extents of both.
      const double late = static_cast<double>(followed.samples);
      return {followed.is_captured,
              rigor::is_finite(followed.frequency_error) ? followed.frequency_error : Interval(0.0),
              kTurnOfSignal * cell.half_turn, late * target.tube->half_width * cell.half_z};
    };
    const CoverResult cover = cover_cells(ask, budget);
    if (!cover.is_proved || cover.cells == 0) {
      const TubeCell point{cover.failed.turn, 0.0, cover.failed.z, 0.0};
      const FollowedStart at_point =
          budget.deadline.is_over() ? FollowedStart{} : follow_start(model, target, point, question);
      result.reason = place_of_failure(*target.tube, cover.failed) + ": " +
                      (budget.deadline.is_over() ? "the time was over before the start was followed"
                       : at_point.is_captured    ? "the start is in the set there, but the cells around it "
                                                   "are too many"
                                                 : at_point.obstacle);
      return result;
    }
    result.cells += cover.cells;
    result.frequency_error = number == 0 ? cover.range : hull(result.frequency_error, cover.range);
    if (progress) {
      progress(static_cast<double>(number + 1) / static_cast<double>(tubes.size()));
    }
  }
  result.samples = samples.load();
  if (!is_error_known.load()) {
    result.frequency_error = Interval::empty();
  }
  result.verdict = rigor::Verdict::proved;
  return result;
}

std::size_t simulated_capture(const TrackerModel& model, const std::vector<TubeOfLevel>& tubes,
                              const std::vector<Interval>& state, std::size_t most) {
  const rigor::NearestRounding nearest;
  constexpr int kPhases = 24;
  std::size_t longest = 0;
  PointTracker points(model);
  PointFrame frame;
  for (const TubeOfLevel& target : tubes) {
    for (const double z : {-1.0, 0.0, 1.0}) {
      const double frequency = target.tube->frequency + z * target.tube->half_width;
      const PointTube tube(*target.tube, frequency);
      for (int j = 0; j < kPhases; ++j) {
        Eigen::VectorXd x(static_cast<Eigen::Index>(state.size()));
        for (std::size_t i = 0; i < state.size(); ++i) {
          x[static_cast<Eigen::Index>(i)] = rigor::midpoint(state[i]);
        }
        std::size_t sample = 0;
        for (; sample < most; ++sample) {
          const double phase = std::remainder(
              kTurnOfSignal * j / kPhases + static_cast<double>(sample) * frequency, kTurnOfSignal);
          tube.at(phase, frame);
          Eigen::VectorXd near = x;
          for (Eigen::Index i = 0; i < near.size(); ++i) {
            if (model.recursion->is_angle[static_cast<std::size_t>(i)]) {
              near[i] -= kTurnOfSignal * std::round((near[i] - frame.curve[i]) / kTurnOfSignal);
            }
          }
          const double level = frame.coordinates(near).norm();
          if (level <= target.level) {
            break;
          }
          if (!std::isfinite(level)) {
            return most;
          }
          x = points.next(x, points.samples(phase + frequency));
        }
        longest = std::max(longest, sample);
      }
    }
  }
  return longest;
}

}  // namespace veritrack::model
