// The KKL observer (Praly, Marconi, Isidori): the constant ell of (10) for four filters.
#pragma once

#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// What a design of the observer assumes: filter rates, 1/s, and the range of frequencies, rad/s.
struct KklDesign {
  std::vector<Ball> lambda;
  Ball frequency_low, frequency_high;
};

/// Objects to numbers that [lo, hi] does not contain, and to what no such design can be.
KklDesign read_kkl_design(const Tree& design, Objections& objections);

/// Objects unless the infimum over the range is certainly in the enclosure of the quantity "ell".
void check_kkl_ell(const Tree& derivation, const KklDesign& design, Objections& objections);

}  // namespace veritrack::checker
