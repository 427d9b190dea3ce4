#include "analysis/quadrature/contraction/verification.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "analysis/quadrature/contraction/proposal.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;
using trackers::FactoredCovariance;
using trackers::QuadratureEkf;
using trackers::ToneModel;

struct Case {
  ToneModel<double> design;
  double aim;    ///< rad/sample: half of what gradient ascent said of an earlier scheme
  double least;  ///< what a prototype certified
};

const std::array<Case, 4> kCases{{{{0.0005, 0.0005, 0.01, 0.0}, 0.077, 0.0326},
                                  {{0.0013, 0.0013, 0.01, 0.0}, 0.155, 0.0532},
                                  {{0.0065, 0.0065, 0.01, 0.0}, 0.29, 0.0692},
                                  {{0.0023, 0.0023, 0.05, 0.0}, 0.064, 0.0282}}};

ToneModel<Interval> exact_design(const ToneModel<double>& d) {
  return {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(d.epsilon)};
}

/// The largest proposal on a ladder of fractions that verifies.
Verification certify(const ProposalRequest& request) {
  Verification last;
  const auto shapes = propose_shapes(request);
  if (shapes.empty()) {
    return last;
  }
  for (const double fraction : {0.8, 0.65, 0.5, 0.35, 0.2}) {
    if (const auto set = propose_set(request, shapes.front(), fraction)) {
      last = verify_certified_set(exact_design(request.design), *set);
      if (last.verdict == Verdict::proved) {
        break;
      }
    }
  }
  return last;
}

ProposalRequest request_for(const ToneModel<double>& design, Objective objective) {
  ProposalRequest request;
  request.design = design;
  request.objective = objective;
  request.evaluations = 40;
  return request;
}

Eigen::Matrix3d turn(double angle) {
  Eigen::Matrix3d u = Eigen::Matrix3d::Identity();
  u(0, 0) = u(1, 1) = std::cos(angle);
  u(1, 0) = std::sin(angle);
  u(0, 1) = -u(1, 0);
  return u;
}

/// The tracker itself, in the plane and without any of the analysis, next to a true signal.
class Simulation {
 public:
  Simulation(const ToneModel<double>& design, const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance,
             double phase, double frequency)
      : tracker_(design, start(error, covariance, phase, frequency)), phase_(phase), frequency_(frequency) {}

  void step(double noise_in_phase, double noise_quadrature, double slew) {
    phase_ += frequency_;
    frequency_ += slew;
    tracker_.step(std::cos(phase_) + noise_in_phase, std::sin(phase_) + noise_quadrature);
  }
  [[nodiscard]] double phase() const { return phase_; }
  [[nodiscard]] double frequency() const { return frequency_; }
  [[nodiscard]] Eigen::Vector3d error() const {
    const auto& x = tracker_.filtered();
    return {std::hypot(x.in_phase, x.quadrature) - 1.0,
            std::remainder(std::atan2(x.quadrature, x.in_phase) - phase_, 2.0 * std::numbers::pi),
            x.frequency - frequency_};
  }
  [[nodiscard]] Eigen::Matrix3d covariance() const {
    const auto& x = tracker_.filtered();
    const Eigen::Matrix3d u = turn(std::atan2(x.quadrature, x.in_phase));
    return u.transpose() * x.covariance.matrix() * u;
  }

 private:
  static trackers::QuadratureEstimate<double> start(const Eigen::Vector3d& error,
                                                    const Eigen::Matrix3d& covariance, double phase,
                                                    double frequency) {
    const Eigen::Matrix3d u = turn(phase + error(1));
    const Eigen::Matrix3d p = u * covariance * u.transpose();
    return {(1.0 + error(0)) * u(0, 0), (1.0 + error(0)) * u(1, 0), frequency + error(2),
            FactoredCovariance<double>::from_matrix(p)};
  }

  QuadratureEkf<double> tracker_;
  double phase_;
  double frequency_;
};

double least_eigenvalue_of(const Eigen::Matrix3d& m) {
  return oracle::least_eigenvalue(0.5 * (m + m.transpose()));
}

/// Is the filter in the set, up to rounding?
bool is_inside(const CertifiedSet& set, const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  constexpr double kSlack = 1e-10;
  return (set.metric * error).norm() <= set.radius * (1.0 + kSlack) &&
         least_eigenvalue_of(covariance - set.covariance_lower) >= -kSlack &&
         least_eigenvalue_of(set.covariance_upper - covariance) >= -kSlack;
}

/// A covariance of the set on or near its boundary: C + D Y D with |Y| <= 1.
Eigen::Matrix3d random_covariance_of(const CertifiedSet& set, test::Random& random) {
  const Eigen::Matrix3d middle = 0.5 * (set.covariance_lower + set.covariance_upper);
  const Eigen::Matrix3d half = 0.5 * (set.covariance_upper - set.covariance_lower);
  const Eigen::Matrix3d d = oracle::cholesky_factor(half);
  Eigen::Matrix3d a;
  for (int i = 0; i < 9; ++i) {
    a(i / 3, i % 3) = random.uniform(-1.0, 1.0);
  }
  const Eigen::Matrix3d q = oracle::orthogonal_factor(a);
  Eigen::Vector3d y;
  for (int i = 0; i < 3; ++i) {
    y(i) = random.below(2) == 0 ? (random.below(2) == 0 ? 1.0 : -1.0) : random.uniform(-1.0, 1.0);
  }
  return middle + d * q * y.asDiagonal() * q.transpose() * d.transpose();
}

