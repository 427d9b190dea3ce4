#include "certificates/sets/simulation.hpp"

#include "analysis/rigor/rounding.hpp"
#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

std::vector<trackers::Sample> simulated_signal(const Assumptions& assume,
                                               const SimulationSettings& settings) {
  trackers::SignalOptions options{.samples = settings.samples,
                                  .seed = settings.seed,
                                  .amplitude = assume.amplitude.nearest,
                                  .frequency_low = assume.frequency[0].nearest,
                                  .frequency_high = assume.frequency[1].nearest,
                                  .slew_bound = assume.slew.nearest};
  if (assume.gaussian) {
    options.noise_deviation = nearest_deviation(assume) * assume.amplitude.nearest;
    options.walk_deviation = assume.frequency_walk ? assume.frequency_walk->nearest : 0.0;
  } else {
    options.noise_bound = assume.noise.nearest;
  }
  return trackers::make_signal(settings.signal, options);
}

theorems::Trajectory at_unit_amplitude(theorems::Trajectory trajectory, double amplitude) {
  const rigor::NearestRounding nearest;
  if (amplitude == 1.0) {
    return trajectory;
  }
  const Eigen::Vector3d scale(1.0 / amplitude, 1.0 / amplitude, 1.0);
  for (theorems::TrajectoryRecord& record : trajectory) {
    record.true_state = record.true_state.cwiseProduct(scale).eval();
    record.measurement /= amplitude;
    record.filtered_state = record.filtered_state.cwiseProduct(scale).eval();
    record.filtered_covariance =
        (scale.asDiagonal() * record.filtered_covariance * scale.asDiagonal()).eval();
    record.predicted_covariance =
        (scale.asDiagonal() * record.predicted_covariance * scale.asDiagonal()).eval();
  }
  return trajectory;
}

}  // namespace veritrack::certificates
