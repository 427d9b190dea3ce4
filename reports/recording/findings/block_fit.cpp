#include "reports/recording/findings/block_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace veritrack::reports {

namespace {

constexpr double kLineApart = 3.0;  // bins
constexpr double kToneApart = 5.0;  // bins; the tone's polynomials take some
constexpr int kHighestOrder = 7;
constexpr std::array kHum{50.0, 60.0, 40.0, 70.0};  // Hz; the last two for comparison

double middle_of(const ToneStretch& stretch) {
  return static_cast<double>(stretch.first) + 0.5 * static_cast<double>(stretch.length - 1);
}

/// Legendre's polynomials.
std::array<double, 4> legendre(double x) {
  return {1.0, x, 0.5 * (3.0 * x * x - 1.0), 0.5 * (5.0 * x * x * x - 3.0 * x)};
}

/// Phases between two middles: the cubic with their phases and frequencies.
double between(const ToneStretch& left, const ToneStretch& right, double place) {
  const double distance = middle_of(right) - middle_of(left);
  const double x = (place - middle_of(left)) / distance;
  const double mean = 0.5 * (left.frequency + right.frequency) * distance;
  const double turned = mean + std::remainder(right.phase - left.phase - mean, kWholeTurn);
  const double h10 = x * (1.0 - x) * (1.0 - x);
  const double h01 = x * x * (3.0 - 2.0 * x);
  const double h11 = x * x * (x - 1.0);
  return left.phase + h10 * distance * left.frequency + h01 * turned + h11 * distance * right.frequency;
}

double beyond(const ToneStretch& near, double slew, double place) {
  const double t = place - middle_of(near);
  return near.phase + t * (near.frequency + 0.5 * slew * t);
}

}  // namespace

BlockFit::BlockFit(const Waveform& waveform, int channels, const certificates::SignalAssumptions& assume,
                   std::optional<double> sample_rate)
    : waveform_(waveform), channels_(channels), band_(assume.frequency), sample_rate_(sample_rate) {
  constexpr double kLeast = 1024.0;
  constexpr double kMost = 16384.0;
  // Two bins between 50 and 60 Hz.
  length_ = static_cast<std::size_t>(
      std::clamp(sample_rate ? std::ceil(0.2 * *sample_rate) : kLeast, kLeast, kMost));
}

Eigen::Index BlockFit::width_of(const Part& part) const {
  return part.kind == Part::Kind::offset ? channels_ : part.kind == Part::Kind::hum ? 2 * channels_ : 2;
}

void BlockFit::turn(std::span<const ToneStretch> stretches, std::size_t count) {
  const auto slew_between = [&](std::size_t i) {
    return (stretches[i + 1].frequency - stretches[i].frequency) /
           (middle_of(stretches[i + 1]) - middle_of(stretches[i]));
  };
  const std::size_t last = stretches.size() - 1;
  const double first_slew = last > 0 ? slew_between(0) : 0.0;
  const double last_slew = last > 0 ? slew_between(last - 1) : 0.0;
  phases_.resize(count);
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double place = static_cast<double>(stretches.front().first) + static_cast<double>(k);
    while (i < last && place >= middle_of(stretches[i + 1])) {
      ++i;
    }
    phases_[k] = place < middle_of(stretches.front()) ? beyond(stretches.front(), first_slew, place)
                 : i == last                          ? beyond(stretches.back(), last_slew, place)
                                                      : between(stretches[i], stretches[i + 1], place);
  }
}

std::vector<BlockFit::Part> BlockFit::parts_beside(double frequency, std::size_t count) const {
  const double bin = kWholeTurn / static_cast<double>(count);
  const auto folded = [&](double omega) {
    const double wrapped = std::remainder(omega, kWholeTurn);
    return channels_ > 1 ? wrapped : std::fabs(wrapped);
  };
  std::vector<double> taken;
  for (const certificates::Harmonic& each : waveform_.harmonics()) {
    taken.push_back(folded(each.order * frequency));
  }
  std::vector<Part> parts;
  const auto add = [&](const Part& part, double omega, double apart) {
    const double place = folded(omega);
    const bool is_apart = std::all_of(taken.begin(), taken.end(), [&](double other) {
      return std::fabs(std::remainder(place - other, kWholeTurn)) > apart * bin;
    });
    // With one channel, a line at half the sample rate has one part only.
    if (is_apart && (channels_ > 1 || std::numbers::pi - place > kLineApart * bin)) {
      parts.push_back(part);
      taken.push_back(place);
    }
  };
  if (!waveform_.has(0)) {
    add({Part::Kind::offset}, 0.0, kToneApart);
  }
  for (int order = 2; order <= kHighestOrder; ++order) {
    if (!waveform_.has(order)) {
      add({Part::Kind::harmonic, order}, order * frequency, kToneApart);
    }
  }
  if (sample_rate_) {
    for (const double hertz : kHum) {
      const double omega = kWholeTurn * hertz / *sample_rate_;
      const bool is_in_band = band_[0] - kToneApart * bin < omega && omega < band_[1] + kToneApart * bin;
      const bool is_near_tone = std::fabs(omega - frequency) < 3.0 * kToneApart * bin;
      if (omega < std::numbers::pi && !(is_in_band && is_near_tone)) {
        add({Part::Kind::hum, 0, hertz}, omega, parts.empty() ? kToneApart : 1.9);
      }
    }
  }
  Eigen::Index column = 2 * kPolynomials;
  for (Part& part : parts) {
    part.column = column;
    column += width_of(part);
  }
  return parts;
}

