// Remainders, and what noise adds: docs/gain-proof.md, section 2.
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/model/gain/grid_function.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

Interval whole_power(const Interval& x, int exponent) {
  Interval result(1.0);
  for (int i = 0; i < std::abs(exponent); ++i) {
    result *= x;
  }
  return exponent < 0 ? Interval(1.0) / result : result;
}

/// The radius of the disc about A^s that holds |y|^s e^(i m (arg y - phase)).
double disc_radius(const Interval& amplitude, int magnitude, int order, double noise) {
  const Interval v(noise);
  if (magnitude > 0 && magnitude == std::abs(order)) {
    const Interval largest(amplitude.upper());
    return (whole_power(largest + v, magnitude) - whole_power(largest, magnitude)).upper();
  }
  if (!(noise < amplitude.lower())) {
    return INFINITY;
  }
  // Differences of powers grow with the amplitude, or fall where the power is negative.
  const Interval worst(magnitude >= 0 ? amplitude.upper() : amplitude.lower());
  const Interval power = whole_power(worst, magnitude);
  const Interval change =
      hull(whole_power(worst + v, magnitude) - power, whole_power(worst - v, magnitude) - power);
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

struct FunctionRule {
  const char* name;
  Interval (*value)(const Interval& x);
  Interval (*slope)(const Interval& x);
};

const Interval kOne(1.0);

FunctionRule rule_of(FrameOperation operation) {
  using I = const Interval&;
  switch (operation) {
    case FrameOperation::reciprocal:
      return {"a quotient", [](I x) { return kOne / x; }, [](I x) { return -kOne / square(x); }};
    case FrameOperation::root:
      return {"a square root", [](I x) { return sqrt(x); }, [](I x) { return Interval(0.5) / sqrt(x); }};
    case FrameOperation::exponential:
      return {"exp", [](I x) { return rigor::exp(x); }, [](I x) { return rigor::exp(x); }};
    case FrameOperation::logarithm:
      return {"log", [](I x) { return rigor::log(x); }, [](I x) { return kOne / x; }};
    case FrameOperation::tangent:
      return {"tan", [](I x) { return rigor::tan(x); }, [](I x) { return kOne + square(rigor::tan(x)); }};
    case FrameOperation::arcsine:
      return {"asin", [](I x) { return rigor::asin(x); }, [](I x) { return kOne / sqrt(kOne - square(x)); }};
    case FrameOperation::arccosine:
      return {"acos", [](I x) { return rigor::acos(x); }, [](I x) { return -kOne / sqrt(kOne - square(x)); }};
    case FrameOperation::arctangent:
      return {"atan", [](I x) { return rigor::atan(x); }, [](I x) { return kOne / (kOne + square(x)); }};
    default:
      throw NoFrame("a function without a rule");
  }
}

/// At most the integral of |f'(b +- s) - f'(b)| over s from 0 to Y.
double function_remainder(const FunctionRule& rule, const Interval& base, double bound) {
  constexpr int kCells = 64;
  if (!(bound < INFINITY)) {
    return INFINITY;
  }
  const Interval slope = rule.slope(base);
  double sum = 0.0;
  for (int i = 0; i < kCells; ++i) {
    const Interval cell =
        Interval(bound) * Interval::from_bounds(i, i + 1) / Interval(static_cast<double>(kCells));
    const Interval up = rule.slope(base + cell) - slope;
    const Interval down = rule.slope(base - cell) - slope;
    if (!rigor::is_finite(up) || !rigor::is_finite(down)) {
      return INFINITY;
    }
    sum = rigor::add_up(
        sum, rigor::mul_up(std::max(rigor::magnitude(up), rigor::magnitude(down)), rigor::width(cell)));
  }
  return sum;
}

/// The same of exp, whose slope at the base is known: one power after the other.
double exponential_remainder(const Interval& slope, double bound) {
  constexpr double kCells = 64.0;
  if (!(bound < INFINITY)) {
    return INFINITY;
  }
  const double width = bound / kCells;
  const double growth = rigor::exp(Interval(width)).upper();
  double at_end = slope.upper();
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(kCells); ++i) {
    at_end = rigor::mul_up(at_end, growth);
    sum = rigor::add_up(sum, rigor::mul_up(rigor::sub_up(at_end, slope.lower()), width));
  }
  return sum < INFINITY ? sum : INFINITY;
}

