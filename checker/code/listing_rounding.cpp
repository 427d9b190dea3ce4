#include "checker/code/listing_rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "checker/code/turned_pair.hpp"

namespace veritrack::checker {

namespace {

/// The exact value of a register, and how far the program's is from it; unknown: a ball of everything.
struct Register {
  Ball exact = Ball::everything();
  Ball error = Ball::everything();
};

Ball size_of(const Ball& x) {
  return abs(x).upper();
}

/// The value when its exact counterpart is off by `error` before it is rounded `units` times.
Register stored(ListedFormat format, const Ball& exact, const Ball& error, const Ball& units = one) {
  const Ball most = (size_of(exact) + error).upper();
  const Ball limit(format.bits == 32 ? 0x1p127 : 0x1p1023);
  const Ball flushed(format.bits == 32 ? 0x1p-126 : 0x1p-1022);
  if (!certainly_less(most, limit)) {
    return {};
  }
  return {exact, (error + units * Ball(half_unit(format)) * most + flushed).upper()};
}

class StepErrors {
 public:
  StepErrors(const CodeListing& listing, const ListedAngles& angles, const std::vector<Ball>& states,
             const Ball& sample)
      : listing_(&listing), angles_(&angles), limits_(angles.arcs) {
    for (std::size_t i = 0; i < listing.states.size(); ++i) {
      const int input = listing.states[i].input;
      const auto angle = angles.states.find(input);
      known_[input] = {angle == angles.states.end() ? states.at(i) : angle->second, zero};
    }
    for (const int input : listing.samples) {
      known_[input] = {sample, zero};
    }
    for (const auto& [place, number] : angles.numbers) {
      known_[place] = {number.exact, std::isfinite(number.value)
                                         ? abs(Ball(number.value) - number.exact).upper()
                                         : Ball::everything()};
    }
    for (const ListedLimit& limit : angles.limits) {
      limits_[limit.place] = Ball::hull(at(limit.low).exact.lower(), at(limit.high).exact.upper());
    }
    for (auto& [place, known] : known_) {
      known.exact = limited(place, known.exact);
    }
  }

  [[nodiscard]] std::optional<std::vector<Ball>> all() {
    for (const auto& [low, high] : angles_->ordered) {
      if (!certainly_less(at(low).exact + at(low).error, at(high).exact - at(high).error)) {
        return std::nullopt;
      }
    }
    std::vector<Ball> errors;
    for (const ListedState& state : listing_->states) {
      // A start is rounded, too.
      const Register stored_start = stored(operation(state.input).format, known_.at(state.input).exact, zero);
      errors.push_back(max(modulo_turns(state.next).error, stored_start.error).upper());
    }
    errors.push_back(at(listing_->frequency).error);
    const bool is_known = std::all_of(errors.begin(), errors.end(), [](const Ball& error) {
      return certainly_less(error, Ball(0x1p60)) && certainly_not_negative(error);
    });
    return is_known ? std::optional(std::move(errors)) : std::nullopt;
  }

 private:
  const ListedOperation& operation(int place) const { return listing_->at(place); }

  /// True, false, or nothing where it is no test of whether a value is a number.
  [[nodiscard]] std::optional<bool> of_numbers(int condition) const {
    const ListedOperation& test = operation(condition);
    if (test.is("fcmp") && (test.predicate == "uno" || test.predicate == "ord")) {
      return test.predicate == "ord";
    }
    if (test.is("xor") && operation(test.operands[1]).is_bit()) {
      const std::optional<bool> inner = of_numbers(test.operands[0]);
      return inner ? std::optional(*inner != (operation(test.operands[1]).integer != 0)) : std::nullopt;
    }
    return std::nullopt;
  }

  const Register& at(int place) {
    const auto found = known_.find(place);
    if (found != known_.end()) {
      return found->second;
    }
    Register value = computed(place);
    if (!value.exact.finite() || !value.error.finite()) {
      value = {};
    }
    value.exact = limited(place, value.exact);
    return known_[place] = std::move(value);
  }

  /// What is known of an exact value of which a limit is shown.
  [[nodiscard]] Ball limited(int place, const Ball& exact) const {
    const auto limit = limits_.find(place);
    if (limit == limits_.end() || !exact.finite() || !limit->second.finite()) {
      return exact;
    }
    const Ball low = max(exact.lower(), limit->second.lower());
    const Ball high = min(exact.upper(), limit->second.upper());
    return certainly_at_most(low, high) ? Ball::hull(low, high) : exact;
  }

