#include "checker/quadrature/followed_starts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "checker/numbers/gradient.hpp"
#include "checker/quadrature/rounded_step.hpp"

namespace veritrack::checker {

namespace {

/// The degree of the polynomials in which derivatives are enclosed.
constexpr std::size_t kSlopeDegree = 2;
constexpr std::size_t kMostGenerators = 90;
constexpr std::size_t kKeptGenerators = 45;

/// With respect to the state and the noise.
using Sensitive = Gradient<Polynomial, kStateSize + 2>;
/// Metric (e - origin), then the covariance in the frame of the estimated phase. arg z is taken about
/// `angle`.
template <typename S>
State<S> polar_of(const State<S>& x, const Matrix3& metric, const std::array<Ball, 3>& origin,
                  const Ball& angle) {
  const S& z1 = x[kZ1];
  const S& z2 = x[kZ2];
  const S length = sqrt(square(z1) + square(z2));
  const S over = reciprocal(length);
  const S tangent = (cos(angle) * z2 - sin(angle) * z1) * reciprocal(cos(angle) * z1 + sin(angle) * z2);
  const std::array<S, 3> error{length - S(one + origin[0]), arctangent(tangent) + S(angle - origin[1]),
                               x[kNu] - S(origin[2])};
  State<S> result = x;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = metric[i][0] * error[0] + metric[i][1] * error[1] + metric[i][2] * error[2];
  }
  turn(result, S(over * z1), S(-(over * z2)));
  return result;
}

/// Everything within `radii` of the polynomials, with the derivatives with respect to each coordinate.
State<Sensitive> neighbourhood(const State<Polynomial>& middle, const State<Ball>& radii) {
  State<Sensitive> x;
  for (std::size_t i = 0; i < kStateSize; ++i) {
    x[i] = Sensitive::variable(middle[i].lowered(kSlopeDegree, radii[i]), i);
  }
  return x;
}

Ball largest(const Ball& x) {
  return abs(x).upper();
}

}  // namespace

FollowedStarts::FollowedStarts(const Loop& loop, const Starts& starts, const Matrix3& covariance)
    : loop_(loop) {
  const Polynomial phase = Polynomial::variable(starts.phase, 0);
  const Polynomial cosine = cos(phase);
  const Polynomial sine = sin(phase);
  // The estimate is in its own direction: its length is not negative.
  const Polynomial length = certainly_positive(one + starts.amplitude)
                                ? Polynomial(one) + Polynomial::variable(starts.amplitude, 2)
                                : Polynomial(Ball::everything());
  middle_[kZ1] = length * cosine;
  middle_[kZ2] = length * sine;
  middle_[kNu] = Polynomial::variable(starts.frequency, 1);
  std::size_t at = kP11;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      middle_[at++] = Polynomial(covariance[i][j]);
    }
  }
  turn(middle_, cosine, sine);
  round();
}

State<Ball> FollowedStarts::radii() const {
  State<Ball> sums;
  for (const State<Ball>& generator : generators_) {
    for (std::size_t i = 0; i < kStateSize; ++i) {
      sums[i] += abs(generator[i]);
    }
  }
  return sums;
}

void FollowedStarts::add_box(const State<Ball>& radii) {
  for (std::size_t i = 0; i < kStateSize; ++i) {
    generators_.emplace_back();
    generators_.back()[i] = radii[i].upper();
  }
}

void FollowedStarts::round() {
  State<Ball> distances;
  for (std::size_t i = 0; i < kStateSize; ++i) {
    distances[i] = middle_[i].round();
  }
  add_box(distances);
}

void FollowedStarts::merge_smallest() {
  if (generators_.size() <= kMostGenerators) {
    return;
  }
  // By their share in the extent of the set; any order is valid.
  const State<Ball> extent = radii();
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t j = 0; j < generators_.size(); ++j) {
    double share = 0.0;
    for (std::size_t i = 0; i < kStateSize; ++i) {
      const double part = std::fabs(generators_[j][i].near()) / extent[i].near();
      share += std::isfinite(part) ? part : 0.0;
    }
    order.emplace_back(-share, j);
  }
  std::sort(order.begin(), order.end());
  std::vector<State<Ball>> kept;
  State<Ball> rest;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const State<Ball>& generator = generators_[order[k].second];
    if (k < kKeptGenerators) {
      kept.push_back(generator);
      continue;
    }
    for (std::size_t i = 0; i < kStateSize; ++i) {
      rest[i] += abs(generator[i]);
    }
  }
  generators_ = std::move(kept);
  add_box(rest);
}

