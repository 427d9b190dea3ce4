// Designs for the tests of Theorem 2.9: the four of the thesis, and random admissible ones.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "analysis/theorems/theorem_2_9.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

/// A row of Table 3.2, as doubles.
struct TableRow {
  std::string figure;
  double q, epsilon, r;
};
inline const std::array<TableRow, 4> kTable32 = {{{"3.2", 0.0005, 0.05, 0.01},
                                                  {"3.3", 0.0065, 0.05, 0.01},
                                                  {"3.4", 0.0013, 0.01, 0.01},
                                                  {"3.5", 0.0023, 0.01, 0.05}}};

/// The same numbers twice: for the code under test, and for an oracle.
struct TestDesign {
  double q1 = 0.0023, q2 = 0.0023, r = 0.05, epsilon = 0.01, state_bound = 7.0, sigma = 1e-3,
         gamma_fraction = 0.5;
  double c1 = 3.0, c2 = 3.0;
  bool q1_equals_q2 = true;

  [[nodiscard]] theorems::Theorem29Input input() const {
    using rigor::Interval;
    theorems::Theorem29Input result;
    result.q1 = Interval(q1);
    result.q2 = Interval(q2);
    result.r = Interval(r);
    result.epsilon = Interval(epsilon);
    result.state_bound = Interval(state_bound);
    result.sigma = Interval(sigma);
    result.gamma_fraction = Interval(gamma_fraction);
    result.c1 = Interval(c1);
    result.c2 = Interval(c2);
    result.q1_equals_q2 = q1_equals_q2;
    return result;
  }
};

inline TestDesign table_design(const TableRow& row) {
  TestDesign design;
  design.q1 = design.q2 = row.q;
  design.r = row.r;
  design.epsilon = row.epsilon;
  return design;
}

/// Admissible in both readings of the theorem, over many decades.
inline TestDesign random_design(Random& random) {
  const auto decades = [&](double from, double to) { return std::pow(10.0, random.uniform(from, to)); };
  TestDesign design;
  design.q1_equals_q2 = false;
  design.q2 = decades(-9.0, 1.0);
  design.q1 = design.q2 * decades(-6.0, 0.0);
  design.r = decades(-6.0, 4.0);
  design.epsilon = random.uniform(0.0, 0.9);
  design.state_bound = 1.0 + decades(-2.0, 3.0);
  design.sigma = random.below(2) == 0 ? decades(-8.0, -1.0) : random.uniform(0.01, 0.65);
  design.gamma_fraction = random.below(2) == 0 ? decades(-6.0, -0.1) : random.uniform(0.001, 0.99);
  design.c1 = decades(-3.0, 2.0);
  design.c2 = decades(-3.0, 2.0);
  return design;
}

}  // namespace veritrack::test
