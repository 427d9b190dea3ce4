// The block tracker: samples in, an estimate for each block of them.
#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "python/trackers/recordings.hpp"
#include "trackers/dft_block/block_dft.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"
#include "trackers/dft_block/lock_monitor.hpp"

namespace veritrack::python {

namespace {

using BlockEstimate = trackers::DftBlockEstimate<double>;

constexpr std::size_t kShares = 4;

/// One tracker with the transform of its block and the monitor of its lock.
struct BlockTracker {
  trackers::BlockDft<double> transform;
  trackers::DftBlockEkf<double> ekf;
  trackers::BlockLockMonitor<double> monitor;
};

/// Trackers whose blocks begin and end together.
class DftBlockBatch {
 public:
  /// `design`: (size, 4), q1, q2, q3, r; `state`: (size, 3), x(1|0); `covariance`: (size, 9), P(1|0).
  DftBlockBatch(std::size_t length, std::size_t centre, std::size_t half_width, int memory,
                const Array& design, const Array& state, const Array& covariance)
      : length_(length) {
    require_shape(design, 4);
    require_shape(state, 3);
    require_shape(covariance, 9);
    const TrackerArithmetic arithmetic;
    for (std::size_t i = 0; i < static_cast<std::size_t>(design.shape(0)); ++i) {
      const double* chosen = row_of(design, i);
      const double* start = row_of(state, i);
      const Eigen::Matrix3d p =
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_of(covariance, i));
      trackers_.push_back(
          {trackers::BlockDft<double>(length, centre, half_width),
           trackers::DftBlockEkf<double>({chosen[0], chosen[1], chosen[2], chosen[3], 0.0, 0.0},
                                         {start[0], start[1], start[2], p}),
           trackers::BlockLockMonitor<double>(static_cast<int>(half_width), memory)});
    }
  }

  [[nodiscard]] std::size_t size() const { return trackers_.size(); }

  /// `samples`: (1 or size, n, 1). For each block that is complete: the filtered state (size, blocks, 3), its
  /// covariance (size, blocks, 9), and of the lock (size, blocks, 5): the share of power that the estimate
  /// leaves of this block and of the last ones, the best offset, what it explains, and the number of the
  /// state. When a tracker throws, no tracker has moved.
  py::tuple run(const Array& samples, std::size_t threads) {
    require_samples(samples, 1, size());
    const auto n = static_cast<std::size_t>(samples.shape(1));
    const std::size_t stride = samples.shape(0) == 1 ? 0 : n;
    const std::size_t blocks = (taken_ + n) / length_;
    Array state({size(), blocks, std::size_t{3}});
    Array covariance({size(), blocks, std::size_t{9}});
    Array lock({size(), blocks, kShares + 1});
    const double* input = samples.data();
    const Targets targets{state.mutable_data(), covariance.mutable_data(), lock.mutable_data()};
    std::vector<BlockTracker> moved = trackers_;
    {
      const py::gil_scoped_release free;
      in_threads(moved.size(), threads, [&](std::size_t first, std::size_t last, Interruption& interruption) {
        const TrackerArithmetic arithmetic;
        for (std::size_t i = first; i < last; ++i) {
          run_one(moved[i], {input + i * stride, n}, i * blocks, targets, interruption);
        }
      });
    }
    trackers_ = std::move(moved);
    taken_ = (taken_ + n) % length_;
    return py::make_tuple(state, covariance, lock);
  }

 private:
  struct Targets {
    double* state;
    double* covariance;
    double* lock;
  };

  static void run_one(BlockTracker& tracker, std::span<const double> samples, std::size_t row,
                      const Targets& targets, Interruption& interruption) {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (k % kSamplesBetweenLooks == 0) {
        interruption.look();
      }
      if (std::isnan(samples[k])) {
        throw std::invalid_argument("the block tracker cannot go on without a sample (NaN)");
      }
      if (tracker.transform.push(samples[k])) {
        take_block(tracker, row++, targets);
      }
    }
  }

  static void take_block(BlockTracker& tracker, std::size_t row, const Targets& targets) {
    tracker.ekf.measurement_update(tracker.transform.bins());
    const BlockEstimate& filtered = tracker.ekf.filtered();
    tracker.monitor.push(tracker.transform.bins(), filtered);
    Eigen::Map<Eigen::Vector3d>(targets.state + 3 * row) = filtered.state();
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(targets.covariance + 9 * row) =
        filtered.covariance;
    const std::array<double, kShares + 1> lock{
        tracker.monitor.last_share(), tracker.monitor.unexplained_share(), tracker.monitor.best_offset(),
        tracker.monitor.best_share(), static_cast<double>(tracker.monitor.state())};
    std::copy(lock.begin(), lock.end(), targets.lock + lock.size() * row);
    tracker.ekf.time_update();
  }

  std::size_t length_;
  std::size_t taken_ = 0;  ///< samples of the block that is not complete
  std::vector<BlockTracker> trackers_;
};

/// (x1, x2, x3) of the start from the bins of the first block of `samples`: (4.35) and (4.36).
std::array<double, 3> start_of(const Array& samples, std::size_t centre, std::size_t half_width) {
  const TrackerArithmetic arithmetic;
  const auto length = static_cast<std::size_t>(samples.size());
  trackers::BlockDft<double> transform(length, centre, half_width);
  for (std::size_t k = 0; k < length; ++k) {
    transform.push(samples.data()[k]);
  }
  const trackers::DftBlockStart<double> start = trackers::dft_block_start(transform.bins());
  return {start.root_amplitude, start.phase, start.offset};
}

}  // namespace

void bind_block_trackers(py::module_& module) {
  py::class_<DftBlockBatch>(module, "DftBlockBatch")
      .def(py::init<std::size_t, std::size_t, std::size_t, int, const Array&, const Array&, const Array&>())
      .def("__len__", &DftBlockBatch::size)
      .def("__copy__", [](const DftBlockBatch& batch) { return DftBlockBatch(batch); })
      .def("run", &DftBlockBatch::run, py::arg("samples"), py::arg("threads"));
  module.def("dft_block_start", &start_of);
}

}  // namespace veritrack::python
