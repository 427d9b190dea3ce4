// The extended Kalman filter that tracks a weak tone from the discrete Fourier transforms of blocks of
// samples.
//
// B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis, Australian National
// University, 1994, chapter 4. Equation numbers are the thesis's.
//
// The tone is constant within a block of T samples, with the frequency 2 pi (M + delta) / T rad/sample, M a
// known integer. The measurements are the 2L + 1 bins Y_m, m = M - L ... M + L, of the transform (4.4) with
// the factor 1/T. State (x1, x2, x3): x1 = sqrt(amplitude / (4 pi)), the phase at the start of the block in
// rad, and the offset delta in bins.
//     x1' = (1 - epsilon_amplitude) x1,   x2' = x2 + 2 pi x3,   x3' = (1 - epsilon_offset) x3, (4.18) Y_m =
//     x1^2 e^{j x2} (e^{j 2 pi x3} - 1) / (j d),   d = M - m + x3,                                  (4.9)
// Q = diag(q1, q2, q3), and R = r I over real and imaginary parts; white noise of variance s gives s / (2T).
//
// With sinc(d) = sin(pi d) / (pi d) the bin is Y_m = 2 pi x1^2 sinc(d) e^{j (x2 + pi d)}, which has no
// special case at integers, and e^{j pi d} = (-1)^(M - m) e^{j pi x3}. In the frame turned by x2 + pi x3 the
// Jacobian (4.19)-(4.24) is real or imaginary, so that H'H consists of three sums, of sinc^2, sinc sinc' and
// sinc'^2: the information of the bins is a 3x3 matrix and a vector, whose sizes do not depend on L. The
// number of bins passed to a step determines L. A step does not allocate.
//
//     using namespace veritrack::trackers;                  // with block_dft.hpp: transform and start
//     BlockDft<double> transform(2048, 300, 2);
//     for (const double sample : samples) {
//       if (transform.push(sample)) {
//         tracker.step(transform.bins());
//         use(tracker.filtered().offset);
//       }
//     }
//
// What the thesis prints differently (a test holds each against sums over the samples):
//   (4.6)   has e^{-j 2 pi delta}; the sign is that of (4.9).
//   (4.5)   the second term has the phase of the conjugate, minus all of what is printed, and it is O(1/T).
//   4.2     the taps of the filter bank give the conjugate of bin m (turned by e^{j 2 pi m / T}), not the
//   bin:
//           those of the bin are e^{j 2 pi m (i + 1) / T} / T.
//   4.3     "zero but for two elements of two rows" at integer delta: those are the rows L + 1 + x3, not M +
//           x3; in them the third column is not zero, and neither is it in any other row.
//   (4.26)  rests on that; from the printed H, too, it would be 8 pi^3 and 16 pi^4 where 8 pi^2 and 16 pi^3
//   are
//           printed. With the true H one block determines all of the state.
//   4.3.1   "discrete frequency is ambiguous": h is not periodic in x3. It is even in x1 instead, so that the
//           square root in (4.12) does not keep the estimate of x1 from changing its sign.
//   4.4.3   "a larger L decreases the effective SNR": H'H grows with each bin that is added.
//
// Assumed, not checked: r > 0, q1, q2, q3 >= 0, P(0) symmetric and positive semidefinite, all finite. 2 pi is
// the double nearest to it. The phase is not wrapped.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// One bin of a discrete Fourier transform, in signal units.
template <typename Scalar>
struct DftBin {
  Scalar real;
  Scalar imaginary;
};

/// The engineer's choices.
template <typename Scalar>
struct DftBlockDesign {
  Scalar q1;  ///< process noise variance of x1, signal units; >= 0
  Scalar q2;  ///< process noise variance of the phase, rad^2; >= 0
  Scalar q3;  ///< process noise variance of the offset, bins^2; >= 0
  Scalar r;   ///< variance of the real and of the imaginary part of a bin, signal units squared; > 0
  Scalar epsilon_amplitude;  ///< leak of x1 towards zero per block; in [0, 1)
  Scalar epsilon_offset;     ///< leak of the offset towards zero per block; in [0, 1)
};

