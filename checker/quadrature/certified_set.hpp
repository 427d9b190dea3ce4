// The certified sets of the tracker without a leak (docs/contraction.md): they are read and proved, and each
// proves bounds on the errors in it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "checker/numbers/matrix3.hpp"
#include "checker/quadrature/step.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// The first row and column are zero except on the diagonal.
bool amplitude_is_apart(const Matrix3& m);

/// A certified set as the certificate gives it.
struct CertifiedSet {
  std::string purpose;
  Setting setting;
  bool verified = false;
};

/// Reads a set and proves, from nothing but the design: P_lo > 0, P_hi > P_lo, T invertible, and the
/// hypotheses (a), (b), (c) of the theorem. Each failure is an objection, and the set is then not verified.
CertifiedSet check_set(const Tree& set, const Design& design, std::int64_t& cells, Objections& objections);

/// The first verified set of this purpose, or none.
const Setting* first_of(const std::vector<CertifiedSet>& sets, const std::string& purpose);

/// It is certified for at least the noise and slew of the design.
bool tolerates(const Setting& set, const Design& design);
/// Lengths of the rows of T^-1: |amplitude|, |phase|, |frequency error| are at most these times |T e|.
std::array<Ball, 3> inverse_rows(const Metric& metric);
/// The largest |frequency error| in the set, rad/sample.
Ball frequency_errors(const Setting& set);
/// sup |T e| over |e_i| <= bounds_i.
Ball largest_level(const Metric& metric, const Ball& amplitude, const Ball& phase, const Ball& frequency);
/// The shifts by whole turns of the frequency error for which a verified set may be asked.
inline const Ball kMostTurns(3.0);
/// A bound on |T e| after a step from |T e| <= level under this noise and slew.
Ball next_level(const Setting& set, const Ball& level, const Ball& noise, const Ball& slew);
/// An upper bound on the limit of |T e| under the noise and slew of the design: the level that is its own
/// next_level.
Ball ultimate_level(const Setting& set, const Design& design);
/// From |T e| <= start on: the frequency error is within `frequency_error` after `samples` samples, and at
/// all later ones: rate'^(2k) (l^2 - u^2) + u^2 <= level^2 with rate'^2 = rate^2 u/(u - rounding).
bool settled(const Setting& set, const Design& design, const Ball& start, const Ball& frequency_error,
             const Ball& samples);

Covariance<Ball> operator-(const Covariance<Ball>& x, const Covariance<Ball>& y);
bool positive_definite(const Covariance<Ball>& p CHECKER_PLACE);
Matrix3 whole(const Covariance<Ball>& p);
/// P - lower > 0 and upper - P > 0.
bool between(const Matrix3& p, const Covariance<Ball>& lower, const Covariance<Ball>& upper);

}  // namespace veritrack::checker
