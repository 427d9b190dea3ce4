// The inverse of a basis that depends on the place (docs/gain-proof.md, section 10).
#pragma once

#include <vector>

#include "analysis/rigor/ball_model.hpp"

namespace veritrack::model {

/// Solves `basis` x = side for all sides at once, in place. `basis`: n x n, row by row. By elimination; the
/// results are not known where a pivot may be 0. Needs the upward rounding mode.
void solve_in_basis(std::vector<rigor::BallModel> basis,
                    const std::vector<std::vector<rigor::BallModel>*>& sides);

}  // namespace veritrack::model
