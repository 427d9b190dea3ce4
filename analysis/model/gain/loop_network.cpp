#include "analysis/model/gain/loop_network.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

/// The values of a program, with these after the constants.
std::vector<FrameValue> run(const trackers::StraightLineProgram& program, Frame& frame,
                            const std::vector<Interval>& constants, const std::vector<FrameValue>& values) {
  std::vector<FrameValue> inputs;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    inputs.push_back(frame.constant(static_cast<int>(i), constants[i]));
  }
  inputs.insert(inputs.end(), values.begin(), values.end());
  std::vector<FrameValue> registers;
  std::vector<FrameValue> results(program.results().size(), FrameValue(0));
  program.run(std::span<const FrameValue>(inputs), registers, std::span<FrameValue>(results));
  return results;
}

linear::Row states_of(const FrameLine& line, std::size_t states) {
  return line.states.empty() ? linear::Row(states, Interval(0.0)) : line.states;
}

Interval weight_of(const FrameLine& line, int component) {
  const auto found = line.inputs.find(component);
  return found == line.inputs.end() ? Interval(0.0) : found->second;
}

class Assembly {
 public:
  Assembly(const TrackerModel& tracker, const std::vector<SteadyValue>& steady, const Interval& band)
      : tracker_(&tracker),
        steady_(&steady),
        states_(steady.size()),
        frame_(tracker.amplitude, band, static_cast<int>(steady.size())) {}

  [[nodiscard]] LoopNetwork make() {
    std::vector<FrameValue> values;
    for (std::size_t i = 0; i < states_; ++i) {
      const SteadyValue& each = (*steady_)[i];
      values.push_back(frame_.state(static_cast<int>(i), tracker_->recursion->is_angle[i], each.turns,
                                    each.constant, each.per_frequency));
    }
    const std::vector<FrameValue> error =
        run(tracker_->recursion->frequency, frame_, tracker_->constants, values);
    frequency_ = frame_.line_of(error.front());
    if (frequency_.turns != 0 || frequency_.is_modular) {
      throw NoFrame("a frequency that is an angle");
    }
    values.push_back(frame_.sample(0));
    values.push_back(frame_.sample(1));
    for (const FrameValue& each : run(tracker_->recursion->step, frame_, tracker_->constants, values)) {
      next_.push_back(frame_.line_of(each));
    }
    add_matrix();
    add_frame_inputs();
    add_frequency_inputs();
    add_forms();
    return std::move(network_);
  }

 private:
  void add_matrix() {
    for (std::size_t i = 0; i < states_; ++i) {
      const bool is_angle = tracker_->recursion->is_angle[i];
      if (next_[i].turns != (*steady_)[i].turns || (next_[i].is_modular && !is_angle)) {
        throw NoFrame("a state that does not turn as its steady state does");
      }
      network_.a.push_back(states_of(next_[i], states_));
    }
  }

  void add_frame_inputs() {
    for (const FrameInput& input : frame_.inputs()) {
      linear::GainInput columns;
      for (int component = input.first; component < input.first + input.components; ++component) {
        columns.columns.emplace_back();
        for (const FrameLine& line : next_) {
          columns.columns.back().push_back(weight_of(line, component));
        }
      }
      network_.columns.push_back(std::move(columns));
      NetworkInput made;
      made.what = input.what;
      if (input.is_remainder) {
        made.cause = NetworkInput::Cause::remainder;
        made.size = [size = input.at_bounds](double /*noise*/, double /*slew*/,
                                             const std::vector<double>& bounds) { return size(bounds); };
      } else {
        made.size = [size = input.at_noise](double noise, double /*slew*/,
                                            const std::vector<double>& /*bounds*/) { return size(noise); };
      }
      network_.inputs.push_back(std::move(made));
    }
  }

  /// A frequency that moves, and what is left of the steady state after a step.
  void add_frequency_inputs() {
    linear::GainInput moves{{linear::Row()}};
    for (const SteadyValue& each : *steady_) {
      moves.columns.front().push_back(-Interval(each.per_frequency));
    }
    network_.columns.push_back(std::move(moves));
    network_.inputs.push_back({NetworkInput::Cause::slew, "",
                               [](double /*noise*/, double slew, const auto& /*bounds*/) { return slew; }});
    for (std::size_t i = 0; i < states_; ++i) {
      const SteadyValue& each = (*steady_)[i];
      Interval residual = next_[i].constant - Interval(each.constant) +
                          (next_[i].per_frequency - Interval(each.per_frequency) -
                           Interval(static_cast<double>(each.turns))) *
                              frame_.band();
      if (tracker_->recursion->is_angle[i]) {
        const Interval turn = Interval(2.0) * rigor::pi();
        residual -= Interval(std::round(rigor::midpoint(residual) / rigor::midpoint(turn))) * turn;
      }
      linear::GainInput unit{{linear::Row(states_, Interval(0.0))}};
      unit.columns.front()[i] = Interval(1.0);
      network_.columns.push_back(std::move(unit));
      const double size = rigor::is_finite(residual) ? rigor::magnitude(residual) : INFINITY;
      network_.inputs.push_back(
          {NetworkInput::Cause::residual, "",
           [size](double /*noise*/, double /*slew*/, const auto& /*bounds*/) { return size; }});
    }
  }

