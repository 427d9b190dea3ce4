#include "certificates/code/harness/guesses.hpp"

#include <fmt/format.h>

#include "certificates/code/harness/names.hpp"

namespace veritrack::certificates::code {

namespace {

constexpr double kTurn = 6.283185307179586;
constexpr double kPhaseGain = 0.16;
constexpr double kFrequencyGain = 0.0002;
constexpr double kNatural = 0.0141;  // the root of kFrequencyGain
constexpr double kMiddle = 0.25;     // rad/sample: the middle of the band of new designs

}  // namespace

std::string number_literal(double value, bool is_double) {
  std::string text = fmt::format("{:.6g}", value);
  if (text.find_first_of(".e") == std::string::npos) {
    text += ".0";
  }
  return is_double ? text : text + "f";
}

std::optional<std::string> guessed_number(const std::string& name, const GuessContext& context) {
  const double rate = context.sample_rate;
  const auto number = [&](double value) { return number_literal(value, context.is_double); };
  const double per_hertz = context.unit == FrequencyUnit::hertz ? kTurn : 1.0;
  const double per_sample = context.unit == FrequencyUnit::radians_per_sample ? 1.0 : rate / per_hertz;
  const double times_period = context.is_times_period(name) ? rate : 1.0;
  if (is_named_like_period(name)) {
    return fmt::format("{} / {}", number(1.0), number(rate));
  }
  if (is_named_like_sample_rate(name)) {
    return number(rate);
  }
  if (has_word(name, {"kp", "proportional"}) || name == "k1") {
    return number(kPhaseGain * times_period);
  }
  if (has_word(name, {"ki", "integral"}) || name == "k2") {
    return number(kFrequencyGain * times_period * per_sample);
  }
  if (has_word(name, {"kd", "derivative"})) {
    return number(0.0);
  }
  if (has_word(name, {"bandwidth", "bw", "wn", "natural"})) {
    const bool is_in_hertz = has_word(name, {"hz"});
    return number(kNatural * rate / (is_in_hertz ? kTurn : 1.0));
  }
  if (has_word(name, {"zeta", "damping", "xi"})) {
    return number(0.7);
  }
  if (has_word(name, {"amplitude", "amp", "scale"})) {
    return number(1.0);
  }
  if (frequency_likeness(name) > 1 || has_word(name, {"w0", "omega0", "f0", "nominal", "center", "centre"}) ||
      name == "w0" || name == "f0") {
    const bool is_in_hertz = has_word(name, {"hz", "f", "freq", "frequency"}) && rate > 1.0;
    return number(is_in_hertz ? kMiddle * rate / kTurn : kMiddle * rate);
  }
  return std::nullopt;
}

}  // namespace veritrack::certificates::code
