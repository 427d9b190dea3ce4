#include "analysis/model/gain/loop_network.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "analysis/linear/resolvent.hpp"
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

}  // namespace

bool has_length(const SteadyValue& vector, const std::vector<SteadyValue>& steady) {
  const SteadyValue& rest = steady.at(*vector.imaginary);
  return rest.constant != 0.0 || rest.per_frequency != 0.0;
}

namespace {

class Assembly {
 public:
  Assembly(const TrackerModel& tracker, const std::vector<SteadyValue>& steady, const Interval& band,
           bool shares_noise)
      : tracker_(&tracker),
        steady_(&steady),
        states_(steady.size()),
        frame_(tracker.amplitude, band, static_cast<int>(steady.size()), tracker.recursion->samples,
               shares_noise) {
    network_.shares_noise = shares_noise;
  }

  /// Not evidence.
  [[nodiscard]] StepResidual residual() {
    run_formulas();
    add_matrix();
    const auto n = static_cast<Eigen::Index>(states_);
    StepResidual result{Eigen::VectorXd(n), Eigen::MatrixXd(n, n)};
    for (std::size_t i = 0; i < states_; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      result.value(row) = rigor::midpoint(residual_of(i));
      for (std::size_t j = 0; j < states_; ++j) {
        result.slope(row, static_cast<Eigen::Index>(j)) = rigor::midpoint(network_.a[i][j]);
      }
    }
    return result;
  }

  [[nodiscard]] LoopNetwork make() {
    run_formulas();
    add_matrix();
    add_frame_inputs();
    add_frequency_inputs();
    add_forms();
    add_ripples();
    add_form(frequency_);
    network_.ripple.resize(network_.forms.size(), 0.0);
    if (network_.has_ripples) {
      average_ripples();
    }
    return std::move(network_);
  }

 private:
  void run_formulas() {
    std::vector<FrameValue> values = frame_states();
    const std::vector<FrameValue> error =
        run(tracker_->recursion->frequency, frame_, tracker_->constants, values);
    frequency_ = frame_.line_of(error.front());
    if (frequency_.turns != 0 || frequency_.is_modular) {
      throw NoFrame("a frequency that is an angle");
    }
    for (int channel = 0; channel < tracker_->recursion->samples; ++channel) {
      values.push_back(frame_.sample(channel));
    }
    const std::vector<FrameValue> results =
        run(tracker_->recursion->step, frame_, tracker_->constants, values);
    next_.resize(states_);
    std::vector<bool> is_part(states_, false);
    for (std::size_t i = 0; i < states_; ++i) {
      const SteadyValue& each = (*steady_)[i];
      if (!each.imaginary) {
        continue;
      }
      const std::size_t other = *each.imaginary;
      is_part[i] = is_part[other] = true;
      if (has_length(each, *steady_)) {
        const auto both = frame_.polar_of(results[i], results[other], length_of(each).name(), each.turns,
                                          each.constant, each.per_frequency);
        next_[i] = both[0];
        next_[other] = both[1];
      } else {
        next_[i] = frame_.direction_of(results[i],
                                       results[other]);  // what is left of the other part does not matter
      }
    }
    for (std::size_t i = 0; i < states_; ++i) {
      next_[i] = is_part[i] ? next_[i] : frame_.line_of(results[i]);
    }
  }

  /// The length of a vector; a constant where it may be any.
  [[nodiscard]] FrameValue length_of(const SteadyValue& vector) {
    const SteadyValue& rest = (*steady_)[*vector.imaginary];
    return has_length(vector, *steady_) ? frame_.state(static_cast<int>(*vector.imaginary), false, 0,
                                                       rest.constant, rest.per_frequency)
                                        : FrameValue(1);
  }