  void add_forms() {
    for (const FrameLine& form : frame_.forms()) {
      add_form(form);
    }
    add_form(frequency_);
    network_.bias = frequency_.constant + (frequency_.per_frequency - Interval(1.0)) * frame_.band();
    for (const FrameLimit& limit : frame_.limits()) {
      network_.limits.emplace_back(static_cast<std::size_t>(limit.form), limit.room);
    }
    const linear::Row& row = network_.forms.back();
    const auto is_not_zero = [](const Interval& x) { return rigor::magnitude(x) > 0.0; };
    if (frequency_.inputs.empty() && std::count_if(row.begin(), row.end(), is_not_zero) == 1) {
      const auto place = std::find_if(row.begin(), row.end(), is_not_zero);
      network_.frequency_state = {static_cast<std::size_t>(place - row.begin()),
                                  std::min(std::fabs(place->lower()), std::fabs(place->upper()))};
    }
  }

  void add_form(const FrameLine& form) {
    network_.forms.push_back(states_of(form, states_));
    network_.direct.emplace_back();
    for (std::size_t l = 0; l < frame_.inputs().size(); ++l) {
      const FrameInput& input = frame_.inputs()[l];
      Interval squares(0.0);
      double single = 0.0;
      for (int component = input.first; component < input.first + input.components; ++component) {
        single = rigor::magnitude(weight_of(form, component));
        squares += square(weight_of(form, component));
      }
      const double weight = input.components == 1 ? single : sqrt(squares).upper();
      if (!(weight == 0.0)) {
        network_.direct.back().push_back({l, weight});
      }
    }
  }

  const TrackerModel* tracker_;
  const std::vector<SteadyValue>* steady_;
  std::size_t states_;
  Frame frame_;
  FrameLine frequency_;
  std::vector<FrameLine> next_;
  LoopNetwork network_;
};

/// The state at the phase 0 that a step to the phase omega turns by omega, if Newton's method finds one.
std::optional<Eigen::VectorXd> steady_at(const TrackedTone& tone, double omega, const std::vector<int>& turns,
                                         Eigen::VectorXd state) {
  constexpr int kSteps = 50;
  const auto n = static_cast<Eigen::Index>(turns.size());
  const Eigen::VectorXd sample = samples_of(tone.signal, tone.amplitude, omega);
  double last = INFINITY;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::VectorXd residual = tone.step.next(state, sample) - state;
    for (Eigen::Index i = 0; i < n; ++i) {
      residual(i) -= turns[static_cast<std::size_t>(i)] * omega;
      if (tone.step.recursion().is_angle[static_cast<std::size_t>(i)]) {
        residual(i) = std::remainder(residual(i), 2.0 * rigor::midpoint(rigor::pi()));
      }
    }
    const Eigen::MatrixXd slope = tone.step.jacobian(state, sample).leftCols(n);
    const Eigen::VectorXd change =
        rigor::product(rigor::approximate_inverse(slope - rigor::identity(n)), residual);
    if (!change.allFinite()) {
      return std::nullopt;
    }
    state -= change;
    const double size = change.cwiseAbs().cwiseQuotient(state.cwiseAbs().cwiseMax(1e-6)).maxCoeff();
    // As near as rounding lets it come.
    if (size < 1e-14 || (size < 1e-6 && size >= 0.5 * last)) {
      return state;
    }
    last = size;
  }
  return std::nullopt;
}

}  // namespace

LoopNetwork loop_network(const TrackerModel& tracker, const std::vector<SteadyValue>& steady,
                         const Interval& band) {
  if (tracker.recursion->samples != 2 || steady.size() != tracker.recursion->is_angle.size()) {
    throw NoFrame("one channel");
  }
  return Assembly(tracker, steady, band).make();
}

std::optional<std::vector<SteadyValue>> proposed_steady_state(const TrackedTone& tone, double low,
                                                              double high) {
  const rigor::NearestRounding nearest;
  const std::vector<bool>& is_angle = tone.step.recursion().is_angle;
  std::vector<int> turns;
  for (const bool each : is_angle) {
    turns.push_back(each ? 1 : 0);
  }
  const auto find = [&](double omega) {
    const std::vector<double> start = tone.start(omega);
    return steady_at(
        tone, omega, turns,
        Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size())));
  };
  const auto first = find(low);
  const auto second = find(high);
  if (!first || !second) {
    return std::nullopt;
  }
  std::vector<SteadyValue> steady;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    double change = (*second)(place) - (*first)(place);
    if (is_angle[i]) {
      change = std::remainder(change, 2.0 * rigor::midpoint(rigor::pi()));
    }
    const double size = std::max(std::fabs((*first)(place)), std::fabs((*second)(place)));
    double slope = high > low && std::fabs(change) > 1e-11 * size ? change / (high - low) : 0.0;
    // A whole number is most often meant where it is nearly one.
    slope = std::fabs(slope - std::nearbyint(slope)) < 1e-9 * std::max(1.0, std::fabs(slope))
                ? std::nearbyint(slope)
                : slope;
    double constant = (*first)(place)-slope * low;
    constant =
        std::fabs(constant) < 1e-11 * std::max(size, std::fabs(slope * low)) || std::fabs(constant) < 1e-13
            ? 0.0
            : constant;
    steady.push_back({turns[i], constant, slope});
  }
  return steady;
}

}  // namespace veritrack::model
