// The state transition f of the tracker, f(x) = (Rot(x3) (x1, x2), (1 - epsilon) x3): suprema of its
// derivatives, and eigenvalues of its Gramian, in closed form. m = |x1 + i x2|.
#pragma once

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// ||df/dx||: the largest singular value of [[1, m], [0, 1 - epsilon]].
inline Ball first_derivative_norm(const Ball& m, const Ball& epsilon) {
  return half * (sqrt(square(m) + square(two - epsilon)) + sqrt(square(m) + square(epsilon)));
}
/// ||d^2 f/dx^2||, the largest of |sin 2t| + m cos^2 t.
inline Ball second_derivative_norm(const Ball& m) {
  return half * (m + sqrt(square(m) + four));
}
/// ||d^3 f/dx^3||, the largest of cos^2 t (3 sin t + m cos t): where 2 tan^2 t + m tan t = 1.
inline Ball third_derivative_norm(const Ball& m) {
  const Ball tangent = (sqrt(square(m) + Ball(8.0)) - m) / four;
  return one / (tangent * sqrt(one + square(tangent)));
}

/// The extreme eigenvalues of r O(k,1) = H'H + (H F^-1)'(H F^-1), w3 = (m/(1 - epsilon))^2: those of
/// [[2, mu], [mu, mu^2]]; the third, 2, lies between them.
struct GramianEigenvalues {
  Ball smallest, largest;
};
inline GramianEigenvalues gramian_eigenvalues(const Ball& w3) {
  const Ball largest = half * (two + w3 + sqrt(square(w3) + four));
  return {w3 / largest, largest};
}

/// sup over all priors of the largest eigenvalue of the (phase, frequency) block of P(k|k), k >= 1, for
/// |z(k-1|k-1)| = m: that of [[r, r/mu], [r/mu, (2r + q1)/mu^2 + q2]] (docs/riccati-bounds.md). Falls with m.
inline Ball phase_frequency_covariance(const Ball& q1, const Ball& q2, const Ball& r, const Ball& epsilon,
                                       const Ball& m) {
  const Ball mu = m / (one - epsilon);
  const Ball frequency = (two * r + q1) / square(mu) + q2;
  const Ball mean = half * (r + frequency);
  return mean + sqrt(square(mean - r) + square(r / mu));
}
/// A bound on ||P(k|k)||: that, or the amplitude's r/2 + q1/4.
inline Ball largest_covariance(const Ball& q1, const Ball& q2, const Ball& r, const Ball& epsilon,
                               const Ball& m) {
  return max(phase_frequency_covariance(q1, q2, r, epsilon, m), half * r + Ball(0.25) * q1);
}

}  // namespace veritrack::checker