Eigen::Vector3d random_error_of(const CertifiedSet& set, test::Random& random) {
  const Eigen::Vector3d u(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  const double level = random.below(2) == 0 ? 1.0 : random.uniform();
  return set.metric.inverse() * u.normalized() * (level * set.radius);
}

/// The same for one of the four designs, found once.
const Verification& certified(std::size_t index, Objective objective) {
  static std::map<std::pair<std::size_t, Objective>, Verification> found;
  const auto key = std::make_pair(index, objective);
  if (!found.contains(key)) {
    found[key] = certify(request_for(kCases[index].design, objective));
  }
  return found[key];
}

TEST_CASE("the four designs reach the aims") {
  for (std::size_t index = 0; index < kCases.size(); ++index) {
    const Case& one = kCases[index];
    const Verification& v = certified(index, Objective::start_error);
    INFO("q1 = " << one.design.q1 << ", r = " << one.design.r << ": " << v.reason);
    REQUIRE(v.verdict == Verdict::proved);
    const rigor::UpwardRounding upward;
    const double radius = error_bounds(v.set, Interval(v.set.radius))[2].lower();
    CHECK(radius > one.least);
    CHECK(radius > one.aim);
    MESSAGE("frequency error radius " << radius << ", rate " << v.set.rate << ", cells " << v.cells);
  }
}

TEST_CASE("a step from the certified set leads into it and contracts, whatever the state in it") {
  test::Random random(51);
  for (std::size_t index = 0; index < kCases.size(); ++index) {
    const Case& one = kCases[index];
    const Verification& v = certified(index, Objective::start_error);
    REQUIRE(v.verdict == Verdict::proved);
    const std::int64_t count = test::effort(20000);
    double worst = 0.0;
    for (std::int64_t k = 0; k < count; ++k) {
      const Eigen::Vector3d error = random_error_of(v.set, random);
      const Eigen::Matrix3d covariance = random_covariance_of(v.set, random);
      Simulation run(one.design, error, covariance, random.uniform(-3.0, 3.0), random.uniform(0.0, 3.0));
      run.step(0.0, 0.0, 0.0);
      REQUIRE(is_inside(v.set, run.error(), run.covariance()));
      worst = std::max(worst, (v.set.metric * run.error()).norm() / (v.set.metric * error).norm());
    }
    CHECK(worst <= v.set.rate + 1e-9);
    // The proof is not so wide of the mark that the check above could not fail.
    CHECK(worst >= 0.6 * v.set.rate);
  }
}

TEST_CASE("noise and slew within the certified limits never drive the tracker out") {
  test::Random random(52);
  for (std::size_t index = 0; index < kCases.size(); ++index) {
    const Case& one = kCases[index];
    for (const Objective objective : {Objective::noise, Objective::slew}) {
      const Verification& v = certified(index, objective);
      INFO("q1 = " << one.design.q1 << ", r = " << one.design.r << ": " << v.reason);
      REQUIRE(v.verdict == Verdict::proved);
      CHECK(std::max(v.set.noise, v.set.slew) > 0.0);
      for (int kind = 0; kind < 6; ++kind) {
        Simulation run(one.design, random_error_of(v.set, random), random_covariance_of(v.set, random),
                       random.uniform(-3.0, 3.0), 1.0);
        const std::int64_t steps = test::effort(2500);
        const double resonance = random.uniform(0.05, 1.0);
        for (std::int64_t k = 0; k < steps; ++k) {
          // Random, constant across the signal, alternating, resonant, away from the estimate.
          const double t = static_cast<double>(k);
          const double sign = kind == 1                  ? 1.0
                              : kind == 2                ? (k % 2 == 0 ? 1.0 : -1.0)
                              : kind == 3                ? (std::sin(resonance * t) < 0.0 ? -1.0 : 1.0)
                              : kind == 4                ? (run.error()(1) < 0.0 ? 1.0 : -1.0)
                              : kind == 5                ? (run.error()(2) < 0.0 ? 1.0 : -1.0)
                              : (random.uniform() < 0.5) ? 1.0
                                                         : -1.0;
          const double angle =
              kind == 0 ? random.uniform(-3.2, 3.2) : run.phase() + run.frequency() + 0.5 * std::numbers::pi;
          run.step(sign * v.set.noise * std::cos(angle), sign * v.set.noise * std::sin(angle),
                   -sign * v.set.slew);
          REQUIRE(is_inside(v.set, run.error(), run.covariance()));
        }
      }
    }
  }
}

TEST_CASE("a set that is too large does not verify") {
  for (const Case& one : kCases) {
    const auto request = request_for(one.design, Objective::start_error);
    const auto shapes = propose_shapes(request);
    REQUIRE(!shapes.empty());
    auto set = propose_set(request, shapes.front(), 0.5);
    REQUIRE(set.has_value());
    CertifiedSet larger = *set;
    larger.radius *= 3.0;
    CHECK(verify_certified_set(exact_design(one.design), larger).verdict == Verdict::undecided);
    CertifiedSet faster = *set;
    faster.rate = 0.3;
    CHECK(verify_certified_set(exact_design(one.design), faster).verdict == Verdict::undecided);
    CertifiedSet noisier = *set;
    noisier.noise = 0.5;
    CHECK(verify_certified_set(exact_design(one.design), noisier).verdict == Verdict::undecided);
    CertifiedSet slewing = *set;
    slewing.slew = (*set).radius;
    CHECK(verify_certified_set(exact_design(one.design), slewing).verdict == Verdict::undecided);
    CertifiedSet narrower = *set;
    narrower.covariance_upper = 0.5 * (narrower.covariance_upper + narrower.covariance_lower);
    CHECK(verify_certified_set(exact_design(one.design), narrower).verdict == Verdict::undecided);
  }
}

TEST_CASE("proposals with NaN, infinities, wrong signs or a wrong form never verify and never throw") {
  const auto request = request_for(kCases[1].design, Objective::start_error);
  const auto shapes = propose_shapes(request);
  REQUIRE(!shapes.empty());
  const auto set = propose_set(request, shapes.front(), 0.4);
  REQUIRE(set.has_value());
  REQUIRE(verify_certified_set(exact_design(kCases[1].design), *set).verdict == Verdict::proved);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity, -1.0}) {
    for (int entry = 0; entry < 9; ++entry) {
      CertifiedSet broken = *set;
      broken.metric(entry / 3, entry % 3) = bad;
      if (entry != 5 || bad != -1.0) {  // the coupling may be negative
        CHECK(verify_certified_set(exact_design(kCases[1].design), broken).verdict == Verdict::undecided);
      }
      broken = *set;
      broken.covariance_lower(entry / 3, entry % 3) = bad;
      CHECK(verify_certified_set(exact_design(kCases[1].design), broken).verdict == Verdict::undecided);
      broken = *set;
      broken.covariance_upper(entry / 3, entry % 3) = bad;
      CHECK(verify_certified_set(exact_design(kCases[1].design), broken).verdict == Verdict::undecided);
    }
    for (double CertifiedSet::*member :
         {&CertifiedSet::radius, &CertifiedSet::noise, &CertifiedSet::slew, &CertifiedSet::rate}) {
      CertifiedSet broken = *set;
      broken.*member = bad;
      CHECK(verify_certified_set(exact_design(kCases[1].design), broken).verdict == Verdict::undecided);
    }
    for (int entry = 0; entry < 4; ++entry) {
      ToneModel<Interval> design = exact_design(kCases[1].design);
      (entry == 0   ? design.q1
       : entry == 1 ? design.q2
       : entry == 2 ? design.r
                    : design.epsilon) = Interval(bad);
      CHECK(verify_certified_set(design, *set).verdict == Verdict::undecided);
    }
  }
  CertifiedSet slow = *set;
  slow.rate = 1.0;
  CHECK(verify_certified_set(exact_design(kCases[1].design), slow).verdict == Verdict::undecided);
}

