#include "papers/claims/pendulum_horseshoe.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using ByStart = rigor::Dual<Interval, 2>;

constexpr std::size_t kOrder = 10;
constexpr int kSteps = 72;

template <typename Number>
struct Motion {
  Number angle, rate;
};

/// Taylor coefficients in time, up to kOrder + 1, of the motion through a state: x' = y, y' = -b y - sin x.
template <typename Number>
std::array<Motion<Number>, kOrder + 2> taylor_coefficients(const Motion<Number>& at,
                                                           const Interval& damping) {
  std::array<Motion<Number>, kOrder + 2> result;
  std::array<Number, kOrder + 2> sine;
  std::array<Number, kOrder + 2> cosine;
  result[0] = at;
  const auto [first_sine, first_cosine] = sin_cos(at.angle);
  sine[0] = first_sine;
  cosine[0] = first_cosine;
  for (std::size_t k = 0; k <= kOrder; ++k) {
    const Number next(static_cast<double>(k + 1));
    result[k + 1] = {result[k].rate / next, (-(Number(damping) * result[k].rate) - sine[k]) / next};
    Number sine_sum(0.0);
    Number cosine_sum(0.0);
    for (std::size_t j = 1; j <= k + 1; ++j) {
      const Number weighted = Number(static_cast<double>(j)) * result[j].angle;
      sine_sum += weighted * cosine[k + 1 - j];
      cosine_sum += weighted * sine[k + 1 - j];
    }
    sine[k + 1] = sine_sum / next;
    cosine[k + 1] = -(cosine_sum / next);
  }
  return result;
}

Interval symmetric_interval(const Interval& size) {
  return hull(-size, size);
}

/// Where a motion from `at` is at any time of a step: |y| grows by at most 1 a unit of time, since damping
/// only takes from it.
Motion<Interval> a_priori(const Motion<Interval>& at, const Interval& damping, const Interval& step) {
  const Interval rate = abs(at.rate) + step;
  return {at.angle + symmetric_interval(step * rate),
          at.rate + symmetric_interval(step * (damping * rate + Interval(1.0)))};
}

/// A set of states: middle + (the matrix) (deviation of a and c), and a box that holds it.
struct StateSet {
  Motion<Interval> middle, box;
  std::array<std::array<Interval, 2>, 2> matrix;  ///< derivatives by a and c, over the set
};

/// The values of the series, with the remainder's coefficient.
template <typename Part>
Interval series_sum(const Part& coefficient, const Interval& remainder, const Interval& step) {
  Interval sum = remainder;
  for (std::size_t k = kOrder + 1; k-- > 0;) {
    sum = sum * step + coefficient(k);
  }
  return sum;
}

StateSet step_of(const StateSet& set, const std::array<Interval, 2>& deviation, const Interval& damping,
                 const Interval& step) {
  StateSet next;
  const auto middle = taylor_coefficients(set.middle, damping);
  const auto middle_rest = taylor_coefficients(a_priori(set.middle, damping, step), damping)[kOrder + 1];
  next.middle = {series_sum([&](std::size_t k) { return middle.at(k).angle; }, middle_rest.angle, step),
                 series_sum([&](std::size_t k) { return middle.at(k).rate; }, middle_rest.rate, step)};
  const Interval zero(0.0);
  const Interval one(1.0);
  const auto over = taylor_coefficients(
      Motion<ByStart>{ByStart(set.box.angle, {one, zero}), ByStart(set.box.rate, {zero, one})}, damping);
  // The derivative by the start differs from the unit matrix by at most e^(L t) - 1, L = 1 + b the norm of
  // the linearisation (the largest row sum).
  const Motion<Interval> during = a_priori(set.box, damping, step);
  const Interval moved = symmetric_interval(rigor::exp((one + damping) * step) - one);
  const auto rest = taylor_coefficients(Motion<ByStart>{ByStart(during.angle, {one + moved, moved}),
                                                        ByStart(during.rate, {moved, one + moved})},
                                        damping)[kOrder + 1];
  std::array<std::array<Interval, 2>, 2> slope;
  for (int by = 0; by < 2; ++by) {
    const auto column = static_cast<std::size_t>(by);
    slope[0].at(column) = series_sum([&](std::size_t k) { return over.at(k).angle.derivative(by); },
                                     rest.angle.derivative(by), step);
    slope[1].at(column) = series_sum([&](std::size_t k) { return over.at(k).rate.derivative(by); },
                                     rest.rate.derivative(by), step);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      next.matrix.at(i).at(j) = slope.at(i)[0] * set.matrix[0].at(j) + slope.at(i)[1] * set.matrix[1].at(j);
    }
  }
  const auto spread = [&](std::size_t i) {
    return next.matrix.at(i)[0] * deviation[0] + next.matrix.at(i)[1] * deviation[1];
  };
  next.box = {next.middle.angle + spread(0), next.middle.rate + spread(1)};
  return next;
}

/// (a, c) of states in the frame, moved to another centre.
struct Coordinates {
  Interval a, c;
};

/// Looks at the images of a part: halves what is undecided, to a depth.
class Crossing {
 public:
  Crossing(const PendulumPart& part, bool is_mirrored, long& boxes)
      : part_(part), is_mirrored_(is_mirrored), boxes_(&boxes) {}

