// Cramer-Rao bounds on the variance of an unbiased estimate of a constant frequency, in (rad/sample)^2, when
// amplitude and phase are unknown too. `noise_to_signal` is the noise variance of a channel over A^2.
//
// D. C. Rife and R. R. Boorstyn, "Single-tone parameter estimation from discrete-time observations", IEEE
// Trans. Information Theory 20(5), 1974; S. M. Kay, "Fundamentals of Statistical Signal Processing:
// Estimation Theory", 1993, example 3.14.
#pragma once

namespace veritrack::limits {

/// For N complex samples: 12 noise_to_signal / (N (N^2 - 1)). N >= 2.
[[nodiscard]] double complex_tone_bound(double noise_to_signal, int samples);

/// For N real samples of a frequency that is not near 0 or pi, N large: twice that.
[[nodiscard]] double real_tone_bound_of_many_samples(double noise_to_signal, int samples);

/// For N real samples A cos(phase + frequency n), n = 1, ..., N, exactly: from the inverse of the Fisher
/// information of (A, phase, frequency). N >= 3.
[[nodiscard]] double real_tone_bound(double noise_to_signal, double frequency, double phase, int samples);

/// The variance, due to noise, of the frequency estimate of a tracker that assumes a random walk of variance
/// tracker_q2 while the frequency is constant: noise_to_signal^(1/4) tracker_q2^(3/4) / (2 sqrt 2),
/// (rad/sample)^2, a quarter of the variance that the tracker itself computes. `noise_to_signal` is that of a
/// complex sample; twice that of a real one. From the steady-state filter for phase and frequency in the
/// limit of slow loops, tracker_q2 << noise_to_signal: the closed loop is s^2 + sqrt(2) Omega s + Omega^2,
/// Omega^4 = tracker_q2 / noise_to_signal, and the noise of the phase reaches the frequency through Omega^2 s
/// over that.
[[nodiscard]] double mistuned_variance(double noise_to_signal, double tracker_q2);

/// The number of samples after which the bound for complex samples is below mistuned_variance: about
/// 3.2 (noise_to_signal / tracker_q2)^(1/4).
[[nodiscard]] double samples_until_mistuned(double noise_to_signal, double tracker_q2);

}  // namespace veritrack::limits
