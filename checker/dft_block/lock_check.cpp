#include "checker/dft_block/lock_check.hpp"

#include <cmath>
#include <vector>

#include "checker/dft_block/block_matrices.hpp"
#include "checker/dft_block/tone_polynomial.hpp"
#include "checker/numbers/threads.hpp"

namespace veritrack::checker {

namespace {

/// sin(x)/x, by the values at the middle and |(sin(x)/x)'| <= |x|/3; and (1 - cos x)/x, whose derivative is
/// at most 1/2.
std::pair<Ball, Ball> ratios(const Ball& x) {
  const Ball at = x.middle();
  const Ball away = x.radius();
  const Ball ratio = sine_ratio(at).value;
  const Ball half_ratio = sine_ratio(half * at).value;
  const Ball bend = abs(x).upper() / Ball(3.0);
  return {ratio + Ball::within(bend * away), half * at * square(half_ratio) + Ball::within(half * away)};
}

BlockErrorSet ball(const Ball& radius) {
  return {radius, {radius, radius, radius}};
}

}  // namespace

struct BlockLock::Cell {
  std::array<std::array<Ball, 2>, 5> sides;  ///< x1, phase, offset error; offset minus the middle; amplitude
  [[nodiscard]] Ball side(std::size_t i) const { return Ball::hull(sides[i][0], sides[i][1]); }
};

BlockLock::BlockLock(const BlockProblem& problem, const BlockSet& set)
    : problem_(problem), set_(set), back_(inverse(set.frame)) {
  Matrix3 turn = identity(one);
  turn[1][2] = two * pi();
  turn_ = product(product(back_, turn), set.frame);
}

Matrix3 BlockLock::process_noise(const Ball& amplitude) const {
  Matrix3 q =
      diagonal(problem_.q1 * four * pi() / amplitude, problem_.q2 + square(pi()) * problem_.q3, problem_.q3);
  q[1][2] = pi() * problem_.q3;
  q[2][1] = q[1][2];
  return about(back_, q);
}

Ball BlockLock::reach(std::size_t i) const {
  const auto& row = set_.frame[i];
  return sqrt(square(row[0]) + square(row[1]) + square(row[2]));
}

Ball BlockLock::length_of(const Vector3& bounds) const {
  Ball sum = zero;
  for (const auto& row : back_) {
    sum += square(abs(row[0]) * bounds[0] + abs(row[1]) * bounds[1] + abs(row[2]) * bounds[2]);
  }
  return sqrt(sum);
}

Ball BlockLock::disturbance() const {
  const Ball amplitude = Ball::hull(problem_.amplitude_low, problem_.amplitude_high);
  const bool is_floor = certainly_not_negative(set_.floor) && certainly_less(set_.floor, set_.above) &&
                        definite(process_noise(amplitude) - identity(set_.floor));
  const Ball gain = is_floor ? set_.above - set_.floor : Ball::everything();
  Ball moved = zero;
  for (const Ball& part : slew_direction()) {
    moved += square(part);
  }
  return sqrt(gain / problem_.r) * problem_.noise + sqrt(moved) * problem_.slew;
}

Vector3 BlockLock::slew_direction() const {
  Vector3 direction;
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = pi() * back_[i][1] + back_[i][2];
  }
  return direction;
}

bool BlockLock::holds(const Matrix3& covariance) const {
  const Ball amplitude = Ball::hull(problem_.amplitude_low, problem_.amplitude_high);
  Matrix3 change = diagonal(sqrt(four * pi() / amplitude), one, one);
  change[1][2] = pi();
  const Matrix3 inside = about(product(back_, change), covariance);
  return definite(identity(set_.above) - inside) && definite(inside - identity(one / set_.below));
}

bool BlockLock::is_outside(const Cell& cell, const BlockErrorSet& errors) const {
  Ball sum = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    const Ball coordinate =
        back_[i][0] * cell.side(0) + back_[i][1] * cell.side(1) + back_[i][2] * cell.side(2);
    if (certainly_less(errors.limits[i], abs(coordinate))) {
      return true;
    }
    sum += square(coordinate);
  }
  return certainly_less(square(errors.radius), sum);
}

Matrix3 block_information(const MeetingSums& sums, const Ball& weight, const Ball& x) {
  const Ball power = square(x);
  Matrix3 result = diagonal(four * weight * power * sums.aa, weight * square(power) * sums.aa,
                            weight * square(power) * sums.bb);
  result[0][2] = two * weight * power * x * sums.ab;
  result[2][0] = result[0][2];
  return result;
}

Matrix3 root_of_block_information(const MeetingSums& sums, const Ball& weight, const Ball& x) {
  // The last row is taken first.
  const Ball root = sqrt(weight) * x;
  Matrix3 result = diagonal(two * root * sqrt(sums.aa - square(sums.ab) / sums.bb), root * x * sqrt(sums.aa),
                            root * x * sqrt(sums.bb));
  result[0][2] = two * root * sums.ab / sqrt(sums.bb);
  return result;
}

