// Trackers on recordings: one call of the interpreter for all samples of all trackers of a batch.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "analysis/rigor/kept_control.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::python {

namespace py = pybind11;

/// Doubles in C order; what is something else is converted.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A tracker's report on a sample: NaN where it has no value.
template <std::size_t Channels, std::size_t Values>
struct Said {
  std::array<double, Values> state;  ///< the estimate with this sample
  double deviation = kNone;          ///< of the frequency, as the tracker believes
  std::array<double, Channels> innovation;
  double nis = kNone;  ///< the normalised innovation squared
};

/// Holds round-to-nearest without flush-to-zero for the calls of the trackers, and gives the interpreter its
/// arithmetic back as it was, exception flags included.
class TrackerArithmetic {
 public:
  TrackerArithmetic() = default;

 private:
  rigor::KeptControl kept_;
  rigor::NearestRounding nearest_;
};

/// Throws std::invalid_argument unless the array is (1 or size, n, channels).
inline void require_samples(const py::array& samples, std::size_t channels, std::size_t size) {
  if (samples.ndim() != 3 || samples.shape(2) != static_cast<py::ssize_t>(channels) ||
      (samples.shape(0) != 1 && samples.shape(0) != static_cast<py::ssize_t>(size))) {
    throw std::invalid_argument("samples of another shape than the batch");
  }
}

/// Thrown in a part of the work when it is to end because another part has failed.
struct Stopped {};

/// Lets Ctrl-C end long work: whoever has called looks for it now and then, and all parts end when it is
/// there. The interpreter is free meanwhile.
class Interruption {
 public:
  /// Throws py::error_already_set in the thread that has called, when a handler of a signal has thrown, and
  /// Stopped in the others then.
  void look() {
    if (stopped_.load(std::memory_order_relaxed)) {
      throw Stopped();
    }
    if (std::this_thread::get_id() != caller_) {
      return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < kBetweenLooks) {
      return;
    }
    last_ = now;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) {
      throw py::error_already_set();
    }
  }
  void stop() { stopped_.store(true, std::memory_order_relaxed); }

  static constexpr std::chrono::milliseconds kBetweenLooks{20};

 private:
  std::thread::id caller_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::atomic<bool> stopped_ = false;
};

/// So many samples of a tracker take a fraction of a millisecond.
inline constexpr std::size_t kSamplesBetweenLooks = 1024;

/// Parts of the batch, a thread each; what the first part that failed has thrown is thrown. `work` takes the
/// first tracker, the one after the last, and the Interruption, which it asks to look() now and then.
template <typename Work>
void in_threads(std::size_t size, std::size_t threads, const Work& work) {
  const std::size_t parts = std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(size, 1));
  std::vector<std::exception_ptr> failures(parts);
  Interruption interruption;
  std::mutex mutex;
  std::condition_variable one_is_done;
  std::size_t running = parts - 1;
  const auto part = [&](std::size_t number) {
    try {
      work(size * number / parts, size * (number + 1) / parts, interruption);
    } catch (const Stopped&) {
    } catch (...) {
      failures[number] = std::current_exception();
      interruption.stop();
    }
  };
  std::vector<std::thread> others;
  others.reserve(parts - 1);
  for (std::size_t number = 1; number < parts; ++number) {
    others.emplace_back([&, number] {
      part(number);
      const std::lock_guard lock(mutex);
      --running;
      one_is_done.notify_one();
    });
  }
  part(0);
  std::unique_lock lock(mutex);
  while (running > 0) {
    one_is_done.wait_for(lock, Interruption::kBetweenLooks);
    lock.unlock();
    try {
      interruption.look();
    } catch (const Stopped&) {
    } catch (...) {
      failures[0] = std::current_exception();
      interruption.stop();
    }
    lock.lock();
  }
  lock.unlock();
  for (std::thread& other : others) {
    other.join();
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) {
      std::rethrow_exception(failure);
    }
  }
}

/// A batch of trackers of one kind. `Tracker` is copyable, has kChannels, kValues, and
///     Said<kChannels, kValues> step(const double* sample),
/// which takes kChannels doubles, and may throw.
template <typename Tracker>
class Batch {
 public:
  static constexpr std::size_t kChannels = Tracker::kChannels;
  static constexpr std::size_t kValues = Tracker::kValues;
  using Saying = Said<kChannels, kValues>;

