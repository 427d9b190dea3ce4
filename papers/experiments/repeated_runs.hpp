// The same experiment over many noise seeds, and what its results amount to. All of this folder is floating
// point and simulation, for the research reports: it proves nothing.
#pragma once

#include <tbb/parallel_for.h>

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::experiments {

/// run(seed) for the seeds 1, ..., runs, in this order. In parallel; the result does not depend on the number
/// of threads. `run` may be called by several threads at a time, each with round-to-nearest.
template <typename Run>
[[nodiscard]] auto repeat(int runs, const Run& run) {
  using Result = std::decay_t<std::invoke_result_t<const Run&, std::uint64_t>>;
  std::vector<Result> results(static_cast<std::size_t>(runs));
  tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t i) {
    const rigor::NearestRounding nearest;
    results[i] = run(static_cast<std::uint64_t>(i) + 1);
  });
  return results;
}

/// Mean and standard deviation over runs, each with its standard error.
struct Summary {
  double mean = 0.0;
  double mean_error = 0.0;       ///< NaN for a single run
  double deviation = 0.0;        ///< NaN for a single run
  double deviation_error = 0.0;  ///< by the fourth moment, for any distribution; NaN for a single run
};

/// The summary of at least one value; a NaN makes all of it NaN.
[[nodiscard]] Summary summary_of(std::span<const double> values);

/// The value with this share of the values at or below it, 0 <= share <= 1; NaN counts as infinite.
[[nodiscard]] double quantile_of(std::span<const double> values, double share);

/// The median, and its standard error for any distribution: half the distance of the order statistics one
/// deviation of the binomial count to either side, sqrt(n)/2 ranks. Infinite, or NaN, where these are.
struct Median {
  double value = 0.0;
  double error = 0.0;
};
/// The median of at least one value; the error of a single one is NaN.
[[nodiscard]] Median median_of(std::span<const double> values);

}  // namespace veritrack::experiments
