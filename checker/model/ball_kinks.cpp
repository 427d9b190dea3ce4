// Functions with kinks and jumps over polynomials.
#include "checker/model/ball_polynomial.hpp"

#include <algorithm>

namespace veritrack::checker {

BallPolynomial larger(const BallPolynomial& x, const BallPolynomial& y) {
  const BallPolynomial difference = x - y;
  const Ball range = difference.range();
  if (!difference.known() || !range.finite()) {
    return BallPolynomial::everything();
  }
  if (certainly_not_negative(range)) {
    return x;
  }
  if (certainly_not_negative(-range)) {
    return y;
  }
  // max(d, 0) is convex: at least t d for 0 <= t <= 1, and at the ends it is (1 - t) u and -t l more.
  const Ball low = range.lower();
  const Ball high = range.upper();
  const double slope = std::clamp((high / (high - low)).near(), 0.0, 1.0);
  const Ball t(slope);
  const double more = max((one - t) * high, -(t * low)).upper_double();
  if (!(slope >= 0.0) || !(more >= 0.0)) {
    return BallPolynomial::everything();
  }
  const double middle = 0.5 * more;
  BallPolynomial result = y + slope * difference + BallPolynomial(middle);
  return result.widen((Ball(more) - Ball(middle)).upper_double());
}

BallPolynomial clamped(const BallPolynomial& x, const BallPolynomial& low, const BallPolynomial& high) {
  return certainly_at_most(low.range(), high.range()) ? -larger(-larger(x, low), -high)
                                                      : BallPolynomial::everything();
}

BallPolynomial chosen(const BallPolynomial& positive, const BallPolynomial& a, const BallPolynomial& b) {
  const Ball range = positive.range();
  return certainly_positive(range) ? a : certainly_not_negative(-range) ? b : BallPolynomial::everything();
}

BallPolynomial sign_of(const BallPolynomial& x) {
  const Ball range = x.range();
  return certainly_positive(range)    ? BallPolynomial(1.0)
         : certainly_positive(-range) ? BallPolynomial(-1.0)
                                      : BallPolynomial::everything();
}

}  // namespace veritrack::checker
