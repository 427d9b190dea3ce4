#include "checker/sets/frequency_words.hpp"

#include "checker/document/design_number.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

FrequencyWords::FrequencyWords(const Tree& assume, Objections& objections) {
  if (const Tree* rate = assume.find("sample_rate")) {
    text_ = text_of(*rate);
    sample_rate_ = read_positive(*rate, "sample_rate", objections);
  }
}

Ball FrequencyWords::in_hertz(const Ball& radians) const {
  return radians * *sample_rate_ / (two * pi());
}

std::string FrequencyWords::at_most(const Ball& radians) const {
  std::string text = upper_decimal(radians) + " rad/sample";
  return sample_rate_ ? text + " (" + upper_decimal(in_hertz(radians)) + " Hz)" : text;
}

std::string FrequencyWords::at_least(const Ball& radians) const {
  std::string text = lower_decimal(radians) + " rad/sample";
  return sample_rate_ ? text + " (" + lower_decimal(in_hertz(radians)) + " Hz)" : text;
}

std::string FrequencyWords::at_most(const std::string& decimal) const {
  const std::string text = decimal + " rad/sample";
  return sample_rate_ ? text + " (" + upper_decimal(in_hertz(from_decimal(decimal))) + " Hz)" : text;
}

std::string FrequencyWords::at_least(const std::string& decimal) const {
  const std::string text = decimal + " rad/sample";
  return sample_rate_ ? text + " (" + lower_decimal(in_hertz(from_decimal(decimal))) + " Hz)" : text;
}

std::string FrequencyWords::between(const std::string& low, const std::string& high) const {
  const std::string text = low + " and " + high + " rad/sample";
  return sample_rate_ ? text + " (" + lower_decimal(in_hertz(from_decimal(low))) + " and " +
                            upper_decimal(in_hertz(from_decimal(high))) + " Hz)"
                      : text;
}

std::string FrequencyWords::slew(const Ball& radians) const {
  std::string text = lower_decimal(radians) + " rad/sample per sample";
  return sample_rate_ ? text + " (" + lower_decimal(in_hertz(radians) * *sample_rate_) + " Hz per second)"
                      : text;
}

std::string FrequencyWords::slew(const std::string& decimal) const {
  const std::string text = decimal + " rad/sample per sample";
  return sample_rate_ ? text + " (" + lower_decimal(in_hertz(from_decimal(decimal)) * *sample_rate_) +
                            " Hz per second)"
                      : text;
}

std::string FrequencyWords::sampled() const {
  return sample_rate_ ? ", sampled at " + text_ + " Hz," : "";
}

}  // namespace veritrack::checker
