#include "reports/recording/tone_fit.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace veritrack::reports {

ToneFit::ToneFit(std::size_t length, int channels, bool is_derived, const Waveform& waveform)
    : channels_(channels),
      is_derived_(is_derived),
      waveform_(waveform),
      basis_(static_cast<Eigen::Index>(length), 3),
      turns_(length),
      values_(length) {
  const double middle = 0.5 * static_cast<double>(length - 1);
  for (Eigen::Index k = 0; k < basis_.rows(); ++k) {
    const double t = static_cast<double>(k) - middle;
    basis_.row(k) << 1.0, t, t * t;
  }
  const double mean = basis_.col(2).mean();
  basis_.col(2).array() -= mean;
  bend_ = -mean / basis_.col(2).norm();
  slope_ = 1.0 / basis_.col(1).norm();
  basis_.colwise().normalize();
}

/// Coefficients of e^{i psi} P, real parts and then imaginary ones.
ToneFit::Coefficients ToneFit::closest(std::span<const RecordedSample> samples) const {
  Coefficients right = Coefficients::Zero();
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto row = basis_.row(static_cast<Eigen::Index>(k));
    const std::complex<double> turn = turns_[k];
    if (channels_ > 1) {
      const std::complex<double> turned =
          std::complex<double>(samples[k].in_phase, samples[k].quadrature) * std::conj(turn);
      right.head<3>() += turned.real() * row.transpose();
      right.tail<3>() += turned.imag() * row.transpose();
      continue;
    }
    Coefficients direction;
    direction << turn.real() * row.transpose(), -turn.imag() * row.transpose();
    right += samples[k].in_phase * direction;
    normal += direction * direction.transpose();
  }
  // The two channels of a turning tone are orthonormal.
  return channels_ > 1 ? right : Coefficients(normal.ldlt().solve(right));
}

const FittedTone& ToneFit::fit(std::span<const RecordedSample> samples, double frequency) {
  const double middle = 0.5 * static_cast<double>(samples.size() - 1);
  std::complex<double> turn = std::polar(1.0, -frequency * middle);
  const std::complex<double> step = std::polar(1.0, frequency);
  for (std::complex<double>& each : turns_) {
    each = turn;
    turn *= step;
  }
  waveform_.is_tone() ? fit_tone(samples, frequency) : fit_waveform(samples, frequency);
  return fitted_;
}

void ToneFit::fit_tone(std::span<const RecordedSample> samples, double frequency) {
  const std::size_t length = samples.size();
  const Coefficients found = closest(samples);
  double residual = 0.0;
  for (std::size_t k = 0; k < length; ++k) {
    const auto row = basis_.row(static_cast<Eigen::Index>(k));
    values_[k] = std::complex<double>(row.dot(found.head<3>()), row.dot(found.tail<3>())) * turns_[k];
    const double in_phase = samples[k].in_phase - values_[k].real();
    const double quadrature = channels_ > 1 ? samples[k].quadrature - values_[k].imag() : 0.0;
    residual += in_phase * in_phase + quadrature * quadrature;
  }
  const double freedom = static_cast<double>(channels_) * static_cast<double>(length) - 6.0;
  fitted_.noise_deviation = std::sqrt(residual / freedom);
  // In the middle t = 0: P_1 = 0 there, and P_0, P_2 are even.
  const double p0 = basis_(0, 0);
  const std::complex<double> value(p0 * found(0) + bend_ * found(2), p0 * found(3) + bend_ * found(5));
  const std::complex<double> derivative(slope_ * found(1), slope_ * found(4));
  fitted_.amplitude = std::abs(value);
  fitted_.frequency = frequency + (derivative / value).imag();
  // Half of a real sample's information is in each of its two turning parts.
  fitted_.frequency_deviation = (channels_ > 1 && !is_derived_ ? 1.0 : std::sqrt(2.0)) *
                                fitted_.noise_deviation * slope_ / fitted_.amplitude;
}

void ToneFit::fit_waveform(std::span<const RecordedSample> samples, double frequency) {
  constexpr int kSteps = 8;
  const std::size_t length = samples.size();
  std::vector<std::complex<double>> means(waveform_.harmonics().size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    for (std::size_t k = 0; k < length; ++k) {
      const std::complex<double> seen(samples[k].in_phase, channels_ > 1 ? samples[k].quadrature : 0.0);
      means[i] +=
          seen * std::pow(std::conj(turns_[k]), waveform_.harmonics()[i].order) / static_cast<double>(length);
    }
  }
  const MatchedTone matched = waveform_.match(means);
  const double p0 = basis_(0, 0);
  // Coefficients of the amplitude, and then of the phase.
  Coefficients found = Coefficients::Zero();
  found(0) = matched.amplitude / p0;
  found(3) = matched.phase / p0;
  Eigen::Matrix<double, 6, 6> normal;
  double residual = 0.0;
  for (int step = 0; step <= kSteps; ++step) {
    normal.setZero();
    Coefficients right = Coefficients::Zero();
    residual = 0.0;
    for (std::size_t k = 0; k < length; ++k) {
      const auto row = basis_.row(static_cast<Eigen::Index>(k));
      const double amplitude = row.dot(found.head<3>());
      const double phase = std::arg(turns_[k]) + row.dot(found.tail<3>());
      values_[k] = amplitude * std::polar(1.0, phase);
      const std::complex<double> shape = waveform_.at(phase);
      const std::complex<double> turned = amplitude * waveform_.derivative(phase);
      const std::complex<double> seen(samples[k].in_phase, channels_ > 1 ? samples[k].quadrature : 0.0);
      const std::complex<double> rest = seen - amplitude * shape;
      residual += std::norm(rest);
      Coefficients in_phase;
      in_phase << shape.real() * row.transpose(), turned.real() * row.transpose();
      Coefficients quadrature;
      quadrature << shape.imag() * row.transpose(), turned.imag() * row.transpose();
      normal += in_phase * in_phase.transpose() + quadrature * quadrature.transpose();
      right += rest.real() * in_phase + rest.imag() * quadrature;
    }
    if (step < kSteps) {
      found += normal.ldlt().solve(right);
    }
  }
  fitted_.noise_deviation =
      std::sqrt(residual / (static_cast<double>(channels_) * static_cast<double>(length) - 6.0));
  fitted_.amplitude = p0 * found(0) + bend_ * found(2);
  fitted_.frequency = frequency + slope_ * found(4);
  const Coefficients unit = Coefficients::Unit(4);
  fitted_.frequency_deviation = fitted_.noise_deviation * slope_ * std::sqrt(normal.ldlt().solve(unit)(4));
}

}  // namespace veritrack::reports
