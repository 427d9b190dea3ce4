#include "analysis/theorems/audit.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using theorems::Trajectory;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The real tracker on a slowly modulated signal with bounded noise, from a start a little off.
Trajectory simulate(const test::TestDesign& design, std::size_t steps, double noise) {
  test::Random random(2940);
  const trackers::ToneModel<double> ekf{design.q1, design.q2, design.r, design.epsilon};
  const Eigen::Matrix3d start_covariance = Eigen::Vector3d(0.02, 0.02, 0.01).asDiagonal();
  trackers::QuadratureEkf<double> tracker(
      ekf, {1.0, 0.004, 0.305, trackers::FactoredCovariance<double>::from_matrix(start_covariance)});
  Trajectory trajectory;
  double phase = 0.0;
  for (std::size_t k = 0; k < steps; ++k) {
    const double frequency = 0.3 + 0.05 * std::sin(0.01 * static_cast<double>(k));
    theorems::TrajectoryRecord record;
    record.true_state = {std::cos(phase), std::sin(phase), frequency};
    record.measurement = record.true_state.head<2>() +
                         noise * Eigen::Vector2d(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
    if (k > 0) {
      tracker.measurement_update(record.measurement.x(), record.measurement.y());
    }
    record.filtered_state = tracker.filtered().state();
    record.filtered_covariance = tracker.filtered().covariance.matrix();
    tracker.time_update();
    record.predicted_covariance = tracker.predicted().covariance.matrix();
    trajectory.push_back(record);
    phase = std::remainder(phase + frequency, 2.0 * std::acos(-1.0));
  }
  return trajectory;
}

struct Case {
  theorems::Theorem29Input input;
  theorems::Theorem29 theorem;
  Trajectory trajectory;
};

Case figure_3_5(std::size_t steps = 60) {
  const test::TestDesign design = test::table_design(test::kTable32[3]);
  Case result;
  result.input = design.input();
  result.theorem = theorems::evaluate_theorem_2_9(theorems::Theorem29Variant::printed, result.input);
  result.trajectory = simulate(design, steps, 0.05);
  return result;
}

theorems::Audit run(const Case& it) {
  return audit_theorem_2_9(it.theorem, it.input, it.trajectory);
}

/// Damages the trajectory or the theorem, and expects the inequality to be violated first at that step.
template <typename Damage>
void check_first_violation(const std::string& id, std::size_t step, Damage damage) {
  CAPTURE(id);
  Case it = figure_3_5();
  REQUIRE_FALSE(find_inequality(run(it), id).first_violation.has_value());
  damage(it);
  const auto inequality = find_inequality(run(it), id);
  REQUIRE(inequality.first_violation.has_value());
  CHECK(*inequality.first_violation == step);
  CHECK(inequality.violated >= 1);
  REQUIRE(inequality.worst.has_value());
  CHECK(inequality.worst->margin.upper() < 0.0);
}

}  // namespace

TEST_CASE("a run of the real tracker is decided at every step") {
  for (const test::TableRow& row : test::kTable32) {
    for (const auto variant : {theorems::Theorem29Variant::printed, theorems::Theorem29Variant::errata}) {
      CAPTURE(row.figure);
      const test::TestDesign design = test::table_design(row);
      Case it;
      it.input = design.input();
      it.theorem = theorems::evaluate_theorem_2_9(variant, it.input);
      it.trajectory = simulate(design, 200, 0.05);
      const theorems::Audit audit = run(it);
      CHECK(audit.steps_within_assumptions == 200);
      for (const auto& inequality : audit.inequalities) {
        CAPTURE(inequality.id);
        if (inequality.id == "error_bound") {
          CHECK(inequality.not_applicable.has_value());
          CHECK(inequality.steps_checked() == 0);
          continue;
        }
        CHECK_FALSE(inequality.not_applicable.has_value());
        CHECK(inequality.undecided == 0);
        CHECK(inequality.violated == 0);
        CHECK_FALSE(audit.refutes(inequality));
        CHECK(inequality.before_first_step.has_value() ==
              (inequality.first_step == 1 && (inequality.source.find("2.4.3") != std::string::npos)));
        const bool between_steps = inequality.id == "process_noise" || inequality.id == "gamma";
        CHECK(inequality.steps_checked() == 200 - inequality.first_step - (between_steps ? 1 : 0));
        REQUIRE(inequality.worst.has_value());
        CHECK(is_finite(inequality.worst->margin));
        CHECK(inequality.worst->margin.upper() - inequality.worst->margin.lower() <=
              1e-6 * (1.0 + inequality.worst->margin.upper()));
      }
    }
  }
}

