#include "analysis/model/step/map_bound.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "analysis/model/step/disturbance_split.hpp"
#include "analysis/model/step/vector_parts.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

/// An upper bound of the square of |of_x x + of_v v + of_w w| for |x| <= scale; |v|^2 and |w|^2 are at most
/// `squared_radius`: 1/2 when both are there, 1 otherwise.
double square_of_linear_part(const VectorParts& parts, double scale, double squared_radius) {
  const Eigen::MatrixXd x = at_middle(parts.of_x) * scale * scale;
  const Interval squared_scale = square(Interval(scale));
  if (parts.of_v.empty() && parts.of_w.empty()) {
    return joint_bound({{&parts.of_x, squared_scale}});  // t = 1: nothing is shared
  }
  if (!parts.of_v.empty() && !parts.of_w.empty()) {
    const std::array<double, 3> shares =
        proposed_shares(x, at_middle(parts.of_v) * squared_radius, at_middle(parts.of_w) * squared_radius);
    // For any positive weights (a + b + c)^2 <= (t1 + t2 + t3) (a^2/t1 + b^2/t2 + c^2/t3).
    const Interval sum = Interval(shares[0]) + Interval(shares[1]) + Interval(shares[2]);
    return joint_bound({{&parts.of_x, squared_scale * sum / Interval(shares[0])},
                        {&parts.of_v, Interval(squared_radius) * sum / Interval(shares[1])},
                        {&parts.of_w, Interval(squared_radius) * sum / Interval(shares[2])}});
  }
  const Gram& other = parts.of_v.empty() ? parts.of_w : parts.of_v;
  const double t = proposed_split(x, at_middle(other) * squared_radius);
  return joint_bound({{&parts.of_x, squared_scale / Interval(t)},
                      {&other, Interval(squared_radius) / (Interval(1.0) - Interval(t))}});
}

}  // namespace

std::vector<double> length_bounds(const std::vector<BallModel>& vector, const std::vector<double>& scales,
                                  bool last_alone) {
  constexpr double kNothingKnown = std::numeric_limits<double>::quiet_NaN();
  const VectorParts parts(vector, last_alone);
  std::vector<double> bounds;
  bounds.reserve(scales.size());
  for (const double scale : scales) {
    Interval total = parts.error;
    for (std::size_t degree = 0; degree < parts.norms.size(); ++degree) {
      for (const Interval& norm : parts.norms.at(degree)) {
        total = total + norm * pow(Interval(scale), static_cast<int>(degree));
      }
    }
    const double linear = square_of_linear_part(parts, scale, last_alone ? 0.5 : 1.0);
    if (!std::isfinite(linear) || !rigor::is_finite(total)) {
      bounds.push_back(kNothingKnown);
      continue;
    }
    bounds.push_back((total + sqrt(Interval::from_bounds(0.0, linear))).upper());
  }
  return bounds;
}

WidthShares width_shares(const std::vector<BallModel>& vector) {
  WidthShares shares;
  const auto& classes = vector.front().monomials().classes();
  for (const BallModel& component : vector) {
    for (std::size_t number = 0; number < classes.size(); ++number) {
      shares.by_phase += classes[number].s > 0 ? component.norm(number) : 0.0;
      shares.by_frequency += classes[number].z > 0 ? component.norm(number) : 0.0;
    }
  }
  return shares;
}

}  // namespace veritrack::model
