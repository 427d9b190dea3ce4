#include "analysis/kkl_observer/kkl_bounded_errors.hpp"

namespace veritrack::kkl_observer {

using rigor::Interval;

BoundedErrors::BoundedErrors(const KklRobustnessQuestion& question, const BoundedDisturbance& disturbance,
                             const Filters& transient)
    : map_(question.range.lambda),
      norm_(map_.lambda(), kCells),
      lowest_amplitude_(question.amplitude.lower()),
      highest_amplitude_(question.amplitude.upper()),
      relative_(disturbance.bound / lowest_amplitude_),
      transient_(transient),
      rows_{map_.pseudoinverse_1(), map_.pseudoinverse_2(), map_.basis()[0], map_.basis()[1]} {
  const Interval largest_s = square(question.range.frequency);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    row_norms_[j] = norm_.upper_bound(rows_[j]);
    Filters driven;
    for (std::size_t i = 0; i < driven.size(); ++i) {
      driven[i] = rows_[j][i] * square(map_.lambda()[i]);
    }
    driven_norms_[j] = norm_.upper_bound(driven) + row_norms_[j] * Interval(largest_s.upper());
  }
  box_(0) = question.range.frequency;
  box_(1) = turns(0.5);
  box_(2) = Interval(0.0);
  for (std::size_t j = 0; j < 2; ++j) {
    const Interval left = abs(Map::along(transient_, map_.basis()[j]));
    box_(static_cast<Eigen::Index>(3 + j)) = rigor::symmetric((relative_ * row_norms_[2 + j] + left).upper());
  }
}

Interval BoundedErrors::disturbed(const Weights& q, const Interval& s) const {
  const Interval middle_s(rigor::midpoint(s));
  const Interval radius_s(rigor::radius(s));
  Filters coefficients;
  coefficients.fill(Interval(0.0));
  Interval change(0.0);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const Interval middle(rigor::midpoint(q[j]));
    change += Interval(rigor::radius(q[j])) * driven_norms_[j] + radius_s * abs(middle) * row_norms_[j];
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      coefficients[i] += middle * rows_[j][i] * (square(map_.lambda()[i]) + middle_s);
    }
  }
  return relative_ * (norm_.upper_bound(coefficients) + change);
}

Interval BoundedErrors::left_over(const Weights& q, const Map::Signal<Interval>& signal) const {
  Interval sum(0.0);
  for (std::size_t i = 0; i < transient_.size(); ++i) {
    Interval weight(0.0);
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      weight += q[j] * rows_[j][i];
    }
    sum += abs(weight * signal.denominators[i] * transient_[i]);
  }
  return sum;
}

BoundedErrors::Filters BoundedErrors::moves() const {
  Filters u;
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] = rigor::symmetric((relative_ / map_.lambda()[i]).upper()) + transient_[i];
  }
  return u;
}

BoundedErrors::State BoundedErrors::state(const KklSearchBox& box) const {
  State at;
  at.signal = map_.signal(box(0), box(1));
  at.y = {at.signal.projected[0] + box(3), at.signal.projected[1] + box(4)};
  at.norm = Map::squared_norm(at.y);
  at.squared_error = largest({Interval(0.0), Interval(0.0), at.y[0] / at.norm, at.y[1] / at.norm}, at.signal);
  return at;
}

double BoundedErrors::amplitude_error(const KklSearchBox& box) const {
  const State at = state(box);
  const Interval zero(0.0);
  const Interval x3 = at.signal.s + rigor::symmetric(at.squared_error);
  const std::array<Interval, 2> to_x3{at.y[0] / at.norm, at.y[1] / at.norm};
  const Filters u = moves();
  Interval pulled_1(0.0);
  Interval pulled_2(0.0);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Interval filter = at.signal.transformed[i] + u[i];
    pulled_1 += map_.pseudoinverse_1()[i] * filter;
    pulled_2 += map_.pseudoinverse_2()[i] * filter;
  }
  const auto weights = [&](const Interval& first, const Interval& second, const Interval& third) -> Weights {
    return {first, second, -(third * to_x3[0]), -(third * to_x3[1])};
  };
  const Interval one(1.0);
  const Interval k1 = rigor::symmetric(largest(weights(one, zero, pulled_1), at.signal));
  const Interval k2 = rigor::symmetric(largest(weights(zero, one, pulled_2), at.signal));
  const Interval x2 = -(at.signal.frequency * at.signal.cosine);
  const Interval from_1 = at.signal.sine + at.signal.sine + k1;
  const Interval from_2 = (x2 + x2 + k2) / x3;
  const Interval from_3 = pulled_1 * from_1 + pulled_2 * from_2 - square(at.signal.cosine) / x3;
  const Weights q = weights(from_1, from_2, from_3);
  const Interval by_disturbance = disturbed(q, at.signal.s);
  const Interval by_start = left_over(q, at.signal);
  // sqrt(1 + t) - 1 is largest in size at the lowest t.
  const Interval root = sqrt(Interval(1.0) - Interval((by_disturbance + by_start).upper()));
  const Interval change =
      (by_disturbance * lowest_amplitude_ + by_start * highest_amplitude_) / (root + Interval(1.0));
  return change.upper();
}

}  // namespace veritrack::kkl_observer
