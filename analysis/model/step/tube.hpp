// The data of a certificate for a tracker that is given by its recursion: a curve through the state space
// over the phase and the frequency of the tone, and a shape around it.
#pragma once

#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

#include "trackers/scalar_functions.hpp"

namespace veritrack::model {

/// Re sum_h sum_d coefficients[h][d] z^d exp(i h phi), h = 0, 1, ..., where z in [-1, 1] is the place in a
/// cell of frequencies. The doubles are meant exactly. No coefficients mean 0.
struct PhaseSeries {
  std::vector<std::vector<std::complex<double>>> coefficients;

  [[nodiscard]] bool operator==(const PhaseSeries& other) const = default;
  /// Its value, where harmonics[h] is (cos h phi, sin h phi) and powers[d] is z^d: at least as many as there
  /// are coefficients.
  template <typename Scalar>
  [[nodiscard]] Scalar at(const std::vector<std::pair<Scalar, Scalar>>& harmonics,
                          const std::vector<Scalar>& powers) const {
    Scalar sum(0.0);
    for (std::size_t h = 0; h < coefficients.size(); ++h) {
      Scalar real(0.0);
      Scalar imaginary(0.0);
      for (std::size_t d = 0; d < coefficients[h].size(); ++d) {
        real = real + Scalar(coefficients[h][d].real()) * powers[d];
        imaginary = imaginary + Scalar(coefficients[h][d].imag()) * powers[d];
      }
      sum = sum + (real * harmonics[h].first - imaginary * harmonics[h].second);
    }
    return sum;
  }
};

/// A tube over the phase phi in [0, 2 pi] and the frequencies |omega - frequency| <= half_width:
/// C(phi, omega) + U(phi, omega) xi, |xi| <= radius, with C(phi, omega) = turns phi + curve and U lower
/// triangular.
struct Tube {
  double frequency = 0.0;   ///< rad/sample
  double half_width = 0.0;  ///< rad/sample, > 0; z = (omega - frequency) / half_width
  double amplitude = 1.0;   ///< of the signal
  std::vector<int> turns;   ///< how often a state turns while the phase turns once: 0 unless it is an angle
  std::vector<PhaseSeries> curve;  ///< one for each state
  std::vector<PhaseSeries> shape;  ///< the lower triangle of U, row by row
  /// For an extended Kalman filter, whose curve and shape are those of the estimate alone: lower and upper
  /// bounds, in the order of symmetric matrices, of the covariance that is predicted for the sample at phi;
  /// lower triangles, row by row. Otherwise empty (docs/model-proof.md, section 13).
  std::vector<PhaseSeries> covariance_low, covariance_high;

  [[nodiscard]] bool operator==(const Tube& other) const = default;
  [[nodiscard]] bool bounds_covariance() const { return !covariance_high.empty(); }
};

/// The signal: sample c is the sum over h of coefficients[c][h] amplitude exp(i h phi), real part.
struct Signal {
  std::vector<std::vector<std::complex<double>>> coefficients;
};

}  // namespace veritrack::model