struct BlockLock::OverCell {
  Matrix3 spread;  ///< X is the middle of its bounds, and up to this more or less
  Matrix3 step;    ///< F (1 - X secant) at that middle
  Matrix3 secant;
  Matrix3 gain;    ///< F X N at the middle
  Matrix3 factor;  ///< N, N N' = J
};

std::optional<BlockLock::OverCell> BlockLock::over(const Cell& cell, const TonePolynomial& tone) const {
  return over(cell, tone, set_.above, set_.below);
}

std::optional<BlockLock::OverCell> BlockLock::over(const Cell& cell, const TonePolynomial& tone,
                                                   const Ball& next_above, const Ball& next_below) const {
  const Ball first = cell.side(0);
  const Ball amplitude = cell.side(4);
  const Ball weight = square(amplitude) / (four * problem_.r);
  const Ball truth = cell.side(3);
  const MeetingSums sums = tone.at(truth + cell.side(2), truth);
  const auto [sine, cosine] = ratios(cell.side(1));
  const Ball x = one + first;
  const Ball power = square(x);
  // H'R^-1 (h(truth) - h(estimate)) = -secant z, and the difference of the secant from the Jacobian.
  const Ball grown = two + first;
  Matrix3 secant =
      diagonal(two * weight * x * grown * sums.aa, weight * power * sums.at * sine, weight * power * sums.bc);
  secant[0][1] = two * weight * x * sums.at * cosine;
  secant[0][2] = two * weight * x * sums.ac;
  secant[2][0] = weight * power * grown * sums.ab;
  secant[2][1] = weight * power * sums.bt * cosine;
  Matrix3 more = secant;
  more[0][0] = -(two * weight * x * first * sums.aa);
  more[0][2] = two * weight * x * (sums.ac - power * sums.ab);
  more[1][1] = weight * power * (sums.at * sine - power * sums.aa);
  more[2][0] = -(weight * power * first * sums.ab);
  more[2][2] = weight * power * (sums.bc - power * sums.bb);

  const Matrix3 into = transposed(set_.frame);
  const Matrix3 information = about(into, block_information(sums, weight, x));
  const Ball least = one / set_.above;
  const Matrix3 high = inverse_near(information + identity(least));
  const Matrix3 low = inverse_near(information + identity(set_.below));
  const Matrix3 noise = process_noise(amplitude);
  if (!definite(identity(next_above) - noise - about(turn_, high)) ||
      !definite(noise + about(turn_, low) - identity(one / next_below))) {
    return std::nullopt;
  }
  // high J = 1 - least high and low J = 1 - below low; high - low = high (below - least) low.
  OverCell found;
  found.spread = scaled(half * (set_.below - least), product(high, low));
  const Matrix3 kept = scaled(half * least, high) + scaled(half * set_.below, low);
  const Matrix3 centre = scaled(half, high + low);
  found.step = product(turn_, kept - product(centre, about(into, more)));
  found.secant = about(into, secant);
  found.factor = product(into, root_of_block_information(sums, weight, x));
  found.gain = product(product(turn_, centre), found.factor);
  return found;
}

bool BlockLock::falls_in(const Cell& cell, const TonePolynomial& tone, const BlockRate& rate) const {
  const std::optional<OverCell> block = over(cell, tone);
  if (!block) {
    return false;
  }
  return definite_together(
      identity(square(rate.rate)) - scaled(rate.weight, about(transposed(block->secant), block->spread)),
      block->step, identity(one) - scaled(one / rate.weight, about(turn_, block->spread)));
}

bool BlockLock::stays_near_in(const Cell& cell, const TonePolynomial& tone, const BlockStage& stage) const {
  const std::optional<OverCell> block = over(cell, tone, stage.next_above, stage.next_below);
  if (!block) {
    return false;
  }
  // X = centre + Y, -spread <= Y <= spread: |u'Y v|^2 <= u'spread u v'spread v.
  const Matrix3 turned = about(turn_, block->spread);
  const Matrix3 seen = about(transposed(block->secant), block->spread);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Ball uncertain = sqrt(abs(turned[i][i]) * abs(seen[j][j]));
      if (!certainly_at_most(abs(block->step[i][j] - stage.reference[i][j]) + uncertain,
                             stage.excess[i][j])) {
        return false;
      }
    }
  }
  const Matrix3 lost = about(transposed(block->factor), block->spread);
  const Ball trace = abs(lost[0][0]) + abs(lost[1][1]) + abs(lost[2][2]);
  return definite(stage.noise -
                  scaled(one + stage.noise_weight, product(block->gain, transposed(block->gain))) -
                  scaled((one + one / stage.noise_weight) * trace, turned));
}

