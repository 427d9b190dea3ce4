#include "analysis/quadrature/contraction/covariance_proposal.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::quadrature {

namespace {

using Block = BlockCovariance<double>;
using Design = trackers::ToneModel<double>;

Block plus(const Block& a, const Block& b, double factor) {
  return {a.p11 + factor * b.p11, a.p22 + factor * b.p22, a.p23 + factor * b.p23, a.p33 + factor * b.p33};
}

/// The positive part of a block-diagonal matrix.
Block positive_part(const Block& a) {
  constexpr double kClearly = 1e-9;  // far above what rounding does to the eigenvalues below
  const double mean = 0.5 * (a.p22 + a.p33);
  const double p11 = std::max(a.p11, 0.0);
  if (a.p22 * a.p33 - a.p23 * a.p23 > kClearly * mean * mean) {
    return mean > 0.0 ? Block{p11, a.p22, a.p23, a.p33} : Block{p11, 0.0, 0.0, 0.0};
  }
  const double half = 0.5 * (a.p22 - a.p33);
  const double radius = std::hypot(half, a.p23);
  if (mean - radius >= 0.0) {
    return {p11, a.p22, a.p23, a.p33};
  }
  if (mean + radius <= 0.0) {
    return {p11, 0.0, 0.0, 0.0};
  }
  // (mean + radius) times the projector (I + (a - mean I)/radius)/2.
  const double weight = 0.5 * (mean + radius) / radius;
  return {p11, weight * (radius + half), weight * a.p23, weight * (radius - half)};
}

double size(const Block& a) {
  return std::fabs(a.p11) + std::fabs(a.p22) + 2.0 * std::fabs(a.p23) + std::fabs(a.p33);
}

}  // namespace

std::optional<Block> steady_covariance(const Design& design) {
  constexpr int kMostSteps = 100000;
  // The amplitude by itself: p = r (p + q1) / (p + q1 + r).
  const double q = design.q1;
  const double p11 = 0.5 * (std::sqrt(q * (q + 4.0 * design.r)) - q);
  Block p{p11, design.r, 0.0, design.q2};
  for (int k = 0; k < kMostSteps; ++k) {
    Block next = riccati_update(p, 1.0, design).filtered;
    next.p11 = p11;
    const double change = size(plus(next, p, -1.0));
    p = next;
    if (change <= 1e-15 * size(p)) {
      break;
    }
  }
  const bool definite = p.p11 > 0.0 && p.p22 > 0.0 && p.p22 * p.p33 - p.p23 * p.p23 > 0.0;
  return definite && std::isfinite(size(p)) ? std::optional<Block>(p) : std::nullopt;
}

CovarianceBounds::CovarianceBounds(const Block& steady)
    : l11_(std::sqrt(steady.p11)),
      l22_(std::sqrt(steady.p22)),
      l32_(steady.p23 / l22_),
      l33_(std::sqrt(steady.p33 - l32_ * l32_)),
      low_{1.0, 1.0, 0.0, 1.0},
      high_(low_) {}

Block CovarianceBounds::enter(const Block& p) const {
  const double x22 = p.p22 / (l22_ * l22_);
  const double x23 = (p.p23 / l22_ - l32_ * x22) / l33_;
  const double x33 = (p.p33 - l32_ * l32_ * x22 - 2.0 * l32_ * l33_ * x23) / (l33_ * l33_);
  return {p.p11 / (l11_ * l11_), x22, x23, x33};
}

Block CovarianceBounds::leave(const Block& x) const {
  return {l11_ * l11_ * x.p11, l22_ * l22_ * x.p22, l22_ * (l32_ * x.p22 + l33_ * x.p23),
          l32_ * l32_ * x.p22 + 2.0 * l32_ * l33_ * x.p23 + l33_ * l33_ * x.p33};
}

/// A block bound, above (sign 1) or below (sign -1), on U Phi U' for the turns by plus and minus the angle.
/// Its off-diagonal block +-o is bounded by [[|o|, 0], [0, o o'/|o|]].
Block CovarianceBounds::image(const Block& p, const TurnSample& sample, const Design& design,
                              double sign) const {
  const Block phi = riccati_update(leave(p), sample.rho, design).filtered;
  const double cosine = 1.0 / std::sqrt(1.0 + sample.tangent * sample.tangent);
  const double sine = sample.tangent * cosine;
  const double gap = phi.p22 - phi.p11;
  const Block even{phi.p11 + sine * sine * gap, phi.p22 - sine * sine * gap, cosine * phi.p23, phi.p33};
  const double odd2 = -sine * cosine * gap / (l11_ * l22_);
  const double odd3 = (-sine * phi.p23 / l11_ - l32_ * odd2) / l33_;
  const double odd = std::hypot(odd2, odd3);
  Block bound = enter(even);
  if (odd > 0.0) {
    bound = plus(bound, {odd, odd2 * odd2 / odd, odd2 * odd3 / odd, odd3 * odd3 / odd}, sign);
  }
  return bound;
}

void CovarianceBounds::include(const CovarianceRange& range, double margin) {
  const Block unit{1.0, 1.0, 0.0, 1.0};
  const Block above = plus(enter(range.upper), unit, margin);
  const Block below = plus(enter(range.lower), unit, -margin);
  high_ = plus(high_, positive_part(plus(above, high_, -1.0)), 1.0);
  low_ = plus(low_, positive_part(plus(low_, below, -1.0)), -1.0);
}

double CovarianceBounds::iterate(const std::array<TurnSample, 9>& samples, const Design& design,
                                 double margin) {
  const Block unit{1.0, 1.0, 0.0, 1.0};
  Block high = image(high_, samples[0], design, 1.0);
  Block low = image(low_, samples[0], design, -1.0);
  for (const TurnSample& sample : samples) {
    high = plus(high, positive_part(plus(image(high_, sample, design, 1.0), high, -1.0)), 1.0);
    low = plus(low, positive_part(plus(low, image(low_, sample, design, -1.0), -1.0)), -1.0);
  }
  high = plus(high, unit, margin);
  low = plus(low, unit, -margin);
  const double moved = size(plus(high, high_, -1.0)) + size(plus(low, low_, -1.0));
  high_ = high;
  low_ = low;
  return moved;
}

bool CovarianceBounds::usable() const {
  constexpr double kLargest = 1000.0;
  return low_.p11 > 0.0 && low_.p22 > 0.0 && low_.p22 * low_.p33 - low_.p23 * low_.p23 > 0.0 &&
         size(high_) < kLargest && size(low_) < kLargest;
}

}  // namespace veritrack::quadrature