  /// The direction of samples that are turned back, away from half a turn, where it would jump.
  [[nodiscard]] Register turned_pair(const ListedOperation& arc, int turn, const Ball& limit) {
    const Register& angle = at(turn);
    const bool is_known = at(arc.operands[0]).error.finite() && at(arc.operands[1]).error.finite();
    const Ball off = error_of_turned_pair(arc.format, angle.error, error_of_sine(arc.format, angle),
                                          angles_->least_sample);
    const bool is_away =
        certainly_at_most(size_of(limit), Ball(3.1401)) && certainly_less(off, Ball(0x1p-11));
    return is_known && is_away ? stored(arc.format, limit, off, Ball(4.0)) : Register{};
  }

  /// The same, where whole turns do not matter.
  Register modulo_turns(int place) {
    const auto wrap = angles_->wraps.find(plain(place));
    return wrap == angles_->wraps.end() ? at(place) : wrapped(wrap->second);
  }

  Register computed(int place) {
    if (const auto wrap = angles_->wraps.find(place); wrap != angles_->wraps.end()) {
      return wrap->second.is_limited ? wrapped(wrap->second) : Register{};
    }
    const ListedOperation& now = operation(place);
    if (!now.format.is_float) {
      return {};
    }
    if (now.is("constant")) {
      return std::isfinite(now.number) ? Register{Ball(now.number), zero} : Register{};
    }
    if (now.is("select")) {
      return selected(now);
    }
    const bool is_periodic = now.is("sin") || now.is("cos");
    const Register x = is_periodic ? modulo_turns(now.operands[0]) : at(now.operands[0]);
    if (now.operands.size() == 1) {
      return of_one(now, x);
    }
    const Register y = at(now.operands[1]);
    if (now.is("arc")) {  // exact: it is the samples that are off
      return {Ball::within(Ball(listing_->largest_arc)), zero};
    }
    if (const auto limit = limits_.find(place); limit != limits_.end()) {
      if (const std::optional<int> turn = angle_of_turned_pair(*listing_, place)) {
        return turned_pair(now, *turn, limit->second);
      }
    }
    return of_two(now, x, y);
  }

  /// Of the library's sine and cosine.
  static Ball error_of_sine(ListedFormat format, const Register& x) {
    const Ball around = x.exact + Ball::within(x.error);
    const bool is_measured = format.bits == 32 && certainly_at_most(abs(around), Ball(8.0));
    return is_measured ? Ball(0x1.8p-24) : Ball(4.0) * Ball(half_unit(format));
  }

  static Register of_one(const ListedOperation& now, const Register& x) {
    const Ball four_units(4.0);
    const Ball around = x.exact + Ball::within(x.error);
    if (now.is("fpext")) {
      return x;
    }
    if (now.is("fptrunc")) {
      return stored(now.format, x.exact, x.error);
    }
    if (now.is("fneg")) {
      return {-x.exact, x.error};
    }
    if (now.is("fabs")) {
      return {abs(x.exact), x.error};
    }
    if (now.is("sin") || now.is("cos")) {
      return {now.is("sin") ? sin(x.exact) : cos(x.exact), (x.error + error_of_sine(now.format, x)).upper()};
    }
    if (now.is("atan")) {
      return stored(now.format, arctangent(x.exact), x.error, four_units);
    }
    if (now.is("sqrt") && certainly_positive(around)) {
      return stored(now.format, sqrt(x.exact), (x.error / (two * sqrt(around.lower()))).upper());
    }
    if (now.is("exp")) {
      return stored(now.format, exp(x.exact), (exp(around) * x.error).upper(), four_units);
    }
    if (now.is("log") && certainly_positive(around)) {
      return stored(now.format, log(x.exact), (x.error / around.lower()).upper(), four_units);
    }
    if ((now.is("asin") || now.is("acos")) && certainly_less(abs(around), one)) {
      const Ball sine = arcsine(x.exact);
      const Ball slope = sqrt(one - square(abs(around).upper())).lower();
      return stored(now.format, now.is("asin") ? sine : half * pi() - sine, (x.error / slope).upper(),
                    four_units);
    }
    return {};
  }

  static Register of_two(const ListedOperation& now, const Register& x, const Register& y) {
    if (now.is("fadd") || now.is("fsub")) {
      return stored(now.format, now.is("fadd") ? x.exact + y.exact : x.exact - y.exact,
                    (x.error + y.error).upper());
    }
    if (now.is("fmul")) {
      const bool is_square = now.operands[0] == now.operands[1];
      const Ball off = size_of(x.exact) * y.error + x.error * (size_of(y.exact) + y.error);
      return stored(now.format, is_square ? square(x.exact) : x.exact * y.exact, off.upper());
    }
    if (now.is("fdiv")) {
      const Ball least = (abs(y.exact) - y.error).lower();
      if (!certainly_positive(least)) {
        return {};
      }
      const Ball quotient = x.exact / y.exact;
      return stored(now.format, quotient, ((x.error + size_of(quotient) * y.error) / least).upper());
    }
    if (now.is("fmin") || now.is("fmax")) {
      return {now.is("fmin") ? min(x.exact, y.exact) : max(x.exact, y.exact), max(x.error, y.error).upper()};
    }
    if (now.is("atan2")) {
      return arc(now.format, x, y);
    }
    return {};
  }

