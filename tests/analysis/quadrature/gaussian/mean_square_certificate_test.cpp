#include "analysis/quadrature/gaussian/mean_square_certificate.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/gaussian/leaking_filter.hpp"
#include "analysis/quadrature/gaussian/linear_filter.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "tests/analysis/quadrature/gaussian/lock_question.hpp"
#include "tests/analysis/quadrature/gaussian/textbook_filter.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;

/// The root mean square of the frequency error over a run in the frame of the true phase.
double simulated(const trackers::ToneModel<double>& design, double deviation, double walk,
                 std::int64_t samples) {
  trackers::RandomStream random(4440);
  const BlockCovariance<double> p = *steady_covariance(design);
  trackers::RotatingFrameState<double> x;
  x << 0.0, 0.0, 0.0, p.p11, 0.0, 0.0, p.p22, p.p23, p.p33;
  double sum = 0.0;
  for (std::int64_t k = 0; k < samples; ++k) {
    sum += x[2] * x[2];
    x = trackers::rotating_frame_map(
        x, {deviation * random.normal(), deviation * random.normal(), walk * random.normal(), 0.0}, design);
  }
  return std::sqrt(sum / static_cast<double>(samples));
}

}  // namespace

TEST_CASE("the root mean square is above that of a simulation, and it is the one that was asked for") {
  for (const double walk : {0.0, 0.001}) {
    LockQuestion question = test_sets::question(26.0);
    question.frequency_walk = Interval(walk);
    question.enough_rms = 0.03;  // some thousand cells
    const LockCertificate lock = certify_lock(question);
    REQUIRE_FALSE(lock.sets.empty());
    const MeanSquareCertificate found = certify_mean_square(question, lock);
    CHECK(found.derivation.verdict == Verdict::proved);
    REQUIRE(found.mean_squares.size() == 1);
    CHECK(found.cells > 0);
    const double proved = theorems::find_quantity(found.derivation, "rms_frequency_error").value.upper();
    const trackers::ToneModel<double>& design = test_sets::kDesigns[1];
    const double deviation = question.noise_deviation.upper();
    const auto filter = linear_filter(design, lock.sets.front().centre);
    const double linear = std::sqrt(frequency_variance(*filter, deviation, walk));
    const double run = simulated(design, deviation, walk, test::effort(20000));
    MESSAGE("walk " << walk << ": proved " << proved << ", simulated " << run << ", linear " << linear);
    CHECK(proved > run);
    CHECK(run == doctest::Approx(linear).epsilon(0.1));
    CHECK(proved < 0.03);
    CHECK(proved > 0.029);
    // The start counts for less the longer it is ago.
    const Interval level = theorems::find_quantity(lock.derivation, "start_level").value;
    const auto rms = [&](double samples) {
      const rigor::UpwardRounding upward;
      return root_mean_square(lock.sets.front(), found.mean_squares.front(), level, Interval(samples))
          .upper();
    };
    CHECK(rms(10.0) > rms(1e3));
    CHECK(rms(1e12) == doctest::Approx(std::sqrt(found.mean_squares.front().bound)).epsilon(1e-6));
  }
}

TEST_CASE("without a set there is no mean square, and it says why") {
  const MeanSquareCertificate found = certify_mean_square(test_sets::question(3.0), LockCertificate{});
  CHECK(found.mean_squares.empty());
  CHECK(found.derivation.verdict == Verdict::undecided);
  CHECK(theorems::applicable_quantity(found.derivation, "rms_frequency_error") == nullptr);
  CHECK(found.derivation.conditions.front().verdict == Verdict::undecided);
}

TEST_CASE("with a leak the bias is in the root mean square, and what it is beside the linear filter's") {
  const LockSet set = [] {
    LockSet small = test_sets::leaking_set();
    small.level = 3.0;
    return small;
  }();
  LockQuestion question;
  question.design = test_sets::enclosed(test_sets::kLeakingDesign);
  question.noise_deviation = Interval(set.noise_deviation);
  question.frequency_walk = Interval(0.0);
  question.samples = Interval(1e6);
  question.frequencies = Interval::from_bounds(set.lowest_frequency, set.highest_frequency);
  question.enough_rms = 0.11;  // some thousand cells
  LockCertificate lock;
  lock.sets = {set};
  theorems::conclude(lock.derivation);
  theorems::add_quantity(lock.derivation, {"start_level", "", "", "", "", theorems::Sense::at_most},
                         Interval(2.0), "");
  const MeanSquareCertificate found = certify_mean_square(question, lock);
  CHECK(found.derivation.verdict == Verdict::proved);
  REQUIRE(found.mean_squares.size() == 1);
  const double proved = theorems::find_quantity(found.derivation, "rms_frequency_error").value.upper();
  const auto filter = leaking_filter(test_sets::kLeakingDesign, set.highest_frequency);
  REQUIRE(filter);
  const double linear = std::sqrt(mean_square_frequency_error(*filter, set.noise_deviation).value());
  MESSAGE("proved " << proved << ", linear " << linear << ", " << found.cells << " cells");
  CHECK(linear > std::fabs(filter->steady.errors[2]));
  CHECK(proved > linear);
  CHECK(proved < 0.11);
}

}  // namespace veritrack::quadrature