TEST_CASE("each bound, violated at a known step, is found there") {
  constexpr std::size_t kStep = 17;
  using Damaged = Case&;
  check_first_violation("R_x", kStep, [](Damaged it) { it.trajectory[kStep].true_state.z() = 7.0; });
  check_first_violation("unit_circle", kStep,
                        [](Damaged it) { it.trajectory[kStep].true_state.x() += 1e-6; });
  check_first_violation("epsilon_r", kStep,
                        [](Damaged it) { it.trajectory[kStep].filtered_state.z() += 0.8; });
  // w(16) = x(17) - f(x(16)).
  check_first_violation("process_noise", kStep - 1,
                        [](Damaged it) { it.trajectory[kStep].true_state.z() += 0.3; });
  check_first_violation("measurement_noise", kStep,
                        [](Damaged it) { it.trajectory[kStep].measurement.x() += 1.0; });
  check_first_violation("estimate_bound", kStep,
                        [](Damaged it) { it.trajectory[kStep].filtered_state.z() = 7.8; });
  // rho_1 = 15.4 bounds about |z| + ..., rho_2 = 10.9 about |z|.
  check_first_violation("rho_1", kStep, [](Damaged it) { it.trajectory[kStep].filtered_state.x() = 16.0; });
  check_first_violation("rho_2", kStep, [](Damaged it) { it.trajectory[kStep].filtered_state.x() = 11.5; });
  check_first_violation("rho_3", kStep, [](Damaged it) { it.trajectory[kStep].filtered_state.x() = 11.5; });
  check_first_violation("rho_4", 0, [](Damaged it) { it.theorem.constants.rho_4 = Interval(0.1); });
  // O(k, 1) sees the estimate of the step before.
  check_first_violation("b_1", kStep + 1,
                        [](Damaged it) { it.trajectory[kStep].filtered_state.head<2>().setZero(); });
  check_first_violation("b_2", kStep + 1, [](Damaged it) { it.trajectory[kStep].filtered_state.x() = 5.0; });
  check_first_violation("a_1", 1,
                        [](Damaged it) { it.input.q1_equals_q2 = false, it.input.q1 = Interval(0.01); });
  check_first_violation("a_2", 1,
                        [](Damaged it) { it.input.q1_equals_q2 = false, it.input.q1 = Interval(0.01); });
  check_first_violation("p", kStep, [](Damaged it) { it.trajectory[kStep].filtered_covariance(1, 1) = 6e4; });
  check_first_violation("q_filtered", kStep,
                        [](Damaged it) { it.trajectory[kStep].filtered_covariance *= 1e-3; });
  check_first_violation("s", kStep,
                        [](Damaged it) { it.trajectory[kStep].predicted_covariance(2, 2) = 2e5; });
  check_first_violation("q_predicted", kStep,
                        [](Damaged it) { it.trajectory[kStep].predicted_covariance *= 1e-3; });
  check_first_violation("gamma", 0, [](Damaged it) { it.theorem.constants.gamma = Interval(1e4); });
  check_first_violation("epsilon_z", 0, [](Damaged it) { it.theorem.constants.epsilon_z = Interval(1e-30); });
  check_first_violation("alpha_beta", 0, [](Damaged it) { it.theorem.constants.beta = Interval(0.5); });
}

