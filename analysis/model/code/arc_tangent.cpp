#include "analysis/model/code/arc_tangent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "analysis/model/code/turns.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model::code {

namespace {

using rigor::Interval;
using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

constexpr double kLargestScale = 0x1p40;

double power_of_scale(int degree) {
  return std::pow(kLargestScale, std::abs(degree));  // exact
}

/// What a register is for samples s x and s y: s^degree times a number of `range`, for all scales s from
/// 2^-40 to 2^40. A constant has any degree, where a share of it may be as large as the scale makes it.
struct Scaled {
  bool is_known = false;
  int degree = 0;
  Interval range;
  bool is_constant = false;
};

/// Of a condition: whether it may hold, and may not.
struct Truth {
  bool may_hold = true, may_fail = true;
};

/// The registers that one is made of, where these are operations on the samples alone, in their order.
class SampleFunction {
 public:
  SampleFunction(const Listing& listing, int value) : listing_(&listing) {
    std::set<int> needed{value};
    for (auto place = needed.rbegin(); place != needed.rend(); ++place) {
      const Instruction& instruction = at(*place);
      const std::set<int> before(instruction.operands.begin(), instruction.operands.end());
      std::copy_if(before.begin(), before.end(), std::inserter(needed, needed.end()),
                   [](int operand) { return operand >= 0; });
    }
    order_.assign(needed.begin(), needed.end());
  }

  /// The value of the register, and so much of it as the scale leaves open. Nothing where no bound is known.
  [[nodiscard]] std::optional<Interval> value(const Interval& x, const Interval& y) {
    scaled_.assign(listing_->instructions.size(), {});
    truths_.assign(listing_->instructions.size(), {});
    scaled_[index(listing_->samples[0])] = {true, 1, x, false};
    scaled_[index(listing_->samples[1])] = {true, 1, y, false};
    for (const int place : order_) {
      const Instruction& instruction = at(place);
      if (std::find(listing_->samples.begin(), listing_->samples.end(), place) != listing_->samples.end()) {
        continue;
      }
      if (instruction.format.is_float) {
        Scaled found = operation(instruction);
        found.is_known = found.is_known && rigor::is_finite(found.range);
        scaled_[index(place)] = found;
      } else {
        truths_[index(place)] = truth(instruction);
      }
    }
    const Scaled& last = scaled_[index(order_.back())];
    return last.is_known && last.degree == 0 ? std::optional(last.range) : std::nullopt;
  }

 private:
  static std::size_t index(int place) { return static_cast<std::size_t>(place); }
  [[nodiscard]] const Instruction& at(int place) const { return listing_->instructions[index(place)]; }

  /// The constant is s^degree times this.
  [[nodiscard]] static Scaled of_degree(const Scaled& value, int degree) {
    if (!value.is_known || value.degree == degree || !value.is_constant) {
      return value.degree == degree ? value : Scaled{};
    }
    const double most = rigor::mul_up(rigor::magnitude(value.range), power_of_scale(degree));
    return {true, degree, Interval::from_bounds(-most, most), true};
  }

  /// Both of the same degree, that of the one that is no constant.
  [[nodiscard]] static std::pair<Scaled, Scaled> alike(const Scaled& a, const Scaled& b) {
    const int degree = a.is_constant ? b.degree : a.degree;
    return {of_degree(a, degree), of_degree(b, degree)};
  }

  [[nodiscard]] static Scaled rounded(Format format, int degree, const Interval& exact, double units = 1.0) {
    const double flushed = format.bits == 32 ? 0x1p-126 : 0x1p-1022;
    const double limit = format.bits == 32 ? 0x1p127 : 0x1p1023;
    const double scale = power_of_scale(degree);
    const double most = rigor::magnitude(exact);
    if (!(rigor::mul_up(most, scale) <= limit)) {
      return {};
    }
    const double off = rigor::add_up(rigor::mul_up(rigor::mul_up(units, unit_roundoff(format)), most),
                                     rigor::mul_up(flushed, scale));
    return {true, degree, exact + Interval::from_bounds(-off, off), false};
  }