void BlockFit::fill(const std::vector<Part>& parts, std::span<const RecordedSample> samples,
                    double amplitude) {
  const Eigen::Index unknowns =
      parts.empty() ? 2 * kPolynomials : parts.back().column + width_of(parts.back());
  const auto count = static_cast<Eigen::Index>(samples.size());
  columns_.setZero(count * channels_, unknowns);
  right_.resize(count * channels_);
  // Rows of one channel stand together.
  const auto put = [&](Eigen::Index k, Eigen::Index column, std::complex<double> value) {
    columns_(k, column) = value.real();
    if (channels_ > 1) {
      columns_(count + k, column) = value.imag();
    }
  };
  for (Eigen::Index k = 0; k < count; ++k) {
    const RecordedSample& sample = samples[static_cast<std::size_t>(k)];
    const double phase = phases_[static_cast<std::size_t>(k)];
    right_(k) = sample.in_phase;
    if (channels_ > 1) {
      right_(count + k) = sample.quadrature;
    }
    const double x = (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(count) - 1.0;
    const std::complex<double> shape = amplitude * waveform_.at(phase);
    const std::complex<double> turned = amplitude * waveform_.derivative(phase);
    const auto polynomials = legendre(x);
    for (std::size_t i = 0; i < polynomials.size(); ++i) {
      put(k, static_cast<Eigen::Index>(2 * i), polynomials[i] * shape);
      put(k, static_cast<Eigen::Index>(2 * i + 1), polynomials[i] * turned);
    }
    for (const Part& part : parts) {
      if (part.kind == Part::Kind::harmonic) {
        const std::complex<double> turn = std::polar(1.0, part.order * phase);
        put(k, part.column, turn);
        put(k, part.column + 1, std::complex<double>(0.0, 1.0) * turn);
        continue;
      }
      for (Eigen::Index channel = 0; channel < channels_; ++channel) {
        if (part.kind == Part::Kind::offset) {
          columns_(channel * count + k, part.column + channel) = 1.0;
        } else {
          const double angle = kWholeTurn * part.hertz / *sample_rate_ * static_cast<double>(k);
          columns_(channel * count + k, part.column + 2 * channel) = std::cos(angle);
          columns_(channel * count + k, part.column + 2 * channel + 1) = std::sin(angle);
        }
      }
    }
  }
}

std::optional<ExaminedBlock> BlockFit::fit(std::span<const ToneStretch> stretches,
                                           std::span<const RecordedSample> samples) {
  ExaminedBlock block;
  block.first = stretches.front().first;
  block.samples = samples;
  double amplitude = 0.0;
  for (const ToneStretch& each : stretches) {
    const double weight = static_cast<double>(each.length) / static_cast<double>(samples.size());
    amplitude += weight * each.amplitude;
    block.frequency += weight * each.frequency;
  }
  turn(stretches, samples.size());
  const std::vector<Part> parts = parts_beside(block.frequency, samples.size());
  fill(parts, samples, amplitude);
  if (columns_.rows() < 4 * columns_.cols()) {
    return std::nullopt;
  }
  const Eigen::LDLT<Eigen::MatrixXd> normal((columns_.transpose() * columns_).eval());
  const Eigen::VectorXd found = normal.solve(columns_.transpose() * right_);
  const Eigen::MatrixXd spread = normal.solve(Eigen::MatrixXd::Identity(columns_.cols(), columns_.cols()));
  const Eigen::VectorXd residual = right_ - columns_ * found;
  block.noise_deviation =
      std::sqrt(residual.squaredNorm() / static_cast<double>(columns_.rows() - columns_.cols()));
  if (!std::isfinite(block.noise_deviation) || !found.allFinite()) {
    return std::nullopt;
  }
  const auto deviation = [&](Eigen::Index i) {
    return block.noise_deviation * std::sqrt(std::fabs(spread(i, i)));
  };
  block.amplitude = amplitude * found(0);
  for (const Part& part : parts) {
    const Eigen::Index i = part.column;
    FittedPart fitted{part.order, part.hertz, found.segment(i, width_of(part)).norm(), deviation(i),
                      found(i)};
    if (part.kind != Part::Kind::offset || channels_ > 1) {
      fitted.value = {found(i), found(i + 1)};
    }
    (part.kind == Part::Kind::offset ? block.offset : fitted) = fitted;
    if (part.kind == Part::Kind::harmonic) {
      block.harmonics.push_back(fitted);
    } else if (part.kind == Part::Kind::hum) {
      // The larger part of two channels counts.
      for (Eigen::Index channel = 0; channel < channels_; ++channel) {
        fitted.size = channel == 0 ? found.segment(i, 2).norm()
                                   : std::max(fitted.size, found.segment(i + 2 * channel, 2).norm());
      }
      block.hum.push_back(fitted);
    }
  }
  for (const double x : {-0.75, 0.75}) {
    const auto polynomials = legendre(x);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(columns_.cols());
    for (std::size_t p = 0; p < polynomials.size(); ++p) {
      weights(static_cast<Eigen::Index>(2 * p)) = amplitude * polynomials[p];
    }
    block.amplitudes.push_back({0, 0.0, weights.dot(found),
                                block.noise_deviation * std::sqrt(std::fabs(weights.dot(spread * weights)))});
  }
  const auto count = static_cast<Eigen::Index>(samples.size());
  const Eigen::VectorXd tone = columns_.leftCols(2 * kPolynomials) * found.head(2 * kPolynomials);
  tone_.resize(samples.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    tone_[static_cast<std::size_t>(k)] = {tone(k), channels_ > 1 ? tone(count + k) : 0.0};
  }
  block.tone = tone_;
  return block;
}

}  // namespace veritrack::reports
