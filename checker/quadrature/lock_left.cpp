#include "checker/quadrature/lock_left.hpp"

#include <cmath>
#include <cstddef>

namespace veritrack::checker {

namespace {

constexpr std::size_t kEndsOfLevel = 2;
constexpr std::size_t kCornersOfErrors = kLockCorners / kEndsOfLevel;

Ball at_side(const Ball& way, std::size_t corner, std::size_t i) {
  return ((corner >> i) & 1U) != 0U ? way : -way;
}

/// Twice the level in the middle, and the change of the level's tangent from there to the corners, not
/// doubled.
struct TangentOfLevel {
  Ball twice_middle;
  LockCorners moved;
};
TangentOfLevel tangent_of_level(const LockSet& set, const LockBox& box) {
  TangentOfLevel tangent{set.weight * square(box.level), {}};
  for (const Ball& u : box.middle) {
    tangent.twice_middle += square(u);
  }
  for (std::size_t k = 0; k < kLockCorners; ++k) {
    tangent.moved[k] = set.weight * box.level * box.ends[k / kCornersOfErrors];
    for (std::size_t i = 0; i < kSides; ++i) {
      tangent.moved[k] += at_side(box.middle[i] * box.half_widths[i], k, i);
    }
  }
  return tangent;
}

/// T^-1 u.
std::array<Ball, 3> errors_of(const Metric& t, const std::array<Ball, 3>& u) {
  const Ball frequency = u[2] / t.frequency;
  return {u[0] / t.amplitude, (u[1] - t.coupling * frequency) / t.phase, frequency};
}
std::array<Ball, 3> image(const Metric& t, const std::array<Ball, 3>& e) {
  return {t.amplitude * e[0], t.phase * e[1] + t.coupling * e[2], t.frequency * e[2]};
}

/// R (e - f).
std::array<Ball, 3> image_of_errors(const LockMeanSquare& form, const std::array<Ball, 3>& e) {
  const std::array<Ball, 3>& f = form.offset;
  return image(form.metric, {e[0] - f[0], e[1] - f[1], e[2] - f[2]});
}

/// |R (e - f)|^2 - h nu^2, convex.
Ball left_of_errors(const LockSet& set, const LockMeanSquare& form, const std::array<Ball, 3>& u) {
  const std::array<Ball, 3> e = errors_of(set.metric, u);
  const std::array<Ball, 3> y = image_of_errors(form, e);
  return square(y[0]) + square(y[1]) + square(y[2]) - form.rate * square(e[2] + set.bias[2]);
}

/// The change of its tangent in the middle along each variable, to the end of the box.
std::array<Ball, 3> tangent_of_errors(const LockSet& set, const LockMeanSquare& form, const LockBox& box) {
  const std::array<Ball, 3> e = errors_of(set.metric, box.middle);
  const std::array<Ball, 3> y = image_of_errors(form, e);
  std::array<Ball, 3> along;
  for (std::size_t i = 0; i < kSides; ++i) {
    std::array<Ball, 3> way;
    way[i] = box.half_widths[i];
    const std::array<Ball, 3> moved = errors_of(set.metric, way);
    const std::array<Ball, 3> z = image(form.metric, moved);
    along[i] = two * (y[0] * z[0] + y[1] * z[1] + y[2] * z[2] - form.rate * (e[2] + set.bias[2]) * moved[2]);
  }
  return along;
}

}  // namespace

double near_twice_level(const LockSet& set, const LockBox& box) {
  double twice = set.weight.near() * std::pow(box.level.near(), 2);
  for (const Ball& u : box.middle) {
    twice += std::pow(u.near(), 2);
  }
  return twice;
}

Metric with_lock_room(const Metric& metric) {
  const Ball more = one + lock_room();
  return {more * metric.amplitude, more * metric.phase, more * metric.coupling, more * metric.frequency};
}

LockLeft left_of_drift(const LockSet& set) {
  const auto at_corners = [set](const LockBox& box, const LockCorners& levels) {
    // 2 log(kappa W + c_0) is convex in (u, s), so that its tangent is below it; -t^2 is concave.
    const TangentOfLevel tangent = tangent_of_level(set, box);
    const Ball over = set.drift * exp(-(half * tangent.twice_middle));
    const Ball share = two * set.decay / (set.decay + over);
    const Ball middle = tangent.twice_middle + two * log(set.decay + over) - two * lock_room();
    LockCorners left;
    for (std::size_t k = 0; k < kLockCorners; ++k) {
      left[k] = middle + share * tangent.moved[k] - set.weight * square(levels[k] + lock_room());
    }
    return left;
  };
  const auto near_middle = [set](const LockBox& box, double level) {
    const double twice = near_twice_level(set, box);
    return twice + 2.0 * std::log(set.decay.near() + set.drift.near() * std::exp(-0.5 * twice)) -
           set.weight.near() * level * level;
  };
  return {with_lock_room(set.metric), at_corners, near_middle};
}

Ball relative_norm_squared(const LockMeanSquare& mean_square, const LockSet& set) {
  Ball sum;
  for (std::size_t i = 0; i < kSides; ++i) {
    std::array<Ball, 3> unit;
    unit[i] = one;
    for (const Ball& entry : image(mean_square.metric, errors_of(set.metric, unit))) {
      sum += square(entry);
    }
  }
  return sum.upper();
}

Ball offset_length(const LockMeanSquare& mean_square) {
  Ball sum;
  for (const Ball& entry : image(mean_square.metric, mean_square.offset)) {
    sum += square(entry);
  }
  return root_of_non_negative(sum);
}

LockLeft left_of_mean_square(const LockSet& set, const LockMeanSquare& mean_square) {
  // |R rho| <= |R T^-1| room, and |x + rho|^2 <= (1 + room)|x|^2 + (1 + 1/room)|rho|^2.
  const Ball rounding = (lock_room() + square(lock_room())) * relative_norm_squared(mean_square, set);
  const Ball constant = mean_square.rate * mean_square.bound - mean_square.share * set.drift - rounding;
  const Ball growth = mean_square.share * (one - set.decay);
  const auto at_corners = [set, form = mean_square, constant, growth](const LockBox& box,
                                                                      const LockCorners& levels) {
    const TangentOfLevel tangent = tangent_of_level(set, box);
    const std::array<Ball, 3> along = tangent_of_errors(set, form, box);
    const Ball level = half * tangent.twice_middle;
    // W >= exp(x) (1 + level - x) for any x, here about the least in the box; level and s^2 are convex.
    double least = tangent.moved[0].near();
    for (const Ball& moved : tangent.moved) {
      least = std::fmin(least, moved.near());
    }
    const Ball x(std::fmax(0.0, level.near() + least));
    const Ball share = growth * exp(x);
    const Ball middle = left_of_errors(set, form, box.middle) + form.weight * square(box.level) + constant +
                        share * (one + level - x);
    LockCorners left;
    for (std::size_t k = 0; k < kLockCorners; ++k) {
      left[k] = middle + two * form.weight * box.level * box.ends[k / kCornersOfErrors] +
                share * tangent.moved[k] - form.weight * square(levels[k] + lock_room());
      for (std::size_t i = 0; i < kSides; ++i) {
        left[k] += at_side(along[i], k, i);
      }
    }
    return left;
  };
  const auto near_middle = [set, form = mean_square, constant, growth](const LockBox& box, double level) {
    const double s = box.level.near();
    return left_of_errors(set, form, box.middle).near() + constant.near() +
           form.weight.near() * (s * s - level * level) +
           growth.near() * std::exp(0.5 * near_twice_level(set, box));
  };
  return {with_lock_room(mean_square.metric), at_corners, near_middle, mean_square.offset};
}

}  // namespace veritrack::checker