  [[nodiscard]] Scaled operation(const Instruction& instruction) const {
    const auto operand = [&](std::size_t i) -> const Scaled& {
      return scaled_[index(instruction.operands[i])];
    };
    if (instruction.operation == Operation::constant) {
      const double number = trackers::code::number_of(instruction.format, instruction.bits);
      return std::isfinite(number) ? Scaled{true, 0, Interval(number), true} : Scaled{};
    }
    if (instruction.operation == Operation::select) {
      return chosen(truths_[index(instruction.operands[0])], operand(1), operand(2));
    }
    if (instruction.operands[0] < 0 || !operand(0).is_known) {
      return {};
    }
    return instruction.operands[1] < 0                          ? of_one(instruction, operand(0))
           : operand(1).is_known && instruction.operands[2] < 0 ? of_two(instruction, operand(0), operand(1))
                                                                : Scaled{};
  }

  [[nodiscard]] static Scaled chosen(const Truth& condition, const Scaled& yes, const Scaled& no) {
    if (!condition.may_fail || !condition.may_hold) {
      return condition.may_hold ? yes : no;
    }
    const auto [a, b] = alike(yes, no);
    return a.is_known && b.is_known
               ? Scaled{true, a.degree, hull(a.range, b.range), a.is_constant && b.is_constant}
               : Scaled{};
  }

  [[nodiscard]] static Scaled of_one(const Instruction& instruction, const Scaled& x) {
    switch (instruction.operation) {
      case Operation::fpext:
        return x;
      case Operation::fptrunc:
        return rounded(instruction.format, x.degree, x.range);
      case Operation::fneg:
        return {true, x.degree, -x.range, x.is_constant};
      case Operation::fabs:
        return {true, x.degree, rigor::abs(x.range), x.is_constant};
      case Operation::sqrt:
        return x.degree % 2 == 0 && x.range.lower() >= 0.0
                   ? rounded(instruction.format, x.degree / 2, rigor::sqrt(x.range))
                   : Scaled{};
      case Operation::atan:
        return x.degree == 0 ? rounded(instruction.format, 0, rigor::atan(x.range), 4.0) : Scaled{};
      default:
        return {};
    }
  }

  [[nodiscard]] static Scaled of_two(const Instruction& instruction, const Scaled& x, const Scaled& y) {
    const auto [a, b] = alike(x, y);
    const bool are_alike = a.is_known && b.is_known;
    const Format format = instruction.format;
    switch (instruction.operation) {
      case Operation::fadd:
        return are_alike ? rounded(format, a.degree, a.range + b.range) : Scaled{};
      case Operation::fsub:
        return are_alike ? rounded(format, a.degree, a.range - b.range) : Scaled{};
      case Operation::fmul: {
        const bool is_square = instruction.operands[0] == instruction.operands[1];
        return rounded(format, x.degree + y.degree, is_square ? rigor::square(x.range) : x.range * y.range);
      }
      case Operation::fdiv:
        return rigor::mignitude(y.range) > 0.0 ? rounded(format, x.degree - y.degree, x.range / y.range)
                                               : Scaled{};
      case Operation::fmin:
      case Operation::fmax: {
        const auto pick = [&](double first, double second) {
          return instruction.operation == Operation::fmin ? std::min(first, second) : std::max(first, second);
        };
        return are_alike ? Scaled{true, a.degree,
                                  Interval::from_bounds(pick(a.range.lower(), b.range.lower()),
                                                        pick(a.range.upper(), b.range.upper())),
                                  a.is_constant && b.is_constant}
                         : Scaled{};
      }
      case Operation::copysign: {
        const Interval size = rigor::abs(x.range);
        return {true, x.degree,
                y.range.lower() > 0.0   ? size
                : y.range.upper() < 0.0 ? -size
                                        : hull(-size, size),
                false};
      }
      default:
        return {};
    }
  }

