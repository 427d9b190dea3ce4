#include "analysis/quadrature/leak/steady_cell.hpp"

#include <algorithm>

namespace veritrack::quadrature {

using rigor::Interval;

bool SteadyCell::is_outside() const {
  return certainly_less(Interval(1.0), square(side(kX)) + square(side(kY)));
}

std::vector<SteadyCell::Point> SteadyCell::corners() const {
  std::vector<Point> points;
  points.reserve(8);
  for (const bool right : {false, true}) {
    for (const bool top : {false, true}) {
      const Point corner{right ? high[kX] : low[kX], top ? high[kY] : low[kY]};
      const Interval x(corner.x);
      const Interval y(corner.y);
      const Interval squared = square(x) + square(y);
      const bool cut = certainly_less(Interval(1.0), squared) && corner.x != 0.0 && corner.y != 0.0;
      if (!cut) {
        points.push_back(corner);
        continue;
      }
      // On the line x X + y Y = |(X, Y)|, rounded away from the disc, and not beyond the cell.
      const double length = sqrt(squared).upper();
      const Interval along_y = (Interval(length) - square(x)) / y;
      const Interval along_x = (Interval(length) - square(y)) / x;
      points.push_back({corner.x, std::clamp(top ? along_y.upper() : along_y.lower(), low[kY], high[kY])});
      points.push_back({std::clamp(right ? along_x.upper() : along_x.lower(), low[kX], high[kX]), corner.y});
    }
  }
  return points;
}

std::vector<SteadyOffset> corner_offsets(const SteadyCell& cell, const Interval& frequencies) {
  const std::vector<SteadyCell::Point> points = cell.corners();
  std::vector<SteadyOffset> offsets;
  offsets.reserve(2 * points.size());
  for (const SteadyCell::Point& point : points) {
    for (const double frequency : {frequencies.lower(), frequencies.upper()}) {
      offsets.push_back({Interval(point.x) - Interval(cell.middle(kX)),
                         Interval(point.y) - Interval(cell.middle(kY)), Interval(0.0), Interval(frequency)});
    }
  }
  return offsets;
}

SteadyOffset offset_box(const SteadyCell& cell, const Interval& frequencies) {
  return {cell.side(kX) - Interval(cell.middle(kX)), cell.side(kY) - Interval(cell.middle(kY)),
          rigor::symmetric(1.0), frequencies};
}

}  // namespace veritrack::quadrature
