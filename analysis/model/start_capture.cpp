#include "analysis/model/start_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "analysis/model/map_bound.hpp"
#include "analysis/model/point_tube.hpp"
#include "analysis/model/tube_models.hpp"
#include "analysis/model/tube_verification.hpp"
#include "analysis/rigor/ball_model.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::BallModelScope;
using rigor::Interval;

constexpr double kTurnOfPhase = 2.0 * std::numbers::pi;
/// Samples between two looks at whether the state is in the tube.
constexpr std::size_t kSamplesBetweenLooks = 4;

/// Adds whole turns so that the constant is nearest to 0: angles count modulo 2 pi.
BallModel turned_back(const BallModel& angle) {
  const double turns = std::round(angle.constant() / kTurnOfPhase);
  const bool is_turned = std::isfinite(turns) && turns != 0.0;
  return is_turned ? angle - BallModel(Interval(turns) * Interval(2.0) * rigor::pi()) : angle;
}

/// The part of a model that depends on s and z alone, without the error: a model of the innermost scope,
/// which has s and z only.
BallModel place_part(const BallModel& model) {
  constexpr int kMost = rigor::BallMonomials::kMost;
  std::array<BallModel, kMost + 1> powers_of_s;
  std::array<BallModel, kMost + 1> powers_of_z;
  powers_of_s[0] = powers_of_z[0] = BallModel(1.0);
  for (std::size_t k = 1; k < powers_of_s.size(); ++k) {
    powers_of_s[k] = powers_of_s[k - 1] * BallModel::s();
    powers_of_z[k] = powers_of_z[k - 1] * BallModel::z();
  }
  BallModel sum;
  for (const rigor::BallMonomials::Class& here : model.monomials().classes()) {
    if (here.ball == 0 && here.disturbance == 0) {
      sum.add_multiple(
          powers_of_s.at(static_cast<std::size_t>(here.s)) * powers_of_z.at(static_cast<std::size_t>(here.z)),
          model.coefficients()[here.first]);
    }
  }
  return sum.without_error();  // the doubles are the polynomial, whatever they come from
}

std::vector<BallModel> lifted(const std::vector<BallModel>& models) {
  std::vector<BallModel> result;
  result.reserve(models.size());
  for (const BallModel& model : models) {
    result.push_back(model.lifted());
  }
  return result;
}

/// The start on its way, over a cell.
class StartFollower {
 public:
  /// Needs the scope of the models, and the upward rounding mode.
  StartFollower(const TrackerModel& model, const TubeOfLevel& target, const TubeCell& cell,
                const StartQuestion& question)
      : model_(&model), target_(&target), question_(&question), shape_only_(*target.tube) {
    require_sizes(model, *target.tube);
    if (question.state.size() != target.tube->curve.size()) {
      throw std::invalid_argument("a start that does not fit the recursion");
    }
    shape_only_.curve.clear();
    const BallModelScope plane(0, 0);
    const CellPlace place = place_of(cell);
    first_phase_ = place.phase;
    z_ = place.z;
    frequency_ = frequency_at(*target.tube, z_);
  }

  [[nodiscard]] FollowedStart run() {
    FollowedStart result;
    begin();
    if (!include_error(result)) {
      is_error_known_ = false;
    }
    constexpr double kMostRadii = 64.0;  // of the tube: what is wider does not come back
    for (;;) {
      if (!(radius_ <= kMostRadii * target_->level)) {
        result.obstacle = fmt::format("at sample {} the bounds of its state are far wider than the set", sample_);
        break;
      }
      if (sample_ % kSamplesBetweenLooks == 0 && is_inside()) {
        result.is_captured = true;
        break;
      }
      if (sample_ >= question_->most_samples) {
        result.obstacle = fmt::format("after {} samples it is not in the set", sample_);
        break;
      }
      step();
      is_error_known_ = is_error_known_ && include_error(result);
    }
    result.samples = sample_;
    if (!is_error_known_) {
      result.frequency_error = Interval::empty();
    }
    return result;
  }

 private:
  /// phi + k omega, less whole turns. In the plane.
  [[nodiscard]] BallModel phase_at(std::size_t sample) const {
    return turned_back(first_phase_ + BallModel(static_cast<double>(sample)) * frequency_);
  }

  void begin() {
    shape_ = shape_at(0);
    std::vector<BallModel> errors;
    {
      const BallModelScope plane(0, 0);
      for (const Interval& state : question_->state) {
        const BallModel start(state);
        middle_.push_back(place_part(start));
        errors.push_back(start - middle_.back());
      }
    }
    is_known_ = is_shape(shape_);
    set_radius(in_units_of(shape_, lifted(errors)));
  }

