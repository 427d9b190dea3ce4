// The error equation of the quadrature tracker, with sound constants for errors up to a radius.
//
// With e = x - xhat(k|k), |z| = 1 for the signal, and F at the estimate (thesis, (2.12), expanded there about
// the signal instead),
//     e+ = (I - KH)(F e + phi + w) - K v,   |phi| <= (curvature/2) |e|^2.
// Four facts, proved in docs/published-results.md, for P = P(k|k), Phat = F P F' + Q, P+ = P(k+1|k+1), give
// the constants below:
//     (I - KH)' (P+)^-1 (I - KH) <= Phat^-1 <= I / q_lo,      K' (P+)^-1 K <= I / r,
//     F' Phat^-1 F <= alpha^2 P^-1,  alpha^-2 = 1 + q_lo / (p_hi a_bar^2),      p_lo I <= P <= p_hi I.
// Norms are Euclidean; they mix signal units and rad/sample as the thesis does, for a signal of amplitude 1.
#pragma once

#include <functional>

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/covariance_range.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// Valid as long as |e(k|k)| <= radius < 1 at every step so far.
struct ErrorEquation {
  rigor::Interval radius;
  rigor::Interval transition;       ///< a_bar: |F| at the estimate and between it and the signal
  rigor::Interval curvature;        ///< |D^2 f| there
  CovarianceRange covariance;       ///< p_lo, p_hi
  rigor::Interval process;          ///< q_lo
  rigor::Interval measurement;      ///< r
  rigor::Interval one_minus_alpha;  ///< 1 - alpha: one step of F multiplies sqrt(e' P^-1 e) by at most alpha
  rigor::Interval beta;             ///< sqrt(p_hi / p_lo)
  rigor::Interval correction;       ///< |I - KH| <= sqrt(p_hi / q_lo)
  rigor::Interval gain;             ///< |K| <= min(p_hi / r, sqrt(p_hi / r))
};

/// The constants for that radius. Empty values where q1 may be zero. Needs the upward rounding mode.
[[nodiscard]] ErrorEquation error_equation(const TrackerInput& input, const rigor::Interval& radius);

/// The radius among 1/2, 1/4, ... for which `value` has the largest lower end; every radius is valid, so the
/// choice needs no proof. 1/2 when there is none.
[[nodiscard]] rigor::Interval best_radius(
    const std::function<rigor::Interval(const rigor::Interval&)>& value);

/// The quantities by which results are compared. Any of them may be empty.
struct Guarantee {
  rigor::Interval initial_frequency_error;  ///< the largest certified initial error, rad/sample
  rigor::Interval noise;                    ///< the largest certified |v(k)|, over the amplitude
  rigor::Interval rate;                     ///< the factor per step in the norm of the result
};

/// Appends the quantities "initial_frequency_error_bound", "noise_bound" and "rate". `no_noise` says why the
/// result tolerates no noise; empty when it tolerates some.
void add_guarantee(Derivation& derivation, const Guarantee& guarantee, const std::string& source,
                   const std::string& no_noise = {});

/// Appends the constants of the error equation as quantities.
void add_error_equation(Derivation& derivation, const ErrorEquation& equation);

/// Is P(0|0) known to lie in the covariance range? For a steady state only if epsilon = 0, where |z| = 1.
[[nodiscard]] Condition start_covariance(const TrackerInput& input, const ErrorEquation& equation);

/// The largest |e_0| allowed against `bound`.
[[nodiscard]] Condition start_error(const TrackerInput& input, const std::string& bound_in_latex,
                                    const rigor::Interval& bound);

/// The largest |w(k)| and |v(k)| allowed; empty where nothing is assumed.
struct AssumedNoise {
  rigor::Interval process, measurement;
};
[[nodiscard]] AssumedNoise assumed_noise(const TrackerInput& input);

}  // namespace veritrack::theorems
