// The tracker and its rotating-frame map over intervals and over dual numbers: the same code, enclosed and
// differentiated.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"
#include "tests/trackers/textbook_ekf.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::trackers {
namespace {

using rigor::Interval;
using test::Random;

ToneModel<Interval> over_intervals(const ToneModel<double>& design) {
  return {Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)};
}

/// The distance from `value` to the interval, zero inside; infinite when the interval is not finite.
long double distance(const Interval& interval, long double value) {
  if (!rigor::is_finite(interval)) {
    return std::numeric_limits<long double>::infinity();
  }
  return std::max({0.0L, static_cast<long double>(interval.lower()) - value,
                   value - static_cast<long double>(interval.upper())});
}

TEST_CASE("the tracker over intervals encloses the textbook filter in extended precision, tightly") {
  Random random(41);
  const std::int64_t runs = test::effort(200);
  for (std::int64_t run = 0; run < runs; ++run) {
    const auto design = test::random_design(random);
    const double frequency = random.uniform(-3.0, 3.0);
    const Eigen::Matrix3d p = test::random_covariance(random);
    test::TextbookEkf<long double> textbook{design.q1,
                                            design.q2,
                                            design.r,
                                            design.epsilon,
                                            Eigen::Matrix<long double, 3, 1>(1.0L, 0.0L, frequency),
                                            p.cast<long double>()};
    QuadratureEkf<double> in_double(design,
                                    {1.0, 0.0, frequency, FactoredCovariance<double>::from_matrix(p)});
    double in_phase = 1.0;
    double quadrature = 0.0;
    std::array<std::array<double, 2>, 5> measurements{};
    for (std::size_t k = 0; k < measurements.size(); ++k) {
      const double phase = frequency * static_cast<double>(k + 1);
      in_phase = std::cos(phase) + random.uniform(-0.05, 0.05);
      quadrature = std::sin(phase) + random.uniform(-0.05, 0.05);
      measurements[k] = {in_phase, quadrature};
      textbook.step({in_phase, quadrature});
      in_double.step(in_phase, quadrature);
    }

    const rigor::UpwardRounding upward;
    QuadratureEkf<Interval> enclosed(over_intervals(design),
                                     {Interval(1.0), Interval(0.0), Interval(frequency),
                                      FactoredCovariance<Interval>::from_matrix(rigor::to_interval(p))});
    for (std::size_t k = 0; k < measurements.size(); ++k) {
      enclosed.step(Interval(measurements[k][0]), Interval(measurements[k][1]));
      if (k == 0) {  // later the boxes wrap, the more the worse conditioned the design is
        const auto first = enclosed.filtered().state();
        const auto first_covariance = enclosed.filtered().covariance.matrix();
        CHECK(rigor::radius(first).maxCoeff() <= 1e-10);
        CHECK(rigor::radius(first_covariance).maxCoeff() <= 1e-10);
      }
    }
    const auto x = enclosed.filtered().state();
    const auto covariance = enclosed.filtered().covariance.matrix();
    const Eigen::Vector3d x_double = in_double.filtered().state();
    for (int i = 0; i < 3; ++i) {
      // Extended precision has rounding errors of its own, far below a double's.
      CHECK(distance(x(i), textbook.x(i)) <= 1e-15L);
      CHECK(distance(x(i), static_cast<long double>(x_double(i))) <= 1e-9L);
      for (int j = 0; j < 3; ++j) {
        CHECK(distance(covariance(i, j), textbook.P(i, j)) <= 1e-15L);
      }
    }
  }
}

