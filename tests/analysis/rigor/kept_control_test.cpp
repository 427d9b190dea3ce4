#include "analysis/rigor/kept_control.hpp"

#include <doctest/doctest.h>

#include <cfenv>

#include "analysis/rigor/rounding.hpp"

using veritrack::rigor::KeptControl;
using veritrack::rigor::UpwardRounding;

namespace {

/// Raises the flag of an inexact result.
void divide_inexactly() {
  volatile double three = 3.0;
  volatile double third = 1.0 / three;
  static_cast<void>(third);
}

}  // namespace

TEST_CASE("the mode and the flags of whoever calls stay, whatever happens in between") {
  std::feclearexcept(FE_ALL_EXCEPT);
  {
    const KeptControl kept;
    const UpwardRounding upward;
    divide_inexactly();
    CHECK(std::fetestexcept(FE_INEXACT) != 0);
  }
  CHECK(std::fetestexcept(FE_ALL_EXCEPT) == 0);
  CHECK(std::fegetround() == FE_TONEAREST);
}

TEST_CASE("a flag that was raised before stays raised") {
  std::feclearexcept(FE_ALL_EXCEPT);
  divide_inexactly();
  {
    const KeptControl kept;
    std::feclearexcept(FE_ALL_EXCEPT);
  }
  CHECK(std::fetestexcept(FE_INEXACT) != 0);
  std::feclearexcept(FE_ALL_EXCEPT);
}

TEST_CASE("another mode than nearest is given back, too") {
  std::fesetround(FE_DOWNWARD);
  {
    const KeptControl kept;
    const UpwardRounding upward;
  }
  const int mode = std::fegetround();
  std::fesetround(FE_TONEAREST);
  CHECK(mode == FE_DOWNWARD);
}
