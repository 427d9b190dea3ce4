#include "checker/numbers/threads.hpp"

#include <flint/flint.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr unsigned kMostThreads = 64;

/// Indices that are taken one after the other.
class Queue {
 public:
  Queue(std::size_t count, const std::function<bool(std::size_t)>& work)
      : count_(count), work_(work), failed_(count) {}

  void run() {
    for (std::size_t k = next_++; k < count_ && !stopped_; k = next_++) {
      try {
        if (!work_(k)) {
          stopped_ = true;
          std::size_t least = failed_;
          while (k < least && !failed_.compare_exchange_weak(least, k)) {
          }
        }
      } catch (...) {
        stopped_ = true;
        if (!throws_.exchange(true)) {
          thrown_ = std::current_exception();
        }
      }
    }
  }

  /// When all have ended.
  [[nodiscard]] std::size_t result() const {
    if (thrown_) {
      std::rethrow_exception(thrown_);
    }
    return failed_;
  }

 private:
  std::size_t count_;
  const std::function<bool(std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::size_t> failed_;
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> throws_ = false;
  std::exception_ptr thrown_;
};

}  // namespace

std::size_t first_failure(std::size_t count, const std::function<bool(std::size_t)>& work) {
  Queue queue(count, work);
  const std::int64_t before = operations_spent();
  const std::size_t most = std::clamp(std::thread::hardware_concurrency(), 1U, kMostThreads);
  std::vector<std::int64_t> spent(std::min(most, std::max<std::size_t>(count, 1)) - 1, 0);
  std::vector<std::thread> threads;
  threads.reserve(spent.size());
  try {
    for (std::int64_t& operations : spent) {
      threads.emplace_back([&queue, before, &operations] {
        // No thread may exceed the budget by itself.
        go_on_from(before);
        queue.run();
        operations = operations_spent() - before;
        flint_cleanup();
      });
    }
  } catch (const std::system_error&) {
    // Then there are fewer.
  }
  queue.run();
  for (std::thread& thread : threads) {
    thread.join();
  }
  const std::size_t result = queue.result();
  for (const std::int64_t operations : spent) {
    spend(operations);
  }
  return result;
}

}  // namespace veritrack::checker
