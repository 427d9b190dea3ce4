#include "analysis/model/gain/frame_value.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/model/gain/frame_rules.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

FrameLine constant_line(const Interval& value) {
  FrameLine line;
  line.constant = value;
  return line;
}

/// A double of at most this many bits on either side of the point: sums and products of few are exact.
bool has_few_digits(double value) {
  constexpr double kMost = 0x1p20;
  return std::fabs(value) <= kMost && std::nearbyint(value * kMost) == value * kMost;
}

/// No zeros are kept.
void add_power(std::map<int, int>& powers, int of, int power) {
  const auto place = powers.try_emplace(of, 0).first;
  place->second += power;
  if (place->second == 0) {
    powers.erase(place);
  }
}

double required_exact(double value) {
  if (!has_few_digits(value)) {
    throw NoFrame("a factor of a sine or cosine is too long");
  }
  return value;
}

}  // namespace

FrameValue::FrameValue(int number)
    : line_(std::make_shared<const FrameLine>(constant_line(Interval(number)))) {}
FrameValue::FrameValue(Frame* frame, int name, FrameLine line)
    : frame_(frame), name_(name), line_(std::make_shared<const FrameLine>(std::move(line))) {}
FrameValue::FrameValue(Frame* frame, int name, Kind kind, Waves waves)
    : frame_(frame), name_(name), kind_(kind), waves_(std::make_shared<const Waves>(std::move(waves))) {}

Frame& FrameRules::frame_of(const FrameValue& a, const FrameValue& b) {
  Frame* frame = a.frame() != nullptr ? a.frame() : b.frame();
  if (frame == nullptr) {
    throw NoFrame("a sum or product of bare numbers");
  }
  return *frame;
}

int FrameRules::name_of(Frame& frame, const FrameValue& value) {
  if (value.name() >= 0) {
    return value.name();
  }
  const auto [place, is_new] = frame.exact_.try_emplace(value.line().constant.lower(), frame.names_);
  frame.names_ += is_new ? 1 : 0;
  return place->second;
}

int FrameRules::named(Frame& frame, FrameOperation operation, int first, int second) {
  const auto [place, is_new] =
      frame.name_of_.try_emplace({static_cast<int>(operation), first, second}, frame.names_);
  frame.names_ += is_new ? 1 : 0;
  return place->second;
}

int FrameRules::named(FrameOperation operation, const FrameValue& a, const FrameValue& b) {
  Frame& frame = frame_of(a, b);
  int first = name_of(frame, a);
  int second = name_of(frame, b);
  if (operation == FrameOperation::add || operation == FrameOperation::multiply) {
    std::tie(first, second) = std::minmax({first, second});
  }
  return named(frame, operation, first, second);
}

std::optional<double> FrameRules::exact(const FrameValue& value) {
  const bool is_exact = value.is_constant() &&
                        value.line().constant.lower() == value.line().constant.upper() &&
                        has_few_digits(value.line().constant.lower());
  return is_exact ? std::optional(value.line().constant.lower()) : std::nullopt;
}

double FrameRules::exact_sum(double a, double b) {
  return required_exact(a + b);
}
double FrameRules::exact_product(double a, double b) {
  return required_exact(a * b);
}

void FrameRules::add_wave(Waves& waves, Monomial monomial, WaveWeights weights) {
  // One of M and its conjugate stands for both; a real one has no imaginary part.
  const int first = monomial.order != 0       ? monomial.order
                    : monomial.angles.empty() ? 0
                                              : monomial.angles.begin()->second;
  if (first < 0) {
    monomial.order = -monomial.order;
    for (auto& [name, multiple] : monomial.angles) {
      multiple = -multiple;
    }
    weights.imaginary = -weights.imaginary;
  }
  if (first == 0) {
    weights.imaginary = 0.0;
  }
  WaveWeights& sum = waves[monomial];
  sum = {exact_sum(sum.real, weights.real), exact_sum(sum.imaginary, weights.imaginary)};
  if (sum.real == 0.0 && sum.imaginary == 0.0) {
    waves.erase(monomial);
  }
}

