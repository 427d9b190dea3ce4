#include "checker/quadrature/disc_cell.hpp"

#include <algorithm>
#include <cmath>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

namespace {

/// The part of a convex polygon where sign (p_i - bound) <= 0.
std::vector<DiscPoint> cut(const std::vector<DiscPoint>& polygon, std::size_t i, double sign, double bound) {
  std::vector<DiscPoint> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const DiscPoint& here = polygon[k];
    const DiscPoint& next = polygon[(k + 1) % polygon.size()];
    const bool inside = sign * (here[i] - bound) <= 0.0;
    if (inside) {
      kept.push_back(here);
    }
    if (inside != (sign * (next[i] - bound) <= 0.0)) {
      const double share = (bound - here[i]) / (next[i] - here[i]);
      DiscPoint crossing{};
      crossing[i] = bound;
      crossing[1 - i] = here[1 - i] + share * (next[1 - i] - here[1 - i]);
      kept.push_back(crossing);
    }
  }
  return kept;
}

}  // namespace

bool DiscCell::is_outside() const {
  const Ball x(std::clamp(0.0, low[0], high[0]));
  const Ball y(std::clamp(0.0, low[1], high[1]));
  return certainly_less(one, square(x) + square(y));
}

// Cut from a polygon around the disc that is larger than it needs to be by far more than rounding moves its
// corners.
std::vector<DiscPoint> DiscCell::corners() const {
  constexpr int kCorners = 32;
  constexpr double kPi = 3.14159265358979;
  const double radius = (1.0 + 1e-9) / std::cos(kPi / kCorners);
  std::vector<DiscPoint> polygon;
  polygon.reserve(kCorners);
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * kPi * k / kCorners;
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    polygon = cut(cut(polygon, i, -1.0, low[i]), i, 1.0, high[i]);
  }
  return polygon;
}

std::array<DiscCell, 2> DiscCell::halves(std::size_t side) const {
  std::array<DiscCell, 2> parts{*this, *this};
  if (side == 2) {
    parts[0].to = parts[1].from = 0.5 * (from + to);
  } else {
    parts[0].high[side] = parts[1].low[side] = 0.5 * (low[side] + high[side]);
  }
  return parts;
}

bool DiscDivision::may_hold(std::size_t node, double level) const {
  constexpr double kWellBelow = 0.85;
  return !is_cut(part(node, 0)) && !is_cut(part(node, 1)) && level < kWellBelow * nodes_[node].level;
}

void DiscDivision::cut(std::size_t node, std::size_t side, double level) {
  nodes_[node].level = level;
  if (!is_cut(node)) {
    nodes_[node].side = side;
    nodes_[node].first = nodes_.size();
    nodes_.resize(nodes_.size() + 2);
  }
}

}  // namespace veritrack::checker