TEST_CASE("an indefinite covariance violates the lower bound on P, and only that") {
  Case it = figure_3_5();
  it.trajectory[9].filtered_covariance(0, 1) = it.trajectory[9].filtered_covariance(1, 0) = 1.0;
  const auto audit = run(it);
  CHECK(find_inequality(audit, "q_filtered").first_violation == 9);
  CHECK_FALSE(find_inequality(audit, "p").first_violation.has_value());
}

TEST_CASE("bounds that need the window N = 1 report step 0 apart") {
  Case it = figure_3_5();
  it.trajectory[0].filtered_covariance = Eigen::Matrix3d::Identity() * 1e9;
  const auto p = find_inequality(run(it), "p");
  CHECK_FALSE(p.first_violation.has_value());
  CHECK(p.steps_checked() == it.trajectory.size() - 1);
  REQUIRE(p.before_first_step.has_value());
  CHECK(p.before_first_step->step == 0);
  CHECK(p.before_first_step->verdict == rigor::Verdict::refuted);
}

TEST_CASE("a violation refutes a claim only while the assumptions hold") {
  Case it = figure_3_5();
  it.theorem.constants.p = Interval(1e-6);
  auto audit = run(it);
  CHECK(audit.refutes(find_inequality(audit, "p")));
  CHECK_FALSE(audit.refutes(find_inequality(audit, "s")));
  it.trajectory[0].filtered_state.z() += 1.0;  // |e(0|0)| > epsilon_r
  audit = run(it);
  CHECK(audit.steps_within_assumptions == 0);
  CHECK(find_inequality(audit, "p").violated == it.trajectory.size() - 1);
  CHECK_FALSE(audit.refutes(find_inequality(audit, "p")));
  CHECK(find_inequality(audit, "epsilon_r").first_violation == 0);
  CHECK_FALSE(audit.refutes(find_inequality(audit, "epsilon_r")));  // an assumption, not a claim
}

TEST_CASE("margins are what they say") {
  Case it = figure_3_5(3);
  it.trajectory[1].filtered_covariance = Eigen::Vector3d(0.5, 0.25, 0.125).asDiagonal();
  it.trajectory[2].filtered_covariance = Eigen::Vector3d(0.25, 0.75, 0.5).asDiagonal();
  it.theorem.constants.p = Interval(2.0);
  const auto p = find_inequality(run(it), "p");
  REQUIRE(p.worst.has_value());
  CHECK(p.worst->step == 2);
  CHECK(std::fabs(p.worst->margin.lower() - 1.25) <= 1e-14);
  CHECK(std::fabs(p.worst->margin.upper() - 1.25) <= 1e-14);
  CHECK(std::fabs(p.worst->relative_margin.upper() - 0.625) <= 1e-14);
}

TEST_CASE("NaN never counts as satisfied") {
  constexpr std::size_t kStep = 23;
  const std::size_t steps = 60;
  const auto poisoned = [&](auto poison) {
    Case it = figure_3_5(steps);
    poison(it.trajectory[kStep]);
    return run(it);
  };
  const auto check_undecided = [](const theorems::Audit& audit, const std::string& id, std::size_t count) {
    CAPTURE(id);
    const auto& inequality = find_inequality(audit, id);
    CHECK(inequality.undecided == count);
    CHECK(inequality.violated == 0);
    REQUIRE(inequality.worst.has_value());
    CHECK(is_finite(inequality.worst->margin));
  };
  auto audit = poisoned([](auto& record) { record.true_state.x() = kNaN; });
  CHECK(audit.steps_within_assumptions == kStep - 1);  // w(22) is made of x(23)
  for (const char* id : {"R_x", "unit_circle", "epsilon_r", "measurement_noise", "rho_4"}) {
    check_undecided(audit, id, 1);
  }
  check_undecided(audit, "process_noise", 2);
  check_undecided(audit, "gamma", steps - 1 - kStep);
  check_undecided(audit, "epsilon_z", steps - 1 - kStep);
  check_undecided(audit, "p", 0);

  audit = poisoned([](auto& record) { record.filtered_state.y() = kNaN; });
  CHECK(audit.steps_within_assumptions == kStep);
  for (const char* id : {"epsilon_r", "estimate_bound", "rho_1", "rho_2", "rho_3", "rho_4", "b_1", "b_2"}) {
    check_undecided(audit, id, 1);
  }
  audit = poisoned([](auto& record) { record.filtered_covariance(2, 1) = kNaN; });
  check_undecided(audit, "p", 1);
  check_undecided(audit, "q_filtered", 1);
  check_undecided(audit, "s", 0);
  audit = poisoned(
      [](auto& record) { record.predicted_covariance.setConstant(std::numeric_limits<double>::infinity()); });
  check_undecided(audit, "s", 1);
  check_undecided(audit, "q_predicted", 1);
  audit = poisoned([](auto& record) { record.measurement.setConstant(kNaN); });
  check_undecided(audit, "measurement_noise", 1);
  CHECK(audit.steps_within_assumptions == kStep);
}