bool FrameRules::as_waves(const FrameValue& value, Waves& waves) {
  if (value.kind() == FrameValue::Kind::waves) {
    waves = value.waves();
    return true;
  }
  if (!value.is_constant()) {
    return false;
  }
  if (const std::optional<double> number = exact(value)) {
    add_wave(waves, {}, {*number, 0.0});
  } else {
    value.frame()->factors_.try_emplace(value.name(), value.line().constant);
    add_wave(waves, {0, 0, 0, {}, {value.name()}}, {1.0, 0.0});
  }
  return true;
}

bool FrameRules::as_factor(const FrameValue& value, const FrameValue& of, Waves& waves) {
  if (value.kind() != FrameValue::Kind::line || of.kind() != FrameValue::Kind::waves ||
      value.line().turns != 0 || value.line().is_modular) {
    return false;
  }
  Frame& frame = *of.frame();
  const bool turns = std::any_of(of.waves().begin(), of.waves().end(),
                                 [&](const auto& wave) { return phase_of(frame, wave.first).turns != 0; });
  if (frame.channels_ != 2 || !turns) {
    return false;
  }
  frame.lengths_.try_emplace(value.name(), value.line());
  add_wave(waves, {0, 0, 0, {}, {}, {{value.name(), 1}}}, {1.0, 0.0});
  return true;
}

/// Re(a) Re(b) = Re(a b)/2 + Re(a conj b)/2.
Waves FrameRules::product_of(const Waves& a, const Waves& b) {
  Waves product;
  for (const auto& [m, u] : a) {
    for (const auto& [n, v] : b) {
      for (const int sign : {1, -1}) {
        Monomial both = m;
        both.magnitude += n.magnitude;
        both.order += sign * n.order;
        both.noise += n.noise;
        for (const auto& [name, multiple] : n.angles) {
          add_power(both.angles, name, sign * multiple);
        }
        for (const auto& [length, power] : n.lengths) {
          add_power(both.lengths, length, power);
        }
        both.factors.insert(both.factors.end(), n.factors.begin(), n.factors.end());
        std::sort(both.factors.begin(), both.factors.end());
        // With M = Re + i Im the wave is Re((real - i imaginary) M).
        const double imaginary = sign * v.imaginary;
        add_wave(product, std::move(both),
                 {exact_product(
                      0.5, exact_sum(exact_product(u.real, v.real), -exact_product(u.imaginary, imaginary))),
                  exact_product(
                      0.5, exact_sum(exact_product(u.real, imaginary), exact_product(u.imaginary, v.real)))});
      }
    }
  }
  return product;
}

FrameLine FrameRules::scaled(const FrameLine& line, const Interval& factor, std::optional<double> exact) {
  FrameLine result = line;
  if (line.turns != 0 || line.is_modular) {
    if (!exact || std::nearbyint(*exact) != *exact) {
      throw NoFrame(
          "a part of an angle (an angle is in rad: for a state in turns use a state that is 2*pi times it)");
    }
    result.turns = line.turns * static_cast<int>(*exact);
  }
  result.constant *= factor;
  result.per_frequency *= factor;
  for (Interval& each : result.states) {
    each *= factor;
  }
  for (auto& [component, weight] : result.inputs) {
    weight *= factor;
  }
  return result;
}

FrameLine FrameRules::sum_of(const FrameLine& a, const FrameLine& b, bool subtracts) {
  const FrameLine second = subtracts ? scaled(b, Interval(-1.0), -1.0) : b;
  FrameLine sum = a;
  sum.turns += second.turns;
  sum.is_modular = a.is_modular || b.is_modular;
  sum.constant += second.constant;
  sum.per_frequency += second.per_frequency;
  if (sum.states.empty()) {
    sum.states = second.states;
  } else {
    for (std::size_t i = 0; i < second.states.size(); ++i) {
      sum.states[i] += second.states[i];
    }
  }
  for (const auto& [component, weight] : second.inputs) {
    const auto [place, is_new] = sum.inputs.try_emplace(component, weight);
    if (!is_new) {
      place->second += weight;
    }
  }
  return sum;
}

namespace {

FrameValue sum(const FrameValue& a, const FrameValue& b, bool subtracts) {
  Frame& frame = FrameRules::frame_of(a, b);
  const int name = FrameRules::named(subtracts ? FrameOperation::subtract : FrameOperation::add, a, b);
  Waves waves;
  Waves second;
  const bool has_waves = a.kind() == FrameValue::Kind::waves || b.kind() == FrameValue::Kind::waves;
  if (has_waves && FrameRules::as_waves(a, waves) && FrameRules::as_waves(b, second)) {
    for (const auto& [monomial, weights] : second) {
      const double sign = subtracts ? -1.0 : 1.0;
      FrameRules::add_wave(waves, monomial, {sign * weights.real, sign * weights.imaginary});
    }
    return {&frame, name, FrameValue::Kind::waves, std::move(waves)};
  }
  return {&frame, name, FrameRules::sum_of(frame.line_of(a), frame.line_of(b), subtracts)};
}

}  // namespace

