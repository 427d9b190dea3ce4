// A set about the exact lock that is never left, with bounded noise: the derivation "lock-set".
#pragma once

#include <cstdint>
#include <optional>

#include "checker/dft_block/lock_check.hpp"
#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// A design's assumptions on the first prediction.
struct BlockStart {
  Vector3 errors;                     ///< |z_i| at most
  std::optional<Matrix3> covariance;  ///< P(1|0); none: that of the steady state
};

/// The derivation as the checker computes it from the evidence "lock". `cells` counts the cells.
Derivation lock_set(const Tree& derivation, const BlockProblem& problem, const BlockStart& start_errors,
                    std::int64_t& cells, Objections& objections);

}  // namespace veritrack::checker
