#include "checker/quadrature/steady_level.hpp"

#include <cmath>
#include <utility>

namespace veritrack::checker {

namespace {

/// Where in the cell, from its middle: x, y, and the frequency.
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

/// What covariance and noise may add to a step under the mean gain: upper bounds over a cell.
struct Added {
  bool meaningful = false;
  Ball turn;  ///< on |arg z - arg of the mean z|/s
  Ball gram_factor, gram_rest;
  Ball noise_gain;  ///< on |T (e+ with v - e+ without)|/|v|
};

/// The corrected estimate is within `radius` of the mean one. Of the Jacobian of (|z|, arg z), averaged over
/// the way, the rows are those at the mean estimate and up to half the radius times the bounds 1/|z| and
/// 1/|z|^2 on their derivatives; and (X + Y)(X + Y)' <= (1 + theta) X X' + (1 + 1/theta) |Y|^2.
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
  result.turn = radius / (level.level * nearest);
  const Ball bend = half * radius / nearest;
  const Ball bent = (bend * (t.t11 + sqrt(square(t.t12) + square(t.t22)) / nearest)).upper();
  const Ball rest = (square(bent / setting.r) * spread).upper();
  Ball trace(0.0);
  for (const Entry k : {k11, k22, k33}) {
    trace += over(step.gram[k], way).upper();
  }
  const Ball theta(std::sqrt(std::fmax(rest.near(), 1e-30) / trace.near()));
  result.gram_factor = one + theta;
  result.gram_rest = (one + one / theta) * rest;
  // T J K for the mean gain, and for its spread.
  Ball a(0.0);
  Ball b(0.0);
  Ball c(0.0);
  for (const std::array<Chord, 2>& line : step.noise) {
    const Ball first = over(line[0], way);
    const Ball second = over(line[1], way);
    a += square(first);
    b += first * second;
    c += square(second);
  }
  result.noise_gain =
      (root_of_non_negative(larger_eigenvalue(a, b, c)) + bent * gain +
       level.level * root_of_non_negative((result.gram_factor * trace + result.gram_rest) * spread))
          .upper();
  return result;
}

/// By how much the deviation of the covariance changes when the turn changes from the mean one by its reach:
/// the derivative of U(-a) P U(-a)', P between the covariances after the step.
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

/// The variable whose slopes are known worst.
std::size_t most_blurred(const Row<Chord>& row, const SteadySetting& setting, const Way& way) {
  Row<double> size;
  size.fill(1.0);
  constexpr std::array<std::array<Entry, 2>, 6> kDiagonal{
      {{k11, k11}, {k11, k22}, {k11, k33}, {k22, k22}, {k22, k33}, {k33, k33}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto [first, second] = kDiagonal[i];
    size[kLow + i] = std::sqrt(setting.below[first].near() * setting.below[second].near());
    size[kHigh + i] = std::sqrt(setting.above[first].near() * setting.above[second].near());
    size[kGram + i] = 0.1;
  }
  std::size_t side = kX;
  double most = 0.0;
  for (std::size_t k = 0; k < kSides; ++k) {
    double blur = 0.0;
    for (std::size_t i = 0; i < kColumns; ++i) {
      blur += mag_get_d(arb_radref(row[i].by[k].raw())) / size[i];
    }
    blur *= mag_get_d(arb_radref(way[k].raw()));
    if (blur > most) {
      most = blur;
      side = k;
    }
  }
  return side;
}

/// A cell: all of it, its middle, and the way from there.
struct Whereabouts {
  Way range, middle, way;
};
Whereabouts whereabouts_of(const DiscCell& cell) {
  Whereabouts where;
  where.range = {Ball::hull(Ball(cell.low[0]), Ball(cell.high[0])),
                 Ball::hull(Ball(cell.low[1]), Ball(cell.high[1])),
                 Ball::hull(Ball(cell.from), Ball(cell.to))};
  for (std::size_t i = 0; i < kSides; ++i) {
    where.middle[i] = where.range[i].middle();
    where.way[i] = where.range[i] - where.middle[i];
  }
  return where;
}

SteadyPlace<Chord> place_of(const SteadyLevel& level, const Whereabouts& where, const SteadyCell& steady) {
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

Row<Ball> centre_of(const Row<Chord>& row) {
  Row<Ball> centre;
  for (std::size_t i = 0; i < kColumns; ++i) {
    centre[i] = row[i].centre;
  }
  return centre;
}

/// Is it true of the row at all corners of a cell, with whichever slopes there are?
template <typename Predicate>
bool all_corners(const Row<Chord>& row, const DiscCell& cell, const Way& middle, const Predicate& fits) {
  std::array<Row<Ball>, 2> ends;
  for (std::size_t end = 0; end < 2; ++end) {
    const Ball offset = Ball(end == 0 ? cell.from : cell.to) - middle[kFrequency];
    for (std::size_t i = 0; i < kColumns; ++i) {
      ends[end][i] = row[i].centre + row[i].by[kFrequency] * offset;
    }
  }
  for (const Point& point : cell.corners()) {
    const Ball x = Ball(point[0]) - middle[kX];
    const Ball y = Ball(point[1]) - middle[kY];
    std::array<Row<Ball>, 2> corner = ends;
    for (std::size_t i = 0; i < kColumns; ++i) {
      const Ball move = row[i].by[kX] * x + row[i].by[kY] * y;
      corner[0][i] += move;
      corner[1][i] += move;
    }
    if (!fits(corner[0]) || !fits(corner[1])) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool SteadyCover::maps_into_next(const SteadyLevel& level) {
  // Levels differ little, so that the cells of one are a good beginning for the next.
  constexpr int kRestart = 4;
  constexpr int kDepth = 24;
  if (levels_++ % kRestart == 0) {
    proved_ = {{{-1.0, -1.0}, {1.0, 1.0}, steady_.from, steady_.to}};
  }
  for (const DiscCell& cell : std::exchange(proved_, {})) {
    if (!is_proved(level, cell, kDepth)) {
      return false;
    }
  }
  return true;
}

bool SteadyCover::is_proved(const SteadyLevel& level, const DiscCell& cell, int depth) {
  if (cell.is_outside()) {
    return true;
  }
  std::size_t side = kX;
  ++cells_;
  if (proves(level, cell, side)) {
    proved_.push_back(cell);
    return true;
  }
  if (depth == 0 || hopeless_) {
    return false;
  }
  const auto [first, second] = cell.halves(side);
  return is_proved(level, first, depth - 1) && is_proved(level, second, depth - 1);
}

bool SteadyCover::proves(const SteadyLevel& level, const DiscCell& cell, std::size_t& side) {
  const Whereabouts where = whereabouts_of(cell);
  const SteadyPlace<Chord> place = place_of(level, where, steady_);
  const SteadyStep<Chord> step = steady_step(setting_, place);
  const Added more = added(setting_, level, step, where.way);
  if (!more.meaningful) {
    side = cell.high[0] - cell.low[0] >= cell.high[1] - cell.low[1] ? kX : kY;
    return false;
  }
  Chord turn = step.turn;
  turn.range += Ball::within(more.turn);
  const Symmetric<Chord> low = turned_deviation(place, step.low, turn);
  const Symmetric<Chord> high = turned_deviation(place, step.high, turn);
  const std::array<Symmetric<Ball>, 2> reach{reach_of(place, low, where.way, more.turn),
                                             reach_of(place, high, where.way, more.turn)};
  Row<Chord> row = row_of(step, low, high);
  for (std::size_t i = kGram; i < kEta; ++i) {
    row[i] = more.gram_factor * row[i];
  }
  for (const Entry k : {k11, k22, k33}) {
    row[kGram + std::size_t{k}].centre += more.gram_rest;
  }
  side = most_blurred(row, setting_, where.way);

  // What noise and slew leave of the level for the errors, and for the covariance.
  const Ball left = (level.next - more.noise_gain * level.noise - level.motion) / level.level;
  const Ball share = (level.next - level.covariance_motion) / level.level;
  // cannot bind (share): below zero it would ask for a lower bound above the upper one.
  if (!certainly_positive(left) || !certainly_positive(share)) {
    return false;
  }
  const Ball limit = square(left);
  const Row<Ball> centre = centre_of(row);
  const Multipliers multipliers = propose(centre, limit);
  const auto fits = [&](const Row<Ball>& point) {
    return keeps_covariance(point, reach, setting_, share) && contracts(point, limit, multipliers);
  };
  if (!fits(centre)) {
    constexpr double kSmall = 0.05;
    hopeless_ = cell.high[0] - cell.low[0] < kSmall && cell.high[1] - cell.low[1] < kSmall;
    return false;
  }
  return all_corners(row, cell, where.middle, fits);
}

}  // namespace veritrack::checker
