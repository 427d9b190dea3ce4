// Ranges of samples in which something is so: the first ones, and how many there are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace veritrack::reports {

struct SampleRange {
  std::int64_t first;
  std::int64_t last;  ///< included
};

/// Keeps the first kKept ranges only, so that memory is constant.
class SampleRanges {
 public:
  /// Ranges that are closer together than `bridge` samples count as one.
  explicit SampleRanges(std::int64_t bridge = 1) : bridge_(bridge) {}

  /// Samples are added in their order.
  void add(std::int64_t first, std::int64_t last) {
    samples_ += last - first + 1;
    if (count_ > 0 && first - end_ <= bridge_) {
      end_ = last;
      if (count_ <= kKept) {
        ranges_.back().last = last;
      }
      return;
    }
    end_ = last;
    if (++count_ <= kKept) {
      ranges_.push_back({first, last});
    }
  }

  [[nodiscard]] const std::vector<SampleRange>& kept() const { return ranges_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// All added samples, without the bridges.
  [[nodiscard]] std::int64_t samples() const { return samples_; }

  static constexpr std::size_t kKept = 100;

 private:
  std::int64_t bridge_;
  std::vector<SampleRange> ranges_;
  std::size_t count_ = 0;
  std::int64_t samples_ = 0;
  std::int64_t end_ = 0;
};

}  // namespace veritrack::reports