FrameValue operator+(const FrameValue& a, const FrameValue& b) {
  return sum(a, b, false);
}
FrameValue operator-(const FrameValue& a, const FrameValue& b) {
  return sum(a, b, true);
}
FrameValue operator-(const FrameValue& a) {
  return FrameValue(-1) * a;
}
FrameValue square(const FrameValue& a) {
  return a * a;
}

FrameValue operator*(const FrameValue& a, const FrameValue& b) {
  Frame& frame = FrameRules::frame_of(a, b);
  const int name = FrameRules::named(FrameOperation::multiply, a, b);
  Waves first;
  Waves second;
  const bool has_waves = a.kind() == FrameValue::Kind::waves || b.kind() == FrameValue::Kind::waves;
  if (has_waves && FrameRules::as_waves(a, first) && FrameRules::as_waves(b, second)) {
    return {&frame, name, FrameValue::Kind::waves, FrameRules::product_of(first, second)};
  }
  Waves factor;
  if (FrameRules::as_factor(a, b, factor) || FrameRules::as_factor(b, a, factor)) {
    return {&frame, name, FrameValue::Kind::waves,
            FrameRules::product_of(factor, (a.kind() == FrameValue::Kind::waves ? a : b).waves())};
  }
  const FrameLine x = frame.line_of(a);
  const FrameLine y = frame.line_of(b);
  if (x.is_constant() || y.is_constant()) {
    return x.is_constant()
               ? FrameValue(&frame, name, FrameRules::scaled(y, x.constant, FrameRules::exact(a)))
               : FrameValue(&frame, name, FrameRules::scaled(x, y.constant, FrameRules::exact(b)));
  }
  return {&frame, name, FrameRules::product_line(frame, x, y, a.name() == b.name())};
}

FrameValue Frame::constant(int number, const Interval& value) {
  return {this, FrameRules::named(*this, FrameOperation::constant, number), constant_line(value)};
}

FrameValue Frame::state(int state, bool is_angle, int turns, double constant, double per_frequency) {
  FrameLine line;
  line.turns = turns;
  line.is_modular = is_angle;
  line.constant = Interval(constant);
  line.per_frequency = Interval(per_frequency);
  line.states.assign(static_cast<std::size_t>(states_), Interval(0.0));
  line.states.at(static_cast<std::size_t>(state)) = Interval(1.0);
  return {this, FrameRules::named(*this, FrameOperation::state, state), std::move(line)};
}

std::array<FrameValue, 2> Frame::vector(int real, int turns, double constant, double per_frequency,
                                        const FrameValue& length) {
  const int of = length.is_constant() ? -1 - real : length.name();
  if (of >= 0) {
    lengths_.try_emplace(of, length.line());
  }
  const FrameValue angle = state(real, true, turns, constant, per_frequency);
  FrameRules::keep_angle(*this, angle.name(), angle.line());
  const auto part = [&](int which) {
    Waves waves;
    FrameRules::add_wave(waves, {0, 0, 0, {{angle.name(), 1}}, {}, {{of, 1}}},
                         {which == 0 ? 1.0 : 0.0, which == 0 ? 0.0 : 1.0});
    return FrameValue(this, FrameRules::named(*this, FrameOperation::vector, real, which),
                      FrameValue::Kind::waves, std::move(waves));
  };
  return {part(0), part(1)};
}

FrameValue Frame::sample(int channel) {
  Waves waves;
  FrameRules::add_wave(waves, {1, 1, 0, {}, {}}, {channel == 0 ? 1.0 : 0.0, channel == 0 ? 0.0 : 1.0});
  if (channels_ == 1) {
    FrameRules::add_wave(waves, {0, 0, 1, {}, {}}, {1.0, 0.0});
  }
  return {this, FrameRules::named(*this, FrameOperation::sample, channel), FrameValue::Kind::waves,
          std::move(waves)};
}

}  // namespace veritrack::model
