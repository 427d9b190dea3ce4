#include "checker/model/gain/gain_network.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "checker/model/gain/frame_value.hpp"
#include "checker/model/gain/gain_ripples.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostForms = 128;

/// The forms of values of a frame, by their numbers.
class Forms {
 public:
  Forms(const LinearFrame& frame, std::vector<GainForm>& forms) : frame_(&frame), forms_(&forms) {}

  std::size_t of(int value) {
    const auto [place, is_new] = places_.try_emplace(value, forms_->size());
    if (is_new) {
      if (forms_->size() >= kMostForms) {
        throw NotCovered("too many forms");
      }
      GainForm form;
      form.row.assign(frame_->states(), zero);
      for (const auto& [source, factor] : frame_->at(value).deviations) {
        if (source < frame_->states()) {
          form.row[source] = factor.first;
        } else {
          form.direct[source - frame_->states()] = factor;
        }
      }
      forms_->push_back(std::move(form));
    }
    return place->second;
  }

 private:
  const LinearFrame* frame_;
  std::vector<GainForm>* forms_;
  std::map<int, std::size_t> places_;
};

/// Row number `state` of the recursion, and the residual of its steady state as an input.
void add_state(const LinearFrame& frame, const LinearValue& value, const SteadyState& steady, bool is_angle,
               std::size_t state, GainNetwork& network) {
  if (value.turns != steady.turns) {
    throw NotCovered("a state does not turn with the signal as its steady state does");
  }
  if (value.is_modulo_turn && !is_angle) {
    throw NotCovered("a state that is no angle is known modulo a turn only");
  }
  for (const auto& [source, factor] : value.deviations) {
    if (source < frame.states()) {
      network.matrix[state][source] = factor.first;
    } else {
      network.inputs[source - frame.states()].column[state] = factor;
    }
  }
  LinearValue left;
  left.constant = value.constant - steady.constant;
  left.per_frequency = value.per_frequency - steady.per_frequency - Ball(static_cast<double>(steady.turns));
  Ball residual = frame.base(left);
  if (is_angle) {
    const Ball turn = two * pi();
    residual -= Ball(std::round((residual / turn).near())) * turn;
  }
  const Ball rounding = Ball(0x1p-30) * (one + abs(steady.constant) + four * abs(steady.per_frequency));
  network.is_at_rest = network.is_at_rest && certainly_at_most(abs(residual), rounding);
  GainInput input;
  input.column.assign(frame.states(), {zero, zero});
  input.column[state].first = one;
  input.size = [size = abs(residual).upper()](const Ball& /*noise*/, const Ball& /*slew*/) { return size; };
  input.is_residual = true;
  network.inputs.push_back(std::move(input));
}

/// Remainders are about forms of inputs that come before them: the induction of the theorem within a sample.
void require_order(const GainNetwork& network) {
  for (std::size_t input = 0; input < network.inputs.size(); ++input) {
    for (const std::size_t form : network.inputs[input].about) {
      const auto& direct = network.forms[form].direct;
      if (!direct.empty() && direct.rbegin()->first >= input) {
        throw NotCovered("a remainder is about what comes after it");
      }
    }
  }
}

LinearValue deviating(const SteadyState& steady, std::size_t state, bool is_angle) {
  return {steady.turns, steady.constant, steady.per_frequency, {{state, {one, zero}}}, is_angle};
}

/// Of the imaginary part of a vector: the length of the vector is in its place.
bool has_length(const SteadyState& rest) {
  return !certainly_equal(rest.constant, zero) || !certainly_equal(rest.per_frequency, zero);
}

std::vector<FrameValue> frame_states(const std::vector<SteadyState>& steady,
                                     const std::vector<bool>& is_angle) {
  std::vector<std::optional<FrameValue>> values(steady.size());
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (steady[i].imaginary) {
      const std::size_t other = *steady[i].imaginary;
      const auto length = has_length(steady[other])
                              ? std::optional(std::pair(other, deviating(steady[other], other, false)))
                              : std::nullopt;
      const auto parts = FrameValue::vector(i, deviating(steady[i], i, true), length);
      values[i] = parts[0];
      values[*steady[i].imaginary] = parts[1];
    }
  }
  std::vector<FrameValue> states;
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (!values[i] && steady[i].turns != 0 && !is_angle[i]) {
      throw NotCovered("only an angle turns with the signal");
    }
    states.push_back(values[i] ? *values[i] : FrameValue::state(i, deviating(steady[i], i, is_angle[i])));
  }
  return states;
}

/// Two states each, no angles, in no other vector, and at the start as the steady state is: a length that is
/// not known says nothing of how far an angle is off. A length that is known is positive.
void require_vectors(const std::vector<SteadyState>& steady, const std::vector<bool>& is_angle,
                     const ModelDesign& design, std::size_t samples) {
  std::vector<bool> is_part(steady.size(), false);
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (!steady[i].imaginary) {
      continue;
    }
    const std::size_t other = *steady[i].imaginary;
    if (samples != 2 || other >= steady.size() || other == i) {
      throw NotCovered("a vector has two states, of a loop of two channels");
    }
    for (const std::size_t part : {i, other}) {
      const bool starts_off =
          !design.start_within.empty() && !certainly_equal(design.start_within.at(part), zero);
      if (is_part[part] || is_angle[part] || starts_off) {
        throw NotCovered(
            "a part of a vector is an angle, is in another vector, or starts off its steady state");
      }
      is_part[part] = true;
    }
    const SteadyState& rest = steady[other];
    const Ball length = rest.constant + rest.per_frequency * Ball::hull(design.lowest, design.highest);
    if (rest.turns != 0 || rest.imaginary || (has_length(rest) && !certainly_positive(length))) {
      throw NotCovered("the imaginary part of a vector has a steady state of its own");
    }
  }
}

