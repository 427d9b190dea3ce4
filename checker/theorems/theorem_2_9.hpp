// Theorem 2.9 (La Scala, thesis 1994) in its two readings: constants, conditions, and whether any choice of
// the free parameters could satisfy it.
#pragma once

#include "checker/theorems/design.hpp"

namespace veritrack::checker {

enum class Reading { printed, errata };

/// The constants of section 2.4.3 and of the list at the end of section 3.5.
struct Constants29 {
  Ball epsilon_r, rho_1, rho_2, b_1, b_2, p, q, s, gamma, beta, one_minus_alpha, epsilon_z, delta_p, delta_k,
      delta_k2, zeta_z, eta_size, eta_slope, eta, zeta, initial_error_bound;
  Ball process_noise, measurement_noise;  ///< c_1 sqrt(q_2) and c_2 sqrt(r)
};
Constants29 constants_2_9(const Design& design, Reading reading);

/// The least |z| of an estimate with |e| <= eps_r, over all eps_r that the errata sheet admits when "sigma
/// arbitrarily small" means 2 sigma <= (1 - eps_r)^2: sqrt(2 sigma). Everything unless 0 < 2 sigma < 1.
Ball smallest_admitted_estimate(const Design& design);

/// sup |e(0)| over the assumed starts.
Ball largest_initial_error(const Design& design);

/// Objects to every statement of the derivation, feasibility included, that could not be re-established.
std::string check_theorem_2_9(const Tree& derivation, const Design& design, Reading reading,
                              Objections& objections);

}  // namespace veritrack::checker
