#include "analysis/kkl_observer/kkl_worst_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/kkl_observer/kkl_error_map.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {

namespace {

using trackers::oscillator_state;

/// The state of the filters when the disturbance has always been bound * sign(kernel), the kernel being that
/// of the first-order frequency error.
template <int M>
Eigen::Matrix<double, M, 1> bang_bang(const KklErrorMap<double, M>& map, double frequency, double phase,
                                      double bound) {
  const auto c = map.pulling(map.signal(frequency, phase));
  const double slowest = *std::min_element(map.lambda().begin(), map.lambda().end());
  constexpr int kSteps = 1500;
  const double step = 15.0 / slowest / kSteps;
  Eigen::Matrix<double, M, 1> moved = Eigen::Matrix<double, M, 1>::Zero();
  for (int k = 0; k < kSteps; ++k) {
    Eigen::Matrix<double, M, 1> decay;
    double kernel = 0.0;
    for (Eigen::Index i = 0; i < M; ++i) {
      decay(i) = std::exp(-map.lambda()[static_cast<std::size_t>(i)] * (k + 0.5) * step);
      kernel += c[static_cast<std::size_t>(i)] * decay(i);
    }
    moved += (kernel > 0.0 ? bound : -bound) * step * decay;
  }
  return moved;
}

}  // namespace

template <int M>
SampledErrors sample_errors(const KklRobustnessQuestionOf<M>& question, int phases) {
  using Rates = Eigen::Matrix<double, M, 1>;
  const rigor::NearestRounding nearest;
  const Rates lambda = rigor::midpoint(question.range.lambda);
  const trackers::KklObserverDesign<double, M> design{lambda, rigor::midpoint(question.ell)};
  const KklErrorMap<double, M> map(lambda);
  SampledErrors largest;
  const auto look = [&](const Rates& xi, double amplitude, double frequency) {
    const auto x = trackers::kkl_inverse<double, M>(xi, design);
    if (!(x(2) > 0.0)) {
      largest.frequency = largest.amplitude = std::numeric_limits<double>::infinity();
      return;
    }
    const auto estimate = trackers::in_engineering_units(x);
    largest.frequency = std::max(largest.frequency, std::fabs(estimate.frequency - frequency));
    largest.amplitude = std::max(largest.amplitude, std::fabs(estimate.amplitude - amplitude));
  };
  const bool is_point = question.range.frequency.lower() == question.range.frequency.upper();
  const int frequencies = is_point ? 1 : 17;
  const double low = question.range.frequency.lower();
  const double ratio = question.range.frequency.upper() / low;
  for (int k = 0; k < frequencies; ++k) {
    const double frequency = is_point ? low : low * std::pow(ratio, k / (frequencies - 1.0));
    for (int j = 0; j < phases; ++j) {
      const double phase = std::numbers::pi * j / phases;
      for (const double amplitude : {question.amplitude.lower(), question.amplitude.upper()}) {
        const Rates clean =
            trackers::kkl_transform<double, M>(oscillator_state(amplitude, phase, frequency), lambda);
        if (const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&question.disturbance)) {
          for (int l = 0; l < 2 * phases; ++l) {
            const double other_phase = std::numbers::pi * l / phases;
            const auto other = oscillator_state(rigor::midpoint(sinusoidal->amplitude), other_phase,
                                                rigor::midpoint(sinusoidal->frequency));
            look(clean + trackers::kkl_transform<double, M>(other, lambda), amplitude, frequency);
          }
        } else if (const auto* bounded = std::get_if<BoundedDisturbance>(&question.disturbance)) {
          const Rates moved = bang_bang<M>(map, frequency, phase, rigor::midpoint(bounded->bound));
          look(clean + moved, amplitude, frequency);
          look(clean - moved, amplitude, frequency);
        } else {
          look(clean, amplitude, frequency);
        }
      }
    }
  }
  return largest;
}

template SampledErrors sample_errors<4>(const KklRobustnessQuestionOf<4>&, int);
template SampledErrors sample_errors<5>(const KklRobustnessQuestionOf<5>&, int);
template SampledErrors sample_errors<6>(const KklRobustnessQuestionOf<6>&, int);
template SampledErrors sample_errors<7>(const KklRobustnessQuestionOf<7>&, int);
template SampledErrors sample_errors<8>(const KklRobustnessQuestionOf<8>&, int);

}  // namespace veritrack::kkl_observer