/// A state estimate with its covariance: filtered, (k|k), or predicted, (k+1|k).
template <typename Scalar>
struct DftBlockEstimate {
  Scalar
      root_amplitude;  ///< x1 = sqrt(amplitude / (4 pi)), square root of signal units; its sign means nothing
  Scalar phase;        ///< x2 at the start of the block, rad
  Scalar offset;       ///< x3 = delta, bins
  Eigen::Matrix<Scalar, 3, 3> covariance;

  /// (x1, x2, x3).
  [[nodiscard]] Eigen::Matrix<Scalar, 3, 1> state() const {
    Eigen::Matrix<Scalar, 3, 1> result;
    result(0) = root_amplitude;
    result(1) = phase;
    result(2) = offset;
    return result;
  }
};

namespace detail {

inline constexpr double kPi = 0x1.921fb54442d18p+1;

/// sinc d = sin(pi d) / (pi d) and its derivative.
template <typename Scalar>
struct SincWithSlope {
  Scalar value;
  Scalar slope;
};

/// From d and the sine and cosine of pi d. Near zero, where those cancel, by the Taylor series, whose first
/// omitted terms are below 2^-64. Only for floating point: a scalar that encloses or differentiates has to
/// bring its own version, found by argument-dependent lookup, since a series cut off is no enclosure.
template <std::floating_point Scalar>
[[nodiscard]] inline SincWithSlope<Scalar> sinc_with_slope(const Scalar& d, const Scalar& sine,
                                                           const Scalar& cosine) {
  constexpr Scalar kPiOfScalar = Scalar(3.141592653589793238462643383279502884L);
  if (d < Scalar(-0.25) || d > Scalar(0.25)) {
    const Scalar inverse = Scalar(1.0) / d;
    const Scalar value = sine * inverse * (Scalar(1.0) / kPiOfScalar);
    return {value, (cosine - value) * inverse};
  }
  // sin x / x = sum (-x^2)^k / (2k + 1)!, and its derivative by x is -x sum (-x^2)^k (2k + 2) / (2k + 3)!.
  constexpr int kTerms = 11;
  constexpr auto kInverseFactorials = [] {
    std::array<Scalar, kTerms + 1> result{};
    Scalar factorial = 1;
    for (int k = 0; k <= kTerms; ++k) {
      factorial *= k == 0 ? Scalar(1) : Scalar(2 * k * (2 * k + 1));
      result[static_cast<std::size_t>(k)] = Scalar(1) / factorial;
    }
    return result;
  }();
  const Scalar x = kPiOfScalar * d;
  const Scalar minus_square = -x * x;
  Scalar value = Scalar(0.0);
  Scalar slope = Scalar(0.0);
  for (int k = kTerms - 1; k >= 0; --k) {
    value = value * minus_square + kInverseFactorials[static_cast<std::size_t>(k)];
    slope = slope * minus_square + Scalar(2 * k + 2) * kInverseFactorials[static_cast<std::size_t>(k) + 1];
  }
  return {value, -kPiOfScalar * x * slope};
}

/// The part of the adjugate of X + Y that is linear in both, for symmetric X and Y; adj X = mixed(X, X) / 2.
/// Positive semidefinite when both are.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix<Scalar, 3, 3> mixed_adjugate(const Eigen::Matrix<Scalar, 3, 3>& x,
                                                                const Eigen::Matrix<Scalar, 3, 3>& y) {
  Eigen::Matrix<Scalar, 3, 3> result;
  const Scalar p01 = x(0, 1) * y(0, 1);
  const Scalar p02 = x(0, 2) * y(0, 2);
  const Scalar p12 = x(1, 2) * y(1, 2);
  result(0, 0) = x(1, 1) * y(2, 2) + y(1, 1) * x(2, 2) - (p12 + p12);
  result(1, 1) = x(0, 0) * y(2, 2) + y(0, 0) * x(2, 2) - (p02 + p02);
  result(2, 2) = x(0, 0) * y(1, 1) + y(0, 0) * x(1, 1) - (p01 + p01);
  result(0, 1) = x(0, 2) * y(1, 2) + y(0, 2) * x(1, 2) - x(0, 1) * y(2, 2) - y(0, 1) * x(2, 2);
  result(0, 2) = x(0, 1) * y(1, 2) + y(0, 1) * x(1, 2) - x(0, 2) * y(1, 1) - y(0, 2) * x(1, 1);
  result(1, 2) = x(0, 1) * y(0, 2) + y(0, 1) * x(0, 2) - x(1, 2) * y(0, 0) - y(1, 2) * x(0, 0);
  result(1, 0) = result(0, 1);
  result(2, 0) = result(0, 2);
  result(2, 1) = result(1, 2);
  return result;
}

