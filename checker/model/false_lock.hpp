// How near a false lock may be: a frequency at which the tracker may settle instead of the true one, as far
// as its formulas and the signal's show (docs/model-proof.md, section 18).
#pragma once

#include <optional>
#include <vector>

#include "checker/model/tube_step.hpp"

namespace veritrack::checker {

/// The degree of a value as a quotient of polynomials in the states and in sines and cosines of them: how
/// many parts of a turn of an angle, or changes of the sign of states, it may not see. sin(x) cos(x) and I Q,
/// which do not see half a turn, have the degree 2. Formulas are evaluated over degrees in place of numbers.
class Repeats {
 public:
  Repeats(double value) : Repeats(Ball(value)) {}  // NOLINT(google-explicit-constructor)
  Repeats(const Ball& value);                      // NOLINT(google-explicit-constructor)
  /// State number `index` of `count`.
  static Repeats variable(std::size_t index, std::size_t count);

  /// The degree of the numerator and of the denominator together.
  [[nodiscard]] long parts() const;
  /// The largest whole number, over all states, that is a factor or a divisor of a state here; 0 for a
  /// constant.
  [[nodiscard]] long multiple() const;

  friend Repeats operator+(const Repeats& x, const Repeats& y);
  friend Repeats operator-(const Repeats& x, const Repeats& y) { return x + y; }
  friend Repeats operator-(const Repeats& x) { return x; }
  friend Repeats operator*(const Repeats& x, const Repeats& y);
  friend Repeats operator/(const Repeats& x, const Repeats& y);
  friend Repeats sqrt(const Repeats& x) { return x.function(); }
  friend Repeats exp(const Repeats& x) { return x.function(); }
  friend Repeats log(const Repeats& x) { return x.function(); }
  friend Repeats sin(const Repeats& x) { return x.periodic(0); }
  friend Repeats cos(const Repeats& x) { return x.periodic(0); }
  friend Repeats tangent(const Repeats& x) { return x.periodic(1); }
  friend Repeats arcsine(const Repeats& x) { return x.function(); }
  friend Repeats arccosine(const Repeats& x) { return x.function(); }
  friend Repeats arctangent(const Repeats& x) { return x.function(); }
  friend Repeats arctangent2(const Repeats& y, const Repeats& x) { return (y / x).function(); }
  friend Repeats stays_within(const Repeats& x, const Repeats& /*low*/, const Repeats& /*high*/) { return x; }
  friend Repeats larger(const Repeats& x, const Repeats& y) { return (x + y).function(); }
  /// As x^2: it does not see a sign.
  friend Repeats absolute(const Repeats& x) { return x.function(); }
  friend Repeats clamped(const Repeats& x, const Repeats& low, const Repeats& high) {
    return (x + low + high).function();
  }
  friend Repeats chosen(const Repeats& positive, const Repeats& a, const Repeats& b) {
    return (positive + a + b).function();
  }
  friend Repeats sign_of(const Repeats& x) { return x.function(); }

 private:
  [[nodiscard]] bool is_constant() const { return multiples_.empty() && parts() == 0; }
  /// The multiples of both, added entry by entry.
  static std::vector<long> multiples(const Repeats& x, const Repeats& y);
  /// A function other than those of period 2 pi: twice the degree, to be safe with sums.
  [[nodiscard]] Repeats function() const;
  /// A function of period 2 pi, with the degree of its denominator for each of its numerator.
  [[nodiscard]] Repeats periodic(long denominator) const;

  std::vector<long> multiples_;  ///< of the states
  bool is_linear_ = true;        ///< a sum of these multiples
  long numerator_ = 0, denominator_ = 0;
  std::optional<long> whole_;  ///< the constant that it is, if that is a whole number
};

/// Less than the frequency error, rad/sample, from which a state may be nearer to a false lock than to the
/// true one, for all frequencies from `lowest` to `highest`; 0 where nothing is left. It is half the distance
/// to the nearest of
/// - the frequencies 2 pi/M away, M the largest degree of the step, of the frequency and of the signal;
/// - the frequencies -omega and 2 pi - omega, unless the signal is certain to move on at each phase, so that
///   it cannot be another one that runs backwards: of one channel it is not;
/// - the frequencies i/j omega, i and j up to n, where the signal has harmonics up to n.
Ball half_distance_to_false_lock(const TrackedModel& model, const Ball& lowest, const Ball& highest);

}  // namespace veritrack::checker
