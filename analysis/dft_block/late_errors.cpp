#include "analysis/dft_block/late_errors.hpp"

#include <algorithm>
#include <cstddef>

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::IntervalVector;
using Rows = rigor::IntervalMatrix<4, 3>;

constexpr int kMostBlocks = 100'000;
constexpr int kMostStageBlocks = 400;

/// By a millionth of it at least.
bool still_improves(const Interval& before, const Interval& after) {
  constexpr double kShare = 1.0 - 1e-6;
  return rigor::certainly_less(after, Interval(kShare) * before);
}

/// The blocks until a bound is at most `goal`, where each block multiplies it by next/goal or less; negative:
/// too many.
int blocks_to_fall(double bound, double goal, double next) {
  const Interval factor = Interval(next) / Interval(goal);
  Interval now(bound);
  constexpr int kMost = 10'000;
  for (int block = 0; block <= kMost; ++block) {
    if (rigor::certainly_less_equal(now, Interval(goal))) {
      return block;
    }
    now = Interval((now * factor).upper());
  }
  return -1;
}

/// |e| alone bounds the coordinates, too.
ErrorBounds bounds_by(const Interval& length) {
  return {length, IntervalVector<3>::Constant(Interval(length.upper()))};
}

/// Whether such errors are in the stage.
bool is_within(const ErrorBounds& bounds, const LateStage& stage) {
  for (int i = 0; i < 3; ++i) {
    if (!rigor::certainly_less_equal(bounds.coordinates(i), Interval(stage.errors.limits(i)))) {
      return false;
    }
  }
  return rigor::certainly_less_equal(bounds.length, Interval(stage.errors.radius));
}

}  // namespace

LateErrors::LateErrors(const LockFrame& frame, const LateStage& stage, const ErrorBounds& start)
    : reference_(rigor::to_interval(stage.reference)),
      excess_(rigor::to_interval(stage.excess)),
      noise_(rigor::to_interval(stage.noise)),
      slew_direction_(frame.slew_direction()),
      noise_unit_(frame.problem().noise / sqrt(frame.problem().r)),
      slew_(frame.problem().slew),
      start_(start.length.upper()),
      driven_(IntervalVector<4>::Constant(Interval(0.0))),
      offset_error_(start.length * frame.reach(2)) {
  power_.topRows<3>() = rigor::IntervalMatrix<3>::Identity();
  power_.row(3) = frame.frame().row(2);
  coordinates_.push_back(start.coordinates);
}

void LateErrors::advance() {
  // e in block m + n, for any m >= 0: reference^n e in block m, and reference^k times what is added in block
  // m + n - 1 - k.
  kernels_.emplace_back(power_.cwiseAbs() * excess_);
  for (int i = 0; i < 4; ++i) {
    const Interval square_of_noise = (power_.row(i) * noise_ * power_.row(i).transpose())(0, 0);
    driven_(i) += noise_unit_ * sqrt(max(Interval(0.0), square_of_noise)) +
                  slew_ * abs((power_.row(i) * slew_direction_)(0, 0));
  }
  power_ = Rows(power_ * reference_);
  IntervalVector<4> now = driven_;
  for (int i = 0; i < 4; ++i) {
    Interval sum(0.0);
    for (int j = 0; j < 3; ++j) {
      sum += square(power_(i, j));
    }
    now(i) += sqrt(sum) * start_;
  }
  const std::size_t last = kernels_.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    now += kernels_[k] * coordinates_[last - k];
  }
  IntervalVector<3> next;
  for (int i = 0; i < 3; ++i) {
    next(i) = Interval(std::min(now(i).upper(), coordinates_.back()(i).upper()));
  }
  coordinates_.push_back(next);
  offset_error_ = Interval(std::min(now(3).upper(), offset_error_.upper()));
}

ErrorSet ErrorBounds::enlarged(double factor) const {
  ErrorSet result{factor * length.upper(), rigor::Vector<3>::Zero()};
  for (int i = 0; i < 3; ++i) {
    result.limits(i) = factor * coordinates(i).upper();
  }
  return result;
}

ErrorBounds LateErrors::bounds() const {
  Interval sum(0.0);
  for (int i = 0; i < 3; ++i) {
    sum += square(coordinates_.back()(i));
  }
  return {min(sqrt(sum), start_), coordinates_.back()};
}

int blocks_to_approach(double above, double below, const LateStage& stage) {
  const int falls = blocks_to_fall(above, stage.above, stage.next_above);
  const int rises = blocks_to_fall(below, stage.below, stage.next_below);
  return falls < 0 || rises < 0 ? -1 : std::max(falls, rises);
}

Timeline timeline_of(const LockFrame& frame, const LockBounds& set, const LockRate& rate,
                     const std::vector<LateStage>& stages, const Interval& start) {
  Timeline result;
  const Interval disturbance = frame.disturbance();
  const Interval rest = disturbance / (Interval(1.0) - Interval(rate.rate));
  const Interval reach = frame.reach(2);
  result.ultimate = rest * reach;
  result.late = bounds_by(rest);
  // By the rate, as long as there is no stage, and until the covariances are near enough to its own.
  int waiting = stages.empty() ? -1 : blocks_to_approach(set.above, set.below, stages.front());
  const bool has_stage = waiting >= 0 && is_within(result.late, stages.front());
  Interval length(start.upper());
  ErrorBounds from = bounds_by(max(length, rest));
  bool is_through = false;
  for (int block = 1; block < kMostBlocks && !is_through; ++block) {
    from = bounds_by(max(length, rest));
    is_through = has_stage && is_within(from, stages.front()) && waiting-- == 0;
    const Interval next((Interval(rate.rate) * length + disturbance).upper());
    if (!is_through) {
      result.offset_error.push_back(from.length * reach);
      if (!has_stage && !still_improves(length, next)) {
        break;
      }
    }
    length = next;
  }
  for (std::size_t i = 0; is_through && i < stages.size(); ++i) {
    LateErrors errors(frame, stages[i], from);
    const LateStage* next = i + 1 < stages.size() ? &stages[i + 1] : nullptr;
    int left = next == nullptr ? -1 : blocks_to_approach(stages[i].above, stages[i].below, *next);
    is_through = false;
    for (int block = 0; block < kMostStageBlocks && !is_through; ++block) {
      is_through = left >= 0 && is_within(errors.bounds(), *next) && left-- == 0;
      if (!is_through) {
        result.offset_error.push_back(errors.offset_error());
        errors.advance();
      }
    }
    result.ultimate = errors.offset_error();
    from = errors.bounds();
    result.late = from;
  }
  result.offset_error.push_back(result.ultimate);
  return result;
}

}  // namespace veritrack::dft_block
