// Quotients, functions, and the angles of waves: docs/gain-proof.md, section 2.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;
using Kind = FrameValue::Kind;

bool FrameRules::find_pattern(Frame& frame, const Waves& y, const Waves& x, WavePattern& pattern) {
  if (y.size() != 1 || x.size() != 1 || y.begin()->first != x.begin()->first) {
    return false;
  }
  const Monomial& monomial = y.begin()->first;
  const WaveWeights& of_y = y.begin()->second;
  const WaveWeights& of_x = x.begin()->second;
  const bool turns_on = of_x.imaginary == -of_y.real && of_y.imaginary == of_x.real;
  const bool turns_back = of_x.imaginary == of_y.real && of_y.imaginary == -of_x.real;
  const bool is_quarter = (of_x.real == 0.0) == (of_y.real != 0.0);
  if (monomial.is_real() || monomial.noise > 0 || !is_quarter || (!turns_on && !turns_back) ||
      !keeps_positive(frame, monomial)) {
    return false;
  }
  Interval factor(1.0);
  for (const int name : monomial.factors) {
    factor *= frame.factors_.at(name);
  }
  const bool is_positive = rigor::certainly_less(Interval(0.0), factor);
  if (!is_positive && !rigor::certainly_less(factor, Interval(0.0))) {
    return false;
  }
  const int quarters = of_x.real != 0.0 ? (of_x.real > 0.0 ? 0 : 2) : (of_y.real > 0.0 ? 1 : 3);
  pattern = {monomial, turns_on ? 1 : -1, (quarters + (is_positive ? 0 : 2)) % 4};
  return true;
}

FrameLine FrameRules::whole_angle(Frame& frame, const WavePattern& pattern) {
  const double sign = pattern.sign;
  FrameLine angle = scaled(phase_of(frame, pattern.monomial), Interval(sign), sign);
  if (pattern.monomial.order != 0 && frame.shares_noise_) {
    add_shared_angle(frame, angle, sign * pattern.monomial.order);
  } else if (pattern.monomial.order != 0 && frame.channels_ == 2) {
    if (frame.angle_input_ < 0) {
      FrameInput input;
      input.at_noise = [amplitude = frame.amplitude_](double noise) {
        return noise < amplitude.lower() ? rigor::asin(Interval(noise) / Interval(amplitude.lower())).upper()
                                         : INFINITY;
      };
      frame.angle_input_ = add_input(frame, std::move(input));
    }
    add_component(angle, frame.angle_input_, Interval(sign * pattern.monomial.order));
  }
  angle.constant += Interval(0.5 * pattern.quarters) * rigor::pi();
  angle.is_modular = true;
  return angle;
}

FrameLine FrameRules::angle_line(Frame& frame, const WavePattern& pattern, int turns_per_period) {
  FrameLine angle = whole_angle(frame, pattern);
  if (angle.turns != 0) {
    if (turns_per_period != 1) {
      throw NoFrame("a value that depends on the phase of the signal");
    }
    return angle;
  }
  const Interval half_period = rigor::pi() / Interval(static_cast<double>(turns_per_period));
  const Interval base = base_of(angle, frame.band_);
  const double periods = std::round(rigor::midpoint(base) / (2.0 * rigor::midpoint(half_period)));
  const Interval moved = Interval(2.0 * periods) * half_period;
  angle.constant -= moved;
  angle.is_modular = false;
  add_limit(frame, add_angle_form(frame, angle), half_period - Interval(rigor::magnitude(base - moved)));
  return angle;
}

FrameLine Frame::direction_of(const FrameValue& real, const FrameValue& imaginary) {
  WavePattern pattern;
  if (real.kind() != Kind::waves || imaginary.kind() != Kind::waves ||
      !FrameRules::find_pattern(*this, imaginary.waves(), real.waves(), pattern) ||
      pattern.monomial.has_unknown_length()) {
    throw NoFrame("a vector of states that does not follow the direction of the samples");
  }
  return FrameRules::whole_angle(*this, pattern);
}

namespace {

/// What is kept of a vector itself, turned by an angle, in its next real part.
std::optional<Monomial> own_wave(Frame& frame, const FrameValue& real, int length, int turns) {
  if (real.kind() != Kind::waves) {
    return std::nullopt;
  }
  for (const auto& [monomial, weights] : real.waves()) {
    const bool is_own = !monomial.is_real() && monomial.lengths.contains(length) && monomial.order == 0 &&
                        weights.real > 0.0 && weights.imaginary == 0.0;
    if (is_own && FrameRules::phase_of(frame, monomial).turns == turns) {
      return monomial;
    }
  }
  return std::nullopt;
}

}  // namespace

