#include "analysis/contraction/steady_contraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "analysis/contraction/steady_rate.hpp"
#include "analysis/contraction/steady_setting.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/derivatives.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Interval;
using Slope = SteadySlope;
constexpr std::size_t kVariables = 5;

/// A box of (s, x, y).
struct Cell {
  std::array<double, 3> low, high;
  [[nodiscard]] double middle(std::size_t i) const { return low[i] + 0.5 * (high[i] - low[i]); }
  [[nodiscard]] double width(std::size_t i) const { return high[i] - low[i]; }
  [[nodiscard]] Interval side(std::size_t i) const { return Interval::from_bounds(low[i], high[i]); }
};
enum Side : std::size_t { kLevel = 0, kX = 1, kY = 2 };

/// Walks the cells depth first.
class Cover {
 public:
  Cover(const SteadySettings& settings, double rate, const SteadyDisturbance& disturbance)
      : settings_(settings),
        middle_(convert<double>(settings.at_middle)),
        rate_(rate),
        disturbance_(disturbance) {}

  /// False when a cell cannot be shown to contract; `reason` then says where.
  bool proves(const Cell& cell, int depth) {
    if (is_outside(cell)) {
      return true;
    }
    if (++cells_ > kMostCells) {
      reason_ = "more than " + std::to_string(kMostCells) + " cells were needed.";
      return false;
    }
    const Enclosure enclosure = enclose(cell);
    const SteadyStep<Interval>& step = enclosure.over_cell;
    const Interval level = cell.side(kLevel);
    const SteadyBounds<Interval> bounds = steady_bounds(step, settings_.over_cell, level, disturbance_.noise);
    // What noise and slew leave for the rest.
    const Interval left(
        (rate_ - (bounds.noise_gain * disturbance_.noise + disturbance_.motion) / level).lower());
    const SteadyStep<double> at_middle =
        steady_step(middle_, {cell.middle(kLevel), cell.middle(kX), cell.middle(kY)});
    const SteadyBounds<double> bounds_at_middle =
        steady_bounds(at_middle, middle_, cell.middle(kLevel), midpoint(disturbance_.noise));
    const SteadyRate proposal = propose_rate(at_middle, bounds_at_middle, left.lower() * left.lower());
    const bool contracts = certainly_positive(left) && certainly_positive(bounds.least_along) &&
                           certainly_positive(step.along) && certainly_less(abs(step.swing), Interval(1.5)) &&
                           certainly_contracts(step, bounds, rigor::square(left), proposal);
    const Order order = contracts ? keeps_covariance(enclosure, cell, bounds) : Order::not_known;
    if (contracts && order == Order::kept) {
      noise_gain_ = std::max(noise_gain_, bounds.noise_gain.upper());
      return true;
    }
    const bool fails_inside =
        order == Order::hopeless || !(proposal.rate_squared <= rate_.upper() * rate_.upper());
    const bool hopeless = depth == 0 || (fails_inside && std::hypot(cell.middle(kX), cell.middle(kY)) <= 1.0);
    if (hopeless) {
      reason_ = "at level " + rigor::to_decimal(cell.middle(kLevel), 3, rigor::Direction::up) +
                (contracts ? " of the set the covariance could not be shown to stay between its bounds."
                           : " of the set a step could not be shown to contract, or to bear the noise.");
      return false;
    }
    // Bisect the side that matters most; the weights are a matter of speed only.
    const std::array<double, 3> weights{cell.width(kLevel), cell.high[kLevel] * cell.width(kX),
                                        cell.high[kLevel] * cell.width(kY)};
    const auto side = static_cast<std::size_t>(
        std::distance(weights.begin(), std::max_element(weights.begin(), weights.end())));
    Cell first = cell;
    Cell second = cell;
    first.high[side] = second.low[side] = cell.middle(side);
    return proves(first, depth - 1) && proves(second, depth - 1);
  }

  [[nodiscard]] SteadyContraction result(bool proved) const {
    SteadyContraction over;
    over.proved = proved;
    over.reason = reason_;
    over.noise_gain = noise_gain_;
    over.cells = cells_;
    return over;
  }

 private:
  static constexpr std::int64_t kMostCells = 4000;
  enum class Order { kept, not_known, hopeless };

  struct Enclosure {
    SteadyStep<Interval> over_cell;
    SteadyStep<Interval> at_middle;
    SteadyStep<Slope> slopes;
  };

  /// value at the middle + derivatives over the cell times the distance from the middle.
  static Interval mean_value(const Interval& at_middle, const Slope& over_cell,
                             const std::array<Interval, kVariables>& distance) {
    Interval value = at_middle;
    for (std::size_t k = 0; k < distance.size(); ++k) {
      value += over_cell.derivative(static_cast<int>(k)) * distance[k];
    }
    return intersection(value, over_cell.value());
  }