  void step() {
    ++sample_;
    const std::vector<BallModel> inputs_of_state = state();
    std::vector<BallModel> samples;
    {
      const BallModelScope plane(0, 0);
      samples = model::run(*model_, *model_->signal, {BallModel(model_->amplitude), phase_at(sample_)});
    }
    std::vector<BallModel> inputs = inputs_of_state;
    for (BallModel& sample : noisy_samples(*model_, lifted(samples), question_->noise, 1.0)) {
      inputs.push_back(std::move(sample));
    }
    std::vector<BallModel> next = model::run(*model_, model_->recursion->step, inputs);
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (model_->recursion->is_angle[i]) {
        next[i] = turned_back(next[i]);
      }
    }
    {
      const BallModelScope plane(0, 0);
      for (std::size_t i = 0; i < next.size(); ++i) {
        middle_[i] = place_part(next[i]);
      }
    }
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i] -= middle_[i].lifted();
    }
    shape_ = shape_at(sample_);
    is_known_ = is_known_ && is_shape(shape_);
    set_radius(in_units_of(shape_, next));
  }

  /// The states, in the scope of the models.
  [[nodiscard]] std::vector<BallModel> state() const {
    TubeHere here = shape_;
    here.curve = lifted(middle_);
    return state_in(here, radius_);
  }

  [[nodiscard]] TubeHere shape_at(std::size_t sample) const {
    TubeHere here;
    {
      const BallModelScope plane(0, 0);
      here = tube_at(shape_only_, phase_at(sample), z_);
    }
    here.shape = lifted(here.shape);
    here.curve.assign(middle_count(), BallModel());  // as many states as the shape has rows
    return here;
  }
  [[nodiscard]] std::size_t middle_count() const { return question_->state.size(); }

  /// NaN where nothing is known, with which no comparison is true.
  void set_radius(const std::vector<BallModel>& rest) {
    // A ball of some size, for the bounds of what is linear in it.
    constexpr double kLeast = 0x1p-40;
    const double length = length_bounds(rest, {1.0}).front();
    radius_ = is_known_ && std::isfinite(length) && length >= 0.0 ? std::max(length, kLeast * target_->level)
                                                                  : std::numeric_limits<double>::quiet_NaN();
  }

  /// |U^-1 (P - C)| + r <= R_0.
  [[nodiscard]] bool is_inside() const {
    if (!(radius_ < target_->level)) {
      return false;
    }
    const BallModelScope plane(0, 0);
    const TubeHere here = tube_at(*target_->tube, phase_at(sample_), z_);
    std::vector<BallModel> deviation;
    for (std::size_t i = 0; i < middle_.size(); ++i) {
      const BallModel difference = middle_[i] - here.curve[i];
      deviation.push_back(model_->recursion->is_angle[i] ? turned_back(difference) : difference);
    }
    BallModel squares;
    for (const BallModel& component : in_units_of(here, deviation)) {
      squares += square(component);
    }
    const Interval range = squares.range();
    if (!is_shape(here) || !rigor::is_finite(range)) {
      return false;
    }
    const Interval length = rigor::sqrt(Interval::from_bounds(0.0, std::max(range.upper(), 0.0)));
    return rigor::certainly_less_equal(Interval((length + Interval(radius_)).upper()),
                                       Interval(target_->level));
  }

  /// The frequency error at this sample; false when nothing is known of it.
  [[nodiscard]] bool include_error(FollowedStart& result) const {
    const BallModel error =
        model::run(*model_, model_->recursion->frequency, state()).front() - frequency_.lifted();
    const Interval range = error.range();
    if (!rigor::is_finite(range)) {
      return false;
    }
    result.frequency_error = sample_ == 0 ? range : hull(result.frequency_error, range);
    return true;
  }

  const TrackerModel* model_;
  const TubeOfLevel* target_;
  const StartQuestion* question_;
  Tube shape_only_;
  BallModel first_phase_, z_, frequency_;  // of the plane
  std::vector<BallModel> middle_;          // P, of the plane
  TubeHere shape_;                         // U, of the scope
  double radius_ = 0.0;
  std::size_t sample_ = 0;
  bool is_known_ = true;
  bool is_error_known_ = true;
};

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

FollowedStart follow_start(const TrackerModel& model, const TubeOfLevel& target, const TubeCell& cell,
                           const StartQuestion& question) {
  const BallModelScope scope(model.recursion->states,
                             is_disturbed(model, question.noise) ? model.recursion->samples : 0);
  return StartFollower(model, target, cell, question).run();
}

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
      const bool is_cell = cell.half_turn > 0.0;  // and no point, that only says whether to go on
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
              kTurnOfPhase * cell.half_turn, late * target.tube->half_width * cell.half_z};
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
              kTurnOfPhase * j / kPhases + static_cast<double>(sample) * frequency, kTurnOfPhase);
          tube.at(phase, frame);
          Eigen::VectorXd near = x;
          for (Eigen::Index i = 0; i < near.size(); ++i) {
            if (model.recursion->is_angle[static_cast<std::size_t>(i)]) {
              near[i] -= kTurnOfPhase * std::round((near[i] - frame.curve[i]) / kTurnOfPhase);
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