/// The trace of X Y, symmetric X and Y.
template <typename Scalar>
[[nodiscard]] inline Scalar trace_of_product(const Eigen::Matrix<Scalar, 3, 3>& x,
                                             const Eigen::Matrix<Scalar, 3, 3>& y) {
  const Scalar off = x(0, 1) * y(0, 1) + x(0, 2) * y(0, 2) + x(1, 2) * y(1, 2);
  return x(0, 0) * y(0, 0) + x(1, 1) * y(1, 1) + x(2, 2) * y(2, 2) + (off + off);
}

/// L of 2L + 1 bins. Throws std::invalid_argument when their number is even.
template <typename Bin>
[[nodiscard]] inline int half_width(std::span<Bin> bins) {
  if (bins.size() % 2 == 0) {
    throw std::invalid_argument("the block tracker takes the bins M - L ... M + L, an odd number of them");
  }
  return static_cast<int>(bins.size() / 2);
}

}  // namespace detail

/// The information of a block's bins about the state near an estimate: H' R^-1 H and H' R^-1 (y - h).
template <typename Scalar>
struct DftBlockInformation {
  Eigen::Matrix<Scalar, 3, 3> matrix;
  Eigen::Matrix<Scalar, 3, 1> vector;
};

/// The information in the bins M - L ... M + L, in this order, at (x1, x2, x3) = `state`, with the variance
/// r: (4.16)-(4.17) and (4.19)-(4.24) summed over the bins. Throws std::invalid_argument for an even number
/// of them.
template <typename Scalar>
[[nodiscard]] DftBlockInformation<Scalar> dft_block_information(const Eigen::Matrix<Scalar, 3, 1>& state,
                                                                std::span<const DftBin<Scalar>> bins,
                                                                const Scalar& r) {
  using detail::sin_cos;
  using detail::sinc_with_slope;
  using detail::square;
  const int half = detail::half_width(bins);
  const Scalar pi(detail::kPi);
  const Scalar half_turn = pi * state(2);
  const auto [sine, cosine] = sin_cos(half_turn);
  const auto [sine_turn, cosine_turn] = sin_cos(Scalar(state(1) + half_turn));
  const Scalar power = square(state(0));
  const Scalar scaled_power = Scalar(2.0 * detail::kPi) * power;

  Scalar values(0.0);      // sum of sinc^2
  Scalar products(0.0);    // sum of sinc sinc'
  Scalar slopes(0.0);      // sum of sinc'^2
  Scalar value_real(0.0);  // sums of sinc and sinc' with the turned innovations
  Scalar slope_real(0.0);
  Scalar value_imaginary(0.0);
  double sign = half % 2 == 0 ? 1.0 : -1.0;
  for (int i = 0; i <= 2 * half; ++i) {
    const DftBin<Scalar>& bin = bins[static_cast<std::size_t>(i)];
    const Scalar s(sign);
    const auto sinc = sinc_with_slope(Scalar(state(2) + Scalar(static_cast<double>(half - i))),
                                      Scalar(s * sine), Scalar(s * cosine));
    const Scalar value = s * sinc.value;
    const Scalar slope = s * sinc.slope;
    const Scalar real = cosine_turn * bin.real + sine_turn * bin.imaginary - scaled_power * value;
    const Scalar imaginary = cosine_turn * bin.imaginary - sine_turn * bin.real;
    values = values + square(value);
    products = products + value * slope;
    slopes = slopes + square(slope);
    value_real = value_real + value * real;
    slope_real = slope_real + slope * real;
    value_imaginary = value_imaginary + value * imaginary;
    sign = -sign;
  }

  // In the turned frame the columns of H are 2 pi times 2 x1 sinc, j x1^2 sinc and x1^2 (sinc' + j pi sinc).
  const Scalar weight = Scalar(2.0 * detail::kPi) / r;
  const Scalar column = weight * (state(0) + state(0));
  const Scalar scale = Scalar(2.0 * detail::kPi) * weight;
  const Scalar quartic = scale * square(power);
  DftBlockInformation<Scalar> result;
  result.matrix(0, 0) = scale * (Scalar(4.0) * power) * values;
  result.matrix(0, 1) = Scalar(0.0);
  result.matrix(0, 2) = scale * (state(0) + state(0)) * power * products;
  result.matrix(1, 1) = quartic * values;
  result.matrix(1, 2) = quartic * pi * values;
  result.matrix(2, 2) = quartic * (slopes + square(pi) * values);
  result.matrix(1, 0) = result.matrix(0, 1);
  result.matrix(2, 0) = result.matrix(0, 2);
  result.matrix(2, 1) = result.matrix(1, 2);
  result.vector(0) = column * value_real;
  result.vector(1) = weight * power * value_imaginary;
  result.vector(2) = weight * power * (slope_real + pi * value_imaginary);
  return result;
}

