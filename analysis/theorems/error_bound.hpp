// The error bound of Theorem 2.9 as a function of time.
#pragma once

#include <optional>

#include "analysis/rigor/interval.hpp"

namespace veritrack::theorems {

/// The conclusion of Theorem 2.9,
///     |e(k|k)| <= beta alpha^k |e_0| + beta (alpha + zeta beta)^k |e_0| + beta eta (R_x - beta epsilon_z) /
///     (1 - (alpha + zeta beta)),
/// with constants that satisfy (2.43). Only `make_error_bound` creates one.
class ErrorBound {
 public:
  /// The bound on |e(k|k)| at step k >= 0 (signal units and rad/sample mixed, as in the thesis). Needs the
  /// upward rounding mode. Throws std::invalid_argument for negative k.
  [[nodiscard]] rigor::Interval at(int k) const;
  /// The last term: the limit as k grows.
  [[nodiscard]] const rigor::Interval& ultimate() const noexcept { return ultimate_; }

 private:
  friend std::optional<ErrorBound> make_error_bound(const struct ErrorBoundConstants& constants);
  ErrorBound() = default;

  rigor::Interval initial_;  // beta |e_0|
  rigor::Interval alpha_;
  rigor::Interval perturbed_rate_;  // alpha + zeta beta
  rigor::Interval ultimate_;
};

/// The constants of the bound; the symbols are those of Theorem 2.9.
struct ErrorBoundConstants {
  rigor::Interval state_bound;  ///< R_x
  rigor::Interval beta, one_minus_alpha, zeta, eta, epsilon_z;
  rigor::Interval initial_error;  ///< |e_0|
};

/// The bound, when the constants are finite, non-negative, one_minus_alpha lies in (0, 1], beta >= 1, and
/// beta (zeta + eta) < 1 - alpha, (2.43), is certain; nothing otherwise. The caller is responsible for the
/// other hypotheses. Opens its own UpwardRounding scope.
[[nodiscard]] std::optional<ErrorBound> make_error_bound(const ErrorBoundConstants& constants);

}  // namespace veritrack::theorems
