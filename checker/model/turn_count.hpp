// By how many turns values change when angles make whole turns: a recursion whose angles are known modulo 2
// pi only must keep these counts. They are read off the formulas, by computing with counts in place of
// numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/model/model_recursion.hpp"

namespace veritrack::checker {

/// A value that changes by 2 pi turns[i] when angle number i changes by 2 pi, for all i and all values of the
/// angles; or one for which that is not known.
class TurnCount {
 public:
  /// It does not change.
  TurnCount(double value) : TurnCount(Ball(value)) {}  // NOLINT(google-explicit-constructor)
  TurnCount(const Ball& value);                        // NOLINT(google-explicit-constructor)
  /// Angle number `index` of `count` itself.
  static TurnCount angle(std::size_t index, std::size_t count);
  static TurnCount unknown();
  /// Some number that does not change.
  static TurnCount still();

  /// Certain to turn this often with each angle, and not at all with angles beyond the end of the list.
  [[nodiscard]] bool turns_by(const std::vector<long>& expected) const;
  [[nodiscard]] bool is_still() const { return turns_by({}); }

  friend TurnCount operator+(const TurnCount& x, const TurnCount& y) { return combined(x, 1, y, 1); }
  friend TurnCount operator-(const TurnCount& x, const TurnCount& y) { return combined(x, 1, y, -1); }
  friend TurnCount operator-(const TurnCount& x) { return combined(x, -1, TurnCount(0.0), 0); }
  friend TurnCount operator*(const TurnCount& x, const TurnCount& y);
  friend TurnCount operator/(const TurnCount& x, const TurnCount& y) { return x.with(y); }
  friend TurnCount sqrt(const TurnCount& x) { return x.with(x); }
  friend TurnCount exp(const TurnCount& x) { return x.with(x); }
  friend TurnCount log(const TurnCount& x) { return x.with(x); }
  friend TurnCount sin(const TurnCount& x) { return x.periodic(); }
  friend TurnCount cos(const TurnCount& x) { return x.periodic(); }
  friend TurnCount tangent(const TurnCount& x) { return x.periodic(); }
  friend TurnCount arcsine(const TurnCount& x) { return x.with(x); }
  friend TurnCount arccosine(const TurnCount& x) { return x.with(x); }
  friend TurnCount arctangent(const TurnCount& x) { return x.with(x); }
  friend TurnCount arctangent2(const TurnCount& y, const TurnCount& x) { return y.with(x); }
  friend TurnCount stays_within(const TurnCount& x, const TurnCount& low, const TurnCount& high) {
    return x.with(low).with(high);
  }
  friend TurnCount larger(const TurnCount& x, const TurnCount& y) { return x.with(y); }
  friend TurnCount clamped(const TurnCount& x, const TurnCount& low, const TurnCount& high) {
    return x.with(low).with(high);
  }
  friend TurnCount chosen(const TurnCount& positive, const TurnCount& a, const TurnCount& b) {
    return positive.with(a).with(b);
  }
  friend TurnCount sign_of(const TurnCount& x) { return x.with(x); }

 private:
  static TurnCount combined(const TurnCount& x, long times_x, const TurnCount& y, long times_y);
  /// Any function of both: still if both are.
  [[nodiscard]] TurnCount with(const TurnCount& y) const;
  /// A function of period 2 pi in this one.
  [[nodiscard]] TurnCount periodic() const;

  bool known_ = true;
  std::vector<long> turns_;    ///< zeros at the end may be missing
  std::optional<long> whole_;  ///< the constant that it is, if that is a whole number
};

/// Empty when G(X + 2 pi e_i) = G(X) + 2 pi e_i for every angle i, the estimate of the frequency does not
/// change with it, and the signal has the period 2 pi in its phase; otherwise lists what is not known.
std::string angle_objection(const ModelRecursion& recursion);

}  // namespace veritrack::checker
