// The claims of the KKL observer's paper (trackers/kkl_observer/kkl_observer.hpp), decided for a design.
#pragma once

#include <optional>
#include <vector>

#include "analysis/kkl_observer/kkl_ell.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/statements/derivation.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {

/// The subject of the claims.
struct KklClaimsQuestion {
  std::vector<rigor::Interval> lambda;  ///< four to eight filter rates, 1/s; certainly positive and distinct
  rigor::Interval frequency;            ///< rad/s; certainly positive
  rigor::Interval amplitude;            ///< signal units; certainly positive
  rigor::Interval ell;                  ///< in use in (9)
  rigor::Interval infimum;              ///< that of (10) over the frequencies (enclose_ell)
};

/// The derivation "kkl-paper": one condition for each claim, with a witness where it is REFUTED. Quantities
/// vandermonde_singular_value, injectivity_constant and continuity_modulus. Opens its own rounding scope.
/// Throws std::invalid_argument unless there are four to eight filters.
[[nodiscard]] theorems::Derivation derive_kkl_claims(const KklClaimsQuestion& question);

/// A signal at one moment, in exact doubles.
struct SignalWitness {
  double x1, x2;     ///< signal units, signal units times rad/s
  double frequency;  ///< rad/s; x3 is its square

  /// Needs the upward mode.
  [[nodiscard]] trackers::OscillatorState<rigor::Interval> state() const {
    return {rigor::Interval(x1), rigor::Interval(x2), square(rigor::Interval(frequency))};
  }
};

/// A signal of the range for which mu of (9) certainly does not vanish on T, so that gamma(T(x)) is not x:
/// (L'L + mu) (gamma - x) = -mu x. Empty when none was found. Needs the upward mode. For four to eight
/// filters.
template <int M>
[[nodiscard]] std::optional<SignalWitness> find_inverse_witness(const KklRangeOf<M>& range,
                                                                const rigor::Interval& ell);

/// The signal of this frequency (rad/s) with the smallest |M T|^2 / |T|^2, scaled somehow: a proposal in
/// double, for four filters.
[[nodiscard]] SignalWitness propose_least_excited(const Eigen::Vector4d& lambda, double frequency);

/// A bound on the rate at which gamma changes with xi (in the units of x per unit of xi) along every path in
/// lower <= |xi| <= upper. Empty when not finite. Needs the upward mode.
///
/// With g = |lambda|^2 |1|^2 - (lambda'1)^2, det Phi >= |M xi|^2 + mu g >= min(g, 1/2) ell |xi|^2, and the
/// trace of Phi bounds the product of its two larger eigenvalues: lambda_min >= det / (trace / 2)^2. Then Phi
/// dgamma = d(L'F^2 xi) - dPhi gamma, with every factor bounded by norms; mu is Lipschitz. For four to eight
/// filters.
template <int M>
[[nodiscard]] rigor::Interval continuity_modulus(const rigor::IntervalVector<M>& lambda,
                                                 const rigor::Interval& ell, const rigor::Interval& lower,
                                                 const rigor::Interval& upper);

}  // namespace veritrack::kkl_observer