  /// The angle of a point (y, x), which turns by at most pi/2 times its share of the distance.
  static Register arc(ListedFormat format, const Register& y, const Register& x) {
    const Ball all = Ball::within(pi());
    const Ball off = (y.error + x.error).upper();
    if (certainly_equal(off, zero)) {
      return stored(format, all, zero, Ball(4.0));
    }
    const Ball away = (x.exact - off).lower();  // from the half turn, where it jumps, and from 0
    if (!certainly_positive(away)) {
      return {};
    }
    return stored(format, all, (two * off / away).upper(), Ball(4.0));
  }

  /// Roundings of the turns that are added, and what the program's constants are off from turns.
  Register wrapped(const ListedWrap& wrap) {
    const Register base = at(wrap.base);
    const Ball slack(1e-5);  // of the ranges that the wrap's shifts were found for
    if (!certainly_at_most(base.error, slack)) {
      return {};
    }
    if (wrap.is_of_any_base) {
      return without_turns(operation(wrap.base).format, base);
    }
    Ball most = zero;
    for (const ListedShift& shift : wrap.shifts) {
      const Ball turns(std::round(shift.by / 6.283185307179586));
      const Ball off = abs(Ball(shift.by) - turns * two * pi());
      most = max(most, off + Ball(shift.roundings) * (Ball(wrap.largest) + slack)).upper();
    }
    const Ball size = wrap.is_limited ? Ball(3.1401) : Ball(wrap.largest) + slack;
    return {Ball::within(size), (base.error + most).upper()};
  }

  /// x - T*rint(x*(1/T)), of at most three turns: T is off, and so are the product, which is at most the sum
  /// of x and what is left, and the difference.
  static Register without_turns(ListedFormat format, const Register& base) {
    const Ball turn = two * pi();
    const Ball size = (size_of(base.exact) + base.error).upper();
    constexpr double kMostTurns = 2.9;
    if (!certainly_at_most(size, Ball(kMostTurns) * turn)) {
      return {};
    }
    // A count next to where it changes is that of an argument a little larger.
    const double count = std::floor((size / turn + half + Ball(0x1p-20)).upper_double());
    const double nearest = format.bits == 32 ? static_cast<double>(0x1.921fb6p+2F) : 0x1.921fb54442d18p+2;
    const Ball constant = Ball(count) * abs(Ball(nearest) - turn);
    const Ball most = max(size, pi() + Ball(1e-5)).upper();
    return {Ball::within(pi() + Ball(1e-4)),
            (base.error + constant + Ball(3.0) * Ball(half_unit(format)) * most).upper()};
  }

  /// A choice: the branch that is certain, or both where they are the same number at the turning point.
  Register selected(const ListedOperation& now) {
    const auto [condition, yes, no] = std::array<int, 3>{now.operands[0], now.operands[1], now.operands[2]};
    if (const std::optional<bool> known = decided(condition)) {
      return at(*known ? yes : no);
    }
    const ListedOperation& test = operation(condition);
    if (!test.is("fcmp") || !is_order(test.predicate) || !meets(yes, no, test)) {
      return {};
    }
    const Register a = at(yes);
    const Register b = at(no);
    return {Ball::hull(min(a.exact, b.exact).lower(), max(a.exact, b.exact).upper()),
            max(a.error, b.error).upper()};
  }

  static bool is_order(const std::string& predicate) {
    return predicate.size() == 3 && (predicate[1] == 'l' || predicate[1] == 'g');
  }

  /// For values that are certainly in this order.
  static bool is_true(const std::string& predicate, bool first_is_less) {
    return (predicate[1] == 'l') == first_is_less;
  }

  [[nodiscard]] std::optional<bool> decided(int condition) {
    if (const std::optional<bool> known = of_numbers(condition)) {
      return known;
    }
    const ListedOperation& test = operation(condition);
    if (test.is_bit()) {
      return test.integer != 0;
    }
    if (test.is("fcmp") && is_order(test.predicate)) {
      const Register a = at(test.operands[0]);
      const Register b = at(test.operands[1]);
      if (certainly_less(a.exact + a.error, b.exact - b.error)) {
        return is_true(test.predicate, true);
      }
      if (certainly_less(b.exact + b.error, a.exact - a.error)) {
        return is_true(test.predicate, false);
      }
      return std::nullopt;
    }
    const bool is_choice = test.is("select");
    if (!is_choice && !test.is("and") && !test.is("or") && !test.is("xor")) {
      return std::nullopt;
    }
    const std::optional<bool> a = decided(test.operands[0]);
    if (is_choice && a) {
      return decided(test.operands[*a ? 1 : 2]);
    }
    const std::optional<bool> b = decided(test.operands[1]);
    if (is_choice) {
      return b == decided(test.operands[2]) ? b : std::nullopt;
    }
    if (test.is("xor")) {
      return a && b ? std::optional(*a != *b) : std::nullopt;
    }
    const bool is_and = test.is("and");
    if ((a && *a != is_and) || (b && *b != is_and)) {
      return !is_and;
    }
    return a && b ? std::optional(is_and) : std::nullopt;
  }