TEST_CASE("over boxes, every tracker that starts in the box ends in the enclosure") {
  Random random(42);
  int finite = 0;
  for (int run = 0; run < 300; ++run) {
    const auto design = test::random_design(random);
    const auto centre = test::random_estimate(random);
    const double y1 = random.uniform(-1.0, 1.0);
    const double y2 = random.uniform(-1.0, 1.0);
    const double half_width = 0.01;
    QuadratureEstimate<Interval> box;
    {
      const rigor::UpwardRounding upward;
      const Interval spread = rigor::symmetric(half_width);
      const FactoredCovariance<double>& p = centre.covariance;
      box = {Interval(centre.in_phase) + spread,
             Interval(centre.quadrature) + spread,
             Interval(centre.frequency) + spread,
             {Interval(p.conditional_11), Interval(p.conditional_12), Interval(p.conditional_22),
              Interval(p.regression_1), Interval(p.regression_2), Interval(p.frequency_variance)}};
      box = step(box, Interval(y1), Interval(y2), over_intervals(design)).filtered;
    }
    const auto enclosure = box.state();
    const auto covariance = box.covariance;
    if (!rigor::is_finite(enclosure(2)) || !rigor::is_finite(covariance.frequency_variance)) {
      continue;  // the box was too wide for this design to show that det W > 0: nothing is claimed
    }
    ++finite;
    for (int sample = 0; sample < 20; ++sample) {
      QuadratureEstimate<double> start = centre;
      start.in_phase += random.uniform(-half_width, half_width);
      start.quadrature += random.uniform(-half_width, half_width);
      start.frequency += random.uniform(-half_width, half_width);
      test::TextbookEkf<long double> textbook{design.q1,
                                              design.q2,
                                              design.r,
                                              design.epsilon,
                                              start.state().cast<long double>(),
                                              start.covariance.matrix().cast<long double>()};
      textbook.step({static_cast<long double>(y1), static_cast<long double>(y2)});
      for (int i = 0; i < 3; ++i) {
        CHECK(distance(enclosure(i), textbook.x(i)) <= 1e-12L);
      }
      CHECK(distance(covariance.frequency_variance, textbook.P(2, 2)) <= 1e-12L);
    }
  }
  CHECK(finite >= 250);
}

TEST_CASE("a tracker fed with nothing known knows nothing") {
  const rigor::UpwardRounding upward;
  const ToneModel<Interval> design = over_intervals({0.0023, 0.0023, 0.05, 0.01});
  const FactoredCovariance<Interval> p{Interval(0.01), Interval(0.0), Interval(0.01),
                                       Interval(0.0),  Interval(0.0), Interval(0.01)};
  const QuadratureEstimate<Interval> start{Interval(1.0), Interval(0.0), Interval(0.5), p};
  CHECK(rigor::is_finite(step(start, Interval(1.0), Interval(0.0), design).filtered.frequency));
  CHECK_FALSE(rigor::is_finite(step(start, Interval::empty(), Interval(0.0), design).filtered.frequency));
  CHECK_FALSE(rigor::is_finite(step(start, Interval(1.0), Interval(NAN), design).filtered.frequency));
  QuadratureEstimate<Interval> indefinite = start;
  indefinite.covariance.frequency_variance =
      Interval::from_bounds(-1.0, 1.0);  // the update may divide by zero
  CHECK_FALSE(rigor::is_finite(step(indefinite, Interval(1.0), Interval(0.0), design).filtered.frequency));
}

RotatingFrameState<double> random_state(Random& random) {
  const Eigen::Matrix3d p = test::random_covariance(random);
  RotatingFrameState<double> state;
  state << random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.5, 0.5), p(0, 0), p(0, 1),
      p(0, 2), p(1, 1), p(1, 2), p(2, 2);
  return state;
}

TEST_CASE("G over intervals meets the tracker over intervals: both enclose the same exact map") {
  Random random(43);
  const std::int64_t count = test::effort(2000);
  for (std::int64_t k = 0; k < count; ++k) {
    const auto design = test::random_design(random);
    const RotatingFrameState<double> state = random_state(random);
    const double frequency = random.uniform(-3.0, 3.0);
    const double slew = random.uniform(-0.1, 0.1);
    const double v1 = random.uniform(-0.1, 0.1);
    const double v2 = random.uniform(-0.1, 0.1);

    const rigor::UpwardRounding upward;
    const auto exact_design = over_intervals(design);
    const RotatingFrameState<Interval> exact_state = rigor::to_interval(state);
    const RotatingFrameInput<Interval> input{Interval(v1), Interval(v2), Interval(slew), Interval(frequency)};
    const RotatingFrameState<Interval> next = rotating_frame_map(exact_state, input, exact_design);

    // The same loop through the tracker, with phi(k) = 0.
    Eigen::Matrix<Interval, 3, 3> p;
    p << exact_state(kP11), exact_state(kP12), exact_state(kP13), exact_state(kP12), exact_state(kP22),
        exact_state(kP23), exact_state(kP13), exact_state(kP23), exact_state(kP33);
    const QuadratureEstimate<Interval> start{
        Interval(1.0) + exact_state(kDeltaInPhase), exact_state(kDeltaQuadrature),
        Interval(frequency) + exact_state(kFrequencyError), FactoredCovariance<Interval>::from_matrix(p)};
    const auto [sine, cosine] = rigor::sin_cos(Interval(frequency));
    const Interval y1 = Interval(1.0) + Interval(v1);
    const Interval y2(v2);
    const auto filtered =
        step(start, cosine * y1 - sine * y2, sine * y1 + cosine * y2, exact_design).filtered;
    const RotatingFrameState<Interval> seen =
        to_rotating_frame(filtered, Interval(1.0), Interval(frequency), Interval(frequency) + Interval(slew));
    for (int i = 0; i < 9; ++i) {
      CHECK_FALSE(rigor::is_empty(rigor::intersection(next(i), seen(i))));
      CHECK(rigor::radius(next(i)) <= 1e-9);
      CHECK(rigor::radius(seen(i)) <= 1e-9);
    }
  }
}

