#include "analysis/quadrature/rounding/set_rounding.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/contraction/verification.hpp"
#include "tests/analysis/quadrature/rounding/rounding_twin.hpp"

using namespace veritrack;
using namespace veritrack::quadrature;
using namespace veritrack::test;
using rigor::Interval;

namespace {

const trackers::ToneModel<double> kDesign{0.0023, 0.0023, 0.05, 0.0};

trackers::ToneModel<Interval> exact() {
  return {Interval(kDesign.q1), Interval(kDesign.q2), Interval(kDesign.r), Interval(0.0)};
}

/// A set that was certified for the design of Figure 3.5 without its leak: the largest for noise of 0.001.
CertifiedSet large_set() {
  CertifiedSet s;
  s.metric << 0x1.16d7b187bb1dp+3, 0, 0, 0, 0x1.94a22f42e4696p+2, -0x1.1ca69fb40a477p+2, 0, 0,
      0x1.ac504ba09a3ccp+3;
  s.radius = 0x1.63a9ecba5513dp+1;
  s.covariance_lower << 0x1.7177084cf6a13p-8, 0, 0, 0, 0x1.3377ae1d8514p-7, 0x1.08fb1e4c52ee8p-9, 0,
      0x1.08fb1e4c52ee8p-9, 0x1.18423af70c76cp-8;
  s.covariance_upper << 0x1.84cbc36b04e22p-6, 0, 0, 0, 0x1.3ef524b3d118ep-5, 0x1.fcd8e4211924bp-7, 0,
      0x1.fcd8e4211924bp-7, 0x1.e2aeb9ff6aa98p-7;
  s.noise = 0x1.0624dd2f1a9fcp-10;
  s.rate = 0x1.f34d3a5ec7969p-1;
  s.noise_gain = 0x1.b808395ab29f6p+5;
  return s;
}

/// Of the same, the one for a small error in the long run.
CertifiedSet small_set() {
  CertifiedSet s;
  s.metric << 0x1.79e9e30ace801p+2, 0, 0, 0, 0x1.94a22f42e4696p+2, -0x1.711f0bb8c3935p+3, 0, 0,
      0x1.d281e2e2e6438p+3;
  s.radius = 0x1.e7d82b2a2085p-4;
  s.covariance_lower << 0x1.2a0baf66ccacp-7, 0, 0, 0, 0x1.8a2616229de24p-6, 0x1.d8f8dafc35a5p-8, 0,
      0x1.d8f8dafc35a5p-8, 0x1.e1ac4d4055eebp-8;
  s.covariance_upper << 0x1.4def2c47448dp-7, 0, 0, 0, 0x1.a94ef80de99c1p-6, 0x1.045f5aea85111p-7, 0,
      0x1.045f5aea85111p-7, 0x1.00b6132b642cp-7;
  s.noise = 0x1.0624dd2f1a9fcp-10;
  s.rate = 0x1.c7a5133aaa572p-1;
  s.noise_gain = 0x1.c6f5df8114ff7p+1;
  return s;
}

/// The largest shares of the bounds that steps from random states of the set reach.
struct Shares {
  double error = 0.0, covariance = 0.0;
};
Shares shares_of(const CertifiedSet& set, const SetRounding& bound, std::uint64_t stream) {
  Random random(stream);
  const Eigen::Matrix3d inverse = set.metric.inverse();
  Shares shares;
  for (std::int64_t i = 0; i < effort(3000); ++i) {
    const double phase = random.uniform(-3.0, 3.0);
    const double omega = random.uniform(-3.1, 3.1);
    Eigen::Vector3d direction(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                              random.uniform(-1.0, 1.0));
    const Eigen::Vector3d e =
        inverse * direction.normalized() * (0.999 * set.radius * std::cbrt(random.uniform(0.2, 1.0)));
    const double angle = phase + e[1];
    const Eigen::Matrix3d u = plane_turn(angle);
    const Eigen::Matrix3d p = u * between(random, set.covariance_lower, set.covariance_upper) * u.transpose();
    const trackers::QuadratureEstimate<double> start{(1.0 + e[0]) * std::cos(angle),
                                                     (1.0 + e[0]) * std::sin(angle), omega + e[2],
                                                     trackers::FactoredCovariance<double>::from_matrix(p)};
    const double of_noise = random.uniform(0.0, 2.0 * M_PI);
    const Twins twins = twin_steps(kDesign, start, std::cos(phase + omega) + set.noise * std::cos(of_noise),
                                   std::sin(phase + omega) + set.noise * std::sin(of_noise));
    const Wide next = static_cast<Wide>(phase) + static_cast<Wide>(omega);
    const WidePolar a = trackers::to_polar_frame<Wide>(estimate_as<Wide>(twins.computed), 1.0L, next, omega);
    const WidePolar b = trackers::to_polar_frame<Wide>(twins.exact, 1.0L, next, omega);
    shares.error = std::max(shares.error, distance(set.metric, a, b) / bound.error);
    shares.covariance =
        std::max(shares.covariance, share_of_difference(set.covariance_lower, a, b) / bound.covariance);
  }
  return shares;
}

}  // namespace