std::array<FrameLine, 2> Frame::polar_of(const FrameValue& real, const FrameValue& imaginary, int length,
                                         int turns, double constant, double per_frequency) {
  Monomial unit;
  FrameLine steady;
  if (const auto own = own_wave(*this, real, length, turns)) {
    unit.angles = own->angles;
    steady = FrameRules::phase_of(*this, unit);
  } else {
    steady.turns = turns;
    steady.constant = Interval(constant);
    steady.per_frequency = Interval(per_frequency) + Interval(static_cast<double>(turns));
    const int name = names_++;
    FrameRules::keep_angle(*this, name, steady);
    unit.angles[name] = 1;
  }
  const auto part = [&](double of_real, double of_imaginary) {
    Waves waves;
    FrameRules::add_wave(waves, unit, {of_real, of_imaginary});
    return FrameValue(this, names_++, Kind::waves, std::move(waves));
  };
  const FrameValue cosine = part(1.0, 0.0);
  const FrameValue sine = part(0.0, 1.0);
  const FrameValue along = real * cosine + imaginary * sine;
  const FrameValue across = imaginary * cosine - real * sine;
  FrameLine turned = FrameRules::sum_of(steady, line_of(atan2(across, along)), false);
  turned.is_modular = true;
  return {std::move(turned), FrameRules::length_line(*this, line_of(across), line_of(along))};
}

namespace {

FrameValue function(FrameOperation operation, const FrameValue& a) {
  Frame& frame = FrameRules::frame_of(a, a);
  const int name = FrameRules::named(frame, operation, FrameRules::name_of(frame, a));
  return {&frame, name, FrameRules::function_line(frame, operation, frame.line_of(a))};
}

FrameValue sine(const FrameValue& a, FrameOperation operation, WaveWeights weights) {
  Frame& frame = FrameRules::frame_of(a, a);
  const int name = FrameRules::named(frame, operation, FrameRules::name_of(frame, a));
  if (a.is_constant()) {
    FrameLine line;
    line.constant =
        operation == FrameOperation::sine ? rigor::sin(a.line().constant) : rigor::cos(a.line().constant);
    return {&frame, name, std::move(line)};
  }
  FrameRules::keep_angle(frame, a.name(), frame.line_of(a));
  Waves waves;
  FrameRules::add_wave(waves, {0, 0, 0, {{a.name(), 1}}, {}}, weights);
  return {&frame, name, Kind::waves, std::move(waves)};
}

/// 1/x for a constant, or for real waves of one monomial, by which one may divide exactly.
bool reciprocal_of(Frame& frame, const FrameValue& x, Waves& result) {
  Waves waves;
  if (!FrameRules::as_waves(x, waves) || waves.size() != 1 || !waves.begin()->first.is_real() ||
      waves.begin()->first.noise > 0 || !FrameRules::keeps_positive(frame, waves.begin()->first)) {
    return false;
  }
  const auto& [monomial, weights] = *waves.begin();
  Monomial other;
  other.magnitude = -monomial.magnitude;
  for (const auto& [name, power] : monomial.lengths) {
    other.lengths[name] = -power;
  }
  for (const int factor : monomial.factors) {
    other.factors.push_back(FrameRules::reciprocal_factor(frame, factor));
  }
  int exponent = 0;
  const double digits = std::frexp(weights.real, &exponent);
  const bool is_power_of_two = std::fabs(digits) == 0.5;
  if (!is_power_of_two) {
    other.factors.push_back(
        FrameRules::reciprocal_factor(frame, FrameRules::exact_factor(frame, weights.real)));
  }
  std::sort(other.factors.begin(), other.factors.end());
  FrameRules::add_wave(result, std::move(other), {is_power_of_two ? 1.0 / weights.real : 1.0, 0.0});
  return true;
}

/// The root of real waves of one monomial that is a square.
bool root_of(Frame& frame, const Waves& waves, Waves& result) {
  if (waves.size() != 1) {
    return false;
  }
  const Monomial& square = waves.begin()->first;
  const bool is_even = std::all_of(square.lengths.begin(), square.lengths.end(),
                                   [](const auto& length) { return length.second % 2 == 0; });
  if (!square.is_real() || square.noise > 0 || square.magnitude % 2 != 0 || !square.factors.empty() ||
      !is_even || !(waves.begin()->second.real > 0.0) || !FrameRules::keeps_positive(frame, square)) {
    return false;
  }
  const double root = std::round(std::sqrt(waves.begin()->second.real) * 0x1p10) * 0x1p-10;
  if (root * root != waves.begin()->second.real) {
    return false;
  }
  Monomial half{square.magnitude / 2, 0, 0, {}, {}};
  for (const auto& [name, power] : square.lengths) {
    half.lengths[name] = power / 2;
  }
  FrameRules::add_wave(result, std::move(half), {root, 0.0});
  return true;
}

FrameValue named_line(FrameOperation operation, const FrameValue& a, const FrameValue& b, FrameLine line) {
  Frame& frame = FrameRules::frame_of(a, b);
  return {&frame, FrameRules::named(operation, a, b), std::move(line)};
}

}  // namespace

void FrameRules::keep_angle(Frame& frame, int name, const FrameLine& line) {
  frame.angles_.try_emplace(name, line);
}

int FrameRules::exact_factor(Frame& frame, double number) {
  const auto [place, is_new] = frame.exact_.try_emplace(number, frame.names_);
  frame.names_ += is_new ? 1 : 0;
  frame.factors_.try_emplace(place->second, Interval(number));
  return place->second;
}

