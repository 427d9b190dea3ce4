// The constant ell of (10) of the KKL observer, for four to eight filters: the derivation "kkl-ell".
#pragma once

#include <optional>

#include "checker/kkl_observer/kkl_design.hpp"

namespace veritrack::checker {

/// The infimum of |M T(x)|^2 / |T(x)|^2 over all signals of one frequency, rad/s. Not finite where a bound
/// cannot be had.
Ball excitation_ratio(const std::vector<Ball>& lambda, const Ball& frequency);

/// The infimum over the range lies in [low, high]; `high` is an upper bound because it is reached at
/// `attained`, rad/s.
struct EllEnclosure {
  Ball low, high, attained;
};
/// Looks at all frequencies of the range.
bool is_true(const EllEnclosure& enclosure, const KklDesign& design);

/// Returns the enclosure of ell when it is true.
std::optional<EllEnclosure> check_kkl_ell(const Tree& derivation, const KklDesign& design,
                                          Objections& objections);

}  // namespace veritrack::checker