bool BlockLock::drifts_in(const Cell& cell, const TonePolynomial& tone, const BlockDrift& drift) const {
  const std::optional<OverCell> block = over(cell, tone);
  if (!block) {
    return false;
  }
  const Matrix3 unit = identity(one);
  const Matrix3 turned = about(turn_, block->spread);
  const Matrix3 gain = scaled(sqrt(drift.tilt), transposed(block->gain));
  const Matrix3 seen = scaled(drift.tilt, about(transposed(block->factor), block->spread));
  if (!definite_together(unit - drift.floor - scaled(one / drift.floor_weight, turned), gain,
                         unit - scaled(drift.floor_weight, seen))) {
    return false;
  }
  const Matrix3 across = scaled(drift.weight * sqrt(drift.tilt),
                                product(product(transposed(block->factor), block->spread), block->secant));
  return definite_together(
      identity(drift.growth) - scaled(drift.weight, about(transposed(block->secant), block->spread)),
      block->step, unit - scaled(one / drift.weight, turned), across, gain,
      unit - scaled(drift.weight, seen));
}

bool BlockLock::true_near(const Ball& low, const Ball& high, const BlockErrorSet& errors,
                          const InCell& is_true, std::int64_t& cells) const {
  const Ball middle = (half * (low + high)).middle();
  const TonePolynomial tone(middle, problem_.half_width);
  Cell whole;
  for (std::size_t i = 0; i < 3; ++i) {
    Ball side = zero;
    for (std::size_t j = 0; j < 3; ++j) {
      side += abs(set_.frame[i][j]) * errors.limits[j];
    }
    side = min(errors.radius * reach(i), side).upper();
    whole.sides[i] = {-side, side};
  }
  whole.sides[3] = {(low - middle).lower(), (high - middle).upper()};
  whole.sides[4] = {problem_.amplitude_low.lower(), problem_.amplitude_high.upper()};
  const double amplitude = problem_.amplitude_low.lower_double();
  // Proposals for the direction in which the information changes most.
  const std::array weights{2.0, 0.15, 1.3, 1.3, 2.0 / amplitude};
  std::vector<Cell> open{whole};
  constexpr std::int64_t kMost = 400'000;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    if (++cells > kMost) {
      return false;
    }
    if (is_outside(cell, errors) || is_true(cell, tone)) {
      continue;
    }
    std::size_t widest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double width = weights[i] * (cell.sides[i][1] - cell.sides[i][0]).near();
      if (width > most) {
        most = width;
        widest = i;
      }
    }
    constexpr double kSmallest = 1e-9;
    if (!(most > kSmallest)) {
      return false;
    }
    const Ball cut = (half * (cell.sides[widest][0] + cell.sides[widest][1])).middle();
    open.push_back(cell);
    open.back().sides[widest][1] = cut;
    open.push_back(cell);
    open.back().sides[widest][0] = cut;
  }
  return true;
}

bool BlockLock::falls(const BlockRate& rate, std::int64_t& cells) const {
  return true_everywhere(
      ball(rate.radius),
      [&](const Cell& cell, const TonePolynomial& tone) { return falls_in(cell, tone, rate); }, cells);
}

bool BlockLock::stays_near(const BlockStage& stage, std::int64_t& cells) const {
  return true_everywhere(
      stage.errors,
      [&](const Cell& cell, const TonePolynomial& tone) { return stays_near_in(cell, tone, stage); }, cells);
}

bool BlockLock::drifts(const BlockDrift& drift, std::int64_t& cells) const {
  return true_everywhere(
      ball(drift.radius),
      [&](const Cell& cell, const TonePolynomial& tone) { return drifts_in(cell, tone, drift); }, cells);
}

bool BlockLock::true_everywhere(const BlockErrorSet& errors, const InCell& is_true,
                                std::int64_t& cells) const {
  // The band in pieces of a few hundredths of a bin.
  const double low = problem_.offset_low.lower_double();
  const double high = problem_.offset_high.upper_double();
  constexpr double kPiece = 0.04;
  const double pieces = std::ceil((high - low) / kPiece);
  constexpr double kMostPieces = 1000.0;
  if (!(pieces >= 0.0) || !(pieces < kMostPieces)) {
    return false;
  }
  const auto count = static_cast<std::size_t>(std::max(pieces, 1.0));
  const auto border = [&](std::size_t i) {
    return i == count ? problem_.offset_high.upper()
                      : (problem_.offset_low.lower() +
                         (problem_.offset_high.upper() - problem_.offset_low.lower()) *
                             Ball(static_cast<double>(i)) / Ball(static_cast<double>(count)))
                            .middle();
  };
  std::vector<std::int64_t> counts(count, 0);
  const bool all = first_failure(count, [&](std::size_t i) {
                     return true_near(i == 0 ? problem_.offset_low.lower() : border(i), border(i + 1), errors,
                                      is_true, counts[i]);
                   }) == count;
  for (const std::int64_t one_count : counts) {
    cells += one_count;
  }
  return all;
}

}  // namespace veritrack::checker
