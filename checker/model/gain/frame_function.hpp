// Functions of one number, and what is left of them beyond their derivative.
#pragma once

#include <string>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// A function and its derivative.
struct FrameFunction {
  const char* name;
  Ball (*value)(const Ball&);
  Ball (*slope)(const Ball&);
};

/// sqrt, exp, log, tan, asin, acos, atan or reciprocal. Throws NotCovered for another.
const FrameFunction& frame_function(const std::string& name);

/// At least |f(b + d) - f(b) - f'(b) d| for |d| <= bound: the integral of |f'(b + s) - f'(b)|, from above.
Ball remainder_of(const FrameFunction& f, const Ball& b, const Ball& bound);

}  // namespace veritrack::checker
