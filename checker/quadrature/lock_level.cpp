#include "checker/quadrature/lock_level.hpp"

#include <cmath>

#include "checker/quadrature/certified_set.hpp"

namespace veritrack::checker {

namespace {

namespace proposal = lock_proposal;

/// T P T'.
LockCovariance transformed(const Metric& t, const LockCovariance& p) {
  Matrix3 metric = diagonal(t.amplitude, t.phase, t.frequency);
  metric[1][2] = t.coupling;
  return lock_covariance(congruent(metric, whole(p)));
}

/// T'^-1 D T^-1.
LockCovariance transformed_back(const Metric& t, const LockCovariance& d) {
  Matrix3 back = diagonal(one / t.amplitude, one / t.phase, one / t.frequency);
  back[2][1] = -(t.coupling / (t.phase * t.frequency));
  return lock_covariance(congruent(back, whole(d)));
}

proposal::Matrix3 rough(const LockCovariance& p) {
  return proposal::near(whole(p));
}

/// The lower triangle of the difference.
SquareMatrix<3> difference(const SquareMatrix<3>& x, const SquareMatrix<3>& y) {
  SquareMatrix<3> z;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      z[i][j] = x[i][j] - y[i][j];
    }
  }
  return z;
}

proposal::Matrix3 near_centre(const Lower3<Chord>& x) {
  proposal::Matrix3 y{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      y[i][j] = x[i][j].centre.near();
    }
  }
  return y;
}

}  // namespace

LockBox::LockBox(const std::array<double, 4>& low, const std::array<double, 4>& high)
    : level(0.5 * (low[3] + high[3])), ends{Ball(low[3]) - level, Ball(high[3]) - level} {
  for (std::size_t i = 0; i < kSides; ++i) {
    middle[i] = Ball(0.5 * (low[i] + high[i]));
    half_widths[i] = max(Ball(high[i]) - middle[i], middle[i] - Ball(low[i])).upper();
    u[i] = Chord(middle[i], middle[i] + Ball::within(half_widths[i]), i, one);
  }
}

LockLevels::LockLevels(const LockSet& set, const Metric& next)
    : next_(next),
      centre_(transformed(next, set.centre)),
      above_(transformed(next, set.above)),
      centre_inverse_(inverse(centre_)),
      below_(transformed_back(next, set.below)),
      level_of_(rough(centre_), rough(above_), rough(centre_inverse_), rough(below_)) {}

// hi(t) minus the image of hi(s), and the image of lo(s) minus lo(t), with tangents along s for the images,
// and chords along u, are affine in (u, s) except for -lo(t), which is concave in t. So the corners decide.
bool LockLevels::is_level(const SquareMatrix<3>& upper, const SquareMatrix<3>& lower,
                          const Ball& level) const {
  const LockCovariance high = centre_ + level * above_;
  const LockCovariance low = inverse(centre_inverse_ + level * below_);
  return certainly_not_negative(level) && definite(difference(whole(high), upper)) &&
         definite(difference(lower, whole(low)));
}

bool LockLevels::find(const LockBox& box, const LockStep& step,
                      std::array<Ball, kLockCorners>& levels) const {
  constexpr std::array<double, 3> kEven{1.0, 1.0, 1.0};
  std::array<SquareMatrix<3>, kLockCorners> upper;
  std::array<SquareMatrix<3>, kLockCorners> lower;
  std::array<double, kLockCorners> needed{};
  const Lower3<Chord> high = transformed(next_, step.upper);
  const Lower3<Chord> high_slope = transformed(next_, step.upper_slope);
  const Lower3<Chord> low = transformed(next_, step.lower);
  const Lower3<Chord> low_slope = transformed(next_, step.lower_slope);
  for (std::size_t end = 0; end < 2; ++end) {
    OverBox<3> most = over_box<3>(high, high_slope, box.ends[end], box.half_widths);
    OverBox<3> least = over_box<3>(low, low_slope, box.ends[end], box.half_widths);
    give_rest(most, kEven);
    take_rest(least, kEven);
    for (std::size_t corner = 0; corner < kLockCorners / 2; ++corner) {
      const std::size_t k = corner + kLockCorners / 2 * end;
      upper[k] = at_corner(most, corner);
      lower[k] = at_corner(least, corner);
      needed[k] = level_of_(proposal::near(upper[k]), proposal::near(lower[k]));
      if (!std::isfinite(needed[k])) {
        return false;
      }
    }
  }
  const proposal::LevelPlane plane = proposal::plane_above(needed);
  for (std::size_t k = 0; k < kLockCorners; ++k) {
    levels[k] = Ball(plane.middle);
    for (std::size_t i = 0; i <= kSides; ++i) {
      const Ball part(plane.along[i]);
      levels[k] += ((k >> i) & 1U) != 0U ? part : -part;
    }
    if (!is_level(upper[k], lower[k], levels[k])) {
      return false;
    }
  }
  return true;
}

double LockLevels::near_middle(const LockStep& step) const {
  return level_of_(near_centre(transformed(next_, step.upper)), near_centre(transformed(next_, step.lower)));
}

}  // namespace veritrack::checker
