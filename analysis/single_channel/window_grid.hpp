// What the proposals of windows look at: phases and frequencies of a grid, in floating point.
#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>
#include <numbers>

#include "analysis/rigor/matrix.hpp"
#include "analysis/single_channel/window_proposal.hpp"

namespace veritrack::single_channel::detail {

using Covariance = PhaseCovariance<double>;
using Matrix3 = rigor::Matrix<3>;

inline constexpr int kSettling = 16;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[nodiscard]] inline Matrix3 matrix_of(const Covariance& p) {
  Matrix3 matrix;
  matrix << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return matrix;
}

template <int Size>
[[nodiscard]] double smallest_eigenvalue(const rigor::Matrix<Size>& matrix) {
  return Eigen::SelfAdjointEigenSolver<rigor::Matrix<Size>>(matrix, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

/// Calls visit as follow_window does, at phases and frequencies of a grid.
template <typename Visit>
void follow_grid(const WindowRequest& request, const WindowAssumption& assumption, int window,
                 const Visit& visit) {
  constexpr int kPhases = 24;
  constexpr std::array<double, 5> kFrequencies = {0.0, 0.1, 0.5, 0.9, 1.0};
  for (const double share : kFrequencies) {
    const double frequency =
        request.lowest_frequency + share * (request.highest_frequency - request.lowest_frequency);
    for (int i = 0; i < kPhases; ++i) {
      const double phase = std::numbers::pi * i / kPhases;
      follow_window<double>(request.design, assumption, {kSettling, window, request.slew}, phase, frequency,
                            [&](int m, const auto& upper, const auto& lower, const auto& predicted) {
                              visit(m, upper, lower, predicted);
                              return true;
                            });
    }
  }
}

}  // namespace veritrack::single_channel::detail