  [[nodiscard]] std::array<Interval, kVariables> distances(const Cell& cell) const {
    std::array<Interval, kVariables> result;
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = cell.side(k) - Interval(cell.middle(k));
    }
    result[3] = rigor::symmetric(1.0);
    result[4] = settings_.frequencies;
    return result;
  }

  [[nodiscard]] Enclosure enclose(const Cell& cell) const {
    Enclosure enclosure;
    enclosure.at_middle =
        steady_step(settings_.at_middle,
                    {Interval(cell.middle(kLevel)), Interval(cell.middle(kX)), Interval(cell.middle(kY))});
    enclosure.slopes = steady_step(
        settings_.slopes, {rigor::variable<5>(cell.side(kLevel), kLevel),
                           rigor::variable<5>(cell.side(kX), kX), rigor::variable<5>(cell.side(kY), kY)});
    enclosure.over_cell = enclosure.at_middle;
    const std::array<Interval, kVariables> distance = distances(cell);
    const auto values = enclosure.over_cell.entries();
    const auto slopes = enclosure.slopes.entries();
    for (std::size_t i = 0; i < values.size(); ++i) {
      *values[i] = mean_value(*values[i], *slopes[i], distance);
    }
    return enclosure;
  }

  /// share * a - b.
  static Symmetric<Interval> difference(const Interval& share, const Symmetric<Interval>& a,
                                        const Symmetric<Interval>& b) {
    return {share * a.p11 - b.p11, share * a.p12 - b.p12, share * a.p13 - b.p13,
            share * a.p22 - b.p22, share * a.p23 - b.p23, share * a.p33 - b.p33};
  }

  [[nodiscard]] bool within_bounds(const CovarianceStep<Interval>& image, const Interval& share) const {
    return certainly_positive_definite(plus(image.low, settings_.over_cell.band.below, share)) &&
           certainly_positive_definite(difference(share, settings_.over_cell.band.above, image.high));
  }

  [[nodiscard]] Order keeps_covariance(const Enclosure& enclosure, const Cell& cell,
                                       const SteadyBounds<Interval>& bounds) const {
    const Interval share((rate_ - disturbance_.covariance_motion / cell.side(kLevel)).lower());
    const Interval level(cell.middle(kLevel));
    const CovarianceStep<Interval> at_middle =
        covariance_step(settings_.at_middle, enclosure.at_middle, level,
                        turn_tangent(settings_.at_middle, enclosure.at_middle, level));
    if (!certainly_positive(share) || !within_bounds(at_middle, share)) {
      return Order::hopeless;
    }
    const Slope levels = rigor::variable<5>(cell.side(kLevel), kLevel);
    const Slope tangents =
        turn_tangent(settings_.slopes, enclosure.slopes, levels) +
        Slope(Interval(bounds.tangent_reach.upper())) * rigor::variable<5>(rigor::symmetric(1.0), 3);
    const CovarianceStep<Slope> slopes =
        covariance_step(settings_.slopes, enclosure.slopes, levels, tangents);
    // Positive definite matrices are a convex set: what is affine in the five variables needs to be looked at
    // in the corners only, with whichever derivatives there are over the cell.
    // Positive definite matrices are a convex set: what is affine in the five variables needs to be looked at
    // in the corners only, with whichever derivatives there are over the cell.
    for (const Point& point : corners(cell)) {
      for (const double end : {cell.low[kLevel], cell.high[kLevel]}) {
        for (const double side : {-1.0, 1.0}) {
          for (const double frequency : {settings_.frequencies.lower(), settings_.frequencies.upper()}) {
            const std::array<Interval, kVariables> offset{
                Interval(end) - Interval(cell.middle(kLevel)), Interval(point.x) - Interval(cell.middle(kX)),
                Interval(point.y) - Interval(cell.middle(kY)), Interval(side), Interval(frequency)};
            const CovarianceStep<Interval> image{moved(at_middle.low, slopes.low, offset),
                                                 moved(at_middle.high, slopes.high, offset)};
            if (!within_bounds(image, share)) {
              return Order::not_known;
            }
          }
        }
      }
    }
    return Order::kept;
  }

  struct Point {
    double x, y;
  };

  /// No point of the cell lies in the unit disc.
  static bool is_outside(const Cell& cell) {
    return certainly_less(Interval(1.0), square(cell.side(kX)) + square(cell.side(kY)));
  }

  /// Corners of a polygon inside the cell that holds all of the cell that lies in the unit disc: corners of
  /// the cell outside the disc are cut off along a line that the disc does not cross.
  static std::vector<Point> corners(const Cell& cell) {
    std::vector<Point> points;
    points.reserve(8);
    for (const bool right : {false, true}) {
      for (const bool top : {false, true}) {
        const Point corner{right ? cell.high[kX] : cell.low[kX], top ? cell.high[kY] : cell.low[kY]};
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
        points.push_back(
            {corner.x, std::clamp(top ? along_y.upper() : along_y.lower(), cell.low[kY], cell.high[kY])});
        points.push_back(
            {std::clamp(right ? along_x.upper() : along_x.lower(), cell.low[kX], cell.high[kX]), corner.y});
      }
    }
    return points;
  }

  /// a + derivatives of b times the offset.
  static Symmetric<Interval> moved(const Symmetric<Interval>& a, const Symmetric<Slope>& b,
                                   const std::array<Interval, kVariables>& offset) {
    const auto entry = [&offset](Interval value, const Slope& slope) {
      for (std::size_t k = 0; k < offset.size(); ++k) {
        value += slope.derivative(static_cast<int>(k)) * offset[k];
      }
      return value;
    };
    return {entry(a.p11, b.p11), entry(a.p12, b.p12), entry(a.p13, b.p13),
            entry(a.p22, b.p22), entry(a.p23, b.p23), entry(a.p33, b.p33)};
  }

  SteadySettings settings_;
  SteadySetting<double> middle_;
  Interval rate_;
  SteadyDisturbance disturbance_;
  double noise_gain_ = 0.0;
  std::int64_t cells_ = 0;
  std::string reason_;
};

}  // namespace

SteadyContraction prove_contraction(const SteadySettings& settings, const LevelRange& range,
                                    const SteadyDisturbance& disturbance) {
  constexpr int kDepth = 14;
  rigor::require_upward_rounding();
  Cover cover(settings, range.rate, disturbance);
  for (const double x : {-1.0, 0.0}) {
    for (const double y : {-1.0, 0.0}) {
      if (!cover.proves({{range.low, x, y}, {range.high, x + 1.0, y + 1.0}}, kDepth)) {
        return cover.result(false);
      }
    }
  }
  return cover.result(true);
}

}  // namespace veritrack::contraction
