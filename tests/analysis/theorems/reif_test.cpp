#include "analysis/theorems/reif.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Verdict;

}  // namespace

TEST_CASE("debug") {
  for (const test::TableRow& row : test::kTable32) {
    for (const auto& d : {theorems::evaluate_reif(test::without_leak(row)), theorems::evaluate_reif_two_step(test::without_leak(row))}) {
      MESSAGE(d.id, " ", row.figure, " ", rigor::to_string(d.verdict));
      for (const auto& q : d.quantities) MESSAGE("   ", q.name, " ", q.value.lower(), " ", q.value.upper());
      for (const auto& c : d.conditions) MESSAGE("   ", c.id, " ", rigor::to_string(c.verdict), " ", c.reason);
    }
  }
}
