// J. S. Baras, A. Bensoussan, M. R. James 1988, theorems 7 and 8 (thesis, theorems 2.1 and 2.2), for the
// continuous-time oscillator that matches a design of the quadrature tracker: with the sample as unit of time
//     dz/dt = i x3 z,   dx3/dt = -epsilon_c x3,   epsilon_c = -log(1 - epsilon),   y = z,
// Q = diag(q1, q1, q2) a sample, R = r I samples, |z| = 1. Its second derivative has norm 1 everywhere.
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// id "baras-bensoussan-james". The theorem's conditions concern all states, and fail; the constants are for
/// states near the signal. The printed (2.16) depends on the units of the state; its proof gives
/// (docs/published-results.md) N <= q I and
///     |x_0 - m_0| |d^2 f| < q_0 / (q^(3/2) |P_0^(1/2)|).
/// Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_baras_bensoussan_james(const TrackerInput& input);

}  // namespace veritrack::theorems
