// Frequencies in sentences: in rad/sample and, for a design with a sample rate, in Hz.
#pragma once

#include <optional>
#include <string>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

class FrequencyWords {
 public:
  FrequencyWords() = default;
  /// Reads the sample_rate of [assume].
  FrequencyWords(const Tree& assume, Objections& objections);

  /// "0.05 rad/sample (63.7 Hz)": an upper bound, both rounded up.
  [[nodiscard]] std::string at_most(const Ball& radians) const;
  /// Likewise a lower bound, rounded down.
  [[nodiscard]] std::string at_least(const Ball& radians) const;
  // The same for a decimal of the certificate.
  [[nodiscard]] std::string at_most(const std::string& decimal) const;
  [[nodiscard]] std::string at_least(const std::string& decimal) const;
  /// "-1.7e-6 and 9e-7 rad/sample (-0.0028 and 0.0015 Hz)".
  [[nodiscard]] std::string between(const std::string& low, const std::string& high) const;
  /// "0.001 rad/sample per sample (1.01e4 Hz per second)", rounded down.
  [[nodiscard]] std::string slew(const Ball& radians) const;
  [[nodiscard]] std::string slew(const std::string& decimal) const;
  /// ", sampled at 8000 Hz,"; empty without a sample rate.
  [[nodiscard]] std::string sampled() const;

 private:
  [[nodiscard]] Ball in_hertz(const Ball& radians) const;

  std::string text_;
  std::optional<Ball> sample_rate_;
};

}  // namespace veritrack::checker