  [[nodiscard]] std::vector<FrameValue> frame_states() {
    std::vector<std::optional<FrameValue>> parts(states_);
    for (std::size_t i = 0; i < states_; ++i) {
      const SteadyValue& each = (*steady_)[i];
      if (each.imaginary) {
        const auto both = frame_.vector(static_cast<int>(i), each.turns, each.constant, each.per_frequency,
                                        length_of(each));
        parts[i] = both[0];
        parts[*each.imaginary] = both[1];
      }
    }
    std::vector<FrameValue> values;
    for (std::size_t i = 0; i < states_; ++i) {
      const SteadyValue& each = (*steady_)[i];
      values.push_back(parts[i] ? *parts[i]
                                : frame_.state(static_cast<int>(i), tracker_->recursion->is_angle[i],
                                               each.turns, each.constant, each.per_frequency));
    }
    return values;
  }

  /// Known up to whole turns.
  [[nodiscard]] bool is_angle(std::size_t i) const {
    return tracker_->recursion->is_angle[i] || (*steady_)[i].imaginary;
  }

  void add_matrix() {
    for (std::size_t i = 0; i < states_; ++i) {
      if (next_[i].turns != (*steady_)[i].turns || (next_[i].is_modular && !is_angle(i))) {
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

  /// The residual of the steady state of state i after a step.
  [[nodiscard]] Interval residual_of(std::size_t i) const {
    const SteadyValue& each = (*steady_)[i];
    Interval residual =
        next_[i].constant - Interval(each.constant) +
        (next_[i].per_frequency - Interval(each.per_frequency) - Interval(static_cast<double>(each.turns))) *
            frame_.band();
    if (is_angle(i)) {
      const Interval turn = Interval(2.0) * rigor::pi();
      residual -= Interval(std::round(rigor::midpoint(residual) / rigor::midpoint(turn))) * turn;
    }
    return residual;
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
      const Interval residual = residual_of(i);
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
    network_.angle_forms.assign(frame_.angle_forms().begin(), frame_.angle_forms().end());
    network_.may_rest_at_kink = frame_.may_rest_at_kink();
    network_.bias = frequency_.constant + (frequency_.per_frequency - Interval(1.0)) * frame_.band();
    for (const FrameLimit& limit : frame_.limits()) {
      network_.limits.emplace_back(static_cast<std::size_t>(limit.form), limit.room);
    }
    const linear::Row row = states_of(frequency_, states_);
    const auto is_not_zero = [](const Interval& x) { return rigor::magnitude(x) > 0.0; };
    if (frequency_.inputs.empty() && std::count_if(row.begin(), row.end(), is_not_zero) == 1) {
      const auto place = std::find_if(row.begin(), row.end(), is_not_zero);
      network_.frequency_state = {static_cast<std::size_t>(place - row.begin()),
                                  std::min(std::fabs(place->lower()), std::fabs(place->upper()))};
    }
  }

  /// The changes of the angles of what turns, from one sample to the next: a form for each.
  void add_ripples() {
    for (const FrameRipple& ripple : frame_.ripples()) {
      const linear::Row phase = ripple.states.empty() ? linear::Row(states_, Interval(0.0)) : ripple.states;
      FrameLine change;
      for (std::size_t j = 0; j < states_; ++j) {
        Interval sum = -phase[j];
        for (std::size_t i = 0; i < states_; ++i) {
          sum += phase[i] * network_.a[i][j];
        }
        change.states.push_back(sum);
      }
      for (const FrameInput& input : frame_.inputs()) {
        for (int component = input.first; component < input.first + input.components; ++component) {
          Interval sum(0.0);
          for (std::size_t i = 0; i < states_; ++i) {
            sum += phase[i] * weight_of(next_[i], component);
          }
          change.inputs[component] = sum;
        }
      }
      FrameLine angle;
      angle.states = phase;
      network_.turning.push_back({0.0, network_.forms.size()});
      add_form(angle);
      changes_.push_back(network_.forms.size());
      add_form(change);
      // Residuals of the steady state change it, too.
      for (std::size_t i = 0; i < states_; ++i) {
        network_.direct.back().push_back({frame_.inputs().size() + 1 + i, rigor::magnitude(phase[i])});
      }
    }
    network_.has_ripples = !frame_.ripples().empty();
    if (network_.has_ripples && tracker_->amplitude_varies) {
      throw NoFrame("an amplitude that varies, with one channel");
    }
  }

  /// Each part that turns with the signal is known: it is taken out of the sums, and its drift is put in
  /// (docs/gain-proof.md, section 9).
  void average_ripples() {
    constexpr int kParts = 1024;
    network_.ripple_at_start.assign(states_, 0.0);
    std::vector<std::vector<double>> drifts(states_);  // of each state, by ripple
    for (std::size_t r = 0; r < frame_.ripples().size(); ++r) {
      const FrameRipple& ripple = frame_.ripples()[r];
      linear::Row real;
      linear::Row imaginary;
      for (const FrameLine& line : next_) {
        real.push_back(weight_of(line, ripple.first));
        imaginary.push_back(-weight_of(line, ripple.first + 1));
      }
      const auto response = linear::turning_response(network_.a, real, imaginary, ripple.turns,
                                                     network_.forms, frame_.band(), kParts);
      if (!response) {
        throw NoFrame("a mode of the loop turns with the signal");
      }
      for (std::size_t f = 0; f < network_.forms.size(); ++f) {
        network_.ripple[f] =
            rigor::add_up(network_.ripple[f], rigor::mul_up(ripple.size, response->forms[f]));
      }
      for (std::size_t j = 0; j < states_; ++j) {
        drifts[j].push_back(rigor::mul_up(ripple.size, response->rest[j]));
        network_.ripple_at_start[j] =
            rigor::add_up(network_.ripple_at_start[j], rigor::mul_up(ripple.size, response->states[j]));
      }
      network_.turning[r].error = rigor::mul_up(ripple.size, response->forms.back());
      move_column(ripple.first, rigor::mul_up(ripple.size, response->direct), changes_[r]);
    }
    for (std::size_t j = 0; j < states_; ++j) {
      linear::GainInput unit{{linear::Row(states_, Interval(0.0))}};
      unit.columns.front()[j] = Interval(1.0);
      network_.columns.push_back(std::move(unit));
      network_.inputs.push_back({NetworkInput::Cause::remainder, "what turns with the signal",
                                 [sizes = drifts[j], changes = changes_](double /*noise*/, double /*slew*/,
                                                                         const std::vector<double>& bounds) {
                                   double sum = 0.0;
                                   for (std::size_t r = 0; r < sizes.size(); ++r) {
                                     sum = rigor::add_up(
                                         sum, rigor::mul_up(sizes[r], std::min(2.0, bounds[changes[r]])));
                                   }
                                   return sum;
                                 }});
    }
  }

  /// The input stays, for forms that it is part of within the sample; its column is that of its drift.
  void move_column(int first, double size, std::size_t change) {
    for (std::size_t l = 0; l < frame_.inputs().size(); ++l) {
      if (frame_.inputs()[l].first != first) {
        continue;
      }
      network_.columns.push_back(network_.columns[l]);
      network_.inputs.push_back(
          {NetworkInput::Cause::remainder, "what turns with the signal",
           [size, change](double /*noise*/, double /*slew*/, const std::vector<double>& bounds) {
             return rigor::mul_up(size, std::min(2.0, bounds[change]));
           }});
      for (linear::Row& column : network_.columns[l].columns) {
        column.assign(states_, Interval(0.0));
      }
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
  std::vector<std::size_t> changes_;  // forms
  LoopNetwork network_;
};

}  // namespace

LoopNetwork loop_network(const TrackerModel& tracker, const std::vector<SteadyValue>& steady,
                         const Interval& band, bool shares_noise) {
  if (steady.size() != tracker.recursion->is_angle.size()) {
    throw NoFrame("another number of states");
  }
  return Assembly(tracker, steady, band, shares_noise).make();
}

StepResidual step_residual(const TrackerModel& tracker, const std::vector<SteadyValue>& steady,
                           double omega) {
  return Assembly(tracker, steady, Interval(omega), false).residual();
}

}  // namespace veritrack::model
