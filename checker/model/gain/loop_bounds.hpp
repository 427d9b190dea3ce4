// Bounds of the frequency error, from which claims by gains are decided.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// rad/sample. Sentences speak of the steady state: what the listed one is off must not show in the
/// frequency.
constexpr double kMostOfResidual = 0x1p-18;

/// Bounds on the frequency error of a loop, rad/sample, for certain noise, slew and starts.
class FrequencyErrors {
 public:
  FrequencyErrors() = default;
  FrequencyErrors(const FrequencyErrors&) = delete;
  FrequencyErrors& operator=(const FrequencyErrors&) = delete;
  virtual ~FrequencyErrors() = default;

  /// At every sample.
  [[nodiscard]] virtual Ball for_ever() const = 0;
  /// From this sample on.
  [[nodiscard]] virtual Ball from(const Ball& sample) const = 0;
  /// A bound on the upper limit.
  [[nodiscard]] virtual Ball in_long_run() const = 0;
  /// All values of the mean over the phase in the long run, at a constant frequency.
  [[nodiscard]] virtual Range mean() const = 0;
  /// By how much it varies in the long run at a constant frequency, without noise.
  [[nodiscard]] virtual Ball variation() const = 0;
};

/// A loop that was verified by gains.
class LoopBounds {
 public:
  LoopBounds() = default;
  LoopBounds(const LoopBounds&) = delete;
  LoopBounds& operator=(const LoopBounds&) = delete;
  virtual ~LoopBounds() = default;

  [[nodiscard]] virtual std::size_t states() const = 0;
  /// The bounds for |v| <= noise, |change of omega| <= slew and deviations of the states from the steady
  /// state of at most `start`; nothing where they are not certain.
  [[nodiscard]] virtual std::unique_ptr<FrequencyErrors> errors(const Ball& noise, const Ball& slew,
                                                                const std::vector<Ball>& start) const = 0;
  /// All deviations of the one state that the frequency is a multiple of with frequency errors up to
  /// `reach`, by state; none where there is no such state.
  [[nodiscard]] virtual std::vector<Ball> starts_within(const Ball& reach) const = 0;
  /// Whether a program's rounding is in the bounds.
  [[nodiscard]] virtual bool is_rounded() const = 0;
};

}  // namespace veritrack::checker
