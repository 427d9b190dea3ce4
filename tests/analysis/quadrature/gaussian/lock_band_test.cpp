#include "analysis/quadrature/gaussian/lock_band.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// Figure 3.4's design with its leak: small sets, some thousand cells each.
LockRequest band_request(double decibels, double lowest, double highest) {
  LockRequest request;
  request.design = test_sets::kLeakingDesign;
  request.noise_deviation = std::sqrt(0.5 * std::pow(10.0, -decibels / 10.0));
  request.level = 10.0;
  request.lowest_frequency = lowest;
  request.highest_frequency = highest;
  return request;
}
LockBand prove(const LockRequest& request, const Interval& needed) {
  const rigor::UpwardRounding upward;
  const trackers::ToneModel<double>& d = request.design;
  return prove_lock_band({Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(d.epsilon)}, request,
                         needed);
}
LockBand prove(const LockRequest& request) {
  return prove(request, Interval::from_bounds(request.lowest_frequency, request.highest_frequency));
}

}  // namespace

TEST_CASE("the sets of a band adjoin and cover it, and each is proved for its frequencies" *
          doctest::test_suite("nightly")) {
  const LockRequest request = band_request(28.0, -0.5, 3.0);
  const LockBand found = prove(request);
  CAPTURE(found.reason);
  REQUIRE_FALSE(found.sets.empty());
  MESSAGE(found.sets.size() << " pieces, " << found.cells << " cells");
  CHECK(found.sets.front().lowest_frequency == -0.5);
  CHECK(found.sets.back().highest_frequency == 3.0);
  for (std::size_t k = 1; k < found.sets.size(); ++k) {
    CHECK(found.sets[k].lowest_frequency == found.sets[k - 1].highest_frequency);
    CHECK(found.sets[k].bias[2] < found.sets[k - 1].bias[2]);
  }
  const trackers::ToneModel<double>& d = request.design;
  const LockVerification again = verify_lock_set(
      {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(d.epsilon)}, found.sets.front());
  CHECK(again.verdict == rigor::Verdict::proved);
}

TEST_CASE("of a band that is wider than is needed only the pieces that are needed are proved") {
  const LockBand found = prove(band_request(34.0, 0.0, 3.0), Interval::from_bounds(0.8, 1.2));
  CAPTURE(found.reason);
  REQUIRE_FALSE(found.sets.empty());
  CHECK(found.sets.front().lowest_frequency <= 0.8);
  CHECK(found.sets.back().highest_frequency >= 1.2);
  for (const LockSet& set : found.sets) {
    CHECK(set.highest_frequency > 0.8);
    CHECK(set.lowest_frequency < 1.2);
  }
}

TEST_CASE("where no set is found the reason names the frequency") {
  const LockBand found = prove(band_request(3.0, 1.0, 1.1));
  CHECK(found.sets.empty());
  CHECK(found.reason.find("1.05") != std::string::npos);
}

}  // namespace veritrack::quadrature
