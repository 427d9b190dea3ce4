// The few bins of a block's discrete Fourier transform that the block tracker needs, sample by sample, and
// the estimate from which it starts: (4.4), (4.35) and (4.36) of the thesis that dft_block_ekf.hpp names.
//
// Each bin is a sum that is turned on with a phasor of its own, so that memory is constant and no block is
// stored. The phasors begin each block at 1; their rounding error is about T/2 units in the last place at
// most.
//
// The thesis calls the estimator (4.35) "unbiased". Its argument is that of least squares, and its maximum
// may lie at the end of the range: then the start is at the end, not at the tone.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "trackers/dft_block/dft_block_ekf.hpp"

namespace veritrack::trackers {

/// The bins M - L ... M + L of blocks of T samples, (4.4). Allocates when it is made, not when it is fed.
template <std::floating_point Scalar = double>
class BlockDft {
 public:
  /// T = `length` samples, M = `centre`, L = `half_width` bins. Throws std::invalid_argument unless L <= M
  /// and 2 (M + L) < T.
  BlockDft(std::size_t length, std::size_t centre, std::size_t half_width) : length_(length) {
    if (half_width > centre || length == 0 || centre >= length || half_width >= length ||
        2 * (centre + half_width) >= length) {
      throw std::invalid_argument("the bins M - L ... M + L of T samples need L <= M and 2 (M + L) < T");
    }
    const std::size_t count = 2 * half_width + 1;
    bins_.resize(count);
    sums_.resize(count);
    phasors_.resize(count);
    turns_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Scalar angle = Scalar(2) * std::numbers::pi_v<Scalar> *
                           static_cast<Scalar>(centre - half_width + i) / static_cast<Scalar>(length);
      turns_.push_back({std::cos(angle), -std::sin(angle)});
    }
    begin_block();
  }

  /// Takes one sample, signal units. True when it completes a block, whose transform is then in bins().
  bool push(const Scalar& sample) {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      DftBin<Scalar>& phasor = phasors_[i];
      sums_[i].real += sample * phasor.real;
      sums_[i].imaginary += sample * phasor.imaginary;
      phasor = {phasor.real * turns_[i].real - phasor.imaginary * turns_[i].imaginary,
                phasor.real * turns_[i].imaginary + phasor.imaginary * turns_[i].real};
    }
    if (++taken_ < length_) {
      return false;
    }
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      bins_[i] = {sums_[i].real / static_cast<Scalar>(length_),
                  sums_[i].imaginary / static_cast<Scalar>(length_)};
    }
    begin_block();
    return true;
  }

  /// Those of the last complete block, zero before the first one.
  [[nodiscard]] std::span<const DftBin<Scalar>> bins() const { return bins_; }

 private:
  void begin_block() {
    taken_ = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      sums_[i] = {Scalar(0), Scalar(0)};
      phasors_[i] = {Scalar(1), Scalar(0)};
    }
  }

  std::size_t length_;
  std::size_t taken_ = 0;
  std::vector<DftBin<Scalar>> bins_;
  std::vector<DftBin<Scalar>> sums_;
  std::vector<DftBin<Scalar>> phasors_;
  std::vector<DftBin<Scalar>> turns_;
};

/// The least squares fit of a block at a given offset: |sum s_m d_m*|^2 / sum |d_m|^2 of (4.35), and the
/// factor sum s_m d_m* / sum |d_m|^2 = x1^2 e^{j x2} of (4.36).
template <typename Scalar>
struct DftBlockFit {
  Scalar explained;  ///< the part of sum |s_m|^2 that the tone explains, signal units squared
  DftBin<Scalar> factor;
};

/// Assumes an offset within [-L, L], where some bin sees the tone. Throws std::invalid_argument for an even
/// number of bins.
template <std::floating_point Scalar>
[[nodiscard]] DftBlockFit<Scalar> dft_block_fit(std::span<const DftBin<Scalar>> bins, Scalar offset) {
  const int half = detail::half_width(bins);
  const Scalar pi = std::numbers::pi_v<Scalar>;
  const Scalar sine = std::sin(pi * offset);
  const Scalar cosine = std::cos(pi * offset);
  Scalar weight = 0;
  DftBin<Scalar> sum{0, 0};
  for (int i = 0; i <= 2 * half; ++i) {
    const Scalar sign = (half - i) % 2 == 0 ? Scalar(1) : Scalar(-1);
    const Scalar value =
        sign *
        detail::sinc_with_slope(offset + static_cast<Scalar>(half - i), sign * sine, sign * cosine).value;
    weight += value * value;
    sum.real += value * bins[static_cast<std::size_t>(i)].real;
    sum.imaginary += value * bins[static_cast<std::size_t>(i)].imaginary;
  }
  const Scalar scale = Scalar(1) / (Scalar(2) * pi * weight);
  return {(sum.real * sum.real + sum.imaginary * sum.imaginary) / weight,
          {scale * (sum.real * cosine + sum.imaginary * sine),
           scale * (sum.imaginary * cosine - sum.real * sine)}};
}

/// x1, x2, x3 of a start.
template <typename Scalar>
struct DftBlockStart {
  Scalar root_amplitude;  ///< x1, square root of signal units; >= 0
  Scalar phase;           ///< x2, rad, in [-pi, pi]
  Scalar offset;          ///< x3, bins, in [-L, L]
};

/// (4.35) and (4.36) from the first block: the best offset of a grid over [-L, L] with 32 points a bin,
/// refined by golden sections to about 1e-8 bins. x(1|0) for this block; the P(1|0) that belongs to it is not
/// printed. The tracker that then filters the same block counts it twice, as the thesis does. Throws
/// std::invalid_argument for an even number of bins.
template <std::floating_point Scalar>
[[nodiscard]] DftBlockStart<Scalar> dft_block_start(std::span<const DftBin<Scalar>> bins) {
  constexpr int kPointsPerBin = 32;
  const int half = detail::half_width(bins);
  const Scalar step = Scalar(1) / Scalar(kPointsPerBin);
  const auto explained = [&](Scalar offset) { return dft_block_fit(bins, offset).explained; };
  Scalar best = -static_cast<Scalar>(half);
  Scalar most = explained(best);
  for (int i = 1; i <= 2 * half * kPointsPerBin; ++i) {
    const Scalar offset = static_cast<Scalar>(i) * step - static_cast<Scalar>(half);
    const Scalar value = explained(offset);
    if (value > most) {
      most = value;
      best = offset;
    }
  }
  Scalar low = std::max(best - step, -static_cast<Scalar>(half));
  Scalar high = std::min(best + step, static_cast<Scalar>(half));
  const Scalar section = std::numbers::phi_v<Scalar> - Scalar(1);
  Scalar left = high - section * (high - low);
  Scalar right = low + section * (high - low);
  Scalar at_left = explained(left);
  Scalar at_right = explained(right);
  for (int i = 0; i < 40; ++i) {
    if (at_left >= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - section * (high - low);
      at_left = explained(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + section * (high - low);
      at_right = explained(right);
    }
  }
  const Scalar offset = (low + high) / Scalar(2);
  const DftBin<Scalar> factor = dft_block_fit(bins, offset).factor;
  return {std::sqrt(std::hypot(factor.real, factor.imaginary)), std::atan2(factor.imaginary, factor.real),
          offset};
}

}  // namespace veritrack::trackers
