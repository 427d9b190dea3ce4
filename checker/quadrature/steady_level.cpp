#include "checker/quadrature/steady_level.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

namespace {

/// The place in the cell, from its middle: x, y, and the frequency.
using Way = std::array<Ball, kSides>;
enum Side : std::size_t { kX, kY, kFrequency };

/// All values over the cell.
Ball over(const Chord& entry, const Way& way) {
  Ball sum = entry.centre;
  for (std::size_t i = 0; i < kSides; ++i) {
    sum += entry.by[i] * way[i];
  }
  return sum;
}
Ball largest(const Chord& a, const Chord& b, const Chord& c, const Way& way) {
  return larger_eigenvalue(over(a, way), over(b, way), over(c, way)).upper();
}

/// Contributions of covariance and noise to a step under the mean gain: upper bounds over a cell.
struct Added {
  bool meaningful = false;
  Ball turn;                  ///< on |arg z - arg of the mean z|/s
  Ball eta_factor, eta_rest;  ///< |y|^2 <= eta_factor eta^2 + eta_rest, eta without noise
  Ball remainder;             ///< on |T (J - J') (D y / r + K v / s)|, J' the Jacobian at the mean estimate
};

/// D y / r and K v / s together keep the corrected estimate within `radius` of the mean one, and the part
/// across turns it. The rows of the Jacobian of (|z|, arg z), averaged over the way, are those at the mean
/// estimate plus up to half the radius times the bounds 1/|z| and 1/|z|^2 on their derivatives. The length of
/// y is up to eta + sqrt(spread) |v|, and (a + b)^2 <= (1 + theta) a^2 + (1 + 1/theta) b^2.
Added added(const SteadySetting& setting, const SteadyLevel& level, const SteadyStep<Chord>& step,
            const Way& way) {
  const TriangularMetric& t = setting.metric;
  const Ball spread = largest(step.spread[k11], step.spread[k12], step.spread[k22], way);
  const Ball gain = largest(step.largest[0], step.largest[1], step.largest[2], way);
  const Ball eta = root_of_non_negative(over(step.eta_squared, way)).upper();
  const Ball radius = level.level * root_of_non_negative(spread) * eta / setting.r + gain * level.noise;
  const Ball nearest = over(step.distance, way).lower() - radius;
  Added result;
  // cannot bind (over(step.forward, way), over(step.along, way), abs(step.swing.range)): in the middle of a
  // level the steady z is as near as `radius` to the mean one, which is longer, so that their product is
  // positive; secants divide by both products, so that they are positive in all cells; and turns are then
  // continuous, zero in the middle.
  result.meaningful = certainly_positive(nearest) && certainly_positive(over(step.forward, way)) &&
                      certainly_positive(over(step.along, way)) &&
                      certainly_less(abs(step.swing.range), Ball(1.5));
  if (!result.meaningful) {
    return result;
  }
  const Ball across = root_of_non_negative(over(step.across, way)).upper();
  result.turn = (across * eta / setting.r + gain * level.noise / level.level) / nearest;
  const Ball bend = half * radius / nearest;
  const Ball bent = (bend * (t.t11 + sqrt(square(t.t12) + square(t.t22)) / nearest)).upper();
  result.remainder = bent * radius / level.level;
  const Ball more = (spread * square(level.noise)).upper();
  const double share = std::sqrt(more.near() / std::fmax(square(eta).near(), 1e-30));
  const Ball theta(std::fmin(std::fmax(share, 1e-6), 100.0));
  result.eta_factor = one + theta;
  result.eta_rest = (one + one / theta) * more;
  return result;
}

/// The change of the deviation of the covariance when the turn changes from the mean one by its reach: the
/// derivative of U(-a) P U(-a)', P between the covariances after the step.
Symmetric<Ball> reach_of(const SteadyPlace<Chord>& place, const Symmetric<Chord>& deviation, const Way& way,
                         const Ball& turn) {
  Symmetric<Ball> after;
  for (std::size_t i = 0; i < after.size(); ++i) {
    after[i] = place.steady.covariance[i].range + place.level.range * over(deviation[i], way);
  }
  // In between it is turned by less than the reach.
  const Ball angle = Ball::within(place.level.range * turn);
  after = turned(after, sin(angle), cos(angle));
  return scaled(turn, Symmetric<Ball>{two * after[k12], after[k22] - after[k11], after[k23],
                                      -(two * after[k12]), -after[k13], zero});
}

/// Adds the uncertainty of the slopes over a cell, in all three directions, with this weight of an entry.
void add_blur(std::array<double, kSides>& blur, const Chord& entry, const Way& way, double weight) {
  for (std::size_t k = 0; k < kSides; ++k) {
    blur[k] += weight * mag_get_d(arb_radref(entry.by[k].raw())) * mag_get_d(arb_radref(way[k].raw()));
  }
}
std::size_t most(const std::array<double, kSides>& blur) {
  return static_cast<std::size_t>(std::max_element(blur.begin(), blur.end()) - blur.begin());
}

/// The direction in which the covariance is blurred the most, in units of its bounds.
std::size_t most_blurred(const Symmetric<Chord>& low, const Symmetric<Chord>& high,
                         const SteadySetting& setting, const Way& way) {
  constexpr std::array<std::array<Entry, 2>, 6> kDiagonal{
      {{k11, k11}, {k11, k22}, {k11, k33}, {k22, k22}, {k22, k33}, {k33, k33}}};
  std::array<double, kSides> blur{};
  for (std::size_t i = 0; i < kDiagonal.size(); ++i) {
    const auto [first, second] = kDiagonal[i];
    const auto weight = [&, i = first, j = second](const Symmetric<Ball>& bound) {
      return 1.0 / std::sqrt(bound[i].near() * bound[j].near());
    };
    add_blur(blur, low[i], way, weight(setting.below));
    add_blur(blur, high[i], way, weight(setting.above));
  }
  return most(blur);
}

/// The number of parts into which turns of this many rad are cut.
int parts_of_turn(double reach) {
  return reach < 0.02 ? 1 : reach < 0.1 ? 3 : 5;
}

/// A cell: all of it, its middle, and the way from there.
struct CellExpansion {
  Way range, middle, way;
};
CellExpansion expansion_of(const DiscCell& cell) {
  CellExpansion where;
  where.range = {Ball::hull(Ball(cell.low[0]), Ball(cell.high[0])),
                 Ball::hull(Ball(cell.low[1]), Ball(cell.high[1])),
                 Ball::hull(Ball(cell.from), Ball(cell.to))};
  for (std::size_t i = 0; i < kSides; ++i) {
    where.middle[i] = where.range[i].middle();
    where.way[i] = where.range[i] - where.middle[i];
  }
  return where;
}

SteadyPlace<Chord> place_of(const SteadyLevel& level, const CellExpansion& where, const SteadyCell& steady) {
  SteadyPlace<Chord> place;
  place.level = level.level;
  place.x = Chord(where.middle[kX], where.range[kX], kX, one);
  place.y = Chord(where.middle[kY], where.range[kY], kY, one);
  const StateVector at = steady.at(where.middle[kFrequency]);
  const StateVector around = steady.at(where.range[kFrequency]);
  for (std::size_t i = 0; i < kStates; ++i) {
    (i < 3 ? place.steady.error[i] : place.steady.covariance[i - 3]) =
        Chord(at[i], around[i], kFrequency, steady.slope[i]);
  }
  return place;
}

template <std::size_t N>
std::array<Ball, N> centre_of(const std::array<Chord, N>& row) {
  std::array<Ball, N> centre;
  for (std::size_t i = 0; i < N; ++i) {
    centre[i] = row[i].centre;
  }
  return centre;
}

/// Ways from the middle of a cell to its corners.
std::vector<Way> ways_to_corners(const DiscCell& cell, const Way& middle) {
  std::vector<Way> ways;
  for (const DiscPoint& point : cell.corners()) {
    for (const double frequency : {cell.from, cell.to}) {
      ways.push_back(
          {Ball(point[0]) - middle[kX], Ball(point[1]) - middle[kY], Ball(frequency) - middle[kFrequency]});
    }
  }
  return ways;
}

/// The values there, with whichever slopes exist.
template <std::size_t N>
std::array<Ball, N> moved_by(const std::array<Chord, N>& row, const Way& way) {
  std::array<Ball, N> moved;
  for (std::size_t i = 0; i < N; ++i) {
    moved[i] = over(row[i], way);
  }
  return moved;
}

/// Takes S (x, y) from the row, with S the middles of the slopes of what is moved.
void take_slopes(Row<Chord>& row, SteadyLimits& limits) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::size_t k : {kX, kY}) {
      limits.slopes[i][k] = Ball(row[i].by[k].near());
      row[i].by[k] = row[i].by[k] - limits.slopes[i][k];
      row[i].centre = row[i].centre - limits.slopes[i][k] * limits.middle[k];
    }
  }
}

