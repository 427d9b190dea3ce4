#include "analysis/theorems/theorem_2_9_repaired.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "analysis/search/maximize.hpp"
#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

/// The steady state along exact estimates, by the textbook Riccati recursion in the frame of the estimate.
Eigen::Matrix3d textbook_steady_state(const test::TestDesign& design) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(1, 2) = 1.0;
  f(2, 2) = 1.0 - design.epsilon;
  const Eigen::Matrix<double, 2, 3> h = Eigen::Matrix<double, 2, 3>::Identity();
  Eigen::Matrix3d p = Eigen::Matrix3d::Identity();
  for (int step = 0; step < 3000; ++step) {
    const Eigen::Matrix3d predicted =
        f * p * f.transpose() + Eigen::Vector3d(design.q1, design.q1, design.q2).asDiagonal().toDenseMatrix();
    const Eigen::Matrix2d s = h * predicted * h.transpose() + design.r * Eigen::Matrix2d::Identity();
    p = predicted - predicted * h.transpose() * s.inverse() * h * predicted;
  }
  return p;
}

/// What is done to the tracker: sizes, and how start and noise are directed.
struct Attack {
  double start = 0.0, measurement_noise = 0.0, process_noise = 0.0;
  double start_latitude = 0.0, start_longitude = 0.0;
  double noise_phase = 0.0, noise_turn = 0.0, process_period = 2.0;
};

/// The largest W(k) = sqrt(e' P^-1 e) of the plain tracker over 150 samples, from the signal e^{i phi}.
double largest_error(const test::TestDesign& design, const Eigen::Matrix3d& steady, const Attack& attack) {
  const rigor::NearestRounding nearest;
  Eigen::Vector3d x(1.0, 0.0, 0.4);
  const Eigen::Vector3d direction(std::cos(attack.start_latitude) * std::cos(attack.start_longitude),
                                  std::cos(attack.start_latitude) * std::sin(attack.start_longitude),
                                  std::sin(attack.start_latitude));
  const Eigen::Vector3d estimate = x - attack.start * direction;
  const double angle = std::atan2(estimate[1], estimate[0]);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  trackers::QuadratureEkf<double> ekf(
      {design.q1, design.q2, design.r, design.epsilon},
      {estimate[0], estimate[1], estimate[2],
       trackers::FactoredCovariance<double>::from_matrix(turn * steady * turn.transpose())});
  double largest = 0.0;
  for (int k = 0; k < 150; ++k) {
    const auto& filtered = ekf.filtered();
    const Eigen::Vector3d error = x - filtered.state();
    largest = std::max(largest, std::sqrt(error.dot(filtered.covariance.matrix().inverse() * error)));
    const std::complex<double> z = std::polar(1.0, x[2]) * std::complex<double>(x[0], x[1]);
    const bool up = std::fmod(k, attack.process_period) < 0.5 * attack.process_period;
    x = {z.real() / std::abs(z), z.imag() / std::abs(z),
         (1.0 - design.epsilon) * x[2] + (up ? 1.0 : -1.0) * attack.process_noise};
    // Relative to the phase of the signal, where a constant direction pulls steadily.
    const std::complex<double> v =
        std::polar(attack.measurement_noise, std::arg(z) + attack.noise_phase + attack.noise_turn * k);
    ekf.step(x[0] + v.real(), x[1] + v.imag());
  }
  return largest;
}

/// NLopt looks for the directions that make W(k) largest.
double worst_error(const test::TestDesign& design, const Attack& sizes) {
  const Eigen::Matrix3d steady = textbook_steady_state(design);
  const auto objective = [&](const Eigen::VectorXd& v) {
    Attack attack = sizes;
    attack.start_latitude = v[0];
    attack.start_longitude = v[1];
    attack.noise_phase = v[2];
    attack.noise_turn = v[3];
    attack.process_period = v[4];
    return largest_error(design, steady, attack);
  };
  search::SearchSpace space;
  constexpr double kPi = std::numbers::pi;
  space.start.resize(5);
  space.start << 0.7, 1.5, 1.5, 0.0, 150.0;
  space.step.resize(5);
  space.step << 0.3, 0.5, 0.5, 0.1, 20.0;
  space.lower.resize(5);
  space.lower << -kPi / 2.0, -kPi, -kPi, -kPi, 2.0;
  space.upper.resize(5);
  space.upper << kPi / 2.0, kPi, kPi, kPi, 400.0;
  space.evaluations = 120;
  space.method = search::SearchMethod::direct;
  const search::BestPoint everywhere = search::maximize(objective, space);
  space.start = everywhere.point;
  space.method = search::SearchMethod::subplex;
  return std::max(everywhere.value, search::maximize(objective, space).value);
}