TEST_CASE("G over dual numbers: its derivatives are its differences") {
  using Number = rigor::Dual<double, 9>;
  Random random(44);
  for (int run = 0; run < 200; ++run) {
    const auto design = test::random_design(random);
    const RotatingFrameState<double> state = random_state(random);
    const RotatingFrameInput<double> input{0.05, -0.03, 0.01, 0.7};
    RotatingFrameState<Number> variables;
    for (int i = 0; i < 9; ++i) {
      std::array<double, 9> unit{};
      unit[static_cast<std::size_t>(i)] = 1.0;
      variables(i) = Number(state(i), unit);
    }
    const RotatingFrameState<Number> next = rotating_frame_map<Number>(
        variables, {Number(0.05), Number(-0.03), Number(0.01), Number(0.7)},
        {Number(design.q1), Number(design.q2), Number(design.r), Number(design.epsilon)});
    const RotatingFrameState<double> value = rotating_frame_map(state, input, design);
    for (int j = 0; j < 9; ++j) {
      // P_jj may be as small as 1e-5: a step far below, relative to r and P.
      const double h = 1e-6 * (j < 3 ? 1.0 : std::min(design.r, 0.1));
      RotatingFrameState<double> ahead = state;
      RotatingFrameState<double> behind = state;
      ahead(j) += h;
      behind(j) -= h;
      const RotatingFrameState<double> slope =
          (rotating_frame_map(ahead, input, design) - rotating_frame_map(behind, input, design)) / (2.0 * h);
      for (int i = 0; i < 9; ++i) {
        CHECK(next(i).value() == doctest::Approx(value(i)).epsilon(1e-12));
        CHECK(std::fabs(next(i).derivative(j) - slope(i)) <= 1e-4 * (1.0 + slope.norm()));
      }
    }
  }
}

TEST_CASE("the tracker runs on nested duals over intervals") {
  using Number = rigor::Dual<rigor::Dual<Interval, 1>, 1>;
  const rigor::UpwardRounding upward;
  const auto constant = [](double x) { return Number(x); };
  const ToneModel<Number> design{constant(0.0023), constant(0.0023), constant(0.05), constant(0.0)};
  const FactoredCovariance<Number> p{constant(0.01), constant(0.0), constant(0.01),
                                     constant(0.0),  constant(0.2), constant(0.01)};
  const rigor::Dual<Interval, 1> inner(Interval(0.5), {Interval(1.0)});
  const Number frequency(inner, {rigor::Dual<Interval, 1>(1.0)});
  const auto filtered = step<Number>({constant(1.0), constant(0.0), frequency, p}, constant(std::cos(0.5)),
                                     constant(std::sin(0.5)), design)
                            .filtered;
  // Second derivative of the filtered frequency by the predicted one, against a difference of the double
  // tracker.
  const auto run = [](double x) {
    return step<double>({1.0, 0.0, x, {0.01, 0.0, 0.01, 0.0, 0.2, 0.01}}, std::cos(0.5), std::sin(0.5),
                        {0.0023, 0.0023, 0.05, 0.0})
        .filtered.frequency;
  };
  const rigor::NearestRounding nearest;
  const double h = 1e-3;
  const double second = (run(0.5 + h) - 2.0 * run(0.5) + run(0.5 - h)) / (h * h);
  const Interval enclosed = filtered.frequency.derivative(0).derivative(0);
  REQUIRE(rigor::is_finite(enclosed));
  CHECK(std::fabs(enclosed.lower() - second) <= 1e-5);
  CHECK(std::fabs(enclosed.upper() - second) <= 1e-5);
}

}  // namespace
}  // namespace veritrack::trackers
