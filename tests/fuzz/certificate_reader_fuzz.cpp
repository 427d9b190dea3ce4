// Whatever the bytes: a certificate that is looked at to the end, or Malformed. Nothing that arbitrary bytes
// say may be VERIFIED but what claims nothing.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "checker/numbers/ball.hpp"
#include "checker/numbers/budget.hpp"
#include "checker/verification.hpp"

namespace {

using namespace veritrack::checker;

/// Numbers are finite, or refused.
void read_as_number(std::string_view text) {
  for (const bool decimal : {true, false}) {
    try {
      if (!(decimal ? from_decimal(text) : from_hexadecimal(text)).finite()) {
        std::abort();
      }
    } catch (const std::invalid_argument&) {
      continue;
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  constexpr std::int64_t kBudget = 20'000'000;           // a second or two
  constexpr std::int64_t kBudgetOfTubes = kBudget / 80;  // whose operations are of polynomials, slow here
  set_budget(kBudget);
  read_as_number(text);
  try {
    const Tree tree = read_json(text);
    if (tree.find("tubes") != nullptr) {
      set_budget(kBudgetOfTubes);
    }
    const Tree* sets = tree.find("certified_sets");
    if (sets == nullptr || sets->elements().empty()) {  // sets take seconds
      (void)verify(tree);
    }
  } catch (const Malformed&) {
    return 0;
  }
  return 0;
}
