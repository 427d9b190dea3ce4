// Figures 4.4 to 4.12 of the thesis, and the sums of Table 4.2 over the noise. None is drawn yet.
#pragma once

#include <cstddef>
#include <vector>

#include "papers/experiments/sonar_pass.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports::sonar {

/// The noise variance of set 1.
inline constexpr double kSet1Noise = 1.0;

/// Median sums over the noise variance of a sample for the three designs, started at the truth, and the
/// printed ones; over at most 60 runs.
[[nodiscard]] Figure draw_noise_scan(const std::vector<experiments::SonarBlock>& pass, int runs);

/// The measurements at the largest and at the smallest range: Figures 4.4, 4.7 and 4.10.
[[nodiscard]] Figure draw_signals(double doppler);

/// Estimates and errors of a run of set number + 1, at the printed noise and at that of set 1.
[[nodiscard]] Figure draw_estimates(std::size_t number, const std::vector<experiments::SonarBlock>& pass);

}  // namespace veritrack::reports::sonar
