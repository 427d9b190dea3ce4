// Worst-case gains of a linear recursion x+ = A x + B u, y = C x: sums of absolute values of its responses,
// enclosed, and resolved in time (docs/gain-proof.md, section 4).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::linear {

using Row = std::vector<rigor::Interval>;

/// An input of one or two components, |u| <= 1 in Euclidean length: one column for each.
struct GainInput {
  std::vector<Row> columns;
};

/// Upper bounds for one form c and one input: of the sum of |c A^k B| over the lags of each block, and of
/// what these bounds miss over all lags together.
struct InputGain {
  std::vector<double> blocks;
  double missed = 0.0;
  [[nodiscard]] double total() const;
};

/// Upper bounds for one form and one state of the start: of |c A^k e| over each block, and over all later
/// samples.
struct StartGain {
  std::vector<double> blocks;
  double later = 0.0;
};

struct WorstCaseGains {
  std::vector<std::vector<InputGain>> inputs;  ///< by form, by input
  std::vector<std::vector<StartGain>> starts;  ///< by form, by state
};

/// Matrices may differ from sample to sample within the intervals of `a` (rows). `samples`: the horizon, a
/// multiple of `blocks`. Empty unless the errors of the horizon are a contraction. Needs the upward rounding
/// mode. Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] std::optional<WorstCaseGains> worst_case_gains(const std::vector<Row>& a,
                                                             const std::vector<GainInput>& inputs,
                                                             const std::vector<Row>& forms,
                                                             std::size_t samples, std::size_t blocks);

/// The samples, a multiple of `blocks`, after which the powers of the middle of `a` are below `tail` of
/// themselves; empty where that takes more than `most`. Not evidence.
[[nodiscard]] std::optional<std::size_t> proposed_horizon(const std::vector<Row>& a, std::size_t blocks,
                                                          double tail, std::size_t most);

}  // namespace veritrack::linear
