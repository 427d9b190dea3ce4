#include "analysis/model/gain/gain_attack.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "analysis/model/gain/steady_proposal.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The directions of the noise in the frame of the signal, and the signs of the slew, by sample.
struct Adjoint {
  std::vector<std::complex<double>> noise;
  std::vector<double> slew;
};

Adjoint adjoint_of(const TrackedTone& tone, const std::vector<SteadyValue>& steady, double omega,
                   std::size_t samples) {
  const auto n = static_cast<Eigen::Index>(steady.size());
  const bool is_one = tone.step.recursion().samples == 1;
  const bool has_vectors = vector_of(steady).has_value();
  // With two channels the steady state is a point in the frame of the signal, but for vectors.
  const bool is_point = !is_one && !has_vectors;
  const auto slope_at = [&](double phase) {
    return tone.step.jacobian(state_at(tone, steady, phase, omega),
                              samples_of(tone.signal, tone.amplitude, phase + omega));
  };
  const Eigen::MatrixXd first = slope_at(0.0);
  const double last = is_point ? 0.0 : std::remainder(static_cast<double>(samples) * omega, kTurn);
  Eigen::RowVectorXd row = tone.step.frequency_gradient(state_at(tone, steady, last, omega));
  Eigen::VectorXd moved = state_per_frequency(tone, steady, 0.0, omega);
  Adjoint adjoint{std::vector<std::complex<double>>(samples), std::vector<double>(samples)};
  for (std::size_t k = samples; k-- > 0;) {
    const double phase = is_point ? 0.0 : std::remainder(static_cast<double>(k) * omega, kTurn);
    const Eigen::MatrixXd slope = is_point ? first : slope_at(phase);
    const Eigen::RowVectorXd effect = row * slope.rightCols(slope.cols() - n);
    const std::complex<double> direction =
        is_one ? std::complex<double>(effect(0), 0.0)
               : std::complex<double>(effect(0), effect(1)) * std::polar(1.0, -phase - omega);
    adjoint.noise[k] = std::abs(direction) > 0.0 ? direction / std::abs(direction) : 0.0;
    if (has_vectors) {
      moved = state_per_frequency(tone, steady, phase + omega, omega);
    }
    adjoint.slew[k] = row.dot(moved) < 0.0 ? 1.0 : -1.0;
    row = (row * slope.leftCols(n)).eval();
  }
  return adjoint;
}

}  // namespace

double attack_loop(const TrackedTone& tone, const std::vector<SteadyValue>& steady, double omega,
                   double noise, double slew, std::size_t samples) {
  const rigor::NearestRounding nearest;
  const Adjoint adjoint = adjoint_of(tone, steady, omega, samples);
  double largest = 0.0;
  // Straight at the linear effect, and so that the angle of the sample changes most.
  const double lean = noise < tone.amplitude ? std::asin(noise / tone.amplitude) : 0.0;
  for (const double angle : {0.0, lean}) {
    double frequency = omega;
    double phase = 0.0;
    Eigen::VectorXd state = state_at(tone, steady, phase, frequency);
    for (std::size_t k = 0; k < samples; ++k) {
      phase += frequency;
      if (std::fabs(phase) > kTurn) {
        // The same turn off the angles, so that nothing grows and rounds.
        const double turn = std::copysign(kTurn, phase);
        phase -= turn;
        for (std::size_t i = 0; i < steady.size(); ++i) {
          state(static_cast<Eigen::Index>(i)) -= steady[i].imaginary ? 0.0 : steady[i].turns * turn;
        }
      }
      Eigen::VectorXd sample = samples_of(tone.signal, tone.amplitude, phase);
      if (sample.size() == 1) {
        sample(0) += noise * adjoint.noise[k].real();
      } else {
        const std::complex<double> in_frame = noise * (adjoint.noise[k] * std::cos(angle) - std::sin(angle));
        const std::complex<double> added = in_frame * std::polar(1.0, phase);
        sample += Eigen::Vector2d(added.real(), added.imag());
      }
      state = tone.step.next(state, sample);
      frequency += slew * adjoint.slew[k];
      largest = std::max(largest, std::fabs(tone.step.frequency(state) - frequency));
    }
  }
  return largest;
}

}  // namespace veritrack::model
