#include "analysis/model/steady_state/linear_worst_case.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analysis/model/steady_state/curve_fit.hpp"
#include "analysis/rigor/larger_or_nan.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

/// The number of samples after which errors that shrink by `rate` a sample are e^-12 of themselves.
int samples_to_forget(double rate) {
  constexpr double kLogarithm = 12.0;
  constexpr double kMostSamples = 60000.0;
  constexpr double kFewSamples = 64.0;
  const double samples = rate > 0.0 ? kLogarithm / -std::log(rate) : kFewSamples;
  return static_cast<int>(std::clamp(samples, kFewSamples, kMostSamples));
}

/// An orbit on the curve of a steady state, with the effect of its steps on deviations. Sample k is at the
/// phase `first` + k omega.
class Orbit {
 public:
  Orbit(const TrackedTone& tone, const NodeCurve& curve, const NodeCurve& beside, double first, int samples)
      : tone_(&tone), curve_(&curve), first_(first) {
    const int n = tone.step.states();
    for (int k = 1; k < samples; ++k) {
      const double next = phase(k);
      const Eigen::MatrixXd jacobian =
          tone.step.jacobian(state_at(curve, phase(k - 1)), samples_of(tone.signal, tone.amplitude, next));
      states_.emplace_back(jacobian.leftCols(n));
      inputs_.emplace_back(jacobian.rightCols(jacobian.cols() - n));
      of_amplitude_.emplace_back(inputs_.back() * samples_of(tone.signal, tone.amplitude_deviation, next));
      slopes_.emplace_back((state_at(beside, next) - state_at(curve, next)) /
                           (beside.frequency - curve.frequency));
    }
  }

  /// Adds up the effects of `memory` samples before sample `last` on its estimate.
  void judge(int last, int memory, double noise, double slew, LinearWorstCase& worst) const {
    const Eigen::VectorXd state = state_at(*curve_, phase(last));
    const double error = std::fabs(tone_->step.frequency(state) - curve_->frequency);
    Eigen::RowVectorXd row = tone_->step.frequency_gradient(state);
    double sum = error;
    for (int k = last; k > last - memory; --k) {
      const auto step = static_cast<std::size_t>(k - 1);
      sum += noise * (row * inputs_[step]).norm() + slew * std::fabs(row.dot(slopes_[step])) +
             std::fabs(row.dot(of_amplitude_[step]));
      row = (row * states_[step]).eval();
    }
    worst.undisturbed = rigor::larger_or_nan(worst.undisturbed, error);
    worst.disturbed = rigor::larger_or_nan(worst.disturbed, sum);
  }

 private:
  [[nodiscard]] double phase(int k) const { return first_ + k * curve_->frequency; }

  const TrackedTone* tone_;
  const NodeCurve* curve_;
  double first_;
  std::vector<Eigen::MatrixXd> states_, inputs_;  // of the step to sample k at k - 1
  std::vector<Eigen::VectorXd> slopes_;
  std::vector<Eigen::VectorXd> of_amplitude_;  // the effect of another amplitude of the sample
};

}  // namespace

std::optional<LinearWorstCase> linear_worst_case(const TrackedTone& tone, double frequency, double noise,
                                                 double slew, int phases) {
  const rigor::NearestRounding nearest;
  if (!(noise >= 0.0) || !(slew >= 0.0) || phases <= 0) {
    throw std::invalid_argument("invalid disturbances, or no phases");
  }
  const SteadyState steady = find_steady_state(tone, frequency);
  if (steady.outcome != SteadyStateOutcome::settled) {
    return std::nullopt;
  }
  const double beside = frequency + 1e-4 * std::min(frequency, std::numbers::pi - frequency);
  const std::optional<NodeCurve> curve = fit_curve_at(tone, frequency, steady);
  const std::optional<NodeCurve> other = fit_curve_at(tone, beside, steady);
  if (!curve || !other) {
    return std::nullopt;
  }
  // Several orbits: where the frequency is a simple fraction of the sample rate, one sees few phases.
  constexpr int kOrbits = 3;
  const int memory = samples_to_forget(steady.rate);
  const int each = (phases + kOrbits - 1) / kOrbits;
  const int spread = std::max(each, static_cast<int>(2.0 * std::numbers::pi / frequency) + 1);
  LinearWorstCase worst{frequency, 0.0, 0.0};
  for (int i = 0; i < kOrbits; ++i) {
    const Orbit orbit(tone, *curve, *other, 0.7 * i, memory + spread);
    for (int j = 0; j < each; ++j) {
      orbit.judge(memory + j * spread / each, memory, noise, slew, worst);
    }
  }
  return std::isfinite(worst.disturbed) ? std::optional(worst) : std::nullopt;
}

}  // namespace veritrack::model
