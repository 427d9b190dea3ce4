// The textbook filter seen in the polar frame: the oracle of the tests of sets around the steady state.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "analysis/sets/fixed_point_bias.hpp"
#include "tests/trackers/textbook_ekf.hpp"

namespace veritrack::test {

using Polar = rigor::Vector<9>;

inline Eigen::Matrix3d turn(double angle) {
  Eigen::Matrix3d u = Eigen::Matrix3d::Identity();
  u.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return u;
}

/// The textbook filter on a tone, started at a state of the polar frame and read in that frame.
struct Simulation {
  TextbookEkf<double> filter;
  double phase = 0.0;
  double frequency;

  Simulation(const trackers::ToneModel<rigor::Interval>& design, const Polar& start, double omega)
      : filter{midpoint(design.q1),      midpoint(design.q2),     midpoint(design.r),
               midpoint(design.epsilon), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()},
        frequency(omega) {
    Eigen::Matrix3d p;
    p << start[3], start[4], start[5], start[4], start[6], start[7], start[5], start[7], start[8];
    const Eigen::Matrix3d u = turn(start[1]);
    filter.P = u * p * u.transpose();
    filter.x << (1.0 + start[0]) * std::cos(start[1]), (1.0 + start[0]) * std::sin(start[1]),
        omega + start[2];
  }

  void step(const Eigen::Vector2d& noise, double slew) {
    phase = std::remainder(phase + frequency, 2.0 * M_PI);
    frequency += slew;
    filter.step(Eigen::Vector2d(std::cos(phase), std::sin(phase)) + noise);
    filter.P = (0.5 * (filter.P + filter.P.transpose())).eval();
  }

  [[nodiscard]] Polar state() const {
    const double angle = std::atan2(filter.x[1], filter.x[0]);
    const Eigen::Matrix3d p = turn(-angle) * filter.P * turn(angle);
    Polar result;
    result << filter.x.head<2>().norm() - 1.0, std::remainder(angle - phase, 2.0 * M_PI),
        filter.x[2] - frequency, p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2);
    return result;
  }
};

/// X*(omega) in double, on the branch's cells.
inline Polar steady_state(const Simulation& simulation, const std::vector<sets::FixedPointFamily<9>>& cells,
                          const trackers::ToneModel<rigor::Interval>& design) {
  for (const auto& cell : cells) {
    if (cell.parameter.lower() <= simulation.frequency && simulation.frequency <= cell.parameter.upper()) {
      const Polar guess = cell.center + cell.slope * (simulation.frequency - cell.parameter_center);
      const auto exact =
          sets::propose_fixed_point(sets::QuadraturePolarLoop{design}, guess, simulation.frequency);
      REQUIRE(exact.has_value());
      return exact->state;
    }
  }
  FAIL("no cell");
  return Polar::Zero();
}

}  // namespace veritrack::test