  [[nodiscard]] Truth truth(const Instruction& instruction) const {
    const auto& [first, second, third] = instruction.operands;
    const auto of = [&](int place) { return truths_[index(place)]; };
    switch (instruction.operation) {
      case Operation::constant:
        return {instruction.bits != 0, instruction.bits == 0};
      case Operation::bit_and:
        return {of(first).may_hold && of(second).may_hold, of(first).may_fail || of(second).may_fail};
      case Operation::bit_or:
        return {of(first).may_hold || of(second).may_hold, of(first).may_fail && of(second).may_fail};
      case Operation::fcmp:
        return compared(instruction.predicate, scaled_[index(first)], scaled_[index(second)]);
      default:
        return {};
    }
  }

  [[nodiscard]] static Truth compared(Predicate predicate, const Scaled& x, const Scaled& y) {
    const auto [a, b] = alike(x, y);
    if (!a.is_known || !b.is_known) {
      return {};
    }
    const bool may_be_less = a.range.lower() < b.range.upper();
    const bool may_be_more = a.range.upper() > b.range.lower();
    const bool may_be_equal = a.range.lower() <= b.range.upper() && a.range.upper() >= b.range.lower();
    switch (predicate) {
      case Predicate::olt:
      case Predicate::ult:
        return {may_be_less, may_be_more || may_be_equal};
      case Predicate::ole:
      case Predicate::ule:
        return {may_be_less || may_be_equal, may_be_more};
      case Predicate::ogt:
      case Predicate::ugt:
        return {may_be_more, may_be_less || may_be_equal};
      case Predicate::oge:
      case Predicate::uge:
        return {may_be_more || may_be_equal, may_be_less};
      case Predicate::oeq:
      case Predicate::ueq:
        return {may_be_equal, may_be_less || may_be_more};
      case Predicate::une:
      case Predicate::one:
        return {may_be_less || may_be_more, may_be_equal};
      case Predicate::ord:
        return {true, false};
      case Predicate::uno:
        return {false, true};
      default:
        return {};
    }
  }

  const Listing* listing_;
  std::vector<int> order_;
  std::vector<Scaled> scaled_;
  std::vector<Truth> truths_;
};

/// A side of the square about 0: the samples there, of which one is 1 or -1, and their angle.
struct Side {
  Interval x, y, angle;
};

Side side(int number, const Interval& t) {
  const Interval arc = rigor::atan(t);
  const Interval quarter = rigor::pi() / Interval(2.0);
  switch (number) {
    case 0:
      return {Interval(1.0), t, arc};
    case 1:
      return {t, Interval(1.0), quarter - arc};
    case 2:
      return {Interval(-1.0), t, rigor::pi() - arc};
    default:
      return {t, Interval(-1.0), arc - quarter};
  }
}

/// The size of an angle modulo whole turns.
double size_of_angle(const Interval& angle) {
  const double turns = std::round(rigor::midpoint(angle) / 6.283185307179586);
  return rigor::magnitude(angle - Interval(2.0 * turns) * rigor::pi());
}

constexpr int kSides = 4;
constexpr double kGrid = 1e-4;   ///< of what is claimed
constexpr double kSpare = 1e-9;  ///< of a decimal and its double

/// Whether the register is certainly nearer than `arc` says, and as small, on all sides.
bool is_proved(SampleFunction& function, const ArcTangent& arc) {
  constexpr int kMostCells = 1'000'000;
  std::vector<std::pair<int, Interval>> open;
  for (int number = 0; number < kSides; ++number) {
    // A sample that is 0 is a case of its own: another that is negative may be anything below it.
    for (const Interval& t :
         {Interval(0.0), Interval::from_bounds(0x1p-900, 1.0), Interval::from_bounds(-1.0, -0x1p-900)}) {
      open.emplace_back(number, t);
    }
  }
  for (int cells = 0; !open.empty(); ++cells) {
    const auto [number, t] = open.back();
    open.pop_back();
    const Side here = side(number, t);
    const std::optional<Interval> value = function.value(here.x, here.y);
    if (value && size_of_angle(*value - here.angle) <= arc.error - kSpare &&
        rigor::magnitude(*value) <= arc.largest - kSpare) {
      continue;
    }
    const double middle = 0.5 * (t.lower() + t.upper());
    if (cells > kMostCells || !(t.lower() < middle && middle < t.upper())) {
      return false;
    }
    open.emplace_back(number, Interval::from_bounds(t.lower(), middle));
    open.emplace_back(number, Interval::from_bounds(middle, t.upper()));
  }
  return true;
}

/// The only register that others know the samples by.
std::optional<int> register_of_samples(const Listing& listing) {
  enum class From { constants, samples, states };
  std::vector<From> from;
  std::set<int> known_by;
  const auto use = [&](int place) {
    if (from[static_cast<std::size_t>(place)] == From::samples) {
      known_by.insert(place);
    }
  };
  for (const Instruction& instruction : listing.instructions) {
    const int place = static_cast<int>(from.size());
    const bool is_sample =
        std::find(listing.samples.begin(), listing.samples.end(), place) != listing.samples.end();
    const bool is_constant = instruction.operation == Operation::constant;
    From all = is_sample ? From::samples : From::constants;
    bool has_operand = false;
    for (const int operand : instruction.operands) {
      if (operand >= 0) {
        has_operand = true;
        all = std::max(all, from[static_cast<std::size_t>(operand)]);
      }
    }
    from.push_back(is_sample || is_constant || has_operand ? all : From::states);
    for (const int operand : instruction.operands) {
      if (operand >= 0 && from.back() == From::states) {
        use(operand);
      }
    }
  }
  for (const trackers::code::State& state : listing.states) {
    use(state.next);
  }
  for (const trackers::code::Obligation& obligation : listing.obligations) {
    use(obligation.must_be_zero);
  }
  return known_by.size() == 1 ? std::optional(*known_by.begin()) : std::nullopt;
}

double next_on_grid(double number) {
  return std::ceil(number / kGrid + 1e-3) * kGrid;
}

}  // namespace

