#include "checker/model/gain/phase_rules.hpp"

#include <algorithm>
#include <cmath>

#include "checker/model/formula.hpp"
#include "checker/model/gain/wide_number.hpp"

namespace veritrack::checker {

namespace {

const double kUnbounded = HUGE_VAL;

BallPolynomial squared(const BallPolynomial& x) {
  return x * x;
}

RuleResult result_of_function(const PhaseNode& node, const BallPolynomial& x) {
  const BallPolynomial unit(1.0);
  switch (node.operation) {
    case PhaseOperation::above: {
      const DoubleRange range = range_over_cell(x);
      const bool is_known = range.low > 0.0 || range.high < 0.0;
      return {
          is_known ? BallPolynomial(range.low > 0.0 ? 1.0 : 0.0) : BallPolynomial::everything(), {}, {}, {}};
    }
    case PhaseOperation::reciprocal: {
      const BallPolynomial inverse = reciprocal(x);
      return {inverse, -squared(inverse), {}, {}};
    }
    case PhaseOperation::sine:
      return {sin(x), cos(x), {}, {}};
    case PhaseOperation::cosine:
      return {cos(x), -sin(x), {}, {}};
    case PhaseOperation::root: {
      const BallPolynomial root = sqrt(x);
      return {root, 0.5 * reciprocal(root), {}, {}};
    }
    case PhaseOperation::exponential:
      return {exp(x), exp(x), {}, {}};
    case PhaseOperation::logarithm:
      return {log(x), reciprocal(x), {}, {}};
    case PhaseOperation::tangent:
      return {tangent(x), unit + squared(tangent(x)), {}, {}};
    case PhaseOperation::arcsine:
      return {arcsine(x), reciprocal(sqrt(unit - squared(x))), {}, {}};
    case PhaseOperation::arccosine:
      return {arccosine(x), -reciprocal(sqrt(unit - squared(x))), {}, {}};
    case PhaseOperation::arctangent:
      return {arctangent(x), reciprocal(unit + squared(x)), {}, {}};
    default:
      return {BallPolynomial::everything(), BallPolynomial::everything(), BallPolynomial::everything(), {}};
  }
}

/// The second derivative over an interval in the domain; everything where it is not there.
Ball curvature(PhaseOperation operation, const Ball& x) {
  switch (operation) {
    case PhaseOperation::root:
      return certainly_positive(x) ? one / (four * x * sqrt(x)) : Ball::everything();
    case PhaseOperation::exponential:
      return exp(x);
    case PhaseOperation::logarithm:
      return certainly_positive(x) ? one / square(x) : Ball::everything();
    case PhaseOperation::tangent:
      // No pole lies between two where the cosine vanishes.
      // cannot bind (abs(cos(x))): near a pole the tangent has no bound, so that it is in no finite ball.
      return certainly_positive(abs(cos(x))) ? two * tangent(x) * (one + square(tangent(x)))
                                             : Ball::everything();
    case PhaseOperation::arcsine:
    case PhaseOperation::arccosine: {
      const Ball rest = one - square(abs(x).upper());
      return certainly_positive(rest) ? abs(x) / (rest * sqrt(rest)) : Ball::everything();
    }
    case PhaseOperation::arctangent: {
      const Ball value = two * x / square(one + square(x));
      const Ball everywhere(0.65);  // 3^(3/2)/8 at 3^(-1/2)
      return certainly_less(abs(value), everywhere) ? value : everywhere;
    }
    default:
      return Ball::everything();
  }
}

/// Y^2/(m^2 (m - Y)).
double remainder_of_reciprocal(const RuleRange& range, double y) {
  const double least = range.low > 0.0 ? range.low : range.high < 0.0 ? -range.high : 0.0;
  const double rest = (least - y) * (1.0 - 0x1p-40);
  const double below = least * least * rest * (1.0 - 0x1p-40);
  return least > 0.0 && rest > 0.0 && below > 0.0 ? up(upward_product(y, y) / below) : kUnbounded;
}

/// |f| (1 - cos Y) + |f'| (Y - sin Y), by sections of their series that end with a positive term; or what is
/// true for large Y.
double remainder_of_wave(const RuleRange& range, double y) {
  const double square = y * y;
  // Two terms more than they are for what rounding may take away.
  const double error = 0x1p-44 * square * (1.0 + square * (1.0 + square));
  const double of_value = square * (0.5 - square * (1.0 / 24.0 - square / 720.0)) + error;
  const double of_slope = y * square * (1.0 / 6.0 - square * (1.0 / 120.0 - square / 5040.0)) + y * error;
  const double small = upward_product(range.value, of_value) + upward_product(range.slope, of_slope);
  const double large = 2.0 * range.value + upward_product(range.slope, up(y + 1.0));
  return small < large ? up(small) : up(large);
}

/// Y^2/2 sup |f''|.
double remainder_of_function(const PhaseNode& node, const RuleRange& range, double y) {
  const Ball deviation(y);
  const Ball all = Ball::hull(Ball(range.low) - deviation, Ball(range.high) + deviation);
  return upper(half * square(deviation) * abs(curvature(node.operation, all)));
}

/// -log(1 - q) - q, where the box does not meet the cut.
double remainder_of_angle(const RuleRange& range, double of_y, double of_x) {
  const Ball deviation_y(of_y);
  const Ball deviation_x(of_x);
  const bool is_off_the_cut = certainly_positive(Ball(range.other_low) - deviation_x) ||
                              certainly_positive(Ball(range.low) - deviation_y) ||
                              certainly_positive(-Ball(range.high) - deviation_y);
  const Ball least(range.value);
  if (!is_off_the_cut || !certainly_positive(least)) {
    return kUnbounded;
  }
  const Ball q = (sqrt(square(deviation_y) + square(deviation_x)) / least).upper();
  return certainly_less(q, one) ? upper(-log(one - q) - q) : kUnbounded;
}

bool is_kept(const PhaseNode& node, const RuleRange& range, double y) {
  return certainly_less(node.low, Ball(range.low) - Ball(y)) &&
         certainly_less(Ball(range.high) + Ball(y), node.high);
}

}  // namespace

RuleResult base_of(const PhaseNode& node, const BallPolynomial& first, const BallPolynomial& second) {
  RuleResult result;
  switch (node.operation) {
    case PhaseOperation::sum:
      result = {first + second, BallPolynomial(1.0), BallPolynomial(1.0), {}};
      break;
    case PhaseOperation::difference:
      result = {first - second, BallPolynomial(1.0), BallPolynomial(-1.0), {}};
      break;
    case PhaseOperation::negation:
      result = {-first, BallPolynomial(-1.0), {}, {}};
      break;
    case PhaseOperation::within:
      result = {first, BallPolynomial(1.0), {}, {}};
      break;
    case PhaseOperation::product:
      result = {first * second, second, first, {}};
      break;
    case PhaseOperation::larger: {
      const DoubleRange difference = range_over_cell(first - second);
      const double share = difference.low > 0.0 ? 1.0 : difference.high < 0.0 ? 0.0 : 0.5;
      result = {larger(first, second), BallPolynomial(share), BallPolynomial(1.0 - share), {}};
      result.range.value = std::max({0.0, difference.low, -difference.high});
      break;
    }
    case PhaseOperation::arctangent2: {
      const BallPolynomial square = squared(first) + squared(second);
      const BallPolynomial inverse = reciprocal(square);
      result = {arctangent2(first, second), second * inverse, -(first * inverse), {}};
      result.range.value = std::sqrt(std::max(0.0, range_over_cell(square).low)) * (1.0 - 0x1p-48);
      break;
    }
    default:
      result = result_of_function(node, first);
  }
  const DoubleRange of_first = range_over_cell(first);
  const DoubleRange of_second = range_over_cell(second);
  result.range.low = of_first.low;
  result.range.high = of_first.high;
  result.range.other_low = of_second.low;
  result.range.other_high = of_second.high;
  if (node.operation == PhaseOperation::sine || node.operation == PhaseOperation::cosine) {
    result.range.value = std::min(largest_in(range_over_cell(result.base)), 1.0);
    result.range.slope = std::min(largest_in(range_over_cell(result.by_first)), 1.0);
  }
  return result;
}

double remainder_size(const PhaseNode& node, const RuleRange& range, double first, double second) {
  if (!(std::isfinite(first) && first >= 0.0 && std::isfinite(second) && second >= 0.0)) {
    return kUnbounded;
  }
  double size = 0.0;
  switch (node.operation) {
    case PhaseOperation::product:
      size = up(upward_product(first, second));
      break;
    case PhaseOperation::reciprocal:
      size = remainder_of_reciprocal(range, first);
      break;
    case PhaseOperation::sine:
    case PhaseOperation::cosine:
      size = remainder_of_wave(range, first);
      break;
    case PhaseOperation::arctangent2:
      size = remainder_of_angle(range, first, second);
      break;
    case PhaseOperation::larger: {
      // Half of both where they may be equal on the curve.
      const double most = up(first + second);
      size = range.value > 0.0 ? std::max(0.0, up(most - range.value)) : 0.5 * most;
      break;
    }
    case PhaseOperation::above:
      return first < range.low || first < -range.high ? 0.0 : kUnbounded;
    case PhaseOperation::within:
      return is_kept(node, range, first) ? 0.0 : kUnbounded;
    case PhaseOperation::sum:
    case PhaseOperation::difference:
    case PhaseOperation::negation:
    case PhaseOperation::number:
    case PhaseOperation::state:
    case PhaseOperation::sample:
      return 0.0;
    default:
      size = remainder_of_function(node, range, first);
  }
  return size >= 0.0 && size < kUnbounded ? size : kUnbounded;
}

}  // namespace veritrack::checker
