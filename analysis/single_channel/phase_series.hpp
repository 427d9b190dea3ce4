// Functions of the phase, and of the frequency: trigonometric polynomials with values in the state space of
// the map over the phase.
#pragma once

#include <cstddef>
#include <vector>

#include "trackers/scalar_functions.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace veritrack::single_channel {

using trackers::RotatingFrameState;

/// X(phi) = mean + sum_k cosines[k-1] cos 2k phi + sines[k-1] sin 2k phi, pi-periodic; the doubles are meant
/// exactly.
struct PhaseSeries {
  RotatingFrameState<double> mean;
  std::vector<RotatingFrameState<double>> cosines;
  std::vector<RotatingFrameState<double>> sines;  ///< as many

  /// X(phase), phase in rad.
  template <typename Scalar>
  [[nodiscard]] RotatingFrameState<Scalar> at(const Scalar& phase) const {
    using trackers::detail::sin_cos;
    const auto [sine, cosine] = sin_cos(phase + phase);
    Scalar sine_k = sine;
    Scalar cosine_k = cosine;
    RotatingFrameState<Scalar> value;
    for (Eigen::Index i = 0; i < value.size(); ++i) {
      value(i) = Scalar(mean(i));
    }
    for (std::size_t k = 0; k < cosines.size(); ++k) {
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        if (cosines[k](i) != 0.0 || sines[k](i) != 0.0) {
          value(i) += Scalar(cosines[k](i)) * cosine_k + Scalar(sines[k](i)) * sine_k;
        }
      }
      const Scalar next = cosine_k * cosine - sine_k * sine;
      sine_k = sine_k * cosine + cosine_k * sine;
      cosine_k = next;
    }
    return value;
  }
};

/// A curve for each frequency of an interval: sum_k terms[k](phase) t^k, t = scale (omega - center).
struct PhaseFamily {
  double center = 0.0;  ///< rad/sample
  double scale = 0.0;   ///< samples/rad; 0 when there is one term only
  std::vector<PhaseSeries> terms;

  /// X(phase; omega), phase in rad, omega in rad/sample.
  template <typename Scalar>
  [[nodiscard]] RotatingFrameState<Scalar> at(const Scalar& phase, const Scalar& omega) const {
    const Scalar t = Scalar(scale) * (omega - Scalar(center));
    RotatingFrameState<Scalar> value = terms.back().at(phase);
    for (std::size_t k = terms.size() - 1; k > 0; --k) {
      const RotatingFrameState<Scalar> term = terms[k - 1].at(phase);
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        value(i) = value(i) * t + term(i);
      }
    }
    return value;
  }
};

}  // namespace veritrack::single_channel
