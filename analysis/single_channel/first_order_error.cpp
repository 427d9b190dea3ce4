#include "analysis/single_channel/first_order_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace veritrack::single_channel {

namespace {

constexpr int kStates = 9;
constexpr int kInputs = kStates + 2;  // and noise and slew
using Step = rigor::Matrix<kStates, kInputs>;

/// The derivatives of each sample's map in lock, from a covariance that forgets how it began.
std::vector<Step> steps_in_lock(const trackers::ToneModel<double>& design, double frequency, int count) {
  using Dual = rigor::Dual<double, kInputs>;
  const trackers::ToneModel<Dual> lifted{Dual(design.q1), Dual(design.q2), Dual(design.r),
                                         Dual(design.epsilon)};
  rigor::Vector<kInputs> at = rigor::Vector<kInputs>::Zero();
  at(trackers::kP11) = at(trackers::kP22) = design.r + design.q1;
  at(trackers::kP33) = design.q2;
  std::vector<Step> steps;
  for (int k = 0; k < count; ++k) {
    const Dual next_phase(std::remainder((k + 1) * frequency, 2.0 * std::acos(-1.0)));
    const auto map = [&](const auto& x) {
      const trackers::RotatingFrameState<Dual> state = x.template head<kStates>();
      return trackers::single_channel_map(state, {next_phase, x(kStates), x(kStates + 1), Dual(frequency)},
                                          lifted);
    };
    const auto step = rigor::linearize(map, at);
    at.head<kStates>() = step.value;
    steps.push_back(step.jacobian);
  }
  return steps;
}

}  // namespace

double first_order_error(const trackers::ToneModel<double>& design, double frequency, double noise,
                         double slew) {
  constexpr int kSettling = 2000;
  constexpr int kPhases = 48;
  const rigor::NearestRounding nearest;
  const std::vector<Step> steps = steps_in_lock(design, frequency, kSettling + kPhases);
  double most = 0.0;
  for (int last = kSettling; last < kSettling + kPhases; ++last) {
    rigor::Matrix<1, kStates> row = rigor::Matrix<1, kStates>::Zero();
    row(trackers::kFrequencyError) = 1.0;
    double sum = 0.0;
    for (int k = last; k >= 0; --k) {
      const rigor::Matrix<1, kInputs> seen = row * steps[static_cast<std::size_t>(k)];
      sum += noise * std::fabs(seen(kStates)) + slew * std::fabs(seen(kStates + 1));
      row = seen.leftCols<kStates>();
    }
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace veritrack::single_channel
