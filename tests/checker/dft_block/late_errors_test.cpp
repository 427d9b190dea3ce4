// When a stage begins: after as many blocks as both bounds of the covariance need to come into its set.
#include "checker/dft_block/late_errors.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "checker/dft_block/block_matrices.hpp"

namespace veritrack::checker {
namespace {

/// A lock whose covariance is between its steady one/below and above times it, without noise or slew.
BlockLock lock_between(double above, double below) {
  BlockProblem problem;
  problem.q1 = problem.q2 = problem.q3 = Ball(20.0);
  problem.r = problem.amplitude_low = problem.amplitude_high = one;
  problem.noise = problem.slew = zero;
  return {problem, {identity(one), Ball(above), Ball(below), zero}};
}

Matrix3 multiple_of_identity(double factor) {
  return identity(Ball(factor));
}

/// A stage for all errors, in which a block takes both bounds from 2 to 1, and errors to half of them.
BlockStage halving_stage() {
  BlockStage stage;
  stage.set = {identity(one), two, two, zero};
  stage.errors = {Ball(8.0), {Ball(8.0), Ball(8.0), Ball(8.0)}};
  stage.next_above = stage.next_below = one;
  stage.noise_weight = one;
  stage.reference = multiple_of_identity(0.5);
  stage.excess = stage.noise = multiple_of_identity(0.0);
  return stage;
}

struct Found {
  std::size_t blocks;  ///< until the offset is about half of that of the start
  bool all_reached;
};

Found before(const BlockStage& stage, double above, double below) {
  bool all_reached = false;
  const Ball slow(1.0 - 0x1p-10);
  const BlockErrors errors =
      block_errors(lock_between(above, below), {{Ball(4.0), slow, one}, {stage}, two}, all_reached);
  std::size_t blocks = 0;
  const double first = errors.offset.front().upper_double();
  while (blocks < errors.offset.size() && errors.offset[blocks].upper_double() > 0.75 * first) {
    ++blocks;
  }
  return {blocks, all_reached};
}

TEST_CASE("a stage begins after as many halvings as each bound of the covariance needs") {
  for (const int above : {0, 1, 3}) {
    for (const int below : {0, 1, 3, 5}) {
      CAPTURE(above);
      CAPTURE(below);
      const Found found = before(halving_stage(), double(2 << above), double(2 << below));
      CHECK(found.all_reached);
      CHECK(found.blocks == 1 + static_cast<std::size_t>(std::max(above, below)));
    }
  }
}

TEST_CASE("a stage whose bounds do not come nearer does not begin") {
  BlockStage stage = halving_stage();
  stage.next_below = two;
  CHECK(before(stage, 4.0, 2.0).all_reached);
  CHECK_FALSE(before(stage, 4.0, 4.0).all_reached);
  stage = halving_stage();
  stage.next_above = two;
  CHECK(before(stage, 2.0, 4.0).all_reached);
  CHECK_FALSE(before(stage, 4.0, 4.0).all_reached);
}

}  // namespace
}  // namespace veritrack::checker