  /// Behind conversions, and behind what is done for values that are no numbers.
  [[nodiscard]] int plain(int place) const {
    for (;;) {
      const ListedOperation& now = operation(place);
      if (now.is("fpext") || now.is("fptrunc")) {
        place = now.operands[0];
        continue;
      }
      const std::optional<bool> known =
          now.is("select") && now.format.is_float ? of_numbers(now.operands[0]) : std::nullopt;
      if (!known) {
        return place;
      }
      place = now.operands[*known ? 1 : 2];
    }
  }

  /// The same behind what is exact alone: a number that is rounded before it is compared turns elsewhere.
  [[nodiscard]] int unrounded(int place) const {
    for (;;) {
      const ListedOperation& now = operation(place);
      const std::optional<bool> known =
          now.is("select") && now.format.is_float ? of_numbers(now.operands[0]) : std::nullopt;
      if (!now.is("fpext") && !known) {
        return place;
      }
      place = now.operands[now.is("fpext") ? 0 : *known ? 1 : 2];
    }
  }

  [[nodiscard]] bool is_same(int a, int b) const {
    const ListedOperation& x = operation(unrounded(a));
    const ListedOperation& y = operation(unrounded(b));
    return unrounded(a) == unrounded(b) || (x.is_number() && y.is_number() && x.number == y.number);
  }

  /// Whether both branches of a choice are the same number where the two that are compared are.
  [[nodiscard]] bool meets(int yes, int no, const ListedOperation& test) const {
    const int first = test.operands[0];
    const int second = test.operands[1];
    const auto at_the_turn = [&](int branch) { return value_at_turn(branch, first, second); };
    const std::optional<int> a = at_the_turn(yes);
    const std::optional<int> b = at_the_turn(no);
    if (a && b) {
      return true;
    }
    // x and -x meet at 0.
    const auto is_minus = [&](int x, int y) {
      const ListedOperation& negated = operation(unrounded(x));
      return negated.is("fneg") && is_same(negated.operands[0], y);
    };
    const ListedOperation& left = operation(unrounded(first));
    const ListedOperation& right = operation(unrounded(second));
    const bool compares_with_0 =
        (left.is_number() && left.number == 0.0) || (right.is_number() && right.number == 0.0);
    const int other = left.is_number() ? second : first;
    return compares_with_0 &&
           ((is_same(yes, other) && is_minus(no, other)) || (is_same(no, other) && is_minus(yes, other)));
  }

  /// A branch that is one of the two compared where these are equal: itself, or a choice with a limit that
  /// does not act there.
  [[nodiscard]] std::optional<int> value_at_turn(int branch, int first, int second) const {
    if (is_same(branch, first) || is_same(branch, second)) {
      return unrounded(branch);
    }
    const ListedOperation& inner = operation(unrounded(branch));
    if (!inner.is("select") || !operation(inner.operands[0]).is("fcmp")) {
      return std::nullopt;
    }
    const ListedOperation& test = operation(inner.operands[0]);
    const bool first_is_number = operation(unrounded(first)).is_number();
    const int limited = first_is_number ? second : first;
    const ListedOperation& there = operation(unrounded(first_is_number ? first : second));
    if (!there.is_number() || !is_order(test.predicate)) {
      return std::nullopt;
    }
    const auto number = [&](int place) -> std::optional<double> {
      const ListedOperation& x = is_same(place, limited) ? there : operation(unrounded(place));
      return x.is_number() ? std::optional(x.number) : std::nullopt;
    };
    const std::optional<double> a = number(test.operands[0]);
    const std::optional<double> b = number(test.operands[1]);
    if (!a || !b || !(*a < *b || *b < *a)) {
      return std::nullopt;
    }
    const int taken = inner.operands[is_true(test.predicate, *a < *b) ? 1 : 2];
    return is_same(taken, limited) ? std::optional(unrounded(taken)) : std::nullopt;
  }

  const CodeListing* listing_;
  const ListedAngles* angles_;
  std::map<int, Register> known_;
  std::map<int, Ball> limits_;
};

}  // namespace

std::optional<std::vector<Ball>> listing_rounding(const CodeListing& listing, const ListedAngles& angles,
                                                  const std::vector<Ball>& states, const Ball& sample) {
  return StepErrors(listing, angles, states, sample).all();
}

}  // namespace veritrack::checker
