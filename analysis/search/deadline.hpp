// When a search has to end.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>

namespace veritrack::search {

/// A point in time that searches look at between two parts of their work. Copies belong together:
/// `has_struck` is that of all of them. Safe to use from several threads.
class Deadline {
 public:
  /// Never over.
  Deadline() = default;
  /// Over after this many seconds from now.
  explicit Deadline(double seconds)
      : struck_(std::make_shared<std::atomic<bool>>(false)),
        end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(seconds < kLongest ? seconds : kLongest))) {}

  /// The same, and over as well when `stop` becomes true, which must outlive all copies.
  [[nodiscard]] Deadline or_when(const std::atomic<bool>& stop) const {
    Deadline both = is_set() ? *this : Deadline(kLongest);
    both.stop_ = &stop;
    return both;
  }

  /// Whether there is one.
  [[nodiscard]] bool is_set() const { return struck_ != nullptr; }
  /// Whether the time is over; whoever asks ends its work then.
  [[nodiscard]] bool is_over() const {
    if (struck_ && !struck_->load() && (!(Clock::now() < end_) || (stop_ != nullptr && stop_->load()))) {
      struck_->store(true);
    }
    return has_struck();
  }
  /// Whether some work was ended by it.
  [[nodiscard]] bool has_struck() const { return struck_ && struck_->load(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLongest = 1e8;  // seconds: three years, which no clock runs out of

  std::shared_ptr<std::atomic<bool>> struck_;
  Clock::time_point end_;
  const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace veritrack::search