int FrameRules::reciprocal_factor(Frame& frame, int factor) {
  const int name = named(frame, FrameOperation::reciprocal, factor);
  frame.factors_.try_emplace(name, Interval(1.0) / frame.factors_.at(factor));
  return name;
}

FrameValue operator/(const FrameValue& a, const FrameValue& b) {
  Frame& frame = FrameRules::frame_of(a, b);
  const int name = FrameRules::named(FrameOperation::divide, a, b);
  WavePattern pattern;
  if (a.kind() == Kind::waves && b.kind() == Kind::waves &&
      FrameRules::find_pattern(frame, a.waves(), b.waves(), pattern)) {
    // The pattern, in the place of weights.
    Waves kept;
    kept[pattern.monomial] = {static_cast<double>(pattern.sign), static_cast<double>(pattern.quarters)};
    return {&frame, name, Kind::tangent, std::move(kept)};
  }
  Waves waves;
  Waves reciprocal;
  const bool has_waves = a.kind() == Kind::waves || b.kind() == Kind::waves;
  if (has_waves && FrameRules::as_waves(a, waves) && reciprocal_of(frame, b, reciprocal)) {
    return {&frame, name, Kind::waves, FrameRules::product_of(waves, reciprocal)};
  }
  if (b.is_constant()) {
    const std::optional<double> exact = FrameRules::exact(b);
    const bool is_sign = exact && (*exact == 1.0 || *exact == -1.0);
    return {&frame, name,
            FrameRules::scaled(frame.line_of(a), Interval(1.0) / b.line().constant,
                               is_sign ? exact : std::optional<double>())};
  }
  return a * function(FrameOperation::reciprocal, b);
}

FrameValue sqrt(const FrameValue& a) {
  Waves root;
  if (a.kind() == Kind::waves && root_of(*a.frame(), a.waves(), root)) {
    return {a.frame(), FrameRules::named(*a.frame(), FrameOperation::root, a.name()), Kind::waves,
            std::move(root)};
  }
  return function(FrameOperation::root, a);
}
FrameValue exp(const FrameValue& a) {
  return function(FrameOperation::exponential, a);
}
FrameValue log(const FrameValue& a) {
  return function(FrameOperation::logarithm, a);
}
FrameValue sin(const FrameValue& a) {
  return sine(a, FrameOperation::sine, {0.0, 1.0});
}
FrameValue cos(const FrameValue& a) {
  return sine(a, FrameOperation::cosine, {1.0, 0.0});
}
FrameValue tan(const FrameValue& a) {
  return a.is_constant() ? function(FrameOperation::tangent, a) : sin(a) / cos(a);
}
FrameValue acos(const FrameValue& a) {
  return function(FrameOperation::arccosine, a);
}
FrameValue asin(const FrameValue& a) {
  return function(FrameOperation::arcsine, a);
}

FrameValue atan(const FrameValue& a) {
  if (a.kind() == Kind::tangent) {
    const auto& [monomial, kept] = *a.waves().begin();
    const WavePattern pattern{monomial, kept.real < 0.0 ? -1 : 1, static_cast<int>(kept.imaginary)};
    return {a.frame(), FrameRules::named(*a.frame(), FrameOperation::arctangent, a.name()),
            FrameRules::angle_line(*a.frame(), pattern, 2)};
  }
  return function(FrameOperation::arctangent, a);
}

FrameValue atan2(const FrameValue& y, const FrameValue& x) {
  Frame& frame = FrameRules::frame_of(y, x);
  WavePattern pattern;
  if (y.is_constant() && x.is_constant()) {
    FrameLine line;
    line.constant = rigor::atan2(y.line().constant, x.line().constant);
    return named_line(FrameOperation::arctangent2, y, x, std::move(line));
  }
  const bool is_of_wave = y.kind() == Kind::waves && x.kind() == Kind::waves &&
                          FrameRules::find_pattern(frame, y.waves(), x.waves(), pattern);
  return named_line(FrameOperation::arctangent2, y, x,
                    is_of_wave ? FrameRules::angle_line(frame, pattern, 1)
                               : FrameRules::direction_line(frame, frame.line_of(y), frame.line_of(x)));
}

FrameValue stays_within(const FrameValue& x, const FrameValue& low, const FrameValue& high) {
  Frame& frame = FrameRules::frame_of(x, low);
  if (!low.is_constant() || !high.is_constant()) {
    throw NoFrame("a limit that is not a constant");
  }
  FrameLine line = frame.line_of(x);
  if (line.turns != 0 || line.is_modular) {
    throw NoFrame("a limit of an angle");
  }
  const Interval base = FrameRules::base_of(line, frame.band());
  const double above = (high.line().constant - base).lower();
  const double below = (base - low.line().constant).lower();
  FrameRules::add_limit(frame, FrameRules::add_form(frame, line), Interval(std::min(above, below)));
  return {&frame, FrameRules::named(frame, FrameOperation::within, x.name()), std::move(line)};
}

}  // namespace veritrack::model
