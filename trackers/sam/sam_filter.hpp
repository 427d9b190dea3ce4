// The subset averaged median filter: a weighted average of medians over subsets of a window. For frequency
// trackers it is a prefilter that takes impulses out.
//
// D. H. Kang, J. Song and Y. H. Lee, "Analysis and optimization of subset averaged median filters", IEEE
// Trans. Signal Processing 44, 1996 (of which one page is at hand): F_i(X) = med(X_i), (1), X_i an odd number
// of the N inputs of the window, and the output sum w_i F_i. Subsets of one input make it a linear filter,
// all of the window a median filter.
//
// A template over the scalar, which needs only + * and <; it allocates when it is made, not in a step.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace veritrack::trackers {

/// One median with its weight. Bit j - 1 of `inputs` stands for X_j, the j-th input from the left, which is
/// the oldest.
template <typename Scalar>
struct MedianSubfilter {
  std::uint32_t inputs;
  Scalar weight;
};

/// The filter with its window of at most 32 samples.
template <typename Scalar = double>
class SamFilter {
 public:
  /// Throws std::invalid_argument for a window outside 1 ... 32, no subfilter, or a subset that is even,
  /// empty or reaches outside the window.
  SamFilter(std::size_t window, std::vector<MedianSubfilter<Scalar>> subfilters)
      : window_(window), subfilters_(std::move(subfilters)) {
    if (window == 0 || window > kLargestWindow) {
      throw std::invalid_argument("the window of a subset averaged median filter has 1 to 32 inputs");
    }
    if (subfilters_.empty()) {
      throw std::invalid_argument("a subset averaged median filter needs at least one subset");
    }
    for (const auto& subfilter : subfilters_) {
      if (std::popcount(subfilter.inputs) % 2 == 0 || (std::uint64_t{subfilter.inputs} >> window) != 0) {
        throw std::invalid_argument("each subset is an odd number of the inputs of the window");
      }
    }
  }

  /// The output for the next sample. Before the window is full, it is filled with the first sample.
  Scalar step(const Scalar& sample) {
    if (!started_) {
      inputs_.fill(sample);
      started_ = true;
    }
    std::move(inputs_.begin() + 1, inputs_.begin() + static_cast<std::ptrdiff_t>(window_), inputs_.begin());
    inputs_[window_ - 1] = sample;
    return output(std::span<const Scalar>(inputs_.data(), window_));
  }

  /// The output for a window X_1 ... X_N, N inputs exactly.
  [[nodiscard]] Scalar output(std::span<const Scalar> inputs) const {
    Scalar sum(0);
    for (const auto& subfilter : subfilters_) {
      sum = sum + subfilter.weight * median(inputs, subfilter.inputs);
    }
    return sum;
  }

  [[nodiscard]] std::size_t window() const { return window_; }
  [[nodiscard]] const std::vector<MedianSubfilter<Scalar>>& subfilters() const { return subfilters_; }

 private:
  static constexpr std::size_t kLargestWindow = 32;

  [[nodiscard]] static Scalar median(std::span<const Scalar> inputs, std::uint32_t subset) {
    std::array<Scalar, kLargestWindow> chosen{};
    std::size_t count = 0;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      if ((subset >> j & 1U) == 0) {
        continue;
      }
      std::size_t place = count++;
      for (; place > 0 && inputs[j] < chosen[place - 1]; --place) {
        chosen[place] = chosen[place - 1];
      }
      chosen[place] = inputs[j];
    }
    return chosen[count / 2];
  }

  std::size_t window_;
  std::vector<MedianSubfilter<Scalar>> subfilters_;
  std::array<Scalar, kLargestWindow> inputs_{};
  bool started_ = false;
};

/// The median of a window of N inputs, N odd.
template <typename Scalar = double>
[[nodiscard]] inline SamFilter<Scalar> median_filter(std::size_t window) {
  const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << std::min<std::size_t>(window, 32)) - 1);
  return SamFilter<Scalar>(window, {{all, Scalar(1)}});
}

}  // namespace veritrack::trackers
