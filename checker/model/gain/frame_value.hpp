// The scalar over which the recursion of a loop is run once, to see it from the phase of its signal
// (docs/gain-proof.md, section 2).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "checker/model/gain/linear_frame.hpp"
#include "checker/model/gain/waves.hpp"

namespace veritrack::checker {

class FrameValue {
 public:
  FrameValue(double value) : FrameValue(Ball(value)) {}  // NOLINT(google-explicit-constructor)
  /// A ball that is not one number is another constant than any other.
  FrameValue(const Ball& value);  // NOLINT(google-explicit-constructor)
  /// A constant by its place (ModelRecursion).
  static FrameValue constant(const Ball& value, std::size_t place);
  static FrameValue state(std::size_t index, const LinearValue& value);
  /// The two parts of a vector whose real part is this state and whose angle is this value; of this length in
  /// the state that is its imaginary part, or of any.
  static std::array<FrameValue, 2> vector(std::size_t state, const LinearValue& angle,
                                          const std::optional<std::pair<std::size_t, LinearValue>>& length);
  /// The number of the angle of a vector, modulo a turn. Its length is certainly positive where noise is
  /// below every amplitude, and depends on that of no vector before. Throws NotCovered.
  static int direction(const FrameValue& real, const FrameValue& imaginary);
  /// The numbers of the angle, modulo a turn, and the length of a vector: seen from the direction of what is
  /// kept of it, which has its length, the state of this number, as a factor; or else from the steady angle.
  /// Throws NotCovered.
  static std::array<int, 2> polar(const FrameValue& real, const FrameValue& imaginary,
                                  const LinearValue& steady_angle, std::size_t length);
  static FrameValue sample(std::size_t channel) { return FrameValue(sample_waves(channel)); }

  static FrameValue sample_of_one() { return FrameValue(sample_of_one_channel()); }

  /// The number of the linear value that it is. Throws NotCovered.
  [[nodiscard]] int linear() const;

  friend FrameValue operator+(const FrameValue& x, const FrameValue& y);
  friend FrameValue operator-(const FrameValue& x, const FrameValue& y) { return x + -y; }
  friend FrameValue operator-(const FrameValue& x);
  friend FrameValue operator*(const FrameValue& x, const FrameValue& y);
  friend FrameValue operator/(const FrameValue& x, const FrameValue& y);
  friend FrameValue sqrt(const FrameValue& x);
  friend FrameValue exp(const FrameValue& x) { return x.function("exp"); }
  friend FrameValue log(const FrameValue& x) { return x.function("log"); }
  friend FrameValue sin(const FrameValue& x) { return FrameValue(sine_wave(x.linear())); }
  friend FrameValue cos(const FrameValue& x) { return FrameValue(cosine_wave(x.linear())); }
  friend FrameValue tangent(const FrameValue& x) { return x.function("tan"); }
  friend FrameValue arcsine(const FrameValue& x) { return x.function("asin"); }
  friend FrameValue arccosine(const FrameValue& x) { return x.function("acos"); }
  friend FrameValue arctangent(const FrameValue& x);
  friend FrameValue arctangent2(const FrameValue& y, const FrameValue& x);
  friend FrameValue stays_within(const FrameValue& x, const FrameValue& low, const FrameValue& high);
  friend FrameValue larger(const FrameValue& x, const FrameValue& y);
  friend FrameValue clamped(const FrameValue& x, const FrameValue& low, const FrameValue& high);
  friend FrameValue chosen(const FrameValue& positive, const FrameValue& a, const FrameValue& b);
  friend FrameValue sign_of(const FrameValue& x);

 private:
  struct Linear {
    int number;
  };
  /// The tangent of an angle within a quarter turn of 0.
  struct Quotient {
    int angle;
  };
  explicit FrameValue(Linear value) : value_(value) {}
  explicit FrameValue(Quotient value) : value_(value) {}
  explicit FrameValue(Waves waves) : value_(std::move(waves)) {}
  [[nodiscard]] FrameValue function(const std::string& name) const;
  /// As waves, if it is a sum of waves or a constant.
  [[nodiscard]] std::optional<Waves> waves() const;
  [[nodiscard]] bool is_sum_of_waves() const { return std::holds_alternative<Waves>(value_); }

  std::variant<Linear, Waves, Quotient> value_;
};

/// While it exists, the values of this thread belong to this frame.
class FrameScope {
 public:
  explicit FrameScope(LinearFrame& frame);
  FrameScope(const FrameScope&) = delete;
  FrameScope& operator=(const FrameScope&) = delete;
  ~FrameScope();

 private:
  LinearFrame* before_;
};

}  // namespace veritrack::checker
