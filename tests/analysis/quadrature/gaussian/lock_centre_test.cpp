#include "analysis/quadrature/gaussian/lock_centre.hpp"

#include <doctest/doctest.h>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/sets/fixed_point_bias.hpp"

namespace veritrack::quadrature {

TEST_CASE("the errors of the centre are those of the verified steady state") {
  using rigor::Interval;
  const trackers::ToneModel<double> design{0.0013, 0.0013, 0.01, 0.01};
  const double frequency = 2.0;
  const auto found = lock_centre(design, frequency);
  REQUIRE(found.has_value());
  const sets::LockBranch branch = sets::verify_lock_branch(
      {Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)},
      Interval(frequency));
  REQUIRE_FALSE(branch.cells.empty());
  const rigor::UpwardRounding upward;
  const sets::SteadyStateError steady = sets::steady_state_error(branch.cells.front());
  const double amplitude = midpoint(steady.amplitude_error);
  const double phase = midpoint(steady.phase_error);
  CHECK(found->errors[0] == doctest::Approx((1.0 + amplitude) * std::cos(phase) - 1.0).epsilon(1e-6));
  CHECK(found->errors[1] == doctest::Approx((1.0 + amplitude) * std::sin(phase)).epsilon(1e-6));
  CHECK(found->errors[2] == doctest::Approx(midpoint(steady.frequency_error)).epsilon(1e-6));
}

TEST_CASE("without a leak the errors are zero and the covariance is that of the filter") {
  const trackers::ToneModel<double> design{0.0013, 0.0013, 0.01, 0.0};
  const auto found = lock_centre(design, 2.0);
  REQUIRE(found.has_value());
  CHECK(found->errors == std::array<double, 3>{});
  CHECK(found->covariance.p33 == steady_covariance(design)->p33);
  // The amplitude's variance falls for ever.
  CHECK_FALSE(lock_centre({0.0, 0.0013, 0.01, 0.01}, 1.0).has_value());
}

}  // namespace veritrack::quadrature
