#include "checker/dft_block/late_errors.hpp"

#include <algorithm>
#include <optional>

#include "checker/dft_block/block_matrices.hpp"

namespace veritrack::checker {

namespace {

Ball times(const Vector3& x, const Vector3& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

Ball length_of(const Vector3& x) {
  return sqrt(times(x, x));
}

Vector3 sizes(const Vector3& x) {
  return {abs(x[0]).upper(), abs(x[1]).upper(), abs(x[2]).upper()};
}

Ball smaller(const Ball& x, const Ball& y) {
  return certainly_at_most(x, y) ? x : y;
}

/// Upper bounds on |C^-1 z| and on its coordinates.
struct Sizes {
  Ball length;
  Vector3 coordinates;

  [[nodiscard]] bool within(const BlockErrorSet& errors) const {
    bool all = certainly_at_most(length, errors.radius);
    for (std::size_t i = 0; i < 3; ++i) {
      all = all && certainly_at_most(coordinates[i], errors.limits[i]);
    }
    return all;
  }
};

Sizes ball_of(const Ball& length) {
  return {length, {length, length, length}};
}

/// A linear function of the errors, a block further each time: its row, and what it has taken up.
struct Follower {
  Vector3 row;
  Ball start, taken;          ///< at most: of the stage's first errors, and of noise and slew since
  std::vector<Vector3> from;  ///< at most: of the errors j blocks back, by the excess
  std::vector<Ball> at_most;  ///< the function from each block of the stage on
};

/// A stage, block by block: bounds from a block on hold for ever, because they are about windows of which
/// the first block is any one of the stage.
class StageErrors {
 public:
  StageErrors(const BlockLock& lock, const BlockStage& stage, const Sizes& begin)
      : stage_(stage), slew_(lock.slew_direction()), noise_(lock.noise_unit()), slew_size_(lock.slew()) {
    const Matrix3 unit = identity(one);
    const Ball length = begin.length.upper();
    for (std::size_t i = 0; i < 3; ++i) {
      followers_.push_back({unit[i], length, zero, {}, {begin.coordinates[i].upper()}});
    }
    const Vector3& row = lock.offset_row();
    followers_.push_back({row, length, zero, {}, {(length_of(row) * length).upper()}});
  }

  void advance() {
    const std::size_t now = followers_[0].at_most.size();
    for (Follower& one_follower : followers_) {
      Vector3& row = one_follower.row;
      const Vector3 sized = sizes(row);
      Vector3 excess;
      Vector3 gain;
      Vector3 next;
      for (std::size_t j = 0; j < 3; ++j) {
        excess[j] = times(sized, column(stage_.excess, j));
        gain[j] = times(row, column(stage_.noise, j));
        next[j] = times(row, column(stage_.reference, j));
      }
      one_follower.from.push_back(sizes(excess));
      const Ball noise = max(zero, times(gain, row).upper());
      one_follower.taken =
          (one_follower.taken + noise_ * sqrt(noise) + slew_size_ * abs(times(row, slew_))).upper();
      row = next;
    }
    std::vector<Ball> found;
    for (const Follower& one_follower : followers_) {
      Ball sum = one_follower.taken + length_of(one_follower.row) * one_follower.start;
      for (std::size_t back = 0; back < now; ++back) {
        const std::size_t block = now - 1 - back;
        sum += times(one_follower.from[back], {followers_[0].at_most[block], followers_[1].at_most[block],
                                               followers_[2].at_most[block]});
      }
      found.push_back(sum.upper());
    }
    for (std::size_t i = 0; i < followers_.size(); ++i) {
      followers_[i].at_most.push_back(smaller(found[i], followers_[i].at_most.back()));
    }
  }

  [[nodiscard]] Ball offset() const { return followers_[3].at_most.back(); }
  [[nodiscard]] Sizes sizes_now() const {
    const Vector3 now{followers_[0].at_most.back(), followers_[1].at_most.back(),
                      followers_[2].at_most.back()};
    return {smaller(length_of(now), followers_[0].start), now};
  }

 private:
  static Vector3 column(const Matrix3& a, std::size_t j) { return {a[0][j], a[1][j], a[2][j]}; }

  const BlockStage& stage_;
  Vector3 slew_;
  Ball noise_, slew_size_;
  std::vector<Follower> followers_;  ///< the coordinates of C^-1 z, and the offset error
};

/// The blocks after which the covariance is between a stage's bounds, when it begins between others. In each
/// direction the next variance is a concave function of the multiple x of C C' at hand, not negative at 0:
/// above a bound x that a block makes `next`, it is at most next/x of what it was, and below one at least.
std::optional<int> blocks_to(const BlockStage& stage, Ball above, Ball below) {
  constexpr int kMost = 10'000;
  for (int block = 0; block <= kMost; ++block) {
    if (certainly_at_most(above, stage.set.above) && certainly_at_most(below, stage.set.below)) {
      return block;
    }
    above = (above * stage.next_above / stage.set.above).upper();
    below = (below * stage.next_below / stage.set.below).upper();
  }
  return std::nullopt;
}

constexpr int kMostBlocks = 100'000;
constexpr int kMostStageBlocks = 400;

/// Block by block until the first stage begins, if it does, with bounds that hold for ever; the errors with
/// which it begins.
std::optional<Sizes> before_stages(const BlockLock& lock, const BlockHistory& history,
                                   std::vector<Ball>& offset) {
  const BlockStage* first = history.stages.empty() ? nullptr : &history.stages[0];
  const auto wait = first == nullptr ? std::nullopt : blocks_to(*first, lock.set().above, lock.set().below);
  const Ball added = lock.disturbance();
  const Ball rest = added / (one - history.rate.rate);
  Ball length = history.start.upper();
  int in_stage = 0;
  for (int block = 1; block < kMostBlocks; ++block) {
    const Ball for_ever = max(length, rest);
    if (wait && ball_of(for_ever).within(first->errors) && in_stage++ == *wait) {
      return ball_of(for_ever);
    }
    offset.push_back((for_ever * lock.reach(2)).upper());
    const Ball next = (history.rate.rate * length + added).upper();
    constexpr double kSmallStep = 1.0 - 1e-6;
    if (!certainly_less(next, Ball(kSmallStep) * length) && in_stage == 0) {
      break;
    }
    length = next;
  }
  return std::nullopt;
}

}  // namespace

BlockErrors block_errors(const BlockLock& lock, const BlockHistory& history, bool& all_reached) {
  BlockErrors found;
  found.ultimate = lock.disturbance() / (one - history.rate.rate) * lock.reach(2);
  std::optional<Sizes> begin = before_stages(lock, history, found.offset);
  std::size_t reached = 0;
  while (begin && reached < history.stages.size()) {
    const BlockStage& stage = history.stages[reached++];
    const BlockStage* next = reached < history.stages.size() ? &history.stages[reached] : nullptr;
    const auto wait = next == nullptr ? std::nullopt : blocks_to(*next, stage.set.above, stage.set.below);
    StageErrors errors(lock, stage, *begin);
    begin.reset();
    int in_next = 0;
    for (int block = 0; block < kMostStageBlocks; ++block) {
      if (wait && errors.sizes_now().within(next->errors) && in_next++ == *wait) {
        begin = errors.sizes_now();
        break;
      }
      found.offset.push_back(errors.offset());
      errors.advance();
    }
    found.ultimate = errors.offset();
  }
  found.offset.push_back(found.ultimate);
  all_reached = reached == history.stages.size();
  return found;
}

}  // namespace veritrack::checker
