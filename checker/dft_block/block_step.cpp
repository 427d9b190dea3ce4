#include "checker/dft_block/block_step.hpp"

#include <utility>
#include <vector>

namespace veritrack::checker {

namespace {

/// sinc d and its first two derivatives over a ball: by Taylor's formula about its middle; the derivative of
/// order n is at most pi^n/(n + 1).
struct Sinc {
  Ball value, slope, bend;
};

Sinc sinc_at(const Ball& d) {
  if (certainly_less(half, abs(d))) {
    // (d sinc)'' = -pi^2 d sinc
    const Ball angle = pi() * d;
    const Ball value = sin(angle) / angle;
    const Ball slope = (cos(angle) - value) / d;
    return {value, slope, -(square(pi()) * value) - two * slope / d};
  }
  if (!certainly_less(abs(d), one)) {
    const Ball all = Ball::everything();
    return {all, all, all};
  }
  // sum over k of (-1)^k pi^2k d^2k/(2k+1)!
  constexpr int kTerms = 30;
  const Ball x = square(pi() * d);
  Ball value = zero;
  Ball slope = zero;
  Ball bend = zero;
  Ball coefficient = one;  // (-1)^k pi^2k/(2k+1)!
  Ball power = one;        // d^(2k-2), for k >= 1
  for (int k = 0; k < kTerms; ++k) {
    const Ball twice(2.0 * k);
    if (k == 0) {
      value += coefficient;
    } else {
      bend += twice * (twice - one) * coefficient * power;
      slope += twice * coefficient * power * d;
      power = power * square(d);
      value += coefficient * power;
    }
    coefficient = -coefficient * square(pi()) / Ball((2.0 * k + 2.0) * (2.0 * k + 3.0));
  }
  // For |d| < 1 each term that is left out is less than half of the one before, in all three. The first one
  // of the second derivative, with this factor, is above those of the others.
  const Ball twice(2.0 * kTerms);
  const Ball next = square(twice) * abs(coefficient) * power * (one + square(d));
  const Ball rest = Ball::within((two * next).upper());
  return {value + rest, slope + rest, bend + rest};
}

Sinc sinc_over(const Ball& d) {
  const Sinc at = sinc_at(d.middle());
  const Ball t = d - d.middle();
  const Ball bound = square(pi()) * pi() / four;
  const Ball away = d.radius();
  const Ball value = at.value + at.slope * t + half * at.bend * square(t) +
                     Ball::within(bound * away * square(away) / Ball(6.0));
  const Ball slope = at.slope + at.bend * t + Ball::within(half * bound * square(away));
  return {value, slope, at.bend + Ball::within(bound * away)};
}

BlockNumber dot(const std::vector<BlockNumber>& x, const std::vector<BlockNumber>& y) {
  BlockNumber sum(zero);
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum = sum + x[i] * y[i];
  }
  return sum;
}

using Rows = std::array<std::array<BlockNumber, 6>, 3>;

/// Turns [A | B] into [I | A^-1 B]: elimination without exchanges, balls of everything where a pivot may be
/// zero.
void eliminate(Rows& rows) {
  for (std::size_t k = 0; k < 3; ++k) {
    const BlockNumber over = reciprocal(rows[k][k]);
    for (std::size_t j = k; j < 6; ++j) {
      rows[k][j] = rows[k][j] * over;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == k) {
        continue;
      }
      const BlockNumber factor = rows[i][k];
      for (std::size_t j = k; j < 6; ++j) {
        rows[i][j] = rows[i][j] - factor * rows[k][j];
      }
    }
  }
}

}  // namespace