/// sup |arg(1 + u + i v) - v| over |u| <= along, |v| <= across; infinite where it may be as far as `room`
/// from 0.
double direction_remainder(double along, double across, const Interval& room) {
  if (!(along < 1.0) || !(across < INFINITY)) {
    return INFINITY;
  }
  const Interval u(along);
  const Interval v(across);
  const Interval nearest = Interval(1.0) - u;
  if (!rigor::certainly_less(rigor::atan(v / nearest), room)) {
    return INFINITY;
  }
  // atan(v/(1 - u)) - v grows up to this v, and falls from there on; v - atan(v/(1 + u)) grows.
  const Interval top = sqrt(u * nearest);
  const Interval at = across < top.lower() ? v : top;
  return larger_or_nan((rigor::atan(at / nearest) - at).upper(),
                       (v - rigor::atan(v / (Interval(1.0) + u))).upper());
}

void require_no_turns(const FrameLine& line) {
  if (line.turns != 0 || line.is_modular) {
    throw NoFrame("a function of an angle other than sin and cos");
  }
}

FrameLine form_of(const FrameLine& line) {
  FrameLine form;
  form.states = line.states;
  form.inputs = line.inputs;
  return form;
}

void add_component(FrameLine& line, int component, const Interval& weight) {
  const auto [place, is_new] = line.inputs.try_emplace(component, weight);
  if (!is_new) {
    place->second += weight;
  }
}

Interval base_of(const FrameLine& line, const Interval& band) {
  return line.constant + line.per_frequency * band;
}

FrameInput remainder(std::string what, std::function<double(const std::vector<double>&)> size) {
  FrameInput input;
  input.is_remainder = true;
  input.what = std::move(what);
  input.at_bounds = std::move(size);
  return input;
}

}  // namespace

int FrameRules::add_form(Frame& frame, const FrameLine& line) {
  frame.forms_.push_back(form_of(line));
  return static_cast<int>(frame.forms_.size()) - 1;
}

int FrameRules::add_input(Frame& frame, FrameInput input) {
  input.first = frame.components_;
  frame.components_ += input.components;
  frame.inputs_.push_back(std::move(input));
  return frame.inputs_.back().first;
}

int FrameRules::add_angle_form(Frame& frame, const FrameLine& line) {
  frame.angle_forms_.push_back(add_form(frame, line));
  return frame.angle_forms_.back();
}

