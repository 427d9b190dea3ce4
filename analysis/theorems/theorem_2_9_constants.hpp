// The constants of Theorem 2.9 (La Scala, thesis 1994, sections 2.4 and 3.5), evaluated for a design of the
// quadrature tracker. theorem_2_9.hpp decides the conditions on them.
#pragma once

#include <optional>

#include "analysis/rigor/interval.hpp"

namespace veritrack::theorems {

/// Which reading of the theorem: the body of the 1994 thesis, or the body with its errata sheet applied.
enum class Theorem29Variant { printed, errata };

/// A design of the quadrature tracker, the assumptions on the signal, and the theorem's free parameters.
/// Section 3.5 takes the signal to be on the unit circle: for a signal of amplitude A give q1/A^2, r/A^2, and
/// states, errors and measurement noise over A.
struct Theorem29Input {
  rigor::Interval q1;       ///< process noise variance of the two signal states, signal units squared
  rigor::Interval q2;       ///< process noise variance of the frequency state, (rad/sample)^2
  rigor::Interval r;        ///< measurement noise variance a channel, signal units squared
  rigor::Interval epsilon;  ///< leak of the frequency state, dimensionless

  rigor::Interval state_bound;     ///< R_x, the bound on |x(k)| (2.26)
  rigor::Interval sigma;           ///< the thesis's "arbitrarily small" number
  rigor::Interval gamma_fraction;  ///< gamma = gamma_fraction / (s p^2), in (0, 1)
  rigor::Interval c1;              ///< |w(k)| <= c1 sqrt(q2)
  rigor::Interval c2;              ///< |v(k)| <= c2 sqrt(r)

  /// Set when q1 and q2 are known to be the same real number (for example the same decimal in a design file).
  /// Two enclosures, even with the same endpoints, cannot show this; without it (2.24) is undecided.
  bool q1_equals_q2 = false;
  /// Enclosures of the largest values that the assumptions on signal and start allow. Without one of them the
  /// condition that compares it with the theorem's assumption is undecided. Where only an upper bound is
  /// known, give the interval from an attained value to the bound: a condition is refuted by the lower end.
  std::optional<rigor::Interval> largest_state;      ///< of |x(k)|, for (2.26)
  std::optional<rigor::Interval> process_noise;      ///< of |w(k)|, w(k) = x(k+1) - f(x(k)), for (2.28)
  std::optional<rigor::Interval> measurement_noise;  ///< of |v(k)|, for (2.29)
  std::optional<rigor::Interval> initial_error;      ///< of |e_0|, for (2.45); see `largest_initial_error`
};

/// The input with every member that is not finite made empty: an unbounded input must decide nothing, and
/// some formulas would lose the information that it was unbounded (1/q1 is finite for every q1 >= 1).
[[nodiscard]] Theorem29Input with_finite_members(const Theorem29Input& input);

/// Every quantity of the theorem. A member is empty where its formula is undefined for the design (a division
/// by q1 = 0), and unbounded or empty where it overflows.
struct Theorem29Constants {
  rigor::Interval state_bound, epsilon_r;
  rigor::Interval rho_1, rho_2, rho_3, rho_4, rho_5;
  rigor::Interval delta_1, delta_2;
  rigor::Interval a_1, a_2, b_1, b_2;
  rigor::Interval p, q, s;
  rigor::Interval gamma, beta, one_minus_alpha, epsilon_z;
  rigor::Interval delta_p, delta_k, delta_k2;
  rigor::Interval zeta_z, eta, zeta;
  rigor::Interval eta_size, eta_slope;  ///< the two entries of (2.40), of which eta is the larger
  rigor::Interval lhs_2_43, lhs_2_44, initial_error_bound;
  rigor::Interval process_noise_bound;      ///< ||w|| = c1 sqrt(q2), section 3.5
  rigor::Interval measurement_noise_bound;  ///< ||v|| = c2 sqrt(r), section 3.5
  rigor::Interval perturbation_2_43;        ///< beta (zeta + eta): (2.43) says it is less than 1 - alpha
  rigor::Interval perturbation_2_44;        ///< beta zeta_z: (2.44) says it is less than 1 - alpha
};

/// Evaluates the formulas as written, whether or not the input is admissible. For admissible inputs no
/// wider than an ulp or two, away from the ends of the ranges of sigma and gamma_fraction, every relative
/// width is below 1e-12: the differences that cancel (in epsilon_z, 1 - alpha, b_1) are formed in
/// algebraically equal ways that do not. Opens its own UpwardRounding scope.
[[nodiscard]] Theorem29Constants theorem_2_9_constants(Theorem29Variant variant, const Theorem29Input& input);

/// The largest |x(0) - xhat(0|0)| of a start whose amplitude is wrong by at most `amplitude_error`, its phase
/// by at most `phase_error` (rad) and its frequency by at most `frequency_error` (rad/sample), for a signal
/// of that amplitude. The largest value is attained: too large an amplitude, with phase and frequency as
/// wrong as allowed,
///     |e_0|^2 = amplitude_error^2 + 4 A (A + amplitude_error) sin^2(phase_error / 2) + frequency_error^2.
/// Empty for negative errors. Opens its own UpwardRounding scope.
[[nodiscard]] rigor::Interval largest_initial_error(const rigor::Interval& amplitude,
                                                    const rigor::Interval& amplitude_error,
                                                    const rigor::Interval& phase_error,
                                                    const rigor::Interval& frequency_error);

}  // namespace veritrack::theorems