TEST_CASE("without process noise on the amplitude nothing is proposed") {
  CHECK(propose_shapes(request_for({0.0, 0.001, 0.01, 0.0}, Objective::start_error)).empty());
}

TEST_CASE("random designs: what is proved is never broken by simulation") {
  test::Random random(53);
  const std::int64_t designs = test::effort(15);
  int proved = 0;
  for (std::int64_t i = 0; i < designs; ++i) {
    const auto power = [&](double low, double high) { return std::pow(10.0, random.uniform(low, high)); };
    const double q2 = power(-5.0, -1.5);
    const ToneModel<double> design{q2 * power(-1.0, 0.5), q2, power(-3.0, 0.0), 0.0};
    ProposalRequest request =
        request_for(design, std::array<Objective, 3>{Objective::start_error, Objective::noise,
                                                     Objective::slew}[static_cast<std::size_t>(i % 3)]);
    request.evaluations = 12;
    const Verification v = certify(request);
    if (v.verdict != Verdict::proved) {
      continue;
    }
    ++proved;
    for (int run_index = 0; run_index < 10; ++run_index) {
      Simulation run(design, random_error_of(v.set, random), random_covariance_of(v.set, random), 0.3, 1.0);
      for (int k = 0; k < 200; ++k) {
        const double sign =
            run_index % 2 == 0 ? (run.error()(2) < 0.0 ? 1.0 : -1.0) : (random.below(2) == 0 ? 1.0 : -1.0);
        const double angle = run.phase() + run.frequency() + 0.5 * std::numbers::pi;
        run.step(sign * v.set.noise * std::cos(angle), sign * v.set.noise * std::sin(angle),
                 -sign * v.set.slew);
        REQUIRE(is_inside(v.set, run.error(), run.covariance()));
      }
    }
  }
  CHECK(proved >= designs / 2);
}

}  // namespace
}  // namespace veritrack::quadrature
