// Functions with kinks and jumps in a frame: docs/gain-proof.md, section 2.
#include "checker/model/gain/linear_frame.hpp"

#include <functional>
#include <string>
#include <utility>

namespace veritrack::checker {

namespace {

/// The excess of a deviation of at most `bound` over `distance`.
Ball beyond(const Ball& bound, const Ball& distance) {
  return max(zero, bound - distance);
}

}  // namespace

/// A listed steady state is one up to rounding: so near a kink the other side might be meant.
void LinearFrame::note_distance(const Ball& distance) {
  may_rest_at_kink_ = may_rest_at_kink_ || !certainly_less(Ball(0x1p-20), distance);
}

int LinearFrame::larger(int x, int y) {
  require_plain(at(x));
  require_plain(at(y));
  const int above = difference(x, y);
  const Ball b = base(at(above));
  const bool is_first = certainly_positive(b);
  const bool is_second = certainly_positive(-b);
  if (at(above).deviations.empty() && (is_first || is_second)) {
    return is_first ? x : y;
  }
  return made("larger " + std::to_string(x) + " " + std::to_string(y), [&] {
    LinearValue result = at(is_first ? x : y);
    std::function<Ball(const std::vector<Ball>&)> size;
    if (is_first || is_second) {
      note_distance(abs(b));
      size = [distance = abs(b)](const std::vector<Ball>& bounds) { return beyond(bounds.at(0), distance); };
    } else {
      // Half the sum, and half of |x - y|.
      may_rest_at_kink_ = true;
      const LinearValue operand = at(above);
      result.constant += half * operand.constant;
      result.per_frequency += half * operand.per_frequency;
      add_deviations(result, operand, half);
      size = [b](const std::vector<Ball>& bounds) { return half * (abs(b) + bounds.at(0)); };
    }
    const std::size_t source = add_input({nullptr, {above}, std::move(size)});
    result.deviations[source] = {one, zero};
    return result;
  });
}

int LinearFrame::clamped(int x, int low, int high) {
  for (const int each : {x, low, high}) {
    require_plain(at(each));
  }
  const int below = difference(low, x);
  const int above = difference(x, high);
  const Ball b = base(at(below));
  const Ball a = base(at(above));
  const bool is_inside = certainly_positive(-b) && certainly_positive(-a);
  if (is_inside && at(x).deviations.empty() && at(low).deviations.empty() && at(high).deviations.empty()) {
    return x;
  }
  if (is_inside) {
    const int result = made("inside " + std::to_string(below) + " " + std::to_string(above), [&] {
      LinearValue value = at(x);
      note_distance(-a);
      note_distance(-b);
      const std::size_t source = add_input({nullptr, {below, above}, [a, b](const std::vector<Ball>& bounds) {
                                              return max(beyond(bounds.at(0), -b), beyond(bounds.at(1), -a));
                                            }});
      value.deviations[source] = {one, zero};
      return value;
    });
    return result;
  }
  if (!at(low).is_constant() || !at(high).is_constant() ||
      !certainly_at_most(at(low).constant, at(high).constant)) {
    throw NotCovered("the limits of a clamp that acts are not constant, or not in order");
  }
  return negated(larger(negated(larger(x, low)), negated(high)));
}

int LinearFrame::certain_sign(int x) {
  require_plain(at(x));
  const Ball b = base(at(x));
  const bool is_positive = certainly_positive(b);
  if (!is_positive && !certainly_positive(-b)) {
    throw NotCovered("the steady state is where a condition or a sign changes");
  }
  if (!at(x).deviations.empty()) {
    note_distance(abs(b));
    // 2^64 is no limit.
    limit(x, is_positive ? zero : -Ball(0x1p64), is_positive ? Ball(0x1p64) : zero);
  }
  return is_positive ? 1 : -1;
}

}  // namespace veritrack::checker
