#include "analysis/single_channel/phase_certificate.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "analysis/single_channel/window_claim.hpp"
#include "tests/analysis/single_channel/phase_attack.hpp"
#include "tests/support/random.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;
using rigor::Verdict;

struct Case {
  double q, r, low, high, noise, slew, error;
};

PhaseQuestion question_of(const Case& one) {
  PhaseQuestion question;
  question.tracker.design = {Interval(one.q), Interval(one.q), Interval(one.r), Interval(0.0)};
  question.tracker.noise = Interval(one.noise);
  question.tracker.slew = Interval(one.slew);
  question.tracker.initial_amplitude_error = Interval(one.error);
  question.tracker.initial_phase_error = Interval(one.error);
  question.tracker.initial_frequency_error = Interval(one.error);
  question.band = Interval::from_bounds(one.low, one.high);
  return question;
}

PhaseCertificate certificate_of(const Case& one) {
  const rigor::UpwardRounding upward;
  return certify_over_phases(question_of(one));
}

double upper_end(const PhaseCertificate& certificate, const char* name) {
  return theorems::find_quantity(certificate.derivation, name).value.upper();
}

/// A start covariance of the certified range: an end of it, or one that differs from an end by a matrix of
/// rank one.
rigor::Matrix<3> start_covariance(const DiagonalStart& start, test::Random& random) {
  const double from = std::stod(start.from);
  const double to = std::stod(start.to);
  const double signal = std::sqrt(std::stod(start.signal));
  const rigor::Vector<3> root(signal, signal, std::sqrt(std::stod(start.frequency)));
  const rigor::Vector<3> direction =
      rigor::Vector<3>(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
          .normalized();
  const rigor::Matrix<3> one = rigor::Matrix<3>::Identity();
  const rigor::Matrix<3> rank = (to - from) * direction * direction.transpose();
  rigor::Matrix<3> multiple;
  switch (random.below(4)) {
    case 0:
      multiple = from * one;
      break;
    case 1:
      multiple = to * one;
      break;
    case 2:
      multiple = from * one + rank;
      break;
    default:
      multiple = to * one - rank;
  }
  return root.asDiagonal() * multiple * root.asDiagonal();
}

TEST_CASE("no attack breaks what is proved, from any P(0|0) of the certified range") {
  test::Random random;
  for (const Case& one :
       {Case{0.005, 0.01, 1.4, 1.5, 0.0008, 0.0001, 0.0005}, Case{1.0, 1.0, 0.7, 0.75, 0.0004, 0.0, 0.0005},
        Case{1.0, 10.0, 2.3, 2.36, 0.0004, 0.00002, 0.0002}}) {
    const PhaseCertificate certificate = certificate_of(one);
    REQUIRE(certificate.derivation.verdict == Verdict::proved);
    const double bound = upper_end(certificate, "frequency_error_bound");
    const double ultimate = upper_end(certificate, "ultimate_frequency_error");
    const double settling = upper_end(certificate, "settling_samples");
    const DiagonalStart start = certificate.bound_set.value().start.value();
    const auto runs = test::effort(30);
    double largest = 0.0;
    for (std::int64_t run = 0; run < runs; ++run) {
      const auto edge = [&] { return random.uniform() > 0.5 ? one.error : -one.error; };
      CAPTURE(run);
      const auto errors = test::attacked_errors({one.q, one.r, random.uniform(0.0, std::numbers::pi),
                                                 random.uniform(one.low, one.high), one.low, one.high,
                                                 one.noise, one.slew, edge(), edge(), edge(), 300,
                                                 start_covariance(start, random).cast<long double>()});
      for (std::size_t k = 0; k < errors.size(); ++k) {
        const double error = std::fabs(errors[k]);
        CHECK(error <= bound);
        if (static_cast<double>(k) >= settling) {
          CHECK(error <= 2.0 * ultimate);
        }
        largest = std::max(largest, error);
      }
    }
    CHECK(largest > 0.02 * bound);  // the attack is one
    MESSAGE("the frequency error reaches " << largest / bound << " of the bound " << bound);
  }
}

/// An error (delta, nu) of that level in the metric of the steady state that the start has.
rigor::Vector<3> error_of_level(const Case& one, double phase, double frequency, double level,
                                test::Random& random) {
  rigor::Vector<3> error(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  rigor::Matrix<3> turn = rigor::Matrix<3>::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(phase), std::sin(phase), -std::sin(phase), std::cos(phase);
  double turned_by = 0.0;
  for (int round = 0; round < 4; ++round) {  // the covariance depends on the phase that the start has
    const rigor::Matrix<3> p =
        turn * test::steady_covariance(one.q, one.r, frequency, phase + turned_by).cast<double>() *
        turn.transpose();
    error *= level / std::sqrt(error.dot(p.inverse() * error));
    turned_by = std::atan2(error(1), 1.0 + error(0));
  }
  return error;
}

TEST_CASE("no attack from the rim of a certified set leaves it") {
  test::Random random(1);
  for (const Case& one :
       {Case{0.005, 0.01, 1.4, 1.5, 0.0008, 0.0001, 0.0}, Case{1.0, 10.0, 0.5, 0.55, 0.0, 0.0, 0.0}}) {
    const rigor::UpwardRounding upward;
    const auto set = PhaseSearch(question_of(one)).largest_set();
    REQUIRE(set);
    const WindowAssumption& assumption = set->claim.assumption;
    const double bound = assumption.radius * std::sqrt(assumption.frequency_variance);
    const rigor::NearestRounding nearest;
    double largest = 0.0;
    for (std::int64_t run = 0; run < test::effort(60); ++run) {
      CAPTURE(run);
      const double phase = random.uniform(0.0, std::numbers::pi);
      const double frequency = random.uniform(one.low, one.high);
      const rigor::Vector<3> e = error_of_level(one, phase, frequency, 0.999 * set->start_level, random);
      const auto errors = test::attacked_errors({one.q, one.r, phase, frequency, one.low, one.high, one.noise,
                                                 one.slew, std::hypot(1.0 + e(0), e(1)) - 1.0,
                                                 std::atan2(e(1), 1.0 + e(0)), e(2), 100});
      for (const double error : errors) {
        CHECK(std::fabs(error) <= bound);
        largest = std::max(largest, std::fabs(error));
      }
    }
    CHECK(largest > 0.4 * bound);
  }
}

TEST_CASE("the designs of the paper's examples with Q = q I have a certified set over [0.4, 2.7]") {
  const rigor::UpwardRounding upward;
  for (const auto& [q, r] : {std::pair{0.005, 0.01}, std::pair{1.0, 1.0}, std::pair{1.0, 10.0}}) {
    const PhaseQuestion question = question_of({q, r, 0.4, 2.7, 0.0001, 0.00001, 0.0});
    const auto set = PhaseSearch(question).largest_set();
    REQUIRE(set);
    CHECK(set->start_level * std::sqrt(set->floor.p33) > 0.003);  // rad/sample
    CHECK(errors_of(question, *set).rate().upper() < 1.0);
  }
}

TEST_CASE("without process noise on the amplitude no steady state is exponentially stable") {
  PhaseQuestion question = question_of({0.005, 0.01, 0.9, 1.0, 0.0, 0.0, 0.0});
  question.tracker.design.q1 = Interval(0.0);
  const PhaseCertificate certificate = certify_over_phases(question);
  CHECK(certificate.derivation.verdict == Verdict::refuted);
  CHECK(!certificate.set);
  const auto& conditions = certificate.derivation.conditions;
  const auto refuted = std::find_if(conditions.begin(), conditions.end(), [](const auto& condition) {
    return condition.verdict == Verdict::refuted;
  });
  REQUIRE(refuted != conditions.end());
  CHECK(refuted->id == "controllable-amplitude");
  CHECK(refuted->reason.find("Witness") != std::string::npos);
}

TEST_CASE("what is not covered is undecided, and says why") {
  const auto check = [](const PhaseQuestion& question) {
    const PhaseCertificate certificate = certify_over_phases(question);
    CHECK(certificate.derivation.verdict == Verdict::undecided);
    for (const auto& condition : certificate.derivation.conditions) {
      CHECK(condition.reason.empty() == (condition.id == "start-in-set"));
    }
    CHECK(certificate.start.has_value() == certificate.set.has_value());
    CHECK(theorems::find_quantity(certificate.derivation, "frequency_error_bound").not_applicable);
  };
  const Case usual{0.005, 0.01, 1.2, 1.3, 0.0005, 0.0, 0.0005};
  PhaseQuestion question = question_of(usual);
  question.tracker.design.epsilon = Interval(0.05);
  check(question);
  check(question_of({0.005, 0.01, 1.2, 1.3, 0.5, 0.0, 0.0}));    // noise of half the amplitude
  check(question_of({0.005, 0.01, 1.2, 1.3, 0.0, 0.0, 0.3}));    // a start far off
  check(question_of({0.005, 0.01, 0.0, 0.001, 0.0, 0.0, 0.0}));  // almost a constant
  question = question_of(usual);
  question.tracker.noise = Interval::empty();
  check(question);
  question = question_of(usual);
  question.tracker.design.r = Interval::entire();
  check(question);
  question = question_of(usual);
  question.band = Interval::entire();
  check(question);
  question = question_of(usual);
  question.tracker.amplitude = Interval(0x1p-61);  // beyond the units in which rounding is bounded
  check(question);
  question = question_of(usual);
  question.tracker.start_covariance = sets::StartCovariance{
      rigor::to_interval(rigor::Matrix<3>(rigor::Matrix<3>::Identity())), Interval(1.0), true};
  check(question);
}

TEST_CASE("without noise and slew only rounding is left in the long run, and nobody waits for it") {
  const PhaseCertificate certificate = certificate_of({0.005, 0.01, 1.4, 1.5, 0.0, 0.0, 0.0005});
  REQUIRE(certificate.bound_set);
  const StepRounding& rounding = certificate.bound_set->claim.assumption.rounding;
  CHECK(rounding.error > 1e-14);
  CHECK(rounding.covariance > 1e-14);
  const double ultimate = upper_end(certificate, "ultimate_frequency_error");
  CHECK(ultimate > rounding.error * 1e-3);
  CHECK(ultimate < 1e-7);
  CHECK(theorems::find_quantity(certificate.derivation, "settling_samples").not_applicable);
}

TEST_CASE(
    "the start of a set is below every covariance of every design that is meant, not of the middle alone") {
  const rigor::UpwardRounding upward;
  int found = 0;
  for (const double share : {0.01, 0.02, 0.03}) {
    CAPTURE(share);
    PhaseQuestion question = question_of({0.005, 0.01, 1.2, 1.3, 0.0005, 0.00005, 0.0005});
    const Interval around = Interval::from_bounds(1.0 - share, 1.0 + share);
    question.tracker.design.q1 = question.tracker.design.q1 * around;
    question.tracker.design.q2 = question.tracker.design.q2 * around;
    const auto set = PhaseSearch(question).least_bound();
    if (set) {
      ++found;
      CHECK(certainly_below_covariances(question.tracker.design, question.band, set->claim,
                                        set->start->times(set->start->to, question.tracker.amplitude)));
    }
  }
  CHECK(found > 0);
}

TEST_CASE("a search for what is required stops at a set that does it, and a harder question is UNDECIDED") {
  const rigor::UpwardRounding upward;
  PhaseQuestion question = question_of({0.005, 0.01, 1.2, 1.3, 0.0005, 0.00005, 0.0005});
  const PhaseCertificate all = certify_over_phases(question);
  REQUIRE(all.bound_set);
  const double least = all.result.starts.proved_bound().value().upper();
  question.tracker.with_limits = false;
  question.tracker.effort = sets::SearchEffort::sufficient;
  for (const double share : {1.01, 1.5}) {
    question.tracker.required.frequency_error = share * least;
    const PhaseCertificate enough = certify_over_phases(question);
    REQUIRE(enough.bound_set);
    CHECK(enough.result.starts.verdict == rigor::Verdict::proved);
    CHECK(enough.result.starts.proved_bound().value().upper() < share * least);
    CHECK(enough.result.frequency_error_radius.value.lower() > 0.0);
  }
  question.tracker.required.frequency_error = 0.5 * least;
  const PhaseCertificate full = certify_over_phases(question);
  REQUIRE(full.bound_set);
  CHECK(full.result.starts.proved_bound().value().upper() == least);
  question.tracker.effort = sets::SearchEffort::quick;
  CHECK_FALSE(certify_over_phases(question).set);
  question.tracker.required.frequency_error.reset();
  question.tracker.required.samples = 2.0;
  question.tracker.settled_frequency_error = 2.0 * least;
  CHECK(certify_over_phases(question).bound_set);
  question.tracker.settled_frequency_error = 1e-9;
  CHECK_FALSE(certify_over_phases(question).bound_set);
}

TEST_CASE("the sets do not depend on the number of threads") {
  const rigor::UpwardRounding upward;
  const PhaseQuestion question = question_of({0.005, 0.01, 1.2, 1.3, 0.0005, 0.00005, 0.0005});
  const auto many = PhaseSearch(question).least_bound();
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = PhaseSearch(question).least_bound();
  REQUIRE(many);
  REQUIRE(alone);
  CHECK(many->claim.shares == alone->claim.shares);
  CHECK(many->claim.assumption.radius == alone->claim.assumption.radius);
  CHECK(many->floor.p33 == alone->floor.p33);
  CHECK(many->start_level == alone->start_level);
  CHECK(*many->assumed_level == *alone->assumed_level);
}

}  // namespace
}  // namespace veritrack::single_channel
