// The member "gains" of a certificate, and what it establishes.
#pragma once

#include <memory>

#include "checker/document/statement.hpp"
#include "checker/model/gain/gain_loop.hpp"

namespace veritrack::checker {

/// Objects where nothing can be said by gains, and returns nothing then.
std::unique_ptr<Gains> read_gains(const Tree& gains, const Tree& model, const ModelRecursion& recursion,
                                  const ModelDesign& design, Objections& objections);

}  // namespace veritrack::checker
