// Waves as linear values, and the discs of what noise adds to them: docs/gain-proof.md, section 2.
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

/// The radius of the disc about A^s that holds |y|^s e^(i m (arg y - phase)).
double disc_radius(const Interval& amplitude, int magnitude, int order, double noise) {
  const Interval v(noise);
  if (magnitude > 0 && magnitude == std::abs(order)) {
    const Interval largest(amplitude.upper());
    return (FrameRules::whole_power(largest + v, magnitude) - FrameRules::whole_power(largest, magnitude))
        .upper();
  }
  if (!(noise < amplitude.lower())) {
    return INFINITY;
  }
  // Differences of powers grow with the amplitude, or fall where the power is negative.
  const Interval worst(magnitude >= 0 ? amplitude.upper() : amplitude.lower());
  const Interval power = FrameRules::whole_power(worst, magnitude);
  const Interval change = hull(FrameRules::whole_power(worst + v, magnitude) - power,
                               FrameRules::whole_power(worst - v, magnitude) - power);
  const Interval angle =
      Interval(static_cast<double>(std::abs(order))) * rigor::asin(v / Interval(amplitude.lower()));
  const double turned = std::min(angle.upper(), rigor::pi().upper());
  const Interval chord = Interval(2.0) * power * rigor::sin(Interval(0.5) * Interval(turned));
  // Half of pi, rounded up, has a sine of at most 1.
  return rigor::add_up(rigor::magnitude(change), rigor::magnitude(chord));
}

/// At most |c0| (1 - cos Y) + |c1| (Y - sin Y).
double wave_remainder(const Interval& c0, const Interval& c1, double bound) {
  if (!(bound < INFINITY)) {
    return INFINITY;
  }
  const Interval y(bound);
  const Interval even = bound < 3.0 ? Interval(1.0) - rigor::cos(y) : Interval(2.0);
  const Interval odd = y - rigor::sin(y);
  // In this order a bound that is no number stays none.
  return rigor::add_up(rigor::mul_up(rigor::magnitude(c0), std::max(even.upper(), 0.0)),
                       rigor::mul_up(rigor::magnitude(c1), std::max(odd.upper(), 0.0)));
}

}  // namespace

Interval FrameRules::whole_power(const Interval& x, int exponent) {
  Interval result(1.0);
  for (int i = 0; i < std::abs(exponent); ++i) {
    result *= x;
  }
  return exponent < 0 ? Interval(1.0) / result : result;
}

/// The angle of a monomial without that of noise: sum of k L + order (phi + omega).
FrameLine FrameRules::phase_of(Frame& frame, const Monomial& monomial) {
  FrameLine phase;
  phase.turns = monomial.order;
  phase.per_frequency = Interval(static_cast<double>(monomial.order));
  for (const auto& [name, multiple] : monomial.angles) {
    const double exact = multiple;
    phase = sum_of(phase, scaled(frame.angles_.at(name), Interval(exact), exact), false);
  }
  return phase;
}

int FrameRules::disc(Frame& frame, const Monomial& monomial) {
  const auto found = frame.discs_.find(monomial);
  if (found != frame.discs_.end()) {
    return found->second;
  }
  FrameInput input;
  input.components = monomial.is_real() ? 1 : 2;
  input.at_noise = [amplitude = frame.amplitude_, monomial, is_one = frame.channels_ == 1](double noise) {
    if (is_one) {
      return (whole_power(amplitude, monomial.magnitude) * whole_power(Interval(noise), monomial.noise))
          .upper();
    }
    return disc_radius(amplitude, monomial.magnitude, monomial.order, noise);
  };
  return frame.discs_[monomial] = add_input(frame, std::move(input));
}

bool FrameRules::keeps_positive(Frame& frame, const Monomial& monomial) {
  for (const auto& [name, power] : monomial.lengths) {
    if (name < 0 || frame.positive_.contains(name)) {
      continue;
    }
    const FrameLine& line = frame.lengths_.at(name);
    const Interval base = base_of(line, frame.band_);
    if (!rigor::certainly_less(Interval(0.0), base)) {
      return false;
    }
    add_limit(frame, add_form(frame, line), base);
    frame.positive_.insert(name);
  }
  return true;
}