State<Ball> FollowedStarts::rounding() const {
  const State<Ball> extent = radii();
  State<Ball> now;
  for (std::size_t i = 0; i < kStateSize; ++i) {
    now[i] = middle_[i].range() + Ball::within(extent[i]);
  }
  const Matrix3 p{{{now[kP11], now[kP12], now[kP13]},
                   {now[kP12], now[kP22], now[kP23]},
                   {now[kP13], now[kP23], now[kP33]}}};
  Held held;
  held.z = root_of_non_negative(square(now[kZ1]) + square(now[kZ2])).upper();
  held.frequency = (loop_.largest_frequency + abs(now[kNu])).upper();
  held.measurement = one + loop_.noise;
  add_covariance(p, p, held);
  const Rounding r = rounded_step({loop_.q1, loop_.q2, loop_.r, loop_.epsilon, loop_.amplitude}, held);
  return {r.z, r.z, r.frequency, r.p_zz, r.p_zz, r.p_z3, r.p_zz, r.p_z3, r.p_33};
}

void FollowedStarts::step() {
  const Ball wobble = Ball::within(loop_.noise);
  const Polynomial noise(wobble);
  const State<Sensitive> slopes = checker::step<Sensitive>(
      loop_, neighbourhood(middle_, radii()),
      {Sensitive::variable(noise, kStateSize), Sensitive::variable(noise, kStateSize + 1)});
  // {G_x e + G_v v}: the middles of the products are generators, their radii a box.
  for (std::size_t v = 0; v < 2; ++v) {
    generators_.emplace_back();
  }
  State<Ball> box = rounding();
  box[kNu] += loop_.slew;
  std::vector<State<Ball>> images(generators_.size());
  std::array<std::array<Ball, kStateSize + 2>, kStateSize> matrix;
  for (std::size_t i = 0; i < kStateSize; ++i) {
    for (std::size_t j = 0; j < kStateSize + 2; ++j) {
      matrix[i][j] = slopes[i].along[j].range();
    }
  }
  for (std::size_t g = 0; g < images.size(); ++g) {
    for (std::size_t i = 0; i < kStateSize; ++i) {
      Ball sum;
      if (g + 2 >= images.size()) {
        sum = matrix[i][kStateSize + g + 2 - images.size()] * loop_.noise;
      } else {
        for (std::size_t j = 0; j < kStateSize; ++j) {
          arb_addmul(sum.raw(), matrix[i][j].raw(), generators_[g][j].raw(), precision());
        }
      }
      images[g][i] = sum.middle();
      box[i] += sum.radius();
    }
  }
  generators_ = std::move(images);
  add_box(box);
  middle_ = checker::step<Polynomial>(loop_, middle_, {Polynomial(), Polynomial()});
  round();
  merge_smallest();
}

Ball FollowedStarts::frequency_error() const {
  return middle_[kNu].range() + Ball::within(radii()[kNu]);
}

PolarEnclosure FollowedStarts::polar(const Matrix3& metric, const std::array<Ball, 3>& origin) const {
  // Near the middle: any angle is valid.
  const double angle = std::atan2(middle_[kZ2].constant().near(), middle_[kZ1].constant().near());
  const State<Ball> extent = radii();
  const auto middle = polar_of<Polynomial>(middle_, metric, origin, Ball(angle));
  const auto slopes = polar_of<Sensitive>(neighbourhood(middle_, extent), metric, origin, Ball(angle));
  // On the segments arg z = angle + atan(tangent): only if z stays on the side that `angle` points to.
  const Ball ahead = cos(Ball(angle)) * (middle_[kZ1].range() + Ball::within(extent[kZ1])) +
                     sin(Ball(angle)) * (middle_[kZ2].range() + Ball::within(extent[kZ2]));
  State<Ball> found;
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::array<Ball, kStateSize> row;
    for (std::size_t j = 0; j < kStateSize; ++j) {
      row[j] = slopes[i].along[j].range();
    }
    Ball way;
    for (const State<Ball>& generator : generators_) {
      Ball sum;
      for (std::size_t j = 0; j < kStateSize; ++j) {
        arb_addmul(sum.raw(), row[j].raw(), generator[j].raw(), precision());
      }
      way += largest(sum);
    }
    // cannot bind (ahead): the tangents are divided by it, and it is positive in the middle.
    found[i] = certainly_positive(ahead) ? middle[i].range() + Ball::within(way) : Ball::everything();
  }
  return {{found[0], found[1], found[2]},
          {{{found[3], found[4], found[5]}, {found[4], found[6], found[7]}, {found[5], found[7], found[8]}}}};
}

}  // namespace veritrack::checker
