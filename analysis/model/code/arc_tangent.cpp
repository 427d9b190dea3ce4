#include "analysis/model/code/arc_tangent.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "analysis/model/code/sample_function.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model::code {

namespace {

using rigor::Interval;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;

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
