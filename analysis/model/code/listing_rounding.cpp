#include "analysis/model/code/listing_rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "analysis/model/code/turned_sample.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model::code {

namespace {

using rigor::Interval;
using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The exact value, and a bound on what the computed one is off.
struct Computed {
  Interval exact;
  double error = kInfinity;
};

/// The smallest normal number: what may be flushed.
double smallest(Format format) {
  return format.bits == 32 ? 0x1p-126 : 0x1p-1022;
}
double largest(Format format) {
  return format.bits == 32 ? 0x1p127 : 0x1p1023;
}

/// Both the exact value and the computed one.
Interval around(const Computed& value) {
  return value.exact + Interval::from_bounds(-value.error, value.error);
}

class Evaluation {
 public:
  Evaluation(const Listing& listing, const StepRanges& ranges)
      : listing_(&listing), ranges_(&ranges), turns_(listing) {
    for (std::size_t i = 0; i < listing.states.size(); ++i) {
      known_[listing.states[i].input] = {ranges.states.at(i), 0.0};
    }
    for (const int sample : listing.samples) {
      known_[sample] = {ranges.sample, 0.0};
    }
    if (ranges.facts != nullptr) {
      know(*ranges.facts);
    }
  }

  [[nodiscard]] std::optional<StepRounding> all() {
    StepRounding result;
    if (ranges_->facts != nullptr) {
      for (const auto& [low, high] : ranges_->facts->ordered) {
        if (!rigor::certainly_less(around(value(low)), around(value(high)))) {
          return std::nullopt;
        }
      }
    }
    for (const trackers::code::State& state : listing_->states) {
      const double error =
          turns_.is_wrapped(state.next) ? wrapped(state.next).error : value(state.next).error;
      // A start is rounded, too.
      const Computed stored = rounded(at(state.input).format, known_.at(state.input).exact, 0.0);
      result.next.push_back(std::max(error, stored.error));
    }
    result.frequency = value(listing_->frequency).error;
    const bool is_known =
        std::isfinite(result.frequency) &&
        std::all_of(result.next.begin(), result.next.end(), [](double e) { return std::isfinite(e); });
    return is_known ? std::optional(std::move(result)) : std::nullopt;
  }

  /// The first operation that has none, though its operands have; -1 for a wrap.
  [[nodiscard]] int without_bound() const { return without_bound_; }

 private:
  [[nodiscard]] const Instruction& at(int value) const {
    return listing_->instructions[static_cast<std::size_t>(value)];
  }

  void know(const WrittenFacts& facts) {
    for (const auto& [place, number] : facts.numbers) {
      known_[place] = {number.exact, std::isfinite(number.value)
                                         ? rigor::magnitude(Interval(number.value) - number.exact)
                                         : kInfinity};
    }
    // Their limits are made of numbers, and need no others.
    for (const RegisterLimit& limit : facts.limits) {
      limits_[limit.value] =
          Interval::from_bounds(value(limit.low).exact.lower(), value(limit.high).exact.upper());
    }
    for (auto& [place, known] : known_) {
      known.exact = limited(place, known.exact);
    }
  }

  /// The exact value, where a limit is proved of it.
  [[nodiscard]] Interval limited(int place, const Interval& exact) const {
    const auto limit = limits_.find(place);
    if (limit == limits_.end()) {
      return exact;
    }
    const double low = std::max(exact.lower(), limit->second.lower());
    const double high = std::min(exact.upper(), limit->second.upper());
    return low <= high ? Interval::from_bounds(low, high) : exact;
  }

  /// The result of an operation that is off by `error` and is then rounded to the format, by `units` of its
  /// roundoff.
  [[nodiscard]] static Computed rounded(Format format, const Interval& exact, double error,
                                        double units = 1.0) {
    const double most = rigor::add_up(rigor::magnitude(exact), error);
    if (!rigor::is_finite(exact) || !(most <= largest(format))) {
      return {exact, kInfinity};
    }
    const double rounding = rigor::mul_up(rigor::mul_up(units, unit_roundoff(format)), most);
    return {exact, rigor::add_up(error, rigor::add_up(rounding, smallest(format)))};
  }

  [[nodiscard]] Computed value(int number) {
    number = listing_plain(number);
    if (const auto found = known_.find(number); found != known_.end()) {
      return found->second;
    }
    Computed result = operation(number);
    result.exact = limited(number, result.exact);
    if (!(result.error >= 0.0) || !rigor::is_finite(result.exact)) {
      result.error = kInfinity;
    }
    if (without_bound_ < 0 && result.error == kInfinity) {
      without_bound_ = number;
    }
    known_[number] = result;
    return result;
  }

