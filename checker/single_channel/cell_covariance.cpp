#include "checker/single_channel/cell_covariance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

namespace {

/// D_ii = sum_j s_ij w_j / w_i: whatever w > 0, a symmetric matrix with entries of at most s_ij lies between
/// -D and D. The w are those of a matrix in the middle of the cell.
template <typename Size>
std::array<Ball, 3> row_sums(const CellCovariance& p, const Size& size) {
  const auto root = [](const CellSeries& x) {
    return Ball(std::sqrt(std::max(x.constant().near(), 1e-200)));
  };
  const Ball w1 = root(p.p11);
  const Ball w2 = root(p.p22);
  const Ball w3 = root(p.p33);
  const Ball s21 = size(p.p21);
  const Ball s31 = size(p.p31);
  const Ball s32 = size(p.p32);
  return {size(p.p11) + (s21 * w2 + s31 * w3) / w1, size(p.p22) + (s21 * w1 + s32 * w3) / w2,
          size(p.p33) + (s31 * w1 + s32 * w2) / w3};
}

}  // namespace

CellCovariance diagonal(const Ball& signal, const Ball& frequency) {
  return {signal, zero, signal, zero, zero, frequency};
}

CellCovariance scaled(const Ball& factor, const CellCovariance& p) {
  return {factor * p.p11, factor * p.p21, factor * p.p22, factor * p.p31, factor * p.p32, factor * p.p33};
}

CellCovariance less(const CellCovariance& a, const Ball& factor, const CellCovariance& b) {
  return {a.p11 - factor * b.p11, a.p21 - factor * b.p21, a.p22 - factor * b.p22,
          a.p31 - factor * b.p31, a.p32 - factor * b.p32, a.p33 - factor * b.p33};
}

bool definite(const CellCovariance& a CHECKER_DECLARED_PLACE) {
  CHECKER_IF_FORCED
  const auto [d1, d2, d3] = row_sums(a, [](const CellSeries& x) { return x.bend(); });
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      Matrix3 corner =
          checker::diagonal(a.p11.corner(x, y) - d1, a.p22.corner(x, y) - d2, a.p33.corner(x, y) - d3);
      corner[1][0] = a.p21.corner(x, y);
      corner[2][0] = a.p31.corner(x, y);
      corner[2][1] = a.p32.corner(x, y);
      if (!checker::definite(corner)) {
        return false;
      }
    }
  }
  return true;
}

CellCovariance predicted(const CellCovariance& p, const Turn& turn, const Ball& keep, const Ball& added,
                         const SingleChannelDesign& d) {
  const CellSeries mean = half * (p.p11 + p.p22);
  const CellSeries difference = half * (p.p11 - p.p22);
  const CellSeries turned = turn.twice.cosine * difference - turn.twice.sine * p.p21;
  const CellSeries t31 = turn.once.cosine * p.p31 - turn.once.sine * p.p32;
  const CellSeries t32 = turn.once.sine * p.p31 + turn.once.cosine * p.p32;
  const CellSeries g1 = -turn.here.sine;
  const CellSeries& g2 = turn.here.cosine;
  const CellSeries p31 = t31 + p.p33 * g1;
  const CellSeries p32 = t32 + p.p33 * g2;
  const CellSeries a1 = t31 + p31;
  const CellSeries a2 = t32 + p32;
  const CellSeries noise = d.q1 + added;
  return {keep * (mean + turned + a1 * g1) + noise,
          keep * (turn.twice.sine * difference + turn.twice.cosine * p.p21 + half * (a1 * g2 + a2 * g1)),
          keep * (mean - turned + a2 * g2) + noise,
          keep * p31,
          keep * p32,
          keep * p.p33 + d.q2};
}

CellCovariance updated(const CellCovariance& p, const Ball& r) {
  const CellSeries variance = p.p11 + r;
  const CellSeries over = certainly_positive(variance.range()) ? reciprocal(variance) : Ball::everything();
  const CellSeries left = r * over;
  const CellSeries k2 = p.p21 * over;
  const CellSeries k3 = p.p31 * over;
  return {left * p.p11, left * p.p21,       p.p22 - k2 * p.p21,
          left * p.p31, p.p32 - k2 * p.p31, p.p33 - k3 * p.p31};
}

CellCovariance without_remainder(CellCovariance p, const Ball& sign) {
  const auto [d1, d2, d3] = row_sums(p, [](const CellSeries& x) { return x.remainder(); });
  for (CellSeries* entry : {&p.p11, &p.p21, &p.p22, &p.p31, &p.p32, &p.p33}) {
    entry->drop_remainder();
  }
  p.p11 += sign * d1.upper();
  p.p22 += sign * d2.upper();
  p.p33 += sign * d3.upper();
  return p;
}

}  // namespace veritrack::checker
