#include "analysis/model/gain/phase_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/piecewise.hpp"
#include "analysis/rigor/taylor_coefficients.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;
using trackers::Instruction;
using trackers::Operation;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Adds factor times the slopes of x.
void add_slopes(PhaseValue& sum, const BallModel& factor, const PhaseValue& x) {
  for (const auto& [key, slope] : x.slopes) {
    const auto [place, is_new] = sum.slopes.try_emplace(key, factor * slope);
    if (!is_new) {
      place->second += factor * slope;
    }
  }
}

Interval range_of(const BallModel& base) {
  const Interval range = base.range();
  return is_empty(range) ? Interval::from_bounds(-kInfinity, kInfinity) : range;
}

Interval around(const Interval& base, double bound) {
  return base + Interval::from_bounds(-bound, bound);
}

/// An upper bound, or infinity where there is none.
double size_or_infinity(double size) {
  if (size >= 0.0) {
    return size;
  }
  return kInfinity;  // not a number
}

/// |f(b + d) - f(b) - f'(b) d| for f = sin or cos, |f(b)| <= value and |f'(b)| <= slope.
double sine_remainder(double value, double slope, double bound) {
  if (!(bound <= 3.0)) {
    return (Interval(2.0) * Interval(value) + Interval(slope) * (Interval(bound) + Interval(1.0))).upper();
  }
  const Interval y(bound);
  const Interval half = sin(y * Interval(0.5));
  const Interval more = y - sin(y);
  return (Interval(value) * Interval(2.0) * half * half +
          Interval(slope) * Interval(std::max(more.upper(), 0.0)))
      .upper();
}

rigor::TaylorCoefficients taylor_of(Operation operation, const Interval& t) {
  switch (operation) {
    case Operation::sqrt:
      return rigor::taylor_of_sqrt(t);
    case Operation::exp:
      return rigor::taylor_of_exp(t);
    case Operation::log:
      return rigor::taylor_of_log(t);
    case Operation::tan:
      return rigor::taylor_of_tan(t);
    case Operation::asin:
      return rigor::taylor_of_asin(t);
    case Operation::acos:
      return rigor::taylor_of_acos(t);
    case Operation::atan:
      return rigor::taylor_of_atan(t);
    default:
      throw NoFrame("an operation without a rule");
  }
}

/// f and f' at a base.
std::pair<BallModel, BallModel> value_and_slope(Operation operation, const BallModel& b) {
  const BallModel one(1.0);
  switch (operation) {
    case Operation::sin:
      return {sin(b), cos(b)};
    case Operation::cos:
      return {cos(b), -sin(b)};
    case Operation::sqrt: {
      const BallModel root = sqrt(b);
      return {root, BallModel(0.5) / root};
    }
    case Operation::exp:
      return {exp(b), exp(b)};
    case Operation::log:
      return {log(b), one / b};
    case Operation::tan: {
      const BallModel tangent = tan(b);
      return {tangent, one + square(tangent)};
    }
    case Operation::asin:
      return {asin(b), one / sqrt(one - square(b))};
    case Operation::acos:
      return {acos(b), -(one / sqrt(one - square(b)))};
    case Operation::atan:
      return {atan(b), one / (one + square(b))};
    default:
      throw NoFrame("an operation without a rule");
  }
}

PhaseValue negative(const PhaseValue& x) {
  PhaseValue result{-x.base, {}};
  add_slopes(result, BallModel(-1.0), x);
  return result;
}

BallModel power_of(const BallModel& b, int exponent) {
  BallModel result(1.0);
  for (int i = 0; i < exponent; ++i) {
    result = result * b;
  }
  return result;
}

}  // namespace

int PhaseRules::form_of(const PhaseValue& value) {
  PhaseForm form;
  for (std::size_t j = 0; j < states_; ++j) {
    const auto found = value.slopes.find(static_cast<int>(j));
    form.states.push_back(found == value.slopes.end() ? BallModel(0.0) : found->second);
  }
  for (const auto& [key, slope] : value.slopes) {
    if (key >= static_cast<int>(states_)) {
      form.direct.push_back({key - static_cast<int>(states_), rigor::magnitude(range_of(slope))});
    }
  }
  step_->forms.push_back(std::move(form));
  return static_cast<int>(step_->forms.size()) - 1;
}

int PhaseRules::form_at(int place, const PhaseValue& value) {
  const auto found = forms_.find(place);
  if (found != forms_.end()) {
    return found->second;
  }
  const int form = form_of(value);
  forms_.emplace(place, form);
  return form;
}

std::optional<std::size_t> PhaseRules::possible_form(int place, const PhaseValue& value) {
  return value.slopes.empty() ? std::nullopt : std::optional(static_cast<std::size_t>(form_at(place, value)));
}

void PhaseRules::add_remainder(PhaseValue& value, RemainderSize size) {
  const auto number = static_cast<int>(step_->inputs.size());
  step_->inputs.push_back({false, std::move(size), {}});
  value.slopes.emplace(number + static_cast<int>(states_), BallModel(1.0));
}

