#include "checker/numbers/rounded_value.hpp"

namespace veritrack::checker {

namespace {

/// Unit roundoff; underflow in a unit of length between 2^-60 and 2^60, for quantities that scale like at
/// most its 8th power and must not exceed this size in it.
const Ball& unit_roundoff() {
  static const Ball value(0x1p-53);
  return value;
}
const Ball& underflow() {
  static const Ball value(0x1p-595);
  return value;
}
const Ball& largest_size() {
  static const Ball value(0x1p540);
  return value;
}

}  // namespace

RoundedValue held(const Ball& size) {
  return {abs(size).upper(), zero};
}

RoundedValue rounded(const Ball& size, const Ball& error, const Ball& units) {
  const Ball largest = (size + error).upper();
  if (!certainly_at_most(largest, largest_size())) {
    return {Ball::everything(), Ball::everything()};
  }
  return {size.upper(), (error + units * (unit_roundoff() * largest + underflow())).upper()};
}

RoundedValue sum(const RoundedValue& x, const RoundedValue& y) {
  return rounded(x.size + y.size, x.error + y.error);
}

RoundedValue product(const RoundedValue& x, const RoundedValue& y) {
  return rounded(x.size * y.size, x.size * y.error + x.error * y.size + x.error * y.error);
}

RoundedValue quotient(const RoundedValue& x, const RoundedValue& y, const Ball& least, const Ball& size) {
  const Ball divisor = (least - y.error).lower();
  if (!certainly_positive(divisor)) {
    return {Ball::everything(), Ball::everything()};
  }
  return rounded(size, (x.error + size * y.error) / divisor);
}

RoundedValue root(const RoundedValue& x, const Ball& least) {
  const Ball computed = (least - x.error).lower();
  return rounded(sqrt(x.size), x.error / (sqrt(least.lower()) + sqrt(computed)));
}

}  // namespace veritrack::checker
