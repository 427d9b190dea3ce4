#include "checker/model/gain/frame_function.hpp"

#include <algorithm>
#include <vector>

#include "checker/model/formula.hpp"
#include "checker/model/gain/linear_frame.hpp"

namespace veritrack::checker {

namespace {

Ball slope_of_arcsine(const Ball& x) {
  return one / sqrt(one - square(x));
}

}  // namespace

const FrameFunction& frame_function(const std::string& name) {
  static const std::vector<FrameFunction> known{
      {"sqrt", [](const Ball& x) { return sqrt(x); }, [](const Ball& x) { return half / sqrt(x); }},
      {"exp", [](const Ball& x) { return exp(x); }, [](const Ball& x) { return exp(x); }},
      {"log", [](const Ball& x) { return log(x); }, [](const Ball& x) { return one / x; }},
      {"tan", [](const Ball& x) { return tangent(x); },
       [](const Ball& x) { return one + square(tangent(x)); }},
      {"asin", [](const Ball& x) { return arcsine(x); }, [](const Ball& x) { return slope_of_arcsine(x); }},
      {"acos", [](const Ball& x) { return arccosine(x); },
       [](const Ball& x) { return -slope_of_arcsine(x); }},
      {"atan", [](const Ball& x) { return arctangent(x); },
       [](const Ball& x) { return one / (one + square(x)); }},
      {"reciprocal", [](const Ball& x) { return one / x; },
       [](const Ball& x) { return -(one / square(x)); }}};
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const FrameFunction& f) { return f.name == name; });
  if (found == known.end()) {
    throw NotCovered("no rule for the function " + name);
  }
  return *found;
}

Ball remainder_of(const FrameFunction& f, const Ball& b, const Ball& bound) {
  constexpr int kCells = 64;
  const Ball width = bound / Ball(kCells);
  const Ball slope = f.slope(b);
  Ball integral;
  for (int cell = 0; cell < kCells; ++cell) {
    const Ball s = Ball::hull(width * Ball(cell), width * Ball(cell + 1));
    integral += max(abs(f.slope(b + s) - slope), abs(f.slope(b - s) - slope)).upper() * width;
  }
  return integral;
}

}  // namespace veritrack::checker
