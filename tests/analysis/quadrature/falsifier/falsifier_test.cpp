#include "analysis/quadrature/falsifier/falsifier.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/contraction/set_search.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;
using trackers::ToneModel;

ToneModel<Interval> exact(const ToneModel<double>& d) {
  return {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(d.epsilon)};
}

double log_uniform(test::Random& random, double lower, double upper) {
  return std::exp(random.uniform(std::log(lower), std::log(upper)));
}

ToneModel<double> random_design(test::Random& random) {
  const double q1 = log_uniform(random, 1e-4, 1e-1);
  const double q2 = log_uniform(random, 1e-4, 1e-1);
  return {q1, q2, log_uniform(random, 1e-3, 1.0), 0.0};
}

/// The certificate of a design for a random start, noise and slew.
ContractionCertificate certificate_of(const ToneModel<double>& design, test::Random& random) {
  sets::ContractionQuestion question;
  question.design = exact(design);
  question.search_evaluations = 2;
  question.with_samples = false;
  const double size = log_uniform(random, 1e-4, 0.03);
  question.initial_amplitude_error = Interval(size);
  question.initial_phase_error = Interval(2.0 * size);
  question.initial_frequency_error = Interval(size * std::sqrt(design.q2 / design.r));
  question.noise = Interval(random.below(4) == 0 ? 0.0 : log_uniform(random, 1e-5, 1e-2));
  question.slew = Interval(
      random.below(2) == 0 ? 0.0 : log_uniform(random, 1e-3, 1e-1) * design.q2 / std::sqrt(design.r));
  return certify_contraction(question);
}

/// A PROVED set that tolerates noise and slew: large, or with tight gains.
std::optional<CertifiedSet> proved_set(const ToneModel<double>& design,
                                       Objective objective = Objective::start_error) {
  sets::ContractionQuestion question;
  question.design = exact(design);
  question.search_evaluations = 5;
  question.noise = Interval(0.003);
  question.slew = Interval(0.05 * design.q2 / std::sqrt(design.r));
  question.initial_phase_error = Interval(0.001);
  const auto found = find_set(question, objective);
  return found ? std::optional(found->set) : std::nullopt;
}

FalsifierOptions quick() {
  FalsifierOptions options;
  options.search_evaluations = 4;
  options.gradient_iterations = 1;
  return options;
}

/// The largest frequency error of a run, simulated anew in the plane with the two halves of a step: the
/// oracle for what is reported.
double replayed(const ToneModel<double>& design, const Attack& attack) {
  double phase = -1.1;
  double frequency = 0.3;
  const double estimated = phase + attack.start_error[1];
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(estimated).toRotationMatrix();
  const Eigen::Matrix3d covariance = turn * attack.start_covariance * turn.transpose();
  const double length = 1.0 + attack.start_error[0];
  trackers::QuadratureEkf<double> tracker(
      design, {length * std::cos(estimated), length * std::sin(estimated), frequency + attack.start_error[2],
               trackers::FactoredCovariance<double>::from_matrix(covariance)});
  double largest = 0.0;
  for (const Eigen::Vector3d& input : attack.inputs) {
    phase += frequency;
    frequency += input[2];
    tracker.time_update();
    const std::complex<double> predicted(tracker.predicted().in_phase, tracker.predicted().quadrature);
    const std::complex<double> noise =
        std::complex<double>(input[0], input[1]) * predicted / std::abs(predicted);
    const std::complex<double> measured = std::polar(1.0, phase) + noise;
    tracker.measurement_update(measured.real(), measured.imag());
    largest = std::max(largest, std::abs(tracker.filtered().frequency - frequency));
  }
  return largest;
}

/// Least, mean and largest.
struct Spread {
  double least = std::numeric_limits<double>::infinity(), sum = 0.0, largest = 0.0;
  int count = 0;
  void add(double x) {
    least = std::min(least, x);
    largest = std::max(largest, x);
    sum += x;
    ++count;
  }
  [[nodiscard]] std::string text() const {
    return std::to_string(least) + " / " + std::to_string(sum / count) + " / " + std::to_string(largest);
  }
};

TEST_CASE("nothing that is PROVED breaks, at random designs") {
  test::Random random(41);
  const auto designs = test::effort(25);
  int proved = 0;
  int sets = 0;
  Spread rim, zero, level;
  for (std::int64_t i = 0; i < designs; ++i) {
    const ToneModel<double> design = random_design(random);
    const ContractionCertificate certificate = certificate_of(design, random);
    proved += certificate.derivation.verdict == Verdict::proved ? 1 : 0;
    for (const auto* verification :
         {&certificate.set, &certificate.noise_set, &certificate.slew_set, &certificate.bound_set,
          &certificate.ultimate_set, &certificate.settling_set}) {
      if (!*verification) {
        continue;
      }
      ++sets;
      const CertifiedSet& set = (*verification)->set;
      const Falsification found = try_to_break(set, design, quick());
      CAPTURE(test::kSeed);
      CAPTURE(i);
      CAPTURE(design.q1);
      CAPTURE(design.q2);
      CAPTURE(design.r);
      CAPTURE((found.alarm ? found.alarm->attack.structure + ": " + found.alarm->statement : std::string()));
      CHECK_FALSE(found.alarm.has_value());
      CHECK(found.from_rim.tightness() <= 1.0);
      CHECK(found.from_zero.tightness() <= 1.0);
      // An attack that achieves nothing would prove nothing about the certificate.
      CHECK(found.from_rim.tightness() > 0.02);
      CHECK(found.from_rim.step >= 1);
      rim.add(found.from_rim.tightness());
      if (found.from_zero.bound > 0.0) {
        zero.add(found.from_zero.tightness());
      }
      level.add(found.largest_level);
    }
  }
  CHECK(4 * proved >= 3 * designs);
  MESSAGE(proved << " of " << designs << " designs PROVED with " << sets
                 << " sets; least / mean / largest tightness from the rim " << rim.text() << ", from zero "
                 << zero.text() << ", |T e| / R " << level.text());
}