  explicit Batch(std::vector<Tracker> trackers) : trackers_(std::move(trackers)) {}

  [[nodiscard]] std::size_t size() const { return trackers_.size(); }
  [[nodiscard]] const std::vector<Tracker>& trackers() const { return trackers_; }

  /// `samples`: (1 or size, n, channels), one row for all or a row for each. Returns state (size, n, values),
  /// deviation (size, n), innovation (size, n, channels) and nis (size, n). The interpreter is free
  /// meanwhile; the results do not depend on `threads`. When a tracker throws, no tracker has moved.
  py::tuple run(const Array& samples, std::size_t threads) {
    require_samples(samples, kChannels, size());
    const auto length = static_cast<std::size_t>(samples.shape(1));
    const std::size_t stride = samples.shape(0) == 1 ? 0 : length * kChannels;
    Array state({size(), length, kValues});
    Array deviation({size(), length});
    Array innovation({size(), length, kChannels});
    Array nis({size(), length});
    const double* input = samples.data();
    const Targets targets{state.mutable_data(), deviation.mutable_data(), innovation.mutable_data(),
                          nis.mutable_data()};
    // The batch itself is touched with the interpreter held only, so that threads may call it as they like.
    std::vector<Tracker> moved = trackers_;
    {
      const py::gil_scoped_release free;
      in_threads(moved.size(), threads, [&](std::size_t first, std::size_t last, Interruption& interruption) {
        const TrackerArithmetic arithmetic;
        for (std::size_t i = first; i < last; ++i) {
          run_one(moved[i], input + i * stride, length, i * length, targets, interruption);
        }
      });
    }
    trackers_ = std::move(moved);
    return py::make_tuple(state, deviation, innovation, nis);
  }

 private:
  struct Targets {
    double* state;
    double* deviation;
    double* innovation;
    double* nis;
  };

  static void run_one(Tracker& tracker, const double* samples, std::size_t length, std::size_t offset,
                      const Targets& targets, Interruption& interruption) {
    for (std::size_t k = 0; k < length; ++k) {
      if (k % kSamplesBetweenLooks == 0) {
        interruption.look();
      }
      const Saying said = tracker.step(samples + k * kChannels);
      const std::size_t row = offset + k;
      std::copy(said.state.begin(), said.state.end(), targets.state + row * kValues);
      std::copy(said.innovation.begin(), said.innovation.end(), targets.innovation + row * kChannels);
      targets.deviation[row] = said.deviation;
      targets.nis[row] = said.nis;
    }
  }

  std::vector<Tracker> trackers_;
};

/// Row i of a (size, width) array.
inline const double* row_of(const Array& array, std::size_t i) {
  return array.data(static_cast<py::ssize_t>(i), 0);
}

/// Throws std::invalid_argument unless the array is (rows, columns).
inline void require_shape(const Array& array, std::size_t columns) {
  if (array.ndim() != 2 || array.shape(1) != static_cast<py::ssize_t>(columns)) {
    throw std::invalid_argument("an array of another shape");
  }
}

/// Registers the batch of a kind of tracker; the constructor takes what `make` takes.
template <typename Tracker, typename... Arguments>
py::class_<Batch<Tracker>> bind_batch(py::module_& module, const char* name,
                                      std::vector<Tracker> (*make)(Arguments...)) {
  return py::class_<Batch<Tracker>>(module, name)
      .def(py::init([make](Arguments... arguments) {
        const TrackerArithmetic arithmetic;
        return Batch<Tracker>(make(arguments...));
      }))
      .def("__len__", &Batch<Tracker>::size)
      .def("__copy__", [](const Batch<Tracker>& batch) { return Batch<Tracker>(batch); })
      .def("run", &Batch<Tracker>::run, py::arg("samples"), py::arg("threads"));
}

/// Each adds its classes to the module.
void bind_block_trackers(py::module_& module);
void bind_extended_kalman_filters(py::module_& module);
void bind_kkl_observers(py::module_& module);
void bind_notches(py::module_& module);
void bind_zarchan_filters(py::module_& module);

}  // namespace veritrack::python