  /// Behind tests for values that are no numbers; conversions round.
  [[nodiscard]] int listing_plain(int number) const {
    while (at(number).operation == Operation::select) {
      const std::optional<bool> is_number = turns_.tests_for_numbers(at(number).operands[0]);
      if (!is_number) {
        break;
      }
      number = at(number).operands[*is_number ? 1 : 2];
    }
    return number;
  }

  [[nodiscard]] Computed operation(int number) {
    const Instruction& instruction = at(number);
    const Format format = instruction.format;
    if (!format.is_float) {
      return {};
    }
    if (turns_.is_wrapped(number)) {
      return wrapped(number);
    }
    const auto operand = [&](std::size_t i) { return value(instruction.operands[i]); };
    switch (instruction.operation) {
      case Operation::constant: {
        const double constant = trackers::code::number_of(format, instruction.bits);
        return std::isfinite(constant) ? Computed{Interval(constant), 0.0} : Computed{};
      }
      case Operation::fpext:
        return operand(0);
      case Operation::fptrunc:
        return rounded(format, operand(0).exact, operand(0).error);
      case Operation::fneg:
        return {-operand(0).exact, operand(0).error};
      case Operation::fabs:
        return {rigor::abs(operand(0).exact), operand(0).error};
      case Operation::fadd:
        return rounded(format, operand(0).exact + operand(1).exact,
                       rigor::add_up(operand(0).error, operand(1).error));
      case Operation::fsub:
        return rounded(format, operand(0).exact - operand(1).exact,
                       rigor::add_up(operand(0).error, operand(1).error));
      case Operation::fmul:
        return product(instruction);
      case Operation::fdiv:
        return quotient(format, operand(0), operand(1));
      case Operation::fmin:
      case Operation::fmax:
        return of_two(operand(0), operand(1), instruction.operation == Operation::fmin);
      case Operation::select:
        return chosen(instruction);
      default:
        return function(instruction);
    }
  }

  [[nodiscard]] Computed product(const Instruction& instruction) {
    const Computed a = value(instruction.operands[0]);
    const Computed b = value(instruction.operands[1]);
    const Interval exact =
        instruction.operands[0] == instruction.operands[1] ? rigor::square(a.exact) : a.exact * b.exact;
    const double by_b = rigor::mul_up(rigor::magnitude(a.exact), b.error);
    const double by_a = rigor::mul_up(a.error, rigor::add_up(rigor::magnitude(b.exact), b.error));
    return rounded(instruction.format, exact, rigor::add_up(by_a, by_b));
  }

  /// a'/b' - a/b = ((a' - a) - (a/b)(b' - b)) / b'.
  [[nodiscard]] static Computed quotient(Format format, const Computed& a, const Computed& b) {
    const double least = rigor::sub_down(rigor::mignitude(b.exact), b.error);
    if (!(least > 0.0)) {
      return {};
    }
    const Interval exact = a.exact / b.exact;
    const double off = rigor::add_up(a.error, rigor::mul_up(rigor::magnitude(exact), b.error));
    return rounded(format, exact, rigor::div_up(off, least));
  }

  /// The smaller, or the larger: exact, and no more off than both.
  [[nodiscard]] static Computed of_two(const Computed& a, const Computed& b, bool is_smaller) {
    const Interval exact = is_smaller ? Interval::from_bounds(std::min(a.exact.lower(), b.exact.lower()),
                                                              std::min(a.exact.upper(), b.exact.upper()))
                                      : Interval::from_bounds(std::max(a.exact.lower(), b.exact.lower()),
                                                              std::max(a.exact.upper(), b.exact.upper()));
    return {exact, std::max(a.error, b.error)};
  }