/// (P^-1 + J)^-1 for symmetric positive semidefinite P and J, without inverting either: with the adjugates it
/// is [P + mixed(adj P, J) + det(P) adj J] / [1 + tr PJ + tr(adj P adj J) + det P det J], where all terms are
/// positive semidefinite, so that a singular P does no harm.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix<Scalar, 3, 3> information_update(const Eigen::Matrix<Scalar, 3, 3>& p,
                                                                    const Eigen::Matrix<Scalar, 3, 3>& j) {
  const Eigen::Matrix<Scalar, 3, 3> adjugate_p = detail::mixed_adjugate(p, p) * Scalar(0.5);
  const Eigen::Matrix<Scalar, 3, 3> adjugate_j = detail::mixed_adjugate(j, j) * Scalar(0.5);
  const Eigen::Matrix<Scalar, 3, 3> mixed = detail::mixed_adjugate(adjugate_p, j);
  const Scalar determinant_p =
      p(0, 0) * adjugate_p(0, 0) + p(0, 1) * adjugate_p(0, 1) + p(0, 2) * adjugate_p(0, 2);
  const Scalar determinant_j =
      j(0, 0) * adjugate_j(0, 0) + j(0, 1) * adjugate_j(0, 1) + j(0, 2) * adjugate_j(0, 2);
  const Scalar inverse =
      Scalar(1.0) / (Scalar(1.0) + detail::trace_of_product(p, j) +
                     detail::trace_of_product(adjugate_p, adjugate_j) + determinant_p * determinant_j);
  return (p + mixed + adjugate_j * determinant_p) * inverse;
}