BlockNumbers block_step(const BlockNumbers& state, const BlockTone& tone) {
  // Taps of the estimate and of the tone; their sign (-1)^m goes away in products of the same m.
  std::vector<BlockNumber> a;
  std::vector<BlockNumber> b;
  std::vector<BlockNumber> t;
  for (int m = -tone.half_width; m <= tone.half_width; ++m) {
    const BlockNumber d = BlockNumber(tone.offset + Ball(1.0 * m)) + state[2];
    const Sinc sinc = sinc_over(d.value);
    a.push_back(d.chain(sinc.value, sinc.slope));
    b.push_back(d.chain(sinc.slope, sinc.bend));
    t.emplace_back(sinc_over(tone.offset + Ball(1.0 * m)).value);
  }
  const BlockNumber g = BlockNumber(one) + state[0];  // x1
  // h = g^2 a e^{j z_2} against t, divided by what makes R the unit matrix: rows of H are (2 g a, 0, g^2 b)
  // and (0, g^2 a, 0) in the frame of the estimate.
  const BlockNumber c = cos(state[1]);
  const BlockNumber s = sin(state[1]);
  const BlockNumber aa = dot(a, a);
  const BlockNumber ab = dot(a, b);
  const BlockNumber bb = dot(b, b);
  const BlockNumber gg = square(g);
  const BlockNumber along_a = c * dot(a, t) - gg * aa;
  const BlockNumber along_b = c * dot(b, t) - gg * ab;
  const std::array<BlockNumber, 3> v{tone.weight * (two * (g * along_a)),
                                     tone.weight * (gg * (-(s * dot(a, t)))), tone.weight * (gg * along_b)};
  const std::array<std::array<BlockNumber, 3>, 3> j{
      {{tone.weight * (four * (gg * aa)), BlockNumber(zero), tone.weight * (two * (gg * (g * ab)))},
       {BlockNumber(zero), tone.weight * (square(gg) * aa), BlockNumber(zero)},
       {tone.weight * (two * (gg * (g * ab))), BlockNumber(zero), tone.weight * (square(gg) * bb)}}};
  const std::array<std::array<std::size_t, 3>, 3> place{{{3, 4, 5}, {4, 6, 7}, {5, 7, 8}}};
  // (I + P J) X = P
  Rows rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      BlockNumber sum(i == k ? one : zero);
      for (std::size_t n = 0; n < 3; ++n) {
        sum = sum + state[place[i][n]] * j[n][k];
      }
      rows[i][k] = sum;
      rows[i][k + 3] = state[place[i][k]];
    }
  }
  eliminate(rows);
  const auto x = [&rows](std::size_t i, std::size_t k) -> const BlockNumber& { return rows[i][k + 3]; };
  std::array<BlockNumber, 3> z;
  for (std::size_t i = 0; i < 3; ++i) {
    z[i] = state[i] + x(i, 0) * v[0] + x(i, 1) * v[1] + x(i, 2) * v[2];
  }
  // The phase at the middle of the next block turns by 2 pi for each bin, and the process noise of the offset
  // is seen half a block later.
  const Ball turn = two * pi();
  return {z[0],
          z[1] + turn * z[2],
          z[2],
          x(0, 0) + BlockNumber(tone.q1),
          x(0, 1) + turn * x(0, 2),
          x(0, 2),
          x(1, 1) + (two * turn) * x(1, 2) + square(turn) * x(2, 2) +
              BlockNumber(tone.q2 + square(pi()) * tone.q3),
          x(1, 2) + turn * x(2, 2) + BlockNumber(pi() * tone.q3),
          x(2, 2) + BlockNumber(tone.q3)};
}

BlockBallFound check_ball(const BlockBall& ball, const BlockTone& tone) {
  BlockBallFound found;
  const Matrix back = ball.shape.inverse();
  std::array<Ball, kBlockStates> reach;
  BlockNumbers around;
  BlockNumbers middle;
  constexpr auto kCount = static_cast<slong>(kBlockStates);
  for (slong i = 0; i < kCount; ++i) {
    const auto at = static_cast<std::size_t>(i);
    Ball sum = zero;
    for (slong k = 0; k < kCount; ++k) {
      sum += square(back(i, k));
    }
    reach[at] = sqrt(sum);
    const Ball away = ball.radius * reach[at];
    found.all.emplace_back(ball.centre[at] - away, ball.centre[at] + away);
    around[at] = BlockNumber::variable(Ball::hull(found.all[at].low, found.all[at].high), at);
    middle[at] = BlockNumber(ball.centre[at]);
  }
  const BlockNumbers next = block_step(around, tone);
  const BlockNumbers moved = block_step(middle, tone);
  Matrix derivative(kCount, kCount);
  Matrix step(kCount, 1);
  for (slong i = 0; i < kCount; ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (slong k = 0; k < kCount; ++k) {
      derivative.set(i, k, next[at].along[static_cast<std::size_t>(k)]);
    }
    step.set(i, 0, moved[at].value - ball.centre[at] - (i == 1 ? two * pi() * ball.turns : zero));
  }
  // S DG S^-1 shortens by the rate when rate^2 I - M'M is definite.
  const Matrix m = ball.shape * derivative * back;
  Matrix left(kCount, kCount);
  for (slong i = 0; i < kCount; ++i) {
    left.set(i, i, square(ball.rate));
  }
  const bool contracts = certainly_positive(ball.radius) && certainly_positive(ball.rate) &&
                         certainly_less(ball.rate, one) && (left - m.transposed() * m).definite();
  const Matrix away = ball.shape * step;
  Ball squares = zero;
  for (slong i = 0; i < kCount; ++i) {
    squares += square(away(i, 0));
  }
  const Ball distance = sqrt(squares);
  found.is_kept = contracts && certainly_at_most(distance + ball.rate * ball.radius, ball.radius);
  for (std::size_t i = 0; i < kBlockStates; ++i) {
    const Ball to_fixed = distance / (one - ball.rate) * reach[i];
    found.fixed.emplace_back(ball.centre[i] - to_fixed, ball.centre[i] + to_fixed);
  }
  return found;
}

}  // namespace veritrack::checker