double witness(const theorems::Derivation& derivation, const std::string& name) {
  for (const theorems::Quantity& quantity : derivation.feasibility->witness) {
    if (quantity.name == name) {
      return quantity.value.lower();
    }
  }
  FAIL("no witness named " << name);
  return 0.0;
}

double quantity(const theorems::Derivation& derivation, const char* name) {
  return theorems::find_quantity(derivation, name).value.lower();
}

/// The start alone, and start, noise and process noise together, as large as certified.
void try_to_break(const test::TestDesign& design) {
  const theorems::Derivation derivation = theorems::derive_repaired_theorem({design.input(), std::nullopt});
  REQUIRE(derivation.feasibility.has_value());
  REQUIRE(derivation.feasibility->verdict == Verdict::proved);
  CAPTURE(design.q1);
  CAPTURE(design.q2);
  CAPTURE(design.r);
  CAPTURE(design.epsilon);
  constexpr double kRounding = 1.0 + 1e-7;
  Attack start;
  start.start = quantity(derivation, "initial_error_bound");
  CHECK(worst_error(design, start) <= quantity(derivation, "radius") * kRounding);
  Attack frequency_only;
  frequency_only.start = quantity(derivation, "initial_frequency_error_bound");
  frequency_only.start_latitude = std::numbers::pi / 2.0;
  CHECK(largest_error(design, textbook_steady_state(design), frequency_only) <=
        quantity(derivation, "radius") * kRounding);
  Attack all;
  all.start = witness(derivation, "initial_error_bound");
  all.measurement_noise = witness(derivation, "c_2") * std::sqrt(design.r);
  all.process_noise = witness(derivation, "c_1") * std::sqrt(design.q2);
  CHECK(worst_error(design, all) <= witness(derivation, "radius") * kRounding);
}

TEST_CASE("the worst starts and noise that NLopt finds never break what is certified: Table 3.2") {
  for (const test::TableRow& row : test::kTable32) {
    test::TestDesign design = test::table_design(row);
    try_to_break(design);
    design.epsilon = 0.0;
    try_to_break(design);
  }
}

TEST_CASE("nor for random designs") {
  test::Random random(2970);
  const std::int64_t count = test::effort(20);
  for (std::int64_t i = 0; i < count; ++i) {
    test::TestDesign design;
    design.r = std::pow(10.0, random.uniform(-4.0, 0.0));
    design.q2 = design.r * std::pow(10.0, random.uniform(-3.0, 0.0));
    design.q1 = design.q2 * std::pow(10.0, random.uniform(-1.0, 1.0));
    design.q1_equals_q2 = false;
    design.epsilon = random.below(2) == 0 ? 0.0 : random.uniform(0.0, 0.1);
    try_to_break(design);
  }
}

TEST_CASE("an assumed start and noise within the bounds is PROVED, and simulation keeps the bound") {
  test::TestDesign design = test::table_design(test::kTable32[1]);
  design.epsilon = 0.0;
  theorems::Theorem29Input input = design.input();
  input.process_noise = Interval(0.0);
  input.measurement_noise = Interval(1e-4);
  input.initial_error = Interval(1e-3);
  const auto derivation = theorems::derive_repaired_theorem({input, std::nullopt});
  REQUIRE(derivation.verdict == Verdict::proved);
  CHECK(quantity(derivation, "ultimate_frequency_error") < quantity(derivation, "frequency_error_bound"));

  const rigor::UpwardRounding upward;
  const rigor::IntervalMatrix<3> given = rigor::to_interval(textbook_steady_state(design));
  CHECK(theorems::derive_repaired_theorem({input, given}).verdict == Verdict::proved);
  const rigor::IntervalMatrix<3> huge = given * Interval(100.0);
  CHECK(theorems::derive_repaired_theorem({input, huge}).verdict == Verdict::undecided);
  input.measurement_noise = Interval(1.0);
  CHECK(theorems::derive_repaired_theorem({input, std::nullopt}).verdict == Verdict::undecided);
}

TEST_CASE("what is no number, or no filter, certifies nothing") {
  const auto nothing = theorems::derive_repaired_theorem({});
  CHECK(nothing.verdict != Verdict::proved);
  CHECK(nothing.feasibility->verdict == Verdict::undecided);
  test::TestDesign design;
  design.q1 = 0.0;
  design.q1_equals_q2 = false;
  const auto singular = theorems::derive_repaired_theorem({design.input(), std::nullopt});
  CHECK(singular.verdict == Verdict::refuted);  // Q > 0 is a condition
  CHECK(singular.feasibility->verdict == Verdict::refuted);
  CHECK(singular.feasibility->lower_bound->lower() == 1.0);
  theorems::Theorem29Input wide = test::TestDesign{}.input();
  wide.r = Interval::from_bounds(0.01, std::numeric_limits<double>::infinity());
  CHECK(theorems::derive_repaired_theorem({wide, std::nullopt}).feasibility->verdict == Verdict::undecided);
}

}  // namespace