void FrameRules::add_limit(Frame& frame, int form, const Interval& room) {
  if (!rigor::certainly_less(Interval(0.0), room)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  frame.limits_.push_back({form, room.lower()});
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
    add_component(line, disc(frame, monomial) + part, Interval(1.0));
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
    const int input = add_input(
        frame, remainder("a sine or cosine", [value, slope, form](const std::vector<double>& bounds) {
          return wave_remainder(value, slope, bounds[static_cast<std::size_t>(form)]);
        }));
    add_component(line, input, Interval(1.0));
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

FrameLine FrameRules::product_line(Frame& frame, const FrameLine& a, const FrameLine& b, bool is_square) {
  require_no_turns(a);
  require_no_turns(b);
  const Interval x = base_of(a, frame.band_);
  const Interval y = base_of(b, frame.band_);
  FrameLine line = sum_of(scaled(form_of(a), y, std::nullopt), scaled(form_of(b), x, std::nullopt), false);
  // To first order in omega where one of them does not depend on it.
  if (a.per_frequency == Interval(0.0) || b.per_frequency == Interval(0.0)) {
    line.constant = a.constant * b.constant;
    line.per_frequency = a.per_frequency * b.constant + b.per_frequency * a.constant;
  } else {
    line.constant = is_square ? square(x) : x * y;
  }
  if (a.is_form_empty() || b.is_form_empty()) {
    return line;
  }
  const auto first = static_cast<std::size_t>(add_form(frame, a));
  const auto second = is_square ? first : static_cast<std::size_t>(add_form(frame, b));
  const int input =
      add_input(frame, remainder("a product", [first, second](const std::vector<double>& bounds) {
                  return rigor::mul_up(bounds[first], bounds[second]);
                }));
  add_component(line, input, Interval(1.0));
  return line;
}

FrameLine FrameRules::function_line(Frame& frame, FrameOperation operation, const FrameLine& operand) {
  require_no_turns(operand);
  const FunctionRule rule = rule_of(operation);
  const Interval base = base_of(operand, frame.band_);
  const Interval slope = rule.slope(base);
  FrameLine line;
  line.constant = rule.value(base);
  if (operand.is_form_empty()) {
    return line;
  }
  if (!rigor::is_finite(slope) || !rigor::is_finite(line.constant)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  line = sum_of(line, scaled(form_of(operand), slope, std::nullopt), false);
  const auto form = static_cast<std::size_t>(add_form(frame, operand));
  const bool is_exponential = operation == FrameOperation::exponential;
  const auto size = [rule, base, slope, form, is_exponential](const std::vector<double>& bounds) {
    return is_exponential ? exponential_remainder(slope, bounds[form])
                          : function_remainder(rule, base, bounds[form]);
  };
  const int input = add_input(frame, remainder(rule.name, size));
  add_component(line, input, Interval(1.0));
  return line;
}

namespace {

/// A vector in its steady state, and what deviates along it and across it, relative to its length.
struct DeviatingVector {
  Interval y, x;
  FrameLine along, across;
};

DeviatingVector deviating_vector(const FrameLine& y, const FrameLine& x, const Interval& band) {
  require_no_turns(y);
  require_no_turns(x);
  DeviatingVector vector{base_of(y, band), base_of(x, band), {}, {}};
  const Interval squares = square(vector.y) + square(vector.x);
  if (!rigor::certainly_less(Interval(0.0), squares)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  const auto part_of = [](const FrameLine& of, const Interval& factor) {
    return FrameRules::scaled(form_of(of), factor, std::nullopt);
  };
  vector.across = FrameRules::sum_of(part_of(y, vector.x / squares), part_of(x, vector.y / squares), true);
  vector.along = FrameRules::sum_of(part_of(x, vector.x / squares), part_of(y, vector.y / squares), false);
  return vector;
}

/// Adds a remainder of this size at the bounds of both.
void add_remainder(Frame& frame, const DeviatingVector& vector, const char* what, FrameLine& line,
                   const std::function<double(double along, double across)>& size) {
  if (vector.along.is_form_empty() && vector.across.is_form_empty()) {
    return;
  }
  const auto u = static_cast<std::size_t>(FrameRules::add_form(frame, vector.along));
  const auto v = static_cast<std::size_t>(FrameRules::add_form(frame, vector.across));
  const int input =
      FrameRules::add_input(frame, remainder(what, [u, v, size](const std::vector<double>& bounds) {
                              return size(bounds[u], bounds[v]);
                            }));
  add_component(line, input, Interval(1.0));
}

}  // namespace

/// atan2(y, x).
FrameLine FrameRules::direction_line(Frame& frame, const FrameLine& y, const FrameLine& x) {
  const DeviatingVector vector = deviating_vector(y, x, frame.band_);
  FrameLine line = vector.across;
  line.constant = rigor::atan2(vector.y, vector.x);
  if (!rigor::is_finite(line.constant)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  const Interval room = rigor::pi() - Interval(rigor::magnitude(line.constant));
  add_remainder(frame, vector, "atan2", line,
                [room](double along, double across) { return direction_remainder(along, across, room); });
  return line;
}

/// The length L |1 + u + i v| of a vector near the positive x axis, with L = x + (L - x) in the steady state.
FrameLine FrameRules::length_line(Frame& frame, const FrameLine& y, const FrameLine& x) {
  const DeviatingVector vector = deviating_vector(y, x, frame.band_);
  const Interval whole = sqrt(square(vector.y) + square(vector.x));
  if (!rigor::certainly_less(Interval(0.0), vector.x)) {
    throw NoFrame("a vector that may be turned back");
  }
  FrameLine line = scaled(vector.along, whole, std::nullopt);
  // L - x, without the width that both have in common.
  const double excess = (square(vector.y) / (Interval(2.0) * Interval(vector.x.lower()))).upper();
  line.constant = x.constant + Interval::from_bounds(0.0, excess);
  line.per_frequency = x.per_frequency;
  add_remainder(frame, vector, "the length of a vector", line,
                [largest = whole.upper()](double along, double across) {
                  const Interval nearest = Interval(1.0) - Interval(along);
                  const Interval length = sqrt(square(nearest) + square(Interval(across)));
                  return rigor::mul_up(largest, (length - nearest).upper());
                });
  return line;
}

FrameLine Frame::line_of(const FrameValue& value) {
  if (value.kind() == FrameValue::Kind::line) {
    return value.line();
  }
  const auto key = std::tuple(static_cast<int>(FrameOperation::line), value.name(), -1);
  const auto found = made_.find(key);
  if (found != made_.end()) {
    return found->second;
  }
  if (value.kind() == FrameValue::Kind::tangent) {
    const auto& [monomial, kappa] = *value.waves().begin();
    const WavePattern pattern{monomial, kappa.real < 0.0 ? -1 : 1, static_cast<int>(kappa.imaginary)};
    const FrameLine angle = FrameRules::angle_line(*this, pattern, 2);
    return made_[key] = FrameRules::function_line(*this, FrameOperation::tangent, angle);
  }
  return made_[key] = FrameRules::line_of_waves(*this, value.waves());
}

}  // namespace veritrack::model
