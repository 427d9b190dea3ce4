// Tracks a noisy tone with a frequency that is not known. Compile with Eigen's headers and the folder that
// holds trackers/:
//     g++ -std=c++20 -O2 -I. -I/usr/include/eigen3 docs/example/track.cpp
#include <cstdio>

#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/signals/test_signals.hpp"

int main() {
  using namespace veritrack::trackers;
  const Eigen::Matrix3d start_covariance = Eigen::Vector3d(0.05, 0.05, 0.1).asDiagonal();
  QuadratureEkf<double> tracker({.q1 = 0.0023, .q2 = 0.0023, .r = 0.05, .epsilon = 0.0},
                                {.in_phase = 1.0,
                                 .quadrature = 0.0,
                                 .frequency = 0.3,
                                 .covariance = FactoredCovariance<double>::from_matrix(start_covariance)});
  for (const Sample& sample :
       make_signal("constant", {.samples = 200, .frequency_low = 0.5, .frequency_high = 0.5})) {
    tracker.step(sample.in_phase, sample.quadrature);
  }
  std::printf("%.4f rad/sample\n", tracker.filtered().frequency);
}
