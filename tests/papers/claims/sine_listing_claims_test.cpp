#include "papers/claims/sine_listing_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <map>
#include <string>

#include "analysis/rigor/rounding.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("the slides' derivations are right, two entries of the listings are not") {
  const std::map<std::string, Verdict> expected{{"zarchan/matrices/transition", Verdict::proved},
                                                {"zarchan/matrices/phase-noise", Verdict::proved},
                                                {"zarchan/matrices/oscillator-noise", Verdict::proved},
                                                {"zarchan/matrices/square-noise", Verdict::proved},
                                                {"zarchan/matrices/oscillator-jacobian", Verdict::proved},
                                                {"zarchan/listings/second", Verdict::refuted},
                                                {"zarchan/listings/fourth", Verdict::refuted}};
  const rigor::UpwardRounding upward;
  std::map<std::string, Verdict> found;
  for (const theorems::Statement& statement : theorems::sine_listing_claims()) {
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.emplace(statement.id, statement.verdict).second);
  }
  CHECK(found == expected);
}

TEST_CASE("the process noise by Simpson's rule, which is exact for it: positive, and with the cube") {
  const double sample = 0.1;
  const double x = 0.7;
  // Filter of (x, x', z): column (0, -x tau, 1).
  const auto integrand = [&](double tau) {
    const Eigen::Vector3d column(0.0, -x * tau, 1.0);
    return Eigen::Matrix3d(column * column.transpose());
  };
  const Eigen::Matrix3d q =
      sample / 6.0 * (integrand(0.0) + 4.0 * integrand(sample / 2.0) + integrand(sample));
  CHECK(q(1, 1) == doctest::Approx(x * x * sample * sample * sample / 3.0));
  CHECK(q(1, 2) == doctest::Approx(-x * sample * sample / 2.0));
  // Filter of (phi, omega): column (tau, 1).
  CHECK((sample / 6.0) * (0.0 + 4.0 * sample / 2.0 + sample) == doctest::Approx(0.5 * sample * sample));
}