  [[nodiscard]] bool holds() const {
    const Interval height = symmetric_interval(parse_decimal(part_.height));
    return is_left(Interval(part_.left), height) && is_right(Interval(part_.right), height) &&
           is_inside_or_beside(Interval::from_bounds(part_.left, part_.right), height);
  }

 private:
  static constexpr double kHalfWidth = 0.25;

  [[nodiscard]] Coordinates image(const Interval& a, const Interval& c) const {
    ++*boxes_;
    const PendulumFrame frame = pendulum_frame();
    const PendulumBox at = image_of_states(a, c);
    const Interval angle =
        is_mirrored_ ? at.angle + frame.angle - Interval(4.0) * rigor::pi() : at.angle - frame.angle;
    const Interval rate = is_mirrored_ ? at.rate + frame.rate : at.rate - frame.rate;
    const Interval determinant = frame.u_angle * frame.s_rate - frame.u_rate * frame.s_angle;
    return {(angle * frame.s_rate - rate * frame.s_angle) / determinant,
            (frame.u_angle * rate - frame.u_rate * angle) / determinant};
  }

  struct Part {
    Interval a, c;
    int halvings_left;
  };

  static std::array<Part, 2> halves_of(const Part& part) {
    // The image is stretched by a, some twenty times as much as by c.
    const bool by_a = 20.0 * width(part.a) > width(part.c);
    const Interval& whole = by_a ? part.a : part.c;
    const double middle = midpoint(whole);
    const auto with = [&](const Interval& half) -> Part {
      return by_a ? Part{half, part.c, part.halvings_left - 1} : Part{part.a, half, part.halvings_left - 1};
    };
    return {with(Interval::from_bounds(whole.lower(), middle)),
            with(Interval::from_bounds(middle, whole.upper()))};
  }

  /// Is it so of the image, or of those of both halves?
  template <typename Holds>
  [[nodiscard]] bool holds_for(const Interval& a, const Interval& c, const Holds& holds) const {
    constexpr int kDepth = 14;
    constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();
    const auto look = [&](const Part& part) -> search::CellDecision<Part> {
      if (holds(image(part.a, part.c))) {
        return {true};
      }
      if (part.halvings_left == 0) {
        return {};
      }
      return {false, halves_of(part)};
    };
    return search::cover_by_bisection(Part{a, c, kDepth}, kUnlimited, look).is_proved;
  }

  [[nodiscard]] bool is_left(const Interval& a, const Interval& c) const {
    return holds_for(a, c, [](const Coordinates& at) { return certainly_less(at.a, Interval(-kHalfWidth)); });
  }
  [[nodiscard]] bool is_right(const Interval& a, const Interval& c) const {
    return holds_for(a, c, [](const Coordinates& at) { return certainly_less(Interval(kHalfWidth), at.a); });
  }
  [[nodiscard]] bool is_inside_or_beside(const Interval& a, const Interval& c) const {
    // Below the height as it is parsed: its lower end.
    const Interval height(parse_decimal(part_.height).lower());
    return holds_for(a, c, [&](const Coordinates& at) {
      return certainly_less(at.a, Interval(-kHalfWidth)) || certainly_less(Interval(kHalfWidth), at.a) ||
             certainly_less(abs(at.c), height);
    });
  }

  PendulumPart part_;
  bool is_mirrored_;
  long* boxes_;
};

}  // namespace

PendulumFrame pendulum_frame() {
  return {parse_decimal("4.4375"), parse_decimal("-1.4351"), parse_decimal("0.8971"),
          parse_decimal("0.4419"), parse_decimal("0.7345"),  parse_decimal("-0.6786")};
}

PendulumBox image_of_states(const Interval& a, const Interval& c) {
  const PendulumFrame frame = pendulum_frame();
  const Interval damping = parse_decimal("0.2");
  const Interval step = parse_decimal("4.32") / Interval(kSteps);
  const Interval a_middle(midpoint(a));
  const Interval c_middle(midpoint(c));
  const std::array<Interval, 2> deviation{a - a_middle, c - c_middle};
  const auto state = [&](const Interval& along, const Interval& across) {
    return Motion<Interval>{frame.angle + along * frame.u_angle + across * frame.s_angle,
                            frame.rate + along * frame.u_rate + across * frame.s_rate};
  };
  StateSet set{state(a_middle, c_middle),
               state(a, c),
               {{{frame.u_angle, frame.s_angle}, {frame.u_rate, frame.s_rate}}}};
  for (int k = 0; k < kSteps; ++k) {
    set = step_of(set, deviation, damping, step);
  }
  return {set.box.angle + rigor::pi(), set.box.rate};
}

Verdict crosses(const PendulumPart& part, bool is_mirrored, long* boxes) {
  long count = 0;
  const bool holds = Crossing(part, is_mirrored, count).holds();
  if (boxes != nullptr) {
    *boxes += count;
  }
  return holds ? Verdict::proved : Verdict::undecided;
}

Verdict has_horseshoe(long* boxes) {
  return rigor::conjunction({crosses({-0.04, 0.04}, false, boxes), crosses({0.1, 0.22}, true, boxes)});
}

}  // namespace veritrack::theorems