std::optional<ArcTangent> arc_tangent(const Listing& listing) {
  constexpr double kMostError = 0.1;
  constexpr int kTried = 256;
  // Samples in single precision: what is not 0 is then above 2^-900 beside the larger of both.
  const bool has_samples = listing.samples.size() == 2 &&
                           std::all_of(listing.samples.begin(), listing.samples.end(), [&](int sample) {
                             return listing.instructions[static_cast<std::size_t>(sample)].format.bits == 32;
                           });
  const std::optional<int> value = has_samples ? register_of_samples(listing) : std::nullopt;
  const Instruction* last = value ? &listing.instructions[static_cast<std::size_t>(*value)] : nullptr;
  if (last == nullptr || !last->format.is_float || last->operation == Operation::atan2 ||
      last->operation == Operation::input) {
    return std::nullopt;
  }
  SampleFunction function(listing, *value);
  double error = 0.0;
  double largest = 0.0;
  for (int number = 0; number < kSides; ++number) {
    for (int i = -kTried; i <= kTried; ++i) {
      const Side here = side(number, Interval(static_cast<double>(i) / kTried));
      const std::optional<Interval> there = function.value(here.x, here.y);
      error = there ? std::max(error, size_of_angle(*there - here.angle)) : HUGE_VAL;
      largest = there ? std::max(largest, rigor::magnitude(*there)) : HUGE_VAL;
    }
  }
  if (!(error <= kMostError)) {
    return std::nullopt;
  }
  const ArcTangent found{*value, next_on_grid(error + kGrid), next_on_grid(largest + kGrid)};
  return is_proved(function, found) ? std::optional(found) : std::nullopt;
}

Listing with_arc_tangent(Listing listing, const ArcTangent& arc) {
  Instruction& instruction = listing.instructions[static_cast<std::size_t>(arc.value)];
  instruction.operation = Operation::atan2;
  instruction.operands = {listing.samples[1], listing.samples[0], -1};
  listing.near_arc_tangent = {arc.value, arc.largest};
  return listing;
}

}  // namespace veritrack::model::code
