#include "checker/model/gain/frame_value.hpp"

#include "checker/model/gain/wave_values.hpp"

namespace veritrack::checker {

namespace {

thread_local LinearFrame* current = nullptr;

LinearFrame& frame() {
  if (current == nullptr) {
    throw NotCovered("no frame");
  }
  return *current;
}

}  // namespace

FrameScope::FrameScope(LinearFrame& scope) : before_(std::exchange(current, &scope)) {}
FrameScope::~FrameScope() {
  current = before_;
}

FrameValue::FrameValue(const Ball& value) : value_(Linear{frame().number(value)}) {}

FrameValue FrameValue::constant(const Ball& value, std::size_t place) {
  return FrameValue(Linear{frame().constant(value, place)});
}

FrameValue FrameValue::state(std::size_t index, const LinearValue& value) {
  return FrameValue(Linear{frame().state(index, value)});
}

std::array<FrameValue, 2> FrameValue::vector(
    std::size_t state, const LinearValue& angle,
    const std::optional<std::pair<std::size_t, LinearValue>>& length) {
  const int number = frame().state(state, angle);
  const int of = length ? frame().state(length->first, length->second) : -1 - static_cast<int>(state);
  return {FrameValue(vector_waves(of, number, 0)), FrameValue(vector_waves(of, number, 1))};
}

std::array<int, 2> FrameValue::polar(const FrameValue& real, const FrameValue& imaginary,
                                     const LinearValue& steady_angle, std::size_t length) {
  const std::string name = "state " + std::to_string(length);
  const std::optional<Wave> own =
      real.is_sum_of_waves() ? own_wave(frame(), *real.waves(), frame().known(name), steady_angle.turns)
                             : std::nullopt;
  const int direction =
      own ? angle_of(frame(), *own) : frame().made("steady angle of " + name, [&] { return steady_angle; });
  const FrameValue cosine(own ? Waves{{*own, {kExactUnit, 0}}} : cosine_wave(direction));
  const FrameValue sine(own ? Waves{{*own, {0, kExactUnit}}} : sine_wave(direction));
  const FrameValue along = real * cosine + imaginary * sine;
  const FrameValue across = imaginary * cosine - real * sine;
  const int turned = arctangent2(across, along).linear();
  return {frame().modulo_turn(frame().sum(direction, turned)),
          frame().length(across.linear(), along.linear())};
}

int FrameValue::direction(const FrameValue& real, const FrameValue& imaginary) {
  if (real.is_sum_of_waves() && imaginary.is_sum_of_waves()) {
    const std::optional<TurnedWave> wave = turned_wave(frame(), *imaginary.waves(), *real.waves());
    if (wave && !wave->wave.has_unknown_length()) {
      return frame().modulo_turn(argument(frame(), *wave));
    }
  }
  throw NotCovered("a vector of states does not follow the direction of the samples");
}

int FrameValue::linear() const {
  if (const auto* known = std::get_if<Linear>(&value_)) {
    return known->number;
  }
  if (const auto* quotient = std::get_if<Quotient>(&value_)) {
    return frame().function("tan", quotient->angle);
  }
  return linear_value(frame(), std::get<Waves>(value_));
}

std::optional<Waves> FrameValue::waves() const {
  if (const auto* sum_of_waves = std::get_if<Waves>(&value_)) {
    return *sum_of_waves;
  }
  const auto* known = std::get_if<Linear>(&value_);
  if (known == nullptr || !frame().at(known->number).is_constant()) {
    return std::nullopt;
  }
  return constant_wave(frame().factors(known->number));
}

FrameValue FrameValue::function(const std::string& name) const {
  return FrameValue(Linear{frame().function(name, linear())});
}

FrameValue operator-(const FrameValue& x) {
  if (const auto* waves = std::get_if<Waves>(&x.value_)) {
    return FrameValue(negated(*waves));
  }
  return FrameValue(FrameValue::Linear{frame().negated(x.linear())});
}

FrameValue operator+(const FrameValue& x, const FrameValue& y) {
  if (x.is_sum_of_waves() || y.is_sum_of_waves()) {
    const std::optional<Waves> left = x.waves();
    const std::optional<Waves> right = y.waves();
    if (left && right) {
      return FrameValue(sum(*left, *right));
    }
  }
  return FrameValue(FrameValue::Linear{frame().sum(x.linear(), y.linear())});
}

FrameValue operator*(const FrameValue& x, const FrameValue& y) {
  if (x.is_sum_of_waves() || y.is_sum_of_waves()) {
    const std::optional<Waves> left = x.waves();
    const std::optional<Waves> right = y.waves();
    if (left && right) {
      return FrameValue(product(*left, *right));
    }
  }
  // A linear value without turns stays a factor of what turns with the signal.
  for (const auto& [factor, turning] : {std::pair(&x, &y), std::pair(&y, &x)}) {
    const auto* known = std::get_if<FrameValue::Linear>(&factor->value_);
    if (known != nullptr && turning->is_sum_of_waves() && turns_with_signal(frame(), *turning->waves()) &&
        frame().at(known->number).is_plain()) {
      return FrameValue(product(*turning->waves(), length_wave(known->number)));
    }
  }
  return FrameValue(FrameValue::Linear{frame().product(x.linear(), y.linear())});
}

FrameValue operator/(const FrameValue& x, const FrameValue& y) {
  const std::optional<Waves> left = x.waves();
  const std::optional<Waves> right = y.waves();
  if (y.is_sum_of_waves() && has_noise(*right)) {
    throw NotCovered("a division by a sum with noise of one channel");
  }
  if (left && y.is_sum_of_waves()) {
    // |y| > 0: the noise is certainly below the amplitude (GainNetwork).
    const std::optional<Wave> lengths = product_of_lengths(*right);
    if (lengths && keeps_positive(frame(), *lengths)) {
      return FrameValue(times(*left, reciprocal(*lengths)));
    }
    if (const std::optional<TurnedWave> wave = turned_wave(frame(), *left, *right)) {
      const int angle = argument(frame(), *wave);
      if (frame().at(angle).turns == 0) {
        return FrameValue(FrameValue::Quotient{frame().principal(angle, pi())});
      }
    }
  }
  if (x.is_sum_of_waves() && right && !y.is_sum_of_waves()) {
    return FrameValue(
        product(*left, *FrameValue(FrameValue::Linear{frame().function("reciprocal", y.linear())}).waves()));
  }
  return FrameValue(FrameValue::Linear{frame().quotient(x.linear(), y.linear())});
}

FrameValue sqrt(const FrameValue& x) {
  if (const auto* waves = std::get_if<Waves>(&x.value_)) {
    const std::optional<Wave> square = product_of_lengths(*waves);
    const std::optional<Wave> length = square ? root(*square) : std::nullopt;
    if (length && keeps_positive(frame(), *length)) {
      return FrameValue(Waves{{*length, {kExactUnit, 0}}});
    }
  }
  return x.function("sqrt");
}

FrameValue arctangent(const FrameValue& x) {
  if (const auto* quotient = std::get_if<FrameValue::Quotient>(&x.value_)) {
    return FrameValue(FrameValue::Linear{quotient->angle});
  }
  return x.function("atan");
}

FrameValue arctangent2(const FrameValue& y, const FrameValue& x) {
  const std::optional<Waves> imaginary = y.waves();
  const std::optional<Waves> real = x.waves();
  const std::optional<TurnedWave> wave =
      imaginary && real ? turned_wave(frame(), *imaginary, *real) : std::nullopt;
  if (!wave) {
    return FrameValue(FrameValue::Linear{frame().direction(y.linear(), x.linear())});
  }
  const int angle = argument(frame(), *wave);
  if (frame().at(angle).turns != 0) {
    // Between -pi and pi; only modulo 2 pi it is the sum.
    return FrameValue(FrameValue::Linear{frame().modulo_turn(angle)});
  }
  return FrameValue(FrameValue::Linear{frame().principal(angle, two * pi())});
}

FrameValue stays_within(const FrameValue& x, const FrameValue& low, const FrameValue& high) {
  return FrameValue(FrameValue::Linear{frame().stays_within(x.linear(), low.linear(), high.linear())});
}
FrameValue larger(const FrameValue& x, const FrameValue& y) {
  return FrameValue(FrameValue::Linear{frame().larger(x.linear(), y.linear())});
}

FrameValue clamped(const FrameValue& x, const FrameValue& low, const FrameValue& high) {
  return FrameValue(FrameValue::Linear{frame().clamped(x.linear(), low.linear(), high.linear())});
}

FrameValue chosen(const FrameValue& positive, const FrameValue& a, const FrameValue& b) {
  return frame().certain_sign(positive.linear()) > 0 ? a : b;
}

FrameValue sign_of(const FrameValue& x) {
  return {static_cast<double>(frame().certain_sign(x.linear()))};
}

}  // namespace veritrack::checker