TEST_CASE("the error bound is audited when there is one") {
  Case it = figure_3_5();
  it.theorem.error_bound = theorems::make_error_bound({.state_bound = Interval(7.0),
                                                       .beta = Interval(1.0),
                                                       .one_minus_alpha = Interval(0.5),
                                                       .zeta = Interval(0.0),
                                                       .eta = Interval(0.0078125),
                                                       .epsilon_z = Interval(0.5),
                                                       .initial_error = Interval(0.01)});
  REQUIRE(it.theorem.error_bound.has_value());  // 0.02 2^-k + 0.1015625
  it.trajectory[30].filtered_state = it.trajectory[30].true_state + Eigen::Vector3d(0.0, 0.0, 0.1015);
  it.trajectory[31].filtered_state = it.trajectory[31].true_state + Eigen::Vector3d(0.0, 0.0, 0.1017);
  for (std::size_t k = 0; k < 60; ++k) {
    if (k != 30 && k != 31) {
      it.trajectory[k].filtered_state = it.trajectory[k].true_state;
    }
  }
  const auto inequality = find_inequality(run(it), "error_bound");
  CHECK_FALSE(inequality.not_applicable.has_value());
  CHECK(inequality.first_violation == 31);
  CHECK(inequality.violated == 1);
  CHECK(inequality.steps_checked() == 60);
}

TEST_CASE("q1 = 0: bounds that do not exist are not audited") {
  test::TestDesign design = test::table_design(test::kTable32[3]);
  design.q1 = 0.0;
  design.q1_equals_q2 = false;
  Case it;
  it.input = design.input();
  it.theorem = theorems::evaluate_theorem_2_9(theorems::Theorem29Variant::printed, it.input);
  it.trajectory = simulate(design, 60, 0.05);
  const auto audit = run(it);
  for (const char* id :
       {"q_filtered", "s", "q_predicted", "gamma", "epsilon_z", "alpha_beta", "error_bound"}) {
    CAPTURE(id);
    CHECK(find_inequality(audit, id).not_applicable.has_value());
    CHECK(find_inequality(audit, id).steps_checked() == 0);
  }
  for (const char* id : {"p", "rho_1", "b_1", "a_2"}) {
    CAPTURE(id);
    CHECK_FALSE(find_inequality(audit, id).not_applicable.has_value());
    CHECK(find_inequality(audit, id).satisfied == 59 + (std::string(id) == "rho_1" ? 1 : 0));
  }
}

TEST_CASE("an empty trajectory and an unknown inequality") {
  Case it = figure_3_5(0);
  const auto audit = run(it);
  CHECK(audit.steps_within_assumptions == 0);
  for (const auto& inequality : audit.inequalities) {
    CHECK(inequality.steps_checked() == 0);
    CHECK_FALSE(inequality.worst.has_value());
    CHECK(inequality.statement.find('|') == std::string::npos);  // would split a cell of a Markdown table
  }
  CHECK_THROWS_AS((void)find_inequality(audit, "rho_9"), std::out_of_range);
}
