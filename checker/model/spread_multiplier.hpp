// The length of (T^-1 m, sqrt(mu) p), T T' = I - S/mu: which mu makes it least.
#pragma once

#include <vector>

#include "checker/model/place_matrix.hpp"

namespace veritrack::checker {

/// The mu for which the vector is approximately shortest in the middle of a part, for vectors m and p in the
/// unit balls of the monomials; 0 when there is none. If `of_gaussian` is not 0, the square of the part with
/// noise counts that many times. A proposal: any mu is valid.
double near_best_multiplier(const PlaceMatrix& spread, const std::vector<BallPolynomial>& deviation,
                            const std::vector<BallPolynomial>& aside, const VectorMonomials& monomials,
                            double of_gaussian);

}  // namespace veritrack::checker