/// The numbers of the next states; of a vector, of its angle, and of its length or 0: what is left of its
/// imaginary part.
std::vector<int> next_numbers(LinearFrame& frame, const std::vector<FrameValue>& values,
                              const std::vector<SteadyState>& steady) {
  std::vector<std::optional<int>> numbers(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (const auto& imaginary = steady[i].imaginary) {
      if (has_length(steady[*imaginary])) {
        LinearValue angle{steady[i].turns,
                          steady[i].constant,
                          steady[i].per_frequency + Ball(static_cast<double>(steady[i].turns)),
                          {},
                          false};
        const auto parts = FrameValue::polar(values[i], values[*imaginary], angle, *imaginary);
        numbers[i] = parts[0];
        numbers[*imaginary] = parts[1];
        continue;
      }
      numbers[i] = FrameValue::direction(values[i], values[*imaginary]);
      numbers[*imaginary] = frame.number(zero);
    }
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    result.push_back(numbers[i] ? *numbers[i] : values[i].linear());
  }
  return result;
}

}  // namespace

GainNetwork gain_network(const ModelRecursion& recursion, const ModelDesign& design,
                         const std::vector<SteadyState>& steady, bool has_one_noise) {
  const std::size_t n = recursion.states();
  if (recursion.filtered() > 0 || steady.size() != n) {
    throw NotCovered(recursion.samples() == 2
                         ? "gains are for loops of two channels, with one steady state for each state"
                         : "gains are for loops with one steady state for each state");
  }
  if (recursion.samples() == 1 && design.amplitude_varies) {
    throw NotCovered("in one channel, gains are for one amplitude at all samples");
  }
  LinearFrame frame(n, design.least_amplitude, design.largest_amplitude, design.lowest, design.highest,
                    recursion.samples(), has_one_noise);
  const FrameScope scope(frame);
  require_vectors(steady, recursion.is_angle(), design, recursion.samples());
  const std::vector<FrameValue> state = frame_states(steady, recursion.is_angle());
  const std::vector<FrameValue> samples =
      frame.has_one_channel() ? std::vector<FrameValue>{FrameValue::sample_of_one()}
                              : std::vector<FrameValue>{FrameValue::sample(0), FrameValue::sample(1)};
  const std::vector<int> next = next_numbers(frame, recursion.next(state, samples), steady);
  const int error = (recursion.frequency(state)).linear();
  const LinearValue frequency = frame.at(error);
  if (!frequency.is_plain()) {
    throw NotCovered("the frequency depends on an angle");
  }

  GainNetwork network;
  network.least_amplitude = design.least_amplitude;
  network.matrix.assign(n, std::vector<Ball>(n, zero));
  Forms forms(frame, network.forms);
  for (const FrameInput& input : frame.inputs()) {
    GainInput entry;
    entry.column.assign(n, {zero, zero});
    if (input.is_remainder()) {
      for (const int value : input.about) {
        entry.about.push_back(forms.of(value));
      }
      entry.at_bounds = input.at_bounds;
    } else {
      entry.size = [size = input.at_noise](const Ball& noise, const Ball& /*slew*/) { return size(noise); };
    }
    network.inputs.push_back(std::move(entry));
  }
  require_order(network);
  for (const FrameLimit& limit : frame.limits()) {
    network.limits.push_back({forms.of(limit.about), limit.base, limit.low, limit.high});
    network.is_at_rest =
        network.is_at_rest && certainly_less(limit.low, limit.base) && certainly_less(limit.base, limit.high);
  }
  for (const int angle : frame.angles()) {
    network.angle_forms.push_back(forms.of(angle));
  }
  network.is_at_rest = network.is_at_rest && !frame.may_rest_at_kink();
  network.error_form = forms.of(error);
  network.frequency = network.forms[network.error_form].row;
  LinearValue bias;
  bias.constant = frequency.constant;
  bias.per_frequency = frequency.per_frequency - one;
  network.bias = frame.base(bias);
  for (std::size_t i = 0; i < n; ++i) {
    add_state(frame, frame.at(next[i]), steady[i], recursion.is_angle()[i] || steady[i].imaginary, i,
              network);
  }
  GainInput slew;
  for (const SteadyState& each : steady) {
    slew.column.push_back({-each.per_frequency, zero});
    network.turns.push_back(each.turns);
    network.has_vector = network.has_vector || each.imaginary;
  }
  slew.size = [](const Ball& /*noise*/, const Ball& most) { return most; };
  network.inputs.push_back(std::move(slew));
  add_ripples(frame.inputs(), design.lowest, design.highest, network);
  return network;
}

}  // namespace veritrack::checker
