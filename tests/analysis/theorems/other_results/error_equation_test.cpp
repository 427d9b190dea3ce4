#include "analysis/theorems/other_results/error_equation.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "tests/analysis/theorems/simulated_errors.hpp"
#include "tests/analysis/theorems/tracker_inputs.hpp"
#include "tests/support/oracles.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

}  // namespace

TEST_CASE("the four facts and the constants hold along random runs of the textbook filter") {
  test::Random random(61);
  const rigor::UpwardRounding upward;
  for (std::int64_t i = 0; i < test::effort(100); ++i) {
    INFO("seed ", test::kSeed + 61, ", design ", i);
    test::TestDesign design;
    design.q1 = std::pow(10.0, random.uniform(-5.0, -1.0));
    design.q2 = std::pow(10.0, random.uniform(-5.0, -1.0));
    design.q1_equals_q2 = false;
    design.r = std::pow(10.0, random.uniform(-4.0, 0.0));
    design.epsilon = 0.0;
    const double radius = random.uniform(0.01, 0.5);
    const auto equation = theorems::error_equation(test::tracker_input(design), Interval(radius));
    const double alpha_squared = std::pow(1.0 - equation.one_minus_alpha.lower(), 2);
    const rigor::NearestRounding nearest;
    Eigen::Matrix3d p = test::steady_state(design);
    for (int step = 0; step < 20; ++step) {
      const double m = random.uniform(1.0 - radius, 1.0 + radius);
      const double angle = random.uniform(0.0, 6.3);
      const double frequency = random.uniform(-1.0, 1.0);
      test::TextbookEkf<double> filter{design.q1,
                                       design.q2,
                                       design.r,
                                       design.epsilon,
                                       {m * std::cos(angle), m * std::sin(angle), frequency},
                                       p};
      const double c = std::cos(frequency);
      const double s = std::sin(frequency);
      Eigen::Matrix3d f;
      f << c, -s, -filter.x(0) * s - filter.x(1) * c, s, c, filter.x(0) * c - filter.x(1) * s, 0.0, 0.0, 1.0;
      filter.time_update();
      const Eigen::Matrix3d predicted = filter.P;
      filter.measurement_update(filter.x.head<2>());
      const Eigen::Matrix3d next = 0.5 * (filter.P + filter.P.transpose());
      const Eigen::Matrix<double, 3, 2> gain = predicted.leftCols<2>() * filter.S.inverse();
      Eigen::Matrix3d correction = Eigen::Matrix3d::Identity();
      correction.leftCols<2>() -= gain;
      const Eigen::Matrix3d closed = correction.transpose() * next.inverse() * correction;
      const double scale = predicted.inverse().norm();
      CHECK(oracle::largest_eigenvalue(closed - predicted.inverse()) <= 1e-7 * scale);
      CHECK(oracle::largest_eigenvalue(gain.transpose() * next.inverse() * gain) <= (1.0 + 1e-7) / design.r);
      CHECK(oracle::largest_eigenvalue(f.transpose() * predicted.inverse() * f -
                                       alpha_squared * p.inverse()) <= 1e-7 * scale);
      CHECK(oracle::singular_values(correction)(0) <= equation.correction.upper() * (1.0 + 1e-9));
      CHECK(oracle::singular_values(gain)(0) <= equation.gain.upper() * (1.0 + 1e-9));
      CHECK(oracle::singular_values(f)(0) <= equation.transition.upper() * (1.0 + 1e-9));
      p = next;
    }
  }
}

TEST_CASE("no process noise, and values unknown, give empty constants") {
  const rigor::UpwardRounding upward;
  theorems::TrackerInput input = test::without_leak(test::kTable32[0]);
  input.theorem_2_9.q1_equals_q2 = false;
  input.theorem_2_9.q1 = Interval(0.0);
  CHECK(is_empty(theorems::error_equation(input, Interval(0.25)).one_minus_alpha));
  CHECK(is_empty(theorems::error_equation(input, Interval(0.25)).beta));
  input.theorem_2_9.q1 = Interval::from_bounds(0.0, std::numeric_limits<double>::infinity());
  CHECK(is_empty(theorems::error_equation(input, Interval(0.25)).correction));
  CHECK(theorems::start_covariance(input, theorems::error_equation(input, Interval(0.25))).verdict ==
        Verdict::undecided);
}

TEST_CASE(
    "the range of the covariance holds both ends of a range of starts, and nothing is said of multiples") {
  const rigor::UpwardRounding upward;
  const auto multiple = [](double factor) {
    return rigor::to_interval(rigor::Matrix<3>(factor * rigor::Matrix<3>::Identity()));
  };
  theorems::TrackerInput input = test::without_leak(test::kTable32[0]);
  input.initial_covariance = multiple(1e-5);
  input.largest_initial_covariance = multiple(7.0);
  const theorems::ErrorEquation wide = theorems::error_equation(input, Interval(0.25));
  CHECK(wide.covariance.smallest.upper() <= 1.001e-5);
  CHECK(wide.covariance.largest.lower() >= 7.0);
  CHECK(theorems::start_covariance(input, wide).verdict == Verdict::proved);
  input.initial_covariance.reset();
  input.largest_initial_covariance.reset();
  const theorems::ErrorEquation steady = theorems::error_equation(input, Interval(0.25));
  CHECK(theorems::start_covariance(input, steady).verdict == Verdict::proved);
  input.starts_from_multiples = true;
  CHECK(theorems::start_covariance(input, steady).verdict == Verdict::undecided);
}

TEST_CASE("the best radius has the largest value") {
  const rigor::UpwardRounding upward;
  const auto hump = [](const Interval& radius) { return radius * (Interval(0.1) - radius); };
  CHECK(theorems::best_radius(hump) == Interval(0.0625));
  CHECK(theorems::best_radius([](const Interval&) { return Interval::empty(); }) == Interval(0.5));
}