  /// A wrapped value: its base, less whole turns.
  [[nodiscard]] Computed wrapped(int number) {
    const int base = turns_.without_turns(number);
    const Computed before = value(base);
    const auto known = ranges_->bases.find(base);
    if (known == ranges_->bases.end() && ranges_->facts == nullptr) {
      return {};
    }
    const Range range =
        known != ranges_->bases.end() ? known->second : Range{before.exact.lower(), before.exact.upper()};
    const auto shifts = turns_.shifts(number, base, range);
    const auto reached = shifts ? turns_.range(number, base, range) : std::nullopt;
    // Ranges of bases hold with that slack.
    if (!reached || !(before.error <= kWrapSlack)) {
      return {};
    }
    const double most = rigor::add_up(std::max({std::fabs(range.low), std::fabs(range.high),
                                                std::fabs(reached->low), std::fabs(reached->high)}),
                                      kWrapSlack);
    double error = 0.0;
    for (const Turns::Shift& shift : *shifts) {
      const double count = std::round(shift.by / (2.0 * std::numbers::pi));
      const Interval off = Interval(shift.by) - Interval(2.0 * count) * rigor::pi();
      error = std::max(error, rigor::add_up(rigor::magnitude(off), rigor::mul_up(shift.roundings, most)));
    }
    const Interval exact = Interval::from_bounds(std::max(reached->low, -kMostOfWrapped),
                                                 std::min(reached->high, kMostOfWrapped));
    return {exact, rigor::add_up(before.error, error)};
  }

  /// The branch that is certainly taken, or both where nothing jumps.
  [[nodiscard]] Computed chosen(const Instruction& instruction) {
    const auto& [condition, yes, no] = instruction.operands;
    if (const std::optional<bool> holds = decided(condition)) {
      return value(*holds ? yes : no);
    }
    const Instruction& comparison = at(condition);
    if (comparison.operation != Operation::fcmp) {
      return {};
    }
    const int first = comparison.operands[0];
    const int second = comparison.operands[1];
    const bool is_order = comparison.predicate != Predicate::oeq && comparison.predicate != Predicate::one &&
                          comparison.predicate != Predicate::ueq && comparison.predicate != Predicate::une;
    // Two numbers that are compared and of which one is taken: the same where they are equal, also with
    // limits of the one or the other behind it.
    if (is_order && meets(yes, no, first, second)) {
      const Computed a = value(yes);
      const Computed b = value(no);
      return {hull(a.exact, b.exact), std::max(a.error, b.error)};
    }
    return {};
  }

  /// The register behind what is exact alone: a number that is rounded before it is compared turns elsewhere.
  [[nodiscard]] int unrounded(int number) const {
    while (true) {
      const Instruction& instruction = at(number);
      const std::optional<bool> known =
          instruction.operation == Operation::select && instruction.format.is_float
              ? turns_.tests_for_numbers(instruction.operands[0])
              : std::nullopt;
      if (instruction.operation != Operation::fpext && !known) {
        return number;
      }
      number = instruction.operands[instruction.operation == Operation::fpext ? 0 : *known ? 1 : 2];
    }
  }

