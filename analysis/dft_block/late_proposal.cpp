#include "analysis/dft_block/late_proposal.hpp"

#include <algorithm>
#include <limits>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::dft_block {

namespace {

using PointMatrix = rigor::Matrix<3>;

/// Between the bounds on covariances and what a block makes of them.
void choose_next_bounds(const LockSearch& search, const std::vector<BlockSample>& samples, LateStage& stage) {
  const PointMatrix turn = search.turn_in_frame();
  double highest = 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  for (const BlockSample& one : samples) {
    for (const PointMatrix& noise : search.process_noises_in_frame()) {
      const PointMatrix up = turn * (one.centre + one.spread) * turn.transpose() + noise;
      const PointMatrix down = turn * (one.centre - one.spread) * turn.transpose() + noise;
      highest = std::max(highest, -smallest_eigenvalue(-up));
      lowest = std::min(lowest, smallest_eigenvalue(down));
    }
  }
  stage.next_above = std::max(1.0, 0.5 * (stage.above + highest));
  stage.next_below = std::max(1.0, 0.5 * (stage.below + 1.0 / lowest));
}

/// The middle of the steps, and their distances from it.
void choose_reference(const std::vector<BlockSample>& samples, LateStage& stage) {
  PointMatrix low = PointMatrix::Constant(std::numeric_limits<double>::infinity());
  PointMatrix high = -low;
  for (const BlockSample& one : samples) {
    const PointMatrix seen = one.secant.transpose() * one.spread * one.secant;
    const PointMatrix away = (one.turned.diagonal() * seen.diagonal().transpose()).cwiseSqrt();
    low = low.cwiseMin(one.step - away);
    high = high.cwiseMax(one.step + away);
  }
  constexpr double kRoom = 1.2;
  constexpr double kShare = 0.02;
  stage.reference = 0.5 * (low + high);
  stage.excess = 0.5 * kRoom * (high - low);
  stage.excess.array() += kShare * stage.excess.maxCoeff();
}

/// The gain of noise with the weight for which it is least.
void choose_noise(const LockSearch& search, const std::vector<BlockSample>& samples, LateStage& stage) {
  const PointMatrix turn = search.turn_in_frame();
  double best = std::numeric_limits<double>::infinity();
  for (double weight = 0.02; weight < 1.0; weight *= 1.4) {
    std::vector<PointMatrix> all;
    PointMatrix shape = PointMatrix::Zero();
    for (const BlockSample& one : samples) {
      const PointMatrix gain = turn * one.centre * one.information * one.centre * turn.transpose();
      const double lost = (one.information * one.spread).trace();
      all.emplace_back((1.0 + weight) * gain + (1.0 + 1.0 / weight) * lost * one.turned);
      shape += all.back() / static_cast<double>(samples.size());
    }
    double above = 0.0;
    for (const PointMatrix& one : all) {
      above = std::max(above, -smallest_eigenvalue(shape - one));
    }
    constexpr double kRoom = 1.1;
    constexpr double kShare = 0.01;
    const PointMatrix noise = shape + (kRoom * above + kShare * shape.trace()) * PointMatrix::Identity();
    if (noise.trace() < best) {
      best = noise.trace();
      stage.noise = 0.5 * (noise + noise.transpose());
      stage.noise_weight = weight;
    }
  }
}

}  // namespace

std::optional<LateStage> propose_stage(const LockSearch& search, const ErrorSet& errors, double room) {
  const auto bounds = search.set_for(errors, room);
  if (!bounds) {
    return std::nullopt;
  }
  const rigor::NearestRounding nearest;
  constexpr double kInner = 0.6;
  constexpr int kDirections = 60;
  constexpr int kOffsets = 6;
  const auto samples = search.samples(*bounds, errors, kInner, kDirections, kOffsets);
  LateStage stage;
  stage.errors = errors;
  stage.above = bounds->above;
  stage.below = bounds->below;
  choose_next_bounds(search, samples, stage);
  choose_reference(samples, stage);
  choose_noise(search, samples, stage);
  return stage;
}

}  // namespace veritrack::dft_block