TEST_CASE("in a certified set rounding moves errors and covariance by less than the bounds") {
  for (const CertifiedSet& set : {large_set(), small_set()}) {
    const SetRounding bound = [&] {
      const rigor::UpwardRounding upward;
      return set_rounding(exact(), {}, set);
    }();
    const Shares shares = shares_of(set, bound, 7115);
    MESSAGE("radius " << set.radius << ", rounding " << bound.error << ", of which the twin shows "
                      << shares.error << "; covariance " << bound.covariance << ", " << shares.covariance);
    CHECK(shares.error <= 1.0);
    CHECK(shares.covariance <= 1.0);
    CHECK(shares.error >= 1e-5);
    CHECK(shares.covariance >= 1e-6);
    CHECK(bound.error <= 1e-10 * set.radius);
    CHECK(bound.covariance <= 1e-9);
  }
}

TEST_CASE("a certified set has room for rounding, and is refused when it has none") {
  const CertifiedSet set = small_set();
  const Verification verified = verify_certified_set(exact(), set);
  REQUIRE(verified.verdict == rigor::Verdict::proved);
  const SetRounding bound = [&] {
    const rigor::UpwardRounding upward;
    return set_rounding(exact(), {}, set);
  }();
  CHECK(verified.set.error_rounding >= bound.error);
  CHECK(verified.set.covariance_rounding >= bound.covariance);
  // The same errors, when noise leaves no room: R = L_v V / sqrt(1 - rate^2), but for 1e-14 of it.
  CertifiedSet full = set;
  full.noise = set.radius * std::sqrt(1.0 - set.rate * set.rate) / set.noise_gain * (1.0 - 1e-15);
  full.noise_gain = set.radius * std::sqrt(1.0 - set.rate * set.rate) / set.noise * (1.0 - 1e-15);
  full.noise = set.noise;
  const Verification refused = verify_certified_set(exact(), full);
  CHECK(refused.verdict == rigor::Verdict::undecided);
  CHECK(refused.reason.find("too large") != std::string::npos);
  // An amplitude at which the program overflows.
  CHECK(verify_certified_set(exact(), set, {Interval(1e200), 3.2}).reason.find("rounding") !=
        std::string::npos);
}

TEST_CASE("a change of z changes the phase, and the covariance that is seen from there") {
  const rigor::UpwardRounding upward;
  const PolarDifference polar =
      polar_difference({1e-3, 1e-4, 1e-5, 1e-6, 1e-7}, Interval(0.5), Interval(2.0), Interval(1.0));
  CHECK(polar.error[0].upper() == 1e-3);
  CHECK(polar.error[1].upper() >= std::asin(2e-3));
  CHECK(polar.error[1].upper() <= 1.001 * std::asin(2e-3));
  CHECK(polar.error[2].upper() == 1e-4);
  CHECK(polar.p_zz >= 1e-5 + 2.0 * 2e-3 * 2.0);
  CHECK(polar.p_z3 >= 1e-6 + 2e-3);
  CHECK(polar.p_33 == 1e-7);
  CHECK_FALSE(std::isfinite(
      polar_difference({1.0, 0.0, 0.0, 0.0, 0.0}, Interval(0.5), Interval(2.0), Interval(1.0)).p_zz));
}

TEST_CASE("a z that may be zero has no phase") {
  const rigor::UpwardRounding upward;
  for (const double least : {0.0, -0.5}) {
    CHECK_FALSE(std::isfinite(
        polar_difference({1e-3, 1e-4, 1e-5, 1e-6, 1e-7}, Interval(least), Interval(2.0), Interval(1.0))
            .p_zz));
  }
}

TEST_CASE("a share of P covers every small matrix within the bounds, and is not much more than needed") {
  const rigor::UpwardRounding upward;
  rigor::Matrix<3> p = rigor::Matrix<3>::Identity();
  p(2, 2) = 4.0;
  PolarDifference difference;
  difference.p_zz = 1e-14;
  difference.p_z3 = 2e-14;
  difference.p_33 = 4e-14;
  // [[1e-14, 2e-14], [2e-14, 4e-14]] needs 2e-14.
  CHECK(share_of(rigor::to_interval(p), difference) >= 2e-14);
  CHECK(share_of(rigor::to_interval(p), difference) <= 4e-14);
  p(2, 2) = 0.0;
  CHECK_FALSE(std::isfinite(share_of(rigor::to_interval(p), difference)));
}
