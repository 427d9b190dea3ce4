#include "analysis/model/capture/followed_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "analysis/model/step/map_bound.hpp"
#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/ball_model.hpp"
#include "analysis/rigor/elementary.hpp"

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
    constexpr double kMostRadii = 64.0;  // of the tube: wider sets of states do not come back
    for (;;) {
      if (!(radius_ <= kMostRadii * target_->level)) {
        result.obstacle =
            fmt::format("at sample {} the bounds of its state are far wider than the set", sample_);
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
  /// phi + k omega, minus whole turns. In the plane.
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

  /// NaN where nothing is known; no comparison with it is true.
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

}  // namespace

FollowedStart follow_start(const TrackerModel& model, const TubeOfLevel& target, const TubeCell& cell,
                           const StartQuestion& question) {
  const BallModelScope scope(model.recursion->states,
                             is_disturbed(model, question.noise) ? model.recursion->samples : 0);
  return StartFollower(model, target, cell, question).run();
}

}  // namespace veritrack::model