PhaseValue PhaseRules::product(int first, int second, const PhaseValue& x, const PhaseValue& z) {
  PhaseValue result{first == second ? square(x.base) : x.base * z.base, {}};
  add_slopes(result, z.base, x);
  add_slopes(result, x.base, z);
  if (x.slopes.empty() || z.slopes.empty()) {
    return result;
  }
  const auto a = static_cast<std::size_t>(form_at(first, x));
  const auto b = static_cast<std::size_t>(form_at(second, z));
  add_remainder(result,
                [a, b](const std::vector<double>& bounds) { return rigor::mul_up(bounds[a], bounds[b]); });
  return result;
}

PhaseValue PhaseRules::function(Operation operation, int exponent, int place, const PhaseValue& x) {
  const bool is_power = operation == Operation::power;
  const bool is_reciprocal = operation == Operation::divide;
  std::pair<BallModel, BallModel> at;
  if (is_power) {
    at = {power_of(x.base, exponent),
          exponent == 0 ? BallModel(0.0)
                        : BallModel(static_cast<double>(exponent)) * power_of(x.base, exponent - 1)};
  } else if (is_reciprocal) {
    const BallModel reciprocal = BallModel(1.0) / x.base;
    at = {reciprocal, -square(reciprocal)};
  } else {
    at = value_and_slope(operation, x.base);
  }
  PhaseValue result{at.first, {}};
  if (x.slopes.empty() || (is_power && exponent == 0)) {
    return result;
  }
  add_slopes(result, at.second, x);
  const Interval base = range_of(x.base);
  const auto form = static_cast<std::size_t>(form_at(place, x));
  if (operation == Operation::sin || operation == Operation::cos) {
    const double value = rigor::magnitude(range_of(at.first));
    const double slope = rigor::magnitude(range_of(at.second));
    add_remainder(result, [form, value, slope](const std::vector<double>& bounds) {
      return size_or_infinity(sine_remainder(value, slope, bounds[form]));
    });
  } else if (is_reciprocal) {
    const double least = rigor::mignitude(base);
    add_remainder(result, [form, least](const std::vector<double>& bounds) {
      const Interval y(bounds[form]);
      const Interval m(least);
      const Interval room = m - y;
      return rigor::certainly_positive(room) ? (square(y) / (square(m) * room)).upper() : kInfinity;
    });
  } else if (is_power) {
    const double factor = 0.5 * exponent * (exponent - 1);
    const int less = std::max(exponent - 2, 0);
    add_remainder(result, [form, base, factor, less](const std::vector<double>& bounds) {
      const Interval most(rigor::magnitude(around(base, bounds[form])));
      return size_or_infinity((Interval(factor) * pow(most, less) * square(Interval(bounds[form]))).upper());
    });
  } else {
    add_remainder(result, [form, base, operation](const std::vector<double>& bounds) {
      const Interval half_second = taylor_of(operation, around(base, bounds[form]))[2];
      return is_empty(half_second)
                 ? kInfinity
                 : size_or_infinity((abs(half_second) * square(Interval(bounds[form]))).upper());
    });
  }
  return result;
}

PhaseValue PhaseRules::angle(int first, int second, const PhaseValue& y, const PhaseValue& x) {
  PhaseValue result{atan2(y.base, x.base), {}};
  if (y.slopes.empty() && x.slopes.empty()) {
    return result;
  }
  const BallModel squares = square(y.base) + square(x.base);
  const BallModel by_y = x.base / squares;
  const BallModel by_x = -(y.base / squares);
  add_slopes(result, by_y, y);
  add_slopes(result, by_x, x);
  const auto a = static_cast<std::size_t>(form_at(first, y));
  const auto b = static_cast<std::size_t>(form_at(second, x));
  const Interval range_y = range_of(y.base);
  const Interval range_x = range_of(x.base);
  const Interval least = sqrt(abs(range_of(squares)));
  add_remainder(result, [a, b, range_y, range_x, least](const std::vector<double>& bounds) {
    const Interval box_y = around(range_y, bounds[a]);
    const Interval box_x = around(range_x, bounds[b]);
    const bool is_off_cut = rigor::certainly_positive(box_x) || rigor::certainly_positive(box_y) ||
                            rigor::certainly_negative(box_y);
    if (!is_off_cut || !(least.lower() > 0.0)) {
      return kInfinity;
    }
    const Interval q =
        sqrt(square(Interval(bounds[a])) + square(Interval(bounds[b]))) / Interval(least.lower());
    const Interval rest = Interval(1.0) - q;
    return rigor::certainly_positive(rest) ? size_or_infinity((-log(rest) - q).upper()) : kInfinity;
  });
  return result;
}

