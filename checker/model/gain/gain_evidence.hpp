// The member "gains" of a certificate, and what it establishes.
#pragma once

#include <memory>

#include "checker/document/statement.hpp"
#include "checker/model/gain/gain_loop.hpp"
#include "checker/model/gain/gain_rounding.hpp"

namespace veritrack::checker {

/// Objects where nothing can be said by gains, and returns nothing then. `rounding`: of the design's code;
/// empty where there is none.
std::unique_ptr<Gains> read_gains(const Tree& gains, const Tree& model, const ModelRecursion& recursion,
                                  const ModelDesign& design, const RoundingOfStep& rounding,
                                  Objections& objections);

}  // namespace veritrack::checker
