#include "checker/kkl_observer/moves.hpp"

#include <algorithm>
#include <cmath>

#include "checker/kkl_observer/filter_deviation.hpp"

namespace veritrack::checker {

namespace {

constexpr int kPeriods = 16;
constexpr double kMostPeriods = 1000.0;
constexpr int kTimes = 120;

bool nearer(const Ball& x, const Ball& y) {
  return x.near() < y.near();
}

Ball squared_length(const Ball& x, const Ball& y) {
  return square(x) + square(y);
}

/// The sum of q_i x_i.
Ball dot(std::span<const Ball> q, const Filters& x) {
  Ball sum(0.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    sum += q[i] * x[i];
  }
  return sum;
}

}  // namespace

Moves::Moves(const KklDesign& design, const Ball& settling_time)
    : lambda_(design.lambda), left_(lambda_.size()), tail_(lambda_.size()) {
  sinusoid_ = design.disturbance_amplitude.value_or(zero) / design.amplitude_low;
  bound_ = design.bound.value_or(zero) / design.amplitude_low;
  if (design.disturbance_frequency) {
    cut_periods(design);
  } else if (design.bound) {
    cut_time();
  }
  const Filters deviation = filter_deviation(design);
  const auto gain = [](const Ball& rate, const Ball& frequency) {
    return one / sqrt(square(rate) + square(frequency));
  };
  for (std::size_t i = 0; i < lambda_.size(); ++i) {
    Ball start = gain(lambda_[i], design.frequency_low);
    if (design.disturbance_frequency) {
      start += sinusoid_ * gain(lambda_[i], *design.disturbance_frequency);
    }
    left_[i] = exp(-(lambda_[i] * settling_time)) * start + deviation[i];
  }
}

void Moves::cut_periods(const KklDesign& design) {
  const Ball longest = one / *design.disturbance_frequency;
  // Dense at first, where the responses of fast filters still change: a proposal, as every partition is
  // valid.
  const double bend = 1.0 / std::max_element(lambda_.begin(), lambda_.end(), nearer)->near();
  const double growth = std::log1p(longest.near() / bend);
  const int periods = kPeriods + static_cast<int>(std::min(kPeriods * growth, kMostPeriods));
  Ball begin(0.0);
  for (int k = 0; k < periods; ++k) {
    const Ball end = k + 1 == periods ? longest : Ball(bend * std::expm1(growth * (k + 1) / periods));
    const Ball middle = half * (begin + end);
    const Filters none(lambda_.size());
    Cell cell{end - begin, end - middle, {none, none}, {none, none}, none, {}};
    for (std::size_t i = 0; i < lambda_.size(); ++i) {
      // With h = 1 / (lambda r + j): r h, its derivative j h^2, and the next one, 2 lambda |h|^3 in size.
      const Ball& rate = lambda_[i];
      const Ball over = reciprocal(square(rate * middle) + one);
      const Ball real = rate * middle * over;
      cell.middle[0][i] = middle * real;
      cell.middle[1][i] = -(middle * over);
      cell.slope[0][i] = two * real * over;
      cell.slope[1][i] = square(real) - square(over);
      const Ball largest = reciprocal(sqrt(square(rate * begin) + one));
      cell.bending[i] = rate * square(largest) * largest;
    }
    cells_.push_back(std::move(cell));
    begin = end;
  }
}

void Moves::cut_time() {
  const auto [slowest, fastest] = std::minmax_element(lambda_.begin(), lambda_.end(), nearer);
  // Dense at first, where fast filters still move: a proposal, as every partition is valid.
  const double bend = 1.0 / fastest->near();
  const double growth = std::log1p(18.0 / slowest->near() / bend);
  const auto decay = [&](std::size_t i, const Ball& time) { return exp(-(lambda_[i] * time)); };
  Ball begin(0.0);
  for (int k = 0; k < kTimes; ++k) {
    const Ball end(bend * std::expm1(growth * (k + 1) / kTimes));
    const Ball middle = half * (begin + end);
    const Filters none(lambda_.size());
    Cell cell{end - begin, end - middle, {none, {}}, {none, {}}, none, none};
    for (std::size_t i = 0; i < lambda_.size(); ++i) {
      const Ball before = decay(i, begin);
      const Ball after = decay(i, end);
      cell.middle[0][i] = decay(i, middle);
      cell.slope[0][i] = -(lambda_[i] * cell.middle[0][i]);
      cell.bending[i] = half * square(lambda_[i]) * before;
      cell.integral[i] = (before - after) / lambda_[i];
    }
    cells_.push_back(std::move(cell));
    begin = end;
  }
  for (std::size_t i = 0; i < lambda_.size(); ++i) {
    tail_[i] = decay(i, begin) / lambda_[i];
  }
}

Ball Moves::largest_response(std::span<const Ball> q) const {
  Ball largest(0.0);
  for (const Cell& cell : cells_) {
    const Ball real = dot(q, cell.middle[0]);
    const Ball imaginary = dot(q, cell.middle[1]);
    const Ball real_change = cell.half_width * dot(q, cell.slope[0]);
    const Ball imaginary_change = cell.half_width * dot(q, cell.slope[1]);
    // |a + b t| is largest at an end.
    const Ball squared = max(squared_length(real + real_change, imaginary + imaginary_change),
                             squared_length(real - real_change, imaginary - imaginary_change));
    largest = max(largest, root_of_non_negative(squared) + bending(q, cell)).upper();
  }
  return largest;
}

Ball Moves::bending(std::span<const Ball> q, const Cell& cell) {
  Ball sum(0.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    sum += abs(q[i]) * cell.bending[i];
  }
  return square(cell.half_width) * sum;
}

Ball Moves::kernel_integral(std::span<const Ball> q) const {
  Ball sum(0.0);
  for (const Cell& cell : cells_) {
    const Ball kernel = dot(q, cell.middle[0]) + Ball::within(cell.half_width * dot(q, cell.slope[0])) +
                        Ball::within(bending(q, cell));
    const bool one_sign = certainly_positive(kernel) || certainly_positive(-kernel);
    sum += one_sign ? abs(dot(q, cell.integral)) : cell.width * abs(kernel).upper();
  }
  for (std::size_t i = 0; i < lambda_.size(); ++i) {
    sum += abs(q[i]) * tail_[i];
  }
  return sum;
}

Ball Moves::reach(std::size_t filter, const Ball& gain) const {
  return (gain + (sinusoid_ + bound_) / lambda_[filter] + left_[filter]).upper();
}

Size Moves::size(std::span<const Ball> q) const {
  Size size{zero, zero};
  // cannot bind (sinusoid_, bound_): the disturbance that there is not has amplitude 0.
  const bool is_sinusoid = certainly_positive(sinusoid_);
  // cannot bind (sinusoid_, bound_): the same.
  const bool is_bounded = certainly_positive(bound_);
  if (is_sinusoid) {
    size.driven = (sinusoid_ * largest_response(q)).upper();
  } else if (is_bounded) {
    size.driven = (bound_ * kernel_integral(q)).upper();
  }
  for (std::size_t i = 0; i < lambda_.size(); ++i) {
    size.left += abs(q[i]) * left_[i];
  }
  size.left = size.left.upper();
  return size;
}

}  // namespace veritrack::checker