  /// Whether the two branches are the same number where the two that are compared are.
  [[nodiscard]] bool meets(int yes, int no, int first, int second) const {
    const auto is = [&](int a, int b) {
      const Instruction& x = at(unrounded(a));
      const Instruction& y = at(unrounded(b));
      return unrounded(a) == unrounded(b) ||
             (x.operation == Operation::constant && y.operation == Operation::constant && x.format.is_float &&
              y.format.is_float &&
              trackers::code::number_of(x.format, x.bits) == trackers::code::number_of(y.format, y.bits));
    };
    if ((is(yes, first) && is(no, second)) || (is(yes, second) && is(no, first))) {
      return true;
    }
    // |x| as x < 0 ? -x : x.
    const auto is_negative_of = [&](int a, int b) {
      const Instruction& x = at(unrounded(a));
      return x.operation == Operation::fneg && is(x.operands[0], b);
    };
    const auto is_zero = [&](int a) {
      const Instruction& x = at(unrounded(a));
      return x.operation == Operation::constant && x.format.is_float &&
             trackers::code::number_of(x.format, x.bits) == 0.0;
    };
    const int other = is_zero(second) ? first : is_zero(first) ? second : -1;
    if (other >= 0 &&
        ((is(yes, other) && is_negative_of(no, other)) || (is(no, other) && is_negative_of(yes, other)))) {
      return true;
    }
    // A limit on one side: x > high ? high : (x < low ? low : x).
    for (const auto& [taken, rest] : {std::pair(yes, no), std::pair(no, yes)}) {
      const Instruction& inner = at(unrounded(rest));
      const bool takes_limit = is(taken, first) || is(taken, second);
      const int limited = is(taken, first) ? second : first;
      if (takes_limit && inner.operation == Operation::select &&
          at(inner.operands[0]).operation == Operation::fcmp) {
        const auto& [condition, a, b] = inner.operands;
        const bool is_of_same = is(a, limited) || is(b, limited);
        const int low = is(a, limited) ? b : a;
        const Instruction& limit = at(unrounded(low));
        const Instruction& high = at(unrounded(taken));
        // Where x is the first limit, the inner one does not act: they are different constants, in order.
        if (is_of_same && limit.operation == Operation::constant && high.operation == Operation::constant &&
            inner_is_idle_at(inner, limited, high)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Whether an inner choice is `limited` itself where that is the number `there`.
  [[nodiscard]] bool inner_is_idle_at(const Instruction& inner, int limited, const Instruction& there) const {
    const Instruction& comparison = at(inner.operands[0]);
    const auto number = [&](int value) -> std::optional<double> {
      const int behind = unrounded(value);
      const Instruction& x = behind == unrounded(limited) ? there : at(behind);
      return x.operation == Operation::constant && x.format.is_float
                 ? std::optional(trackers::code::number_of(x.format, x.bits))
                 : std::nullopt;
    };
    const std::optional<double> a = number(comparison.operands[0]);
    const std::optional<double> b = number(comparison.operands[1]);
    if (!a || !b || *a == *b) {
      return false;
    }
    const std::optional<bool> holds = order(comparison.predicate, *a < *b);
    return holds && unrounded(inner.operands[*holds ? 1 : 2]) == unrounded(limited);
  }

  /// What a comparison is when the first number is certainly smaller, or certainly larger.
  [[nodiscard]] static std::optional<bool> order(Predicate predicate, bool is_less) {
    switch (predicate) {
      case Predicate::olt:
      case Predicate::ole:
      case Predicate::ult:
      case Predicate::ule:
        return is_less;
      case Predicate::ogt:
      case Predicate::oge:
      case Predicate::ugt:
      case Predicate::uge:
        return !is_less;
      case Predicate::one:
      case Predicate::une:
        return true;
      case Predicate::oeq:
      case Predicate::ueq:
        return false;
      default:
        return std::nullopt;
    }
  }

  /// What a condition certainly is, of the exact values and of the computed ones.
  [[nodiscard]] std::optional<bool> decided(int condition) {
    if (const std::optional<bool> is_number = turns_.tests_for_numbers(condition)) {
      return is_number;
    }
    const Instruction& instruction = at(condition);
    const auto& [a, b, c] = instruction.operands;
    if (instruction.operation == Operation::constant) {
      return instruction.bits != 0;
    }
    if (instruction.operation == Operation::select) {
      if (const std::optional<bool> takes_first = decided(a)) {
        return decided(*takes_first ? b : c);
      }
      const std::optional<bool> first = decided(b);
      return first == decided(c) ? first : std::nullopt;
    }
    if (instruction.operation == Operation::fcmp) {
      const Interval first = around(value(a));
      const Interval second = around(value(b));
      if (rigor::certainly_less(first, second)) {
        return order(instruction.predicate, true);
      }
      return rigor::certainly_less(second, first) ? order(instruction.predicate, false) : std::nullopt;
    }
    const bool is_and = instruction.operation == Operation::bit_and;
    if (is_and || instruction.operation == Operation::bit_or) {
      const std::optional<bool> first = decided(a);
      const std::optional<bool> second = decided(b);
      if ((first && *first != is_and) || (second && *second != is_and)) {
        return !is_and;
      }
      return first && second ? std::optional(is_and) : std::nullopt;
    }
    if (instruction.operation == Operation::bit_xor) {
      const std::optional<bool> first = decided(a);
      const std::optional<bool> second = decided(b);
      return first && second ? std::optional(*first != *second) : std::nullopt;
    }
    return std::nullopt;
  }

  /// Of the sine and the cosine of the library.
  [[nodiscard]] static double error_of_sine(Format format, const Interval& argument) {
    // Its bound was measured there.
    const bool is_measured = format.bits == 32 && rigor::magnitude(argument) <= 8.0;
    return is_measured ? 0x1.8p-24 : 4.0 * unit_roundoff(format);
  }

  [[nodiscard]] Computed function(const Instruction& instruction) {
    constexpr double kTwoPlaces = 4.0;  // units of roundoff in two units in the last place
    const Format format = instruction.format;
    const Computed x = value(instruction.operands[0]);
    const Interval whole = around(x);
    switch (instruction.operation) {
      case Operation::sin:
      case Operation::cos: {
        const auto [sine, cosine] = rigor::sin_cos(x.exact);
        return {instruction.operation == Operation::sin ? sine : cosine,
                rigor::add_up(x.error, error_of_sine(format, whole))};
      }
      case Operation::sqrt: {
        const double least = rigor::sub_down(x.exact.lower(), x.error);
        if (!(least > 0.0)) {
          return {};
        }
        const double root = rigor::sqrt(Interval(least)).lower();
        return rounded(format, rigor::sqrt(x.exact), rigor::div_up(x.error, 2.0 * root));
      }
      case Operation::atan:
        return rounded(format, rigor::atan(x.exact), x.error, kTwoPlaces);
      case Operation::atan2:
        return arc(instruction);
      case Operation::asin:
      case Operation::acos: {
        if (!(rigor::magnitude(whole) < 1.0)) {
          return {};
        }
        const Interval slope = rigor::sqrt(Interval(1.0) - rigor::square(whole));
        const Interval sine = rigor::asin(x.exact);
        const Interval exact =
            instruction.operation == Operation::asin ? sine : rigor::pi() / Interval(2.0) - sine;
        return rounded(format, exact, rigor::div_up(x.error, slope.lower()), kTwoPlaces);
      }
      case Operation::exp:
        return rounded(format, rigor::exp(x.exact), rigor::mul_up(rigor::exp(whole).upper(), x.error),
                       kTwoPlaces);
      case Operation::log:
        return whole.lower() > 0.0
                   ? rounded(format, rigor::log(x.exact), rigor::div_up(x.error, whole.lower()), kTwoPlaces)
                   : Computed{};
      default:
        return {};
    }
  }

  /// Of the exact angle of a sample that is turned back: the recursion of a code has that limit.
  [[nodiscard]] Interval limit_of_arc(int place) const {
    const auto limit = limits_.find(place);
    return limit != limits_.end()      ? limit->second
           : ranges_->facts == nullptr ? Interval::from_bounds(-kMostOfWrapped, kMostOfWrapped)
                                       : Interval::from_bounds(-kInfinity, kInfinity);
  }

  /// The angle of a point turns by no more than asin(off / distance), at most pi/2 times that.
  [[nodiscard]] Computed arc(const Instruction& instruction) {
    constexpr double kTwoPlaces = 4.0;
    const Computed y = value(instruction.operands[0]);
    const Computed x = value(instruction.operands[1]);
    const bool is_near = &instruction == &at(std::max(listing_->near_arc_tangent.value, 0));
    const double most = std::max(rigor::pi().upper(), is_near ? listing_->near_arc_tangent.largest : 0.0);
    const Interval half_turns = Interval::from_bounds(-most, most);
    const int place = static_cast<int>(&instruction - listing_->instructions.data());
    const Interval limit = limit_of_arc(place);
    const auto turn = std::isfinite(y.error) && std::isfinite(x.error)
                          ? turned_back_by(*listing_, instruction)
                          : std::nullopt;
    // Away from half a turn, where it jumps.
    if (turn && rigor::magnitude(limit) <= kMostOfWrapped) {
      const Computed t = value(*turn);
      const double error = error_of_turned_sample(
          instruction.format, t.error, error_of_sine(instruction.format, around(t)), ranges_->least_sample);
      constexpr double kNearest = 1e-3;
      return error < kNearest ? rounded(instruction.format, limit, error, kTwoPlaces) : Computed{};
    }
    if (y.error == 0.0 && x.error == 0.0) {
      return rounded(instruction.format, half_turns, 0.0, kTwoPlaces);
    }
    const double off = rigor::add_up(y.error, x.error);
    const double least = rigor::sub_down(rigor::sqrt(rigor::square(Interval(rigor::mignitude(y.exact))) +
                                                     rigor::square(Interval(rigor::mignitude(x.exact))))
                                             .lower(),
                                         off);
    // At the half turn it jumps, unless the point stays on one side of it.
    const bool is_away = around(x).lower() > 0.0;
    if (!(least > 0.0) || !is_away) {
      return {};
    }
    return rounded(instruction.format, half_turns, rigor::mul_up(2.0, rigor::div_up(off, least)), kTwoPlaces);
  }

  const Listing* listing_;
  const StepRanges* ranges_;
  Turns turns_;
  std::map<int, Computed> known_;
  std::map<int, Interval> limits_;
  int without_bound_ = -1;
};

}  // namespace

std::optional<StepRounding> step_rounding(const Listing& listing, const StepRanges& ranges, int* without) {
  Evaluation evaluation(listing, ranges);
  std::optional<StepRounding> found = evaluation.all();
  if (!found && without != nullptr) {
    *without = evaluation.without_bound();
  }
  return found;
}

}  // namespace veritrack::model::code
