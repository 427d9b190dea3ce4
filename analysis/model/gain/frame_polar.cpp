// The direction and the length of a vector: docs/gain-proof.md, section 2.
#include <cmath>
#include <functional>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::Interval;
using rigor::larger_or_nan;

namespace {

/// sup |arg(1 + u + i v) - v| over |u| <= along, |v| <= across; infinite where it may be as far as `room`
/// from 0.
double direction_remainder(double along, double across, const Interval& room) {
  if (!(along < 1.0) || !(across < INFINITY)) {
    return INFINITY;
  }
  const Interval u(along);
  const Interval v(across);
  const Interval nearest = Interval(1.0) - u;
  if (!rigor::certainly_less(rigor::atan(v / nearest), room)) {
    return INFINITY;
  }
  // atan(v/(1 - u)) - v grows up to this v, and falls from there on; v - atan(v/(1 + u)) grows.
  const Interval top = sqrt(u * nearest);
  const Interval at = across < top.lower() ? v : top;
  return larger_or_nan((rigor::atan(at / nearest) - at).upper(),
                       (v - rigor::atan(v / (Interval(1.0) + u))).upper());
}

/// A vector in its steady state, and what deviates along it and across it, relative to its length.
struct DeviatingVector {
  Interval y, x;
  FrameLine along, across;
};

DeviatingVector deviating_vector(const FrameLine& y, const FrameLine& x, const Interval& band) {
  FrameRules::require_no_turns(y);
  FrameRules::require_no_turns(x);
  DeviatingVector vector{FrameRules::base_of(y, band), FrameRules::base_of(x, band), {}, {}};
  const Interval squares = square(vector.y) + square(vector.x);
  if (!rigor::certainly_less(Interval(0.0), squares)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  const auto part_of = [](const FrameLine& of, const Interval& factor) {
    return FrameRules::scaled(FrameRules::form_of(of), factor, std::nullopt);
  };
  vector.across = FrameRules::sum_of(part_of(y, vector.x / squares), part_of(x, vector.y / squares), true);
  vector.along = FrameRules::sum_of(part_of(x, vector.x / squares), part_of(y, vector.y / squares), false);
  return vector;
}

/// Adds a remainder of this size at the bounds of both.
void add_vector_remainder(Frame& frame, const DeviatingVector& vector, const char* what, FrameLine& line,
                          const std::function<double(double along, double across)>& size) {
  if (vector.along.is_form_empty() && vector.across.is_form_empty()) {
    return;
  }
  const auto u = static_cast<std::size_t>(FrameRules::add_form(frame, vector.along));
  const auto v = static_cast<std::size_t>(FrameRules::add_form(frame, vector.across));
  FrameRules::add_remainder(frame, line, what, [u, v, size](const std::vector<double>& bounds) {
    return size(bounds[u], bounds[v]);
  });
}

}  // namespace

/// atan2(y, x).
FrameLine FrameRules::direction_line(Frame& frame, const FrameLine& y, const FrameLine& x) {
  const DeviatingVector vector = deviating_vector(y, x, frame.band_);
  FrameLine line = vector.across;
  line.constant = rigor::atan2(vector.y, vector.x);
  if (!rigor::is_finite(line.constant)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  const Interval room = rigor::pi() - Interval(rigor::magnitude(line.constant));
  add_vector_remainder(frame, vector, "atan2", line, [room](double along, double across) {
    return direction_remainder(along, across, room);
  });
  return line;
}

/// The length L |1 + u + i v| of a vector near the positive x axis, with L = x + (L - x) in the steady state.
FrameLine FrameRules::length_line(Frame& frame, const FrameLine& y, const FrameLine& x) {
  const DeviatingVector vector = deviating_vector(y, x, frame.band_);
  const Interval whole = sqrt(square(vector.y) + square(vector.x));
  if (!rigor::certainly_less(Interval(0.0), vector.x)) {
    throw NoFrame("a vector that may be turned back");
  }
  FrameLine line = scaled(vector.along, whole, std::nullopt);
  // L - x, without the width that both have in common.
  const double excess = (square(vector.y) / (Interval(2.0) * Interval(vector.x.lower()))).upper();
  line.constant = x.constant + Interval::from_bounds(0.0, excess);
  line.per_frequency = x.per_frequency;
  add_vector_remainder(frame, vector, "the length of a vector", line,
                       [largest = whole.upper()](double along, double across) {
                         const Interval nearest = Interval(1.0) - Interval(along);
                         const Interval length = sqrt(square(nearest) + square(Interval(across)));
                         return rigor::mul_up(largest, (length - nearest).upper());
                       });
  return line;
}

}  // namespace veritrack::model