/// The remainder of a rate for the errors of a cell decides about all of its (x, y), with one set of
/// multipliers or another.
struct ErrorCheck {
  bool contracts = false;
  bool hopeless = false;  ///< not even the middle of the cell does
  std::size_t side = kX;  ///< where to cut the cell, when it does not
};
ErrorCheck check_errors(const Row<Chord>& row, const Way& way, const std::vector<Way>& corners,
                        const SteadyLimits& limits, Multipliers& last) {
  std::vector<Row<Ball>> rows;
  rows.reserve(corners.size());
  for (const Way& corner : corners) {
    rows.push_back(moved_by(row, corner));
  }
  const auto contract = [&](const Multipliers& multipliers) {
    const ErrorInequality inequality(limits, multipliers);
    return std::all_of(rows.begin(), rows.end(),
                       [&](const Row<Ball>& at) { return inequality.contracts(at); });
  };
  if (contract(last)) {
    return {true};
  }
  Row<Ball> worst = centre_of(row);
  worst[kEta] = over(row[kEta], way).upper();
  const Proposal proposal = propose(worst, limits);
  last = proposal.multipliers;
  if (contract(last)) {
    return {true};
  }
  SteadyLimits point = limits;
  point.size_squared = zero;
  const double middle = (square(limits.middle[kX]) + square(limits.middle[kY])).near();
  const bool hopeless =
      middle < 1.0 && propose(centre_of(row), point).rate_squared > limits.rate_squared.near();
  std::array<double, kSides> blur{};
  for (std::size_t i = 0; i < kColumns; ++i) {
    add_blur(blur, row[i], way, std::fabs(proposal.weights[i]));
  }
  return {false, hopeless, most(blur)};
}

}  // namespace

