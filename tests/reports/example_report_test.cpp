#include "reports/example_report.hpp"

#include <doctest/doctest.h>

namespace veritrack::reports {
namespace {

StartRates rates_of(double frequency_only, double identity) {
  return {{"a start", 0.0, 0.0, 0.0, 1.0},
          {{"one", 1.0}, {"two", frequency_only}},
          {{"one", 1.0}, {"two", identity}}};
}

TEST_CASE("the sentence says which reading reproduces everything, whatever that is") {
  CHECK(reading_sentence({rates_of(0.05, 0.6)}).find("only Q = q diag(1, 1, 1)") != std::string::npos);
  CHECK(reading_sentence({rates_of(0.6, 0.05)}).find("only Q = q diag(0, 0, 1)") != std::string::npos);
  CHECK(reading_sentence({rates_of(0.6, 0.6)}).find("Either reading") != std::string::npos);
  CHECK(reading_sentence({rates_of(0.05, 0.05)}).find("Neither reading") != std::string::npos);
  CHECK(reading_sentence({rates_of(0.05, 0.05), rates_of(0.05, 0.1)}).find("only Q = q diag(1, 1, 1)") !=
        std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
