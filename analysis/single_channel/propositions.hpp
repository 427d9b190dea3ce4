// Propositions 1 and 2 of S. Bittanti and S. M. Savaresi, "On the parameterization and design of an extended
// Kalman filter frequency tracker", IEEE Trans. Automatic Control 45(9), 2000, as statements with verdicts.
#pragma once

#include <string>
#include <vector>

#include "analysis/single_channel/invariant_curve.hpp"
#include "analysis/statements/statement.hpp"

namespace veritrack::single_channel {

/// The formulas of Proposition 1: the printed numerators and denominators of (4) and (6) against the
/// characteristic polynomial of the filter that they are to describe, as polynomial identities, and the
/// corrected ones. They hold or fail for all gains and frequencies: no design enters. Needs the upward mode.
[[nodiscard]] std::vector<theorems::Statement> proposition_1_formulas();

/// The conclusion of Proposition 1, "unbiased if and only if epsilon omega = 0", in both directions, at one
/// frequency (its decimal, rad/sample): `with_leak` and `without_leak` are the steady states of the design
/// and of the design with epsilon = 0. The second direction is omitted for a design with epsilon = 0. Needs
/// the upward mode.
[[nodiscard]] std::vector<theorems::Statement> proposition_1_conclusion(const SteadyStateBias& with_leak,
                                                                        const SteadyStateBias& without_leak,
                                                                        const rigor::Interval& epsilon,
                                                                        const std::string& frequency);

/// Proposition 2: q, r and P(0) scaled by the same factor leave the estimates alone (an identity of the
/// maps), q and r alone, with "the same initialization", do not (a witness). No design enters. Needs the
/// upward mode.
[[nodiscard]] std::vector<theorems::Statement> proposition_2();

}  // namespace veritrack::single_channel
