#include "certificates/dft_block/dft_block_track.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/dft_block/dft_block_simulation.hpp"
#include "certificates/sets/gaussian_noise.hpp"
#include "trackers/dft_block/block_dft.hpp"
#include "trackers/dft_block/lock_monitor.hpp"

namespace veritrack::certificates {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

TrackedBlock::State state_of(trackers::BlockLockState state) {
  switch (state) {
    case trackers::BlockLockState::lock:
      return TrackedBlock::State::lock;
    case trackers::BlockLockState::false_lock:
      return TrackedBlock::State::false_lock;
    case trackers::BlockLockState::no_tone:
      return TrackedBlock::State::no_tone;
    case trackers::BlockLockState::settling:
      break;
  }
  return TrackedBlock::State::settling;
}

class BlocksOfSamples final : public TrackerRun {
 public:
  explicit BlocksOfSamples(const BlockTables& tables)
      : tables_(tables),
        length_(tables.design.block_length.value().nearest),
        centre_(tables.design.centre.value().nearest),
        half_width_(static_cast<int>(tables.design.half_width.nearest)),
        tracker_(design(), {0.0, 0.0, 0.0, Eigen::Matrix3d::Identity()}) {}

  [[nodiscard]] int channels() const override { return 1; }
  [[nodiscard]] bool has_innovation() const override { return false; }

  void start(const ToneAtSample& first) override {
    const double offset = first.frequency * length_ / kTurn - centre_;
    transform_ = transform();
    monitor_ = trackers::BlockLockMonitor<double>(half_width_);
    tracker_ = trackers::DftBlockEkf<double>(design(),
                                             {std::sqrt(first.amplitude / (2.0 * kTurn)), first.phase, offset,
                                              steady_covariance(tables_, first.amplitude, offset)});
    estimate_ = first.frequency;
    deviation_ = kNoNumber;
  }

  [[nodiscard]] TrackerOutput step(std::span<const double> sample) override {
    if (transform_.push(sample.front())) {
      tracker_.measurement_update(transform_.bins());
      const auto& filtered = tracker_.filtered();
      monitor_.push(transform_.bins(), filtered);
      estimate_ = frequency_of(filtered.offset);
      deviation_ = std::sqrt(filtered.covariance(2, 2)) * kTurn / length_;
      blocks_.push_back({static_cast<std::int64_t>(length_), estimate_, monitor_.last_share(),
                         monitor_.unexplained_share(), frequency_of(monitor_.best_offset()),
                         monitor_.best_share(), state_of(monitor_.state())});
      tracker_.time_update();
    }
    return {estimate_, deviation_, {kNoNumber, kNoNumber}, kNoNumber};
  }

  [[nodiscard]] std::optional<TrackerOutput> predict() override { return std::nullopt; }
  [[nodiscard]] std::span<const TrackedBlock> blocks() const override { return blocks_; }

 private:
  [[nodiscard]] trackers::DftBlockDesign<double> design() const {
    return {tables_.design.q1.nearest,
            tables_.design.q2.nearest,
            tables_.design.q3.nearest,
            tables_.design.r.nearest,
            0.0,
            0.0};
  }
  [[nodiscard]] trackers::BlockDft<double> transform() const {
    return {static_cast<std::size_t>(length_), static_cast<std::size_t>(centre_),
            static_cast<std::size_t>(half_width_)};
  }
  [[nodiscard]] double frequency_of(double offset) const { return kTurn * (centre_ + offset) / length_; }

  BlockTables tables_;
  double length_;
  double centre_;
  int half_width_;
  trackers::BlockDft<double> transform_ = transform();
  trackers::BlockLockMonitor<double> monitor_{half_width_};
  trackers::DftBlockEkf<double> tracker_;
  std::vector<TrackedBlock> blocks_;
  double estimate_ = kNoNumber;
  double deviation_ = kNoNumber;
};

}  // namespace

TrackerOnSamples track_dft_block(const Design& design) {
  const BlockTables& tables = block_tables(design);
  if (!tables.design.block_length || !tables.design.centre) {
    throw NotTrackable(
        "veritrack track needs the number of samples in a block and the bin in the middle; allowed: "
        "block_length = "
        "... and centre = ... in [design]");
  }
  const rigor::NearestRounding nearest;
  const double length = tables.design.block_length->nearest;
  const double centre = tables.design.centre->nearest;
  const BlockAssumptions& assume = tables.assume;
  TrackerOnSamples result;
  result.tracker = std::make_unique<BlocksOfSamples>(tables);
  result.assume.amplitude = {assume.amplitude[0].nearest, assume.amplitude[1].nearest};
  result.assume.frequency = {kTurn * (centre + assume.offset[0].nearest) / length,
                             kTurn * (centre + assume.offset[1].nearest) / length};
  if (assume.gaussian) {
    result.assume.noise_deviation =
        nearest_deviation(*assume.gaussian, assume.amplitude[0]) * assume.amplitude[0].nearest;
  }
  result.assume.start = {
      fmt::format("offset off by at most {} bins", assume.initial_offset_error.text),
      fmt::format("phase off by at most {} rad", assume.initial_phase_error.text),
      fmt::format("amplitude off by at most a part of {}", assume.initial_amplitude_error.text),
  };
  result.assume.slew = kTurn * assume.slew.nearest / (length * length);
  return result;
}

}  // namespace veritrack::certificates