/// Re M or Im M with linear values as factors.
FrameLine FrameRules::scaled_part(Frame& frame, const Monomial& monomial, int part) {
  if (monomial.has_unknown_length()) {
    throw NoFrame("the length of a vector of states matters");
  }
  Monomial bare = monomial;
  bare.lengths.clear();
  FrameLine line = part_of_wave(frame, bare, part);
  for (const auto& [name, power] : monomial.lengths) {
    const FrameLine& length = frame.lengths_.at(name);
    const FrameLine factor = power > 0 ? length : function_line(frame, FrameOperation::reciprocal, length);
    for (int i = 0; i < std::abs(power); ++i) {
      line = product_line(frame, line, factor, false);
    }
  }
  return line;
}

/// Re M (part 0) or Im M (part 1) of a monomial without factors.
FrameLine FrameRules::part_of_wave(Frame& frame, const Monomial& monomial, int part) {
  const auto key = std::pair(monomial, part);
  const auto found = frame.parts_.find(key);
  if (found != frame.parts_.end()) {
    return found->second;
  }
  if (!monomial.lengths.empty()) {
    return frame.parts_[key] = scaled_part(frame, monomial, part);
  }
  const FrameLine phase = phase_of(frame, monomial);
  FrameLine line;
  if (monomial.noise > 0) {
    add_component(line, disc(frame, monomial) + part, Interval(1.0));
    return frame.parts_[key] = std::move(line);
  }
  if (phase.turns != 0) {
    add_component(line, ripple(frame, monomial, phase) + part, Interval(1.0));
    return frame.parts_[key] = std::move(line);
  }
  if (frame.channels_ == 2 && (monomial.magnitude != 0 || monomial.order != 0)) {
    if (frame.shares_noise_) {
      add_shared_noise(frame, line, monomial, phase, part);
    } else {
      add_component(line, disc(frame, monomial) + part, Interval(1.0));
    }
  }
  const Interval size = whole_power(frame.amplitude_, monomial.magnitude);
  const Interval base = base_of(phase, frame.band_);
  const Interval cosine = size * rigor::cos(base);
  const Interval sine = size * rigor::sin(base);
  const Interval value = part == 0 ? cosine : sine;
  line.constant = value;
  if (!phase.is_form_empty()) {
    const Interval slope = part == 0 ? -sine : cosine;
    line = sum_of(line, scaled(form_of(phase), slope, std::nullopt), false);
    const int form = form_of_phase(frame, monomial, phase);
    add_remainder(frame, line, "a sine or cosine", [value, slope, form](const std::vector<double>& bounds) {
      return wave_remainder(value, slope, bounds[static_cast<std::size_t>(form)]);
    });
  }
  return frame.parts_[key] = std::move(line);
}

/// The first component of what turns with the signal.
int FrameRules::ripple(Frame& frame, const Monomial& monomial, const FrameLine& phase) {
  if (frame.channels_ != 1 || !phase.inputs.empty()) {
    throw NoFrame("a value that depends on the phase of the signal");
  }
  const auto found = frame.discs_.find(monomial);
  if (found != frame.discs_.end()) {
    return found->second;
  }
  const double size = rigor::magnitude(whole_power(frame.amplitude_, monomial.magnitude));
  FrameInput input;
  input.components = 2;
  input.at_noise = [size](double /*noise*/) { return size; };
  const int first = add_input(frame, std::move(input));
  frame.ripples_.push_back({first, phase.turns, size, phase.states});
  return frame.discs_[monomial] = first;
}

int FrameRules::form_of_phase(Frame& frame, const Monomial& monomial, const FrameLine& phase) {
  const auto found = frame.phase_forms_.find(monomial);
  return found != frame.phase_forms_.end() ? found->second
                                           : frame.phase_forms_[monomial] = add_angle_form(frame, phase);
}

FrameLine FrameRules::line_of_waves(Frame& frame, const Waves& waves) {
  FrameLine sum;
  for (const auto& [monomial, weights] : waves) {
    Interval factor(1.0);
    for (const int name : monomial.factors) {
      factor *= frame.factors_.at(name);
    }
    Monomial bare = monomial;
    bare.factors.clear();
    for (const auto& [part, weight] : {std::pair(0, weights.real), std::pair(1, weights.imaginary)}) {
      if (weight != 0.0) {
        sum = sum_of(sum, scaled(part_of_wave(frame, bare, part), factor * Interval(weight), std::nullopt),
                     false);
      }
    }
  }
  return sum;
}

}  // namespace veritrack::model