/// From (k|k) to (k+1|k): (2.5) and (2.6) with F of (4.18).
template <typename Scalar>
[[nodiscard]] inline DftBlockEstimate<Scalar> time_update(const DftBlockEstimate<Scalar>& filtered,
                                                          const DftBlockDesign<Scalar>& design) {
  using detail::square;
  const Scalar turn(2.0 * detail::kPi);
  const Scalar kept_amplitude = Scalar(1.0) - design.epsilon_amplitude;
  const Scalar kept_offset = Scalar(1.0) - design.epsilon_offset;
  const Eigen::Matrix<Scalar, 3, 3>& p = filtered.covariance;
  DftBlockEstimate<Scalar> result{kept_amplitude * filtered.root_amplitude,
                                  filtered.phase + turn * filtered.offset, kept_offset * filtered.offset, p};
  Eigen::Matrix<Scalar, 3, 3>& m = result.covariance;
  const Scalar cross = p(1, 2) + turn * p(2, 2);
  m(0, 0) = square(kept_amplitude) * p(0, 0) + design.q1;
  m(0, 1) = kept_amplitude * (p(0, 1) + turn * p(0, 2));
  m(0, 2) = kept_amplitude * kept_offset * p(0, 2);
  m(1, 1) = p(1, 1) + turn * (p(1, 2) + cross) + design.q2;
  m(1, 2) = kept_offset * cross;
  m(2, 2) = square(kept_offset) * p(2, 2) + design.q3;
  m(1, 0) = m(0, 1);
  m(2, 0) = m(0, 2);
  m(2, 1) = m(1, 2);
  return result;
}

/// From (k|k-1) to (k|k) with the bins M - L ... M + L of block k, signal units: (2.3), (2.4), (2.7) in
/// information form. Throws std::invalid_argument for an even number of bins.
template <typename Scalar>
[[nodiscard]] inline DftBlockEstimate<Scalar> measurement_update(const DftBlockEstimate<Scalar>& predicted,
                                                                 std::span<const DftBin<Scalar>> bins,
                                                                 const DftBlockDesign<Scalar>& design) {
  const DftBlockInformation<Scalar> information = dft_block_information(predicted.state(), bins, design.r);
  const Eigen::Matrix<Scalar, 3, 3> p = information_update(predicted.covariance, information.matrix);
  const Eigen::Matrix<Scalar, 3, 1>& v = information.vector;
  return {predicted.root_amplitude + (p(0, 0) * v(0) + p(0, 1) * v(1) + p(0, 2) * v(2)),
          predicted.phase + (p(1, 0) * v(0) + p(1, 1) * v(1) + p(1, 2) * v(2)),
          predicted.offset + (p(2, 0) * v(0) + p(2, 1) * v(1) + p(2, 2) * v(2)), p};
}

/// The tracker with its memory. It starts from one estimate, which is x(0|0) when `step` or `time_update`
/// comes first, and as x(1|0) when `measurement_update` does.
template <typename Scalar = double>
class DftBlockEkf {
 public:
  DftBlockEkf(const DftBlockDesign<Scalar>& design, const DftBlockEstimate<Scalar>& start)
      : design_(design), predicted_(start), filtered_(start) {}

  /// predicted() becomes (k+1|k), from filtered() at (k|k).
  void time_update() { predicted_ = trackers::time_update(filtered_, design_); }

  /// filtered() becomes (k|k), from predicted() at (k|k-1) and the bins of block k. Throws
  /// std::invalid_argument for an even number of bins.
  void measurement_update(std::span<const DftBin<Scalar>> bins) {
    filtered_ = trackers::measurement_update(predicted_, bins, design_);
  }

  /// One block: time_update, then measurement_update with the bins of block k+1.
  void step(std::span<const DftBin<Scalar>> bins) {
    time_update();
    measurement_update(bins);
  }

  [[nodiscard]] const DftBlockDesign<Scalar>& design() const { return design_; }
  [[nodiscard]] const DftBlockEstimate<Scalar>& predicted() const { return predicted_; }
  [[nodiscard]] const DftBlockEstimate<Scalar>& filtered() const { return filtered_; }

 private:
  DftBlockDesign<Scalar> design_;
  DftBlockEstimate<Scalar> predicted_;
  DftBlockEstimate<Scalar> filtered_;
};

}  // namespace veritrack::trackers