TEST_CASE("what is false breaks, for most designs" * doctest::test_suite("nightly")) {
  struct Falsehood {
    const char* name;
    void (*tell)(CertifiedSet&);
    Objective of;  ///< which set it is told of
    int broken;
  };
  std::array<Falsehood, 7> falsehoods{{
      {"radius times 4", [](CertifiedSet& s) { s.radius *= 4.0; }, Objective::start_error, 0},
      {"noise as large as the signal", [](CertifiedSet& s) { s.noise = 1.0; }, Objective::start_error, 0},
      {"slew times 30", [](CertifiedSet& s) { s.slew *= 30.0; }, Objective::ultimate_error, 0},
      {"frequency bound divided by 4", [](CertifiedSet& s) { s.metric(2, 2) *= 4.0; }, Objective::start_error,
       0},
      {"gains divided by 3",
       [](CertifiedSet& s) {
         s.noise_gain /= 3.0;
         s.slew_gain /= 3.0;
       },
       Objective::ultimate_error, 0},
      {"rate halved", [](CertifiedSet& s) { s.rate *= 0.5; }, Objective::start_error, 0},
      {"covariance bounds moved together",
       [](CertifiedSet& s) {
         const Eigen::Matrix3d third = (s.covariance_upper - s.covariance_lower) / 3.0;
         s.covariance_lower += third;
         s.covariance_upper -= third;
       },
       Objective::start_error, 0},
  }};
  test::Random random(42);
  const auto designs = test::effort(25);
  int proved = 0;
  for (std::int64_t i = 0; i < designs; ++i) {
    const ToneModel<double> design = random_design(random);
    const auto large = proved_set(design);
    const auto tight = proved_set(design, Objective::ultimate_error);
    if (!large || !tight) {
      continue;
    }
    ++proved;
    for (Falsehood& falsehood : falsehoods) {
      CertifiedSet claim = falsehood.of == Objective::start_error ? *large : *tight;
      falsehood.tell(claim);
      const Falsification found = try_to_break(claim, design, quick());
      falsehood.broken += found.alarm.has_value() ? 1 : 0;
      CHECK((!found.alarm || !found.alarm->attack.inputs.empty()));
    }
  }
  REQUIRE(proved > 0);
  for (const Falsehood& falsehood : falsehoods) {
    MESSAGE(std::string(falsehood.name) << ": " << falsehood.broken << " of " << proved << " broken");
    CHECK(5 * falsehood.broken >= 4 * proved);
  }
}

TEST_CASE("the same question gets the same answer, and what is no set is refused") {
  const ToneModel<double> design{0.0023, 0.0023, 0.05, 0.0};
  const auto set = proved_set(design);
  REQUIRE(set.has_value());
  const Falsification one = try_to_break(*set, design, quick());
  const Falsification two = try_to_break(*set, design, quick());
  CHECK(one.from_rim.frequency_error == two.from_rim.frequency_error);
  CHECK(one.from_zero.frequency_error == two.from_zero.frequency_error);
  CHECK(one.runs == two.runs);

  FalsifierOptions none = quick();
  none.steps = 0;
  CHECK_THROWS_AS(static_cast<void>(try_to_break(*set, design, none)), std::invalid_argument);
  CertifiedSet swapped = *set;
  std::swap(swapped.covariance_lower, swapped.covariance_upper);
  CHECK_THROWS_AS(static_cast<void>(try_to_break(swapped, design)), std::invalid_argument);
  CertifiedSet flat = *set;
  flat.metric(2, 2) = 0.0;
  CHECK_THROWS_AS(static_cast<void>(try_to_break(flat, design)), std::invalid_argument);
  CertifiedSet odd = *set;
  odd.radius = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(static_cast<void>(try_to_break(odd, design)), std::invalid_argument);
}

TEST_CASE("attacks stay within the limits they are given and can be repeated") {
  const ToneModel<double> design{0.0013, 0.0013, 0.01, 0.0};
  const auto set = proved_set(design);
  REQUIRE(set.has_value());
  const Falsification found = try_to_break(*set, design);
  for (const WorstCase* worst : {&found.from_rim, &found.from_zero}) {
    const Attack& attack = worst->attack;
    CHECK((set->metric * attack.start_error).norm() <= set->radius * (1.0 + 1e-12));
    REQUIRE(!attack.inputs.empty());
    CHECK(replayed(design, attack) == doctest::Approx(worst->frequency_error).epsilon(1e-9));
    for (const Eigen::Vector3d& input : attack.inputs) {
      CHECK(std::hypot(input[0], input[1]) <= set->noise * (1.0 + 1e-12));
      CHECK(std::abs(input[2]) <= set->slew);
    }
  }
  CHECK(found.from_zero.attack.start_error.norm() == 0.0);
  // The largest set leaves large gains to noise and slew: its bound in the long run is not a sharp one.
  CHECK(found.from_zero.tightness() > 0.02);
}

}  // namespace
}  // namespace veritrack::quadrature
