// How long (T^-1 m, sqrt(mu) p), T T' = I - S/mu, is: for which mu the least.
#pragma once

#include <vector>

#include "checker/model/place_matrix.hpp"

namespace veritrack::checker {

/// The mu for which the vector is about the shortest in the middle of a part, for vectors m and p in the unit
/// balls of the monomials; 0 when there is none. `of_gaussian`, if not 0: where the square of the part with
/// noise counts that many times. A proposal: any mu will do.
double near_best_multiplier(const PlaceMatrix& spread, const std::vector<BallPolynomial>& deviation,
                            const std::vector<BallPolynomial>& aside, const VectorMonomials& monomials,
                            double of_gaussian);

}  // namespace veritrack::checker