bool SteadyCover::maps_into_next(const SteadyLevel& level) {
  constexpr int kDepth = 24;
  updates_.clear();
  return is_proved(level, {{-1.0, -1.0}, {1.0, 1.0}, steady_.from, steady_.to}, DiscDivision::kWhole, kDepth);
}

bool SteadyCover::is_proved(const SteadyLevel& level, const DiscCell& cell, std::size_t node, int depth) {
  if (cell.is_outside()) {
    return true;
  }
  if (!division_.is_cut(node) || division_.may_hold(node, level.level.near())) {
    std::size_t side = kX;
    ++cells_;
    if (proves(level, cell, side)) {
      division_.undo_cut(node);
      return true;
    }
    if (depth == 0 || hopeless_) {
      return false;
    }
    division_.cut(node, side, level.level.near());
  }
  const auto [first, second] = cell.halves(division_.side(node));
  return is_proved(level, first, division_.part(node, 0), depth - 1) &&
         is_proved(level, second, division_.part(node, 1), depth - 1);
}

bool SteadyCover::proves(const SteadyLevel& level, const DiscCell& cell, std::size_t& side) {
  const CellExpansion where = expansion_of(cell);
  const SteadyPlace<Chord> place = place_of(level, where, steady_);
  const SteadyTurn<Chord> turn_of_place = steady_turn(setting_, place);
  const auto [update, is_new] = updates_.try_emplace({cell.low[0], cell.high[0], cell.from, cell.to});
  if (is_new) {
    update->second = steady_update(setting_, place, turn_of_place);
  }
  const SteadyStep<Chord> step = steady_step(setting_, place, turn_of_place, update->second);
  const Added more = added(setting_, level, step, where.way);
  side = cell.high[0] - cell.low[0] >= cell.high[1] - cell.low[1] ? kX : kY;
  if (!more.meaningful) {
    return false;
  }
  Row<Chord> row = row_of(step);
  row[kEta] = more.eta_factor * row[kEta];
  row[kEta].centre += more.eta_rest;

  // The remainder of the level for the errors, and for the covariance, after slew, rounding and `remainder`.
  const Ball left = level.error_rate - more.remainder;
  const Ball& share = level.covariance_rate;
  // cannot bind (share): below zero it would ask for a lower bound above the upper one.
  if (!certainly_positive(left) || !certainly_positive(share)) {
    return false;
  }
  SteadyLimits limits{square(left),
                      square(level.noise / level.level).upper(),
                      setting_.hidden(),
                      {},
                      {where.middle[kX], where.middle[kY]},
                      (square(where.way[kX]) + square(where.way[kY])).upper()};
  take_slopes(row, limits);
  const std::vector<Way> corners = ways_to_corners(cell, where.middle);
  // Smaller cells do not help where a small one fails in its middle, a point of the disc.
  constexpr double kSmall = 0.02;
  const bool small = cell.high[0] - cell.low[0] < kSmall && cell.high[1] - cell.low[1] < kSmall &&
                     cell.to - cell.from < kSmall;
  // The turns one part after the other, the middle first: an odd number of them.
  const int parts = parts_of_turn((level.level * more.turn).near());
  const Ball half_part = more.turn / Ball(double(parts));
  for (int part = 0; part < parts; ++part) {
    const int away = part % 2 == 0 ? -part : part + 1;
    const Ball shift = half_part * Ball(double(away));
    Chord turn = step.turn;
    turn.centre += shift;
    turn.range += shift + Ball::within(half_part);
    const DeviationTurn<Chord> turned_by = deviation_turn(place, turn);
    const Symmetric<Chord> low = turned_deviation(step.low, turned_by);
    const Symmetric<Chord> high = turned_deviation(step.high, turned_by);
    const std::array<Symmetric<Ball>, 2> reach{reach_of(place, low, where.way, half_part),
                                               reach_of(place, high, where.way, half_part)};
    if (part == 0) {
      side = most_blurred(low, high, setting_, where.way);
      if (!keeps_covariance(centre_of(low), centre_of(high), reach, setting_, share)) {
        hopeless_ = small && certainly_less(square(limits.middle[kX]) + square(limits.middle[kY]), one);
        return false;
      }
      const ErrorCheck errors = check_errors(row, where.way, corners, limits, multipliers_);
      if (!errors.contracts) {
        side = errors.side;
        hopeless_ = small && errors.hopeless;
        return false;
      }
    }
    // All of the cell at once, or else its corners.
    const auto keeps = [&](const Way& way) {
      return keeps_covariance(moved_by(low, way), moved_by(high, way), reach, setting_, share);
    };
    if (!keeps(where.way) && !std::all_of(corners.begin(), corners.end(), keeps)) {
      return false;
    }
  }
  return true;
}

}  // namespace veritrack::checker
