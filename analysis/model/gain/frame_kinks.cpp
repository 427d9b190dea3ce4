// Functions with kinks and jumps: docs/gain-proof.md, section 2.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::Interval;
using rigor::larger_or_nan;

namespace {

FrameLine plain_line(Frame& frame, const FrameValue& value) {
  FrameLine line = frame.line_of(value);
  if (line.turns != 0 || line.is_modular) {
    throw NoFrame("a function with a kink, or a condition, of an angle or of what depends on the phase");
  }
  return line;
}

/// The excess of a deviation of at most `bound` over `distance`.
double beyond(double bound, double distance) {
  return bound > distance ? rigor::sub_up(bound, distance) : bound <= distance ? 0.0 : bound;
}

/// A proposed steady state is one up to rounding: so near a kink the other side might be meant. The checker
/// is content with half of this.
void note_distance(Frame& frame, double distance) {
  constexpr double kNear = 0x1p-19;
  if (!(distance >= kNear)) {
    FrameRules::rest_at_kink(frame);
  }
}

FrameLine with_remainder(Frame& frame, FrameLine line, const char* what,
                         std::function<double(const std::vector<double>&)> size) {
  FrameRules::add_remainder(frame, line, what, std::move(size));
  return line;
}

/// The one that is larger in the steady state, and a remainder; where that is not certain half of the sum,
/// and half of |a - b|.
FrameLine larger(Frame& frame, const FrameLine& a, const FrameLine& b, const char* what) {
  const FrameLine z = FrameRules::sum_of(a, b, true);
  const Interval middle = FrameRules::base_of(z, frame.band());
  const bool is_first = rigor::certainly_positive(middle);
  const bool is_second = rigor::certainly_negative(middle);
  if (z.is_form_empty() && (is_first || is_second)) {
    return is_first ? a : b;
  }
  const auto form = static_cast<std::size_t>(FrameRules::add_form(frame, z));
  if (is_first || is_second) {
    note_distance(frame, rigor::mignitude(middle));
    return with_remainder(frame, is_first ? a : b, what,
                          [form, distance = rigor::mignitude(middle)](const std::vector<double>& bounds) {
                            return beyond(bounds[form], distance);
                          });
  }
  FrameRules::rest_at_kink(frame);
  const double most = rigor::magnitude(middle);
  if (!(most < INFINITY)) {
    throw NoFrame("a value that is not known");
  }
  return with_remainder(
      frame, FrameRules::sum_of(b, FrameRules::scaled(z, Interval(0.5), std::nullopt), false), what,
      [form, most](const std::vector<double>& bounds) { return 0.5 * rigor::add_up(most, bounds[form]); });
}

FrameLine opposite(const FrameLine& line) {
  return FrameRules::scaled(line, Interval(-1.0), -1.0);
}

FrameLine smaller(Frame& frame, const FrameLine& a, const FrameLine& b, const char* what) {
  return opposite(larger(frame, opposite(a), opposite(b), what));
}

FrameLine inside(Frame& frame, const FrameLine& x, const FrameLine& low, const FrameLine& high) {
  constexpr const char* kWhat = "a clamp";
  const FrameLine below = FrameRules::sum_of(low, x, true);
  const FrameLine above = FrameRules::sum_of(x, high, true);
  const Interval to_low = -FrameRules::base_of(below, frame.band());
  const Interval to_high = -FrameRules::base_of(above, frame.band());
  if (rigor::certainly_positive(to_low) && rigor::certainly_positive(to_high)) {
    if (below.is_form_empty() && above.is_form_empty()) {
      return x;
    }
    note_distance(frame, std::min(to_low.lower(), to_high.lower()));
    const auto first = static_cast<std::size_t>(FrameRules::add_form(frame, below));
    const auto second = static_cast<std::size_t>(FrameRules::add_form(frame, above));
    return with_remainder(
        frame, x, kWhat,
        [first, second, a = to_low.lower(), b = to_high.lower()](const std::vector<double>& bounds) {
          return larger_or_nan(beyond(bounds[first], a), beyond(bounds[second], b));
        });
  }
  if (!low.is_constant() || !high.is_constant() ||
      !rigor::certainly_less_equal(low.constant, high.constant)) {
    throw NoFrame("the limits of a clamp that acts are not constant, or not in order");
  }
  return smaller(frame, larger(frame, x, low, kWhat), high, kWhat);
}

FrameValue named_line(Frame& frame, FrameOperation operation, int first, int second, FrameLine line) {
  return {&frame, FrameRules::named(frame, operation, first, second), std::move(line)};
}

/// 1 or -1: that it stays so is a limit.
int certain_sign(Frame& frame, const FrameLine& line) {
  const Interval middle = FrameRules::base_of(line, frame.band());
  const bool is_positive = rigor::certainly_positive(middle);
  if (!is_positive && !rigor::certainly_negative(middle)) {
    throw NoFrame("the steady state is where a condition or a sign changes");
  }
  if (!line.is_form_empty()) {
    note_distance(frame, rigor::mignitude(middle));
    FrameRules::add_limit(frame, FrameRules::add_form(frame, line), Interval(rigor::mignitude(middle)));
  }
  return is_positive ? 1 : -1;
}

}  // namespace

void FrameRules::rest_at_kink(Frame& frame) {
  frame.may_rest_at_kink_ = true;
}

FrameValue maximum(const FrameValue& a, const FrameValue& b) {
  Frame& frame = FrameRules::frame_of(a, b);
  FrameLine line = larger(frame, plain_line(frame, a), plain_line(frame, b), "max");
  return named_line(frame, FrameOperation::largest, FrameRules::name_of(frame, a),
                    FrameRules::name_of(frame, b), std::move(line));
}

FrameValue minimum(const FrameValue& a, const FrameValue& b) {
  Frame& frame = FrameRules::frame_of(a, b);
  FrameLine line = smaller(frame, plain_line(frame, a), plain_line(frame, b), "min");
  return named_line(frame, FrameOperation::least, FrameRules::name_of(frame, a),
                    FrameRules::name_of(frame, b), std::move(line));
}

FrameValue absolute(const FrameValue& x) {
  Frame& frame = FrameRules::frame_of(x, x);
  const FrameLine line = plain_line(frame, x);
  return named_line(frame, FrameOperation::absolute, FrameRules::name_of(frame, x), -1,
                    larger(frame, line, opposite(line), "abs"));
}

FrameValue clamped(const FrameValue& x, const FrameValue& low, const FrameValue& high) {
  Frame& frame = FrameRules::frame_of(x, low);
  FrameLine line = inside(frame, plain_line(frame, x), plain_line(frame, low), plain_line(frame, high));
  const int limits = FrameRules::named(frame, FrameOperation::limits, FrameRules::name_of(frame, low),
                                       FrameRules::name_of(frame, high));
  return named_line(frame, FrameOperation::clamped, FrameRules::name_of(frame, x), limits, std::move(line));
}

FrameValue chosen(const FrameValue& positive, const FrameValue& a, const FrameValue& b) {
  Frame& frame = FrameRules::frame_of(positive, a);
  return certain_sign(frame, plain_line(frame, positive)) > 0 ? a : b;
}

FrameValue sign_of(const FrameValue& x) {
  Frame& frame = FrameRules::frame_of(x, x);
  const int sign = certain_sign(frame, plain_line(frame, x));
  FrameLine line;
  line.constant = Interval(static_cast<double>(sign));
  return {&frame, FrameRules::name_of(frame, FrameValue(sign)), std::move(line)};
}

}  // namespace veritrack::model
