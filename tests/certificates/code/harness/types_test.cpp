#include "certificates/code/harness/types.hpp"

#include <doctest/doctest.h>

namespace veritrack::certificates::code {

TEST_CASE("types are read as clang spells them") {
  CHECK(bare_type("const struct pll *") == "pll");
  CHECK(bare_type("pll_t *const") == "pll_t");
  CHECK(bare_type("const ns::Loop<float, 2> &") == "ns::Loop<float, 2>");
  CHECK(is_number_type("const float"));
  CHECK(is_number_type("double"));
  CHECK_FALSE(is_number_type("float *"));
  CHECK_FALSE(is_number_type("int"));
  CHECK(is_pointer("pll_t *"));
  CHECK_FALSE(is_pointer("pll_t **"));
  CHECK_FALSE(is_pointer("float (*)(float)"));
  CHECK(is_reference("Loop &"));
  CHECK_FALSE(is_reference("Loop &&"));
  CHECK(is_writable("volatile float *"));
  CHECK_FALSE(is_writable("const pll_t *"));
  CHECK_FALSE(is_writable("float"));
}

}  // namespace veritrack::certificates::code
