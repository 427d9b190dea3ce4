// Inputs for the results beside Theorem 2.9: the four designs of Table 3.2, with and without their leak.
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"
#include "tests/analysis/theorems/theorem_2_9_designs.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace veritrack::test {

/// Noise and start that are far below what any result could bear, and no process noise.
inline theorems::TrackerInput tracker_input(const TestDesign& design) {
  theorems::TrackerInput input;
  input.theorem_2_9 = design.input();
  input.theorem_2_9.measurement_noise = rigor::Interval(1e-9);
  input.theorem_2_9.process_noise = rigor::Interval(0.0);
  input.theorem_2_9.initial_error = rigor::Interval(1e-9);
  return input;
}

inline theorems::TrackerInput without_leak(const TableRow& row) {
  TestDesign design = table_design(row);
  design.epsilon = 0.0;
  return tracker_input(design);
}

inline const theorems::Condition& find_condition(const theorems::Derivation& derivation,
                                                 const std::string& id) {
  const auto found = std::find_if(derivation.conditions.begin(), derivation.conditions.end(),
                                  [&](const auto& condition) { return condition.id == id; });
  REQUIRE(found != derivation.conditions.end());
  return *found;
}

inline rigor::Interval value_of(const theorems::Derivation& derivation, const std::string& name) {
  return theorems::find_quantity(derivation, name).value;
}

}  // namespace veritrack::test
