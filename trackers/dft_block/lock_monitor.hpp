// Whether the block tracker of dft_block_ekf.hpp follows the tone, or sits in a false lock about a whole
// number of bins off: seen from the bins and the estimates alone.
//
// A false lock attracts, and its covariance looks as in lock. But its estimate leaves nearly all power of the
// bins unexplained, sum |Y_m - h_m|^2 of sum |Y_m|^2, and a tone at another offset would explain it.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "trackers/dft_block/block_dft.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace veritrack::trackers {

/// sum |Y_m - h_m(x)|^2, signal units squared, over the bins M - L ... M + L, with (4.9) at x = (x1, x2, x3).
/// Throws std::invalid_argument for an even number of bins.
template <std::floating_point Scalar>
[[nodiscard]] Scalar unexplained_power(const Eigen::Matrix<Scalar, 3, 1>& state,
                                       std::span<const DftBin<Scalar>> bins) {
  const int half = detail::half_width(bins);
  const Scalar pi = std::numbers::pi_v<Scalar>;
  const Scalar turn = state(1) + pi * state(2);
  const Scalar sine = std::sin(pi * state(2));
  const Scalar cosine = std::cos(pi * state(2));
  Scalar power = 0;
  for (int i = 0; i <= 2 * half; ++i) {
    const Scalar sign = (half - i) % 2 == 0 ? Scalar(1) : Scalar(-1);
    const Scalar value =
        Scalar(2) * pi * state(0) * state(0) * sign *
        detail::sinc_with_slope(state(2) + static_cast<Scalar>(half - i), sign * sine, sign * cosine).value;
    const DftBin<Scalar>& bin = bins[static_cast<std::size_t>(i)];
    const Scalar real = bin.real - value * std::cos(turn);
    const Scalar imaginary = bin.imaginary - value * std::sin(turn);
    power += real * real + imaginary * imaginary;
  }
  return power;
}

/// The state of the lock, judged from the last blocks.
enum class BlockLockState {
  settling,    ///< fewer blocks than the memory
  lock,        ///< the estimate explains at least half of the power that the best offset explains
  false_lock,  ///< another offset explains more than twice as much as the estimate
  no_tone      ///< no offset explains clearly more than it would of noise
};

/// Power of the last blocks, with weights that fall by a factor from block to block. Allocates when it is
/// made, not when it is fed.
template <std::floating_point Scalar = double>
class BlockLockMonitor {
 public:
  /// For 2L + 1 bins, L = `half_width` >= 1; `memory` >= 1: over about this many blocks.
  explicit BlockLockMonitor(int half_width, int memory = 20)
      : half_(half_width),
        memory_(memory),
        keep_(Scalar(1) - Scalar(1) / static_cast<Scalar>(memory)),
        explained_(static_cast<std::size_t>(2 * half_width * kPointsPerBin + 1), Scalar(0)) {
    if (half_width < 1 || memory < 1) {
      throw std::invalid_argument("the monitor of a block tracker needs at least 3 bins and 1 block");
    }
  }

  /// The bins of a block and the estimate (k|k) with it. Throws std::invalid_argument for another number of
  /// bins.
  void push(std::span<const DftBin<Scalar>> bins, const DftBlockEstimate<Scalar>& filtered) {
    if (bins.size() != static_cast<std::size_t>(2 * half_ + 1)) {
      throw std::invalid_argument("another number of bins than the monitor was made for");
    }
    Scalar power = 0;
    for (const DftBin<Scalar>& bin : bins) {
      power += bin.real * bin.real + bin.imaginary * bin.imaginary;
    }
    last_ = power > Scalar(0) ? unexplained_power(filtered.state(), bins) / power : Scalar(1);
    power_ = keep_ * power_ + power;
    unexplained_ = keep_ * unexplained_ + last_ * power;
    for (std::size_t i = 0; i < explained_.size(); ++i) {
      explained_[i] = keep_ * explained_[i] + dft_block_fit(bins, offset_of(i)).explained;
    }
    ++blocks_;
  }

  /// The share of the power of the last block that the estimate leaves: 0 for a tone without noise in lock,
  /// about 1 in a false lock, and more where the estimate is worse than 0.
  [[nodiscard]] Scalar last_share() const { return last_; }
  /// The same over the last blocks; 1 before the first.
  [[nodiscard]] Scalar unexplained_share() const {
    return power_ > Scalar(0) ? unexplained_ / power_ : Scalar(1);
  }
  /// The offset in [-L, L] whose tones, of any amplitude and phase in each block, explain most of the power
  /// of the last blocks, to 1/16 bin: where to start again.
  [[nodiscard]] Scalar best_offset() const { return offset_of(best()); }
  /// The part of it that they explain.
  [[nodiscard]] Scalar best_share() const {
    return power_ > Scalar(0) ? explained_[best()] / power_ : Scalar(0);
  }

  /// The least best_share() with which a tone is present: one complex number in 2L + 1 is explained in white
  /// noise.
  [[nodiscard]] Scalar tone_threshold() const {
    return Scalar(1) / static_cast<Scalar>(2 * half_ + 1) + Scalar(0.25);
  }

  [[nodiscard]] BlockLockState state() const {
    if (blocks_ < memory_) {
      return BlockLockState::settling;
    }
    const Scalar most = best_share();
    if (!(most >= tone_threshold())) {
      return BlockLockState::no_tone;
    }
    const bool is_half = Scalar(1) - unexplained_share() >= most / Scalar(2);
    return is_half ? BlockLockState::lock : BlockLockState::false_lock;
  }

 private:
  static constexpr int kPointsPerBin = 16;
  [[nodiscard]] Scalar offset_of(std::size_t i) const {
    return static_cast<Scalar>(i) / static_cast<Scalar>(kPointsPerBin) - static_cast<Scalar>(half_);
  }
  [[nodiscard]] std::size_t best() const {
    std::size_t most = 0;
    for (std::size_t i = 1; i < explained_.size(); ++i) {
      most = explained_[i] > explained_[most] ? i : most;
    }
    return most;
  }

  int half_;
  int memory_;
  Scalar keep_;
  std::vector<Scalar> explained_;
  Scalar power_ = 0, unexplained_ = 0, last_ = 1;
  int blocks_ = 0;
};

}  // namespace veritrack::trackers
