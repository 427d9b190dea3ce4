#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor::detail {

void throw_rounding_mode_error() {
  throw RoundingModeError(
      "interval arithmetic used outside an UpwardRounding scope, or with denormals flushed to zero");
}

}  // namespace veritrack::rigor::detail
