// The posterior Cramer-Rao bound on the frequency of a sinusoid whose frequency is a random walk.
//
// P. Tichavsky, C. H. Muravchik and A. Nehorai, "Posterior Cramer-Rao bounds for discrete-time nonlinear
// filtering", IEEE Trans. Signal Processing 46(5), 1998. Their information recursion, for a state x,
//     J(k+1) = D22 - D21 (J(k) + D11)^-1 D12,
// has for linear dynamics x(k+1) = F x(k) + w, w normal with covariance Q, and measurements h(x) with noise
// covariance R the terms D11 = F'Q^-1 F, D12 = D21' = -F'Q^-1, D22 = Q^-1 + E[(dh/dx)' R^-1 dh/dx], and is by
// the matrix inversion lemma
//     J(k+1) = (F J(k)^-1 F' + Q)^-1 + E[(dh/dx)' R^-1 dh/dx].
// In this form Q may be singular, and the bound is still valid: x(k+1) is a linear function of the start and
// of the noise that does enter, for which the information is regular.
//
// In the coordinates (A, phi, omega) the dynamics is linear, and the expectation is over a normal phase: it
// is evaluated in closed form, without simulation.
#pragma once

#include <vector>

#include "papers/limits/tracking_model.hpp"

namespace veritrack::limits {

/// A lower bound on the mean square error of any estimate of omega(k) from the start and y(1), ..., y(k),
/// (rad/sample)^2, for k = 1, ..., samples at index k - 1. (For DrawnAtStart::start: of any that is unbiased
/// in the signal's amplitude, phase and frequency at k = 0.)
[[nodiscard]] std::vector<double> posterior_frequency_bounds(const TrackingModel& model, int samples);

/// The limit of that bound for quadrature measurements: the steady state of the filter for phase and
/// frequency alone, which is known in closed form (by spectral factorisation), (rad/sample)^2. walk_variance
/// > 0.
[[nodiscard]] double steady_frequency_bound(double noise_to_signal, double walk_variance);

}  // namespace veritrack::limits
