// Sets for the designs of La Scala's Table 3.2 without their leak, found by search in floating point.
#pragma once

#include <array>
#include <cmath>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature::test_sets {

/// The variances of Figures 3.2 and 3.5.
inline constexpr std::array<trackers::ToneModel<double>, 2> kDesigns{
    {{0.0005, 0.0005, 0.01, 0.0}, {0.0023, 0.0023, 0.05, 0.0}}};

/// A set for such a design and signal-to-noise ratio, dB.
inline LockSet lock_set(std::size_t design, double decibels) {
  LockSet set;
  set.metric = design == 0 ? BlockMetric<double>{10.573, 12.196, -18.779, 25.173}
                           : BlockMetric<double>{10.83, 12.125, -19.295, 26.112};
  set.centre = level_covariance(*steady_covariance(kDesigns[design]));
  set.spread_above = design == 0 ? LevelCovariance<double>{0.00206937, 0.0020926, 0.00113445, 0.000974987}
                                 : LevelCovariance<double>{0.0102071, 0.0103345, 0.00544712, 0.00452148};
  set.spread_below = design == 0 ? LevelCovariance<double>{377.239, 152.682, 13.7852, 287.319}
                                 : LevelCovariance<double>{81.7628, 32.0706, 2.56431, 61.9756};
  set.weight = 4.0;
  set.level = 27.0;
  set.decay = 0.99;
  set.drift = 0.37;
  set.noise_deviation = std::sqrt(0.5 * std::pow(10.0, -decibels / 10.0));
  return set;
}

/// Figure 3.4's design with its leak.
inline constexpr trackers::ToneModel<double> kLeakingDesign{0.0013, 0.0013, 0.01, 0.01};

/// A set for it at 24 dB, from the search, and a level that makes it small.
inline LockSet leaking_set() {
  LockSet set;
  set.metric = {16.92711, 18.46067, -15.22689, 31.15116};
  set.centre = {0.003046134, 0.006000013, 0.002205306, 0.003407049};
  set.spread_above = {0.003232077, 0.001654278, 0.001011668, 0.001283472};
  set.spread_below = {294.7268, 81.95477, -5.073968, 92.91476};
  set.weight = 4.572852;
  set.level = 10.0;
  set.decay = 0.99;
  set.drift = 1.0;
  set.noise_deviation = 0.0446;
  set.bias = {0.002076551, -0.02650165, -0.03968453};
  set.lowest_frequency = 1.4;
  set.highest_frequency = 1.6;
  return set;
}

}  // namespace veritrack::quadrature::test_sets