PhaseValue PhaseRules::larger(int first, int second, const PhaseValue& x, const PhaseValue& z) {
  PhaseValue result{maximum(x.base, z.base), {}};
  const Interval difference = range_of(x.base - z.base);
  const double distance = rigor::mignitude(difference);
  // Both ways, half each, where the difference may be 0 on the curve.
  const double share = !(distance > 0.0) ? 0.5 : difference.lower() > 0.0 ? 1.0 : 0.0;
  for (const auto& [factor, each] : {std::pair(share, &x), std::pair(1.0 - share, &z)}) {
    if (factor > 0.0) {
      add_slopes(result, BallModel(factor), *each);
    }
  }
  const auto a = possible_form(first, x);
  const auto b = possible_form(second, z);
  if (a || b) {
    add_remainder(result, [=](const std::vector<double>& bounds) {
      const double y = rigor::add_up(a ? bounds[*a] : 0.0, b ? bounds[*b] : 0.0);
      const double beyond = distance > 0.0 ? rigor::sub_up(y, distance) : 0.5 * y;
      return size_or_infinity(beyond < 0.0 ? 0.0 : beyond);
    });
  }
  return result;
}

PhaseValue PhaseRules::chosen(int place, const PhaseValue& positive, const PhaseValue& a,
                              const PhaseValue& b) {
  const Interval base = range_of(positive.base);
  const double distance = rigor::mignitude(base);
  if (!(distance > 0.0)) {
    throw NoFrame("a condition that may turn in the steady state");
  }
  PhaseValue result = base.lower() > 0.0 ? a : b;
  if (const auto form = possible_form(place, positive)) {
    add_remainder(result, [form = *form, distance](const std::vector<double>& bounds) {
      return bounds[form] < distance ? 0.0 : kInfinity;
    });
  }
  return result;
}

PhaseValue PhaseRules::within(int place, const PhaseValue& x, const PhaseValue& low, const PhaseValue& high) {
  if (!low.slopes.empty() || !high.slopes.empty()) {
    throw NoFrame("limits that are not constant");
  }
  PhaseValue result = x;
  const Interval below = range_of(low.base);
  const Interval above = range_of(high.base);
  const Interval base = range_of(x.base);
  const bool has_form = !x.slopes.empty();
  const auto form = has_form ? static_cast<std::size_t>(form_at(place, x)) : 0;
  // A remainder of size 0 where the limits are kept.
  add_remainder(result, [=](const std::vector<double>& bounds) {
    const Interval box = has_form ? around(base, bounds[form]) : base;
    return rigor::certainly_less(below, box) && rigor::certainly_less(box, above) ? 0.0 : kInfinity;
  });
  return result;
}

PhaseValue PhaseRules::by_larger(const Instruction& each, const std::vector<PhaseValue>& registers) {
  const auto operand = [&](int number) -> const PhaseValue& {
    return registers[static_cast<std::size_t>(number)];
  };
  const PhaseValue& x = operand(each.first);
  switch (each.operation) {
    case Operation::minimum:
      return negative(larger(each.first, each.second, negative(x), negative(operand(each.second))));
    case Operation::absolute:
      return larger(each.first, each.first, x, negative(x));
    default: {
      const PhaseValue& low = operand(each.second);
      const PhaseValue& high = operand(each.third);
      if (!rigor::certainly_less_equal(range_of(low.base), range_of(high.base)) || !low.slopes.empty() ||
          !high.slopes.empty()) {
        throw NoFrame("limits that are not constant, or not in order");
      }
      const PhaseValue above_low = larger(each.first, each.second, x, low);
      const int place = -1 - static_cast<int>(registers.size());  // beyond the registers
      return negative(larger(place, each.third, negative(above_low), negative(high)));
    }
  }
}

PhaseValue PhaseRules::value_of(const Instruction& each, const std::vector<PhaseValue>& registers) {
  const auto operand = [&](int number) -> const PhaseValue& {
    return registers[static_cast<std::size_t>(number)];
  };
  const PhaseValue& x = operand(each.first);
  switch (each.operation) {
    case Operation::add:
    case Operation::subtract: {
      const double sign = each.operation == Operation::add ? 1.0 : -1.0;
      PhaseValue sum = x;
      sum.base.add_multiple(operand(each.second).base, sign);
      add_slopes(sum, BallModel(sign), operand(each.second));
      return sum;
    }
    case Operation::negate:
      return negative(x);
    case Operation::multiply:
      return product(each.first, each.second, x, operand(each.second));
    case Operation::divide: {
      // The reciprocal is a value of its own, with a place beyond the registers.
      const PhaseValue& z = operand(each.second);
      const PhaseValue reciprocal = function(Operation::divide, 0, each.second, z);
      const int place = -1 - static_cast<int>(registers.size());
      return product(each.first, place, x, reciprocal);
    }
    case Operation::atan2:
      return angle(each.first, each.second, x, operand(each.second));
    case Operation::maximum:
      return larger(each.first, each.second, x, operand(each.second));
    case Operation::minimum:
    case Operation::absolute:
    case Operation::clamp:
      return by_larger(each, registers);
    case Operation::sign:
      return chosen(each.first, x, {BallModel(1.0), {}}, {BallModel(-1.0), {}});
    case Operation::choose:
      return chosen(each.first, x, operand(each.second), operand(each.third));
    case Operation::stays_within:
      return within(each.first, x, operand(each.second), operand(each.third));
    default:
      return function(each.operation, each.exponent, each.first, x);
  }
}

}  // namespace veritrack::model
