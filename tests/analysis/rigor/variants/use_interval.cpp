// Compiled with right and with wrong flags: see CMakeLists.txt beside.
#include "analysis/rigor/interval.hpp"

veritrack::rigor::Interval twice(const veritrack::rigor::Interval& x) {
  return x + x;
}
