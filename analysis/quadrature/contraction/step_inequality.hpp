// The inequality that every step of a set satisfies,
//     |T e+|^2 <= rate^2 |T e|^2 + L_v^2 |v|^2 + L_w^2 w^2.
//
// Both sides are quadratic forms in (x, y, nu, v, w, z), see polar_step_form.hpp. By the S-procedure, with a
// multiplier lambda > 0 for the bound on |z| and a multiplier tau >= 0 for the angle to the axis, |y| <=
// tangent |x|, and since sup over z of |p + B z|^2 - lambda |z|^2 is p' (I - B B'/lambda)^-1 p when I >
// B B'/lambda, it suffices that
//     [[L_v^2 I - lambda Delta, -lambda Delta i,                                              G'],
//      [  .  , rate^2 q - lambda i' Delta i + tau diag(-tangent^2, 1, 0),                     P'],
//      [  .  ,    .   ,                                       I - Gamma/lambda - t t'/L_w^2]]
// is positive definite: its rows belong to v, to (x, y, nu), and to the three components of T e+. Here Delta
// = diag(Delta11, Delta22), i = (i_x, i_y, 0), G = T J K_mean, P = (T c_x, T c_y, t), t = T (0, 0, 1)', and
// q, Gamma are the form's. The rows of v are eliminated by hand: their block is diagonal.
#pragma once

#include <array>
#include <limits>

#include "analysis/quadrature/contraction/polar_step_form.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::quadrature {

/// The constants of the inequality, and whether there is noise or slew at all: if not, their rows are left
/// out and their gains are not read.
template <typename Constant>
struct StepConstants {
  Constant rate_squared, noise_gain_squared, slew_gain_squared;
  bool noisy = false, slewing = false;
};

/// The matrix without the rows of v.
template <typename Constant, typename Scalar>
struct ReducedForm {
  Gram<Scalar> schur;                           ///< of the components of T e+
  std::array<std::array<Scalar, 3>, 2> centre;  ///< the columns of P for x and y
  Scalar offset11, offset12, offset22;          ///< to be subtracted from rate^2 q, in (x, y)
  std::array<Constant, 2> noise_pivots;         ///< must be positive
};

namespace detail {
/// g - factor c c'.
template <typename Target, typename Scalar>
void subtract_outer(Gram<Target>& g, const std::array<Scalar, 3>& c, const Scalar& factor) {
  using trackers::detail::square;
  g.g11 -= factor * square(c[0]);
  g.g12 -= factor * (c[0] * c[1]);
  g.g13 -= factor * (c[0] * c[2]);
  g.g22 -= factor * square(c[1]);
  g.g23 -= factor * (c[1] * c[2]);
  g.g33 -= factor * square(c[2]);
}
}  // namespace detail

/// Eliminates noise and slew for a multiplier lambda.
template <typename Constant, typename Scalar>
[[nodiscard]] ReducedForm<Constant, Scalar> reduced_form(const PolarStepForm<Constant, Scalar>& form,
                                                         const BlockMetric<Constant>& metric,
                                                         const StepConstants<Constant>& constants,
                                                         const Constant& multiplier) {
  using trackers::detail::square;
  const Constant one(1.0);
  const Constant over = one / multiplier;
  const Gram<Scalar>& g = form.gram;
  const Scalar none(0.0);
  ReducedForm<Constant, Scalar> reduced{{one - g.g11 * over, -(g.g12 * over), -(g.g13 * over),
                                         one - g.g22 * over, -(g.g23 * over), one - g.g33 * over},
                                        form.centre,
                                        none,
                                        none,
                                        none,
                                        {one, one}};
  if (constants.slewing) {
    detail::subtract_outer(reduced.schur,
                           std::array<Constant, 3>{Constant(0.0), metric.coupling, metric.frequency},
                           Constant(one / constants.slew_gain_squared));
  }
  for (std::size_t j = 0; j < 2; ++j) {
    const std::array<Scalar, 2> i{form.innovation[0][j], form.innovation[1][j]};
    Scalar weight = form.spread[j] * multiplier;
    if (constants.noisy) {
      const Scalar pivot = constants.noise_gain_squared - weight;
      const Scalar reciprocal = one / pivot;
      reduced.noise_pivots[j] = detail::value_of(pivot);
      for (std::size_t basis = 0; basis < 2; ++basis) {
        const Scalar moved = weight * reciprocal * i[basis];
        for (std::size_t k = 0; k < 3; ++k) {
          reduced.centre[basis][k] += form.gain[j][k] * moved;
        }
      }
      detail::subtract_outer(reduced.schur, form.gain[j], reciprocal);
      // weight + weight^2 / pivot.
      weight = weight * (reciprocal * constants.noise_gain_squared);
    }
    reduced.offset11 += weight * square(i[0]);
    reduced.offset12 += weight * (i[0] * i[1]);
    reduced.offset22 += weight * square(i[1]);
  }
  return reduced;
}

namespace detail {

inline constexpr std::size_t kAcrossRow = 4;
inline constexpr std::size_t kAlongRow = 5;

/// The matrix without the rows of v, in the order T e+, nu, y, x.
template <typename Constant, typename Scalar>
rigor::LowerTriangle<6, Scalar> remaining_matrix(const PolarStepForm<Constant, Scalar>& form,
                                                 const BlockMetric<Constant>& metric,
                                                 const StepConstants<Constant>& constants,
                                                 const ReducedForm<Constant, Scalar>& reduced) {
  const Gram<Scalar>& w = reduced.schur;
  const Gram<Constant>& q = form.size;
  const Constant& k = constants.rate_squared;
  const auto& c = reduced.centre;
  const Scalar none(0.0);
  return {{{w.g11, none, none, none, none, none},
           {w.g12, w.g22, none, none, none, none},
           {w.g13, w.g23, w.g33, none, none, none},
           {none, Scalar(metric.coupling), Scalar(metric.frequency), Scalar(k * q.g33), none, none},
           {c[1][0], c[1][1], c[1][2], Scalar(k * q.g23), k * q.g22 - reduced.offset22, none},
           {c[0][0], c[0][1], c[0][2], Scalar(k * q.g13), k * q.g12 - reduced.offset12,
            k * q.g11 - reduced.offset11}}};
}

template <typename Scalar>
void add_angle(rigor::LowerTriangle<6, Scalar>& a, const Scalar& multiplier, const Scalar& tangent_squared) {
  a[kAlongRow][kAlongRow] -= multiplier * tangent_squared;
  a[kAcrossRow][kAcrossRow] += multiplier;
}

}  // namespace detail

/// The contraction on one ray, proposed in double: the smallest rate for which the inequality is certified on
/// the axis (y = 0) by some multiplier, and that multiplier lambda.
struct RayRate {
  double rate_squared;
  double multiplier;
};

/// Proposal only; the rate in `constants` is not read. A rate of infinity when no multiplier works. The
/// search ends at a rate squared of at most `enough`.
[[nodiscard]] RayRate propose_rate(const PolarStepForm<double, double>& form,
                                   const BlockMetric<double>& metric, const StepConstants<double>& constants,
                                   double enough = -std::numeric_limits<double>::infinity());

/// The rate squared that this one multiplier certifies there, infinity when none: never below the smallest.
[[nodiscard]] double rate_squared_with(const PolarStepForm<double, double>& form,
                                       const BlockMetric<double>& metric,
                                       const StepConstants<double>& constants, double multiplier);

/// The multiplier tau for the angle that leaves most room beside the multiplier lambda; 0 when none does.
/// Proposal only.
[[nodiscard]] double propose_angle_multiplier(const PolarStepForm<double, double>& form,
                                              const BlockMetric<double>& metric,
                                              const StepConstants<double>& constants, double multiplier,
                                              double tangent_squared);

/// The matrix of the inequality over a cell is that in its middle plus, for each of s, beta, along and
/// across, an enclosure of the derivative times the way from the middle.
constexpr int kCellVariables = 4;
using Derivatives = rigor::Dual<rigor::Interval, kCellVariables>;
struct CellForms {
  PolarStepForm<double, double> proposal;                  ///< in the middle, by and large
  PolarStepForm<rigor::Interval, rigor::Interval> middle;  ///< there, enclosed
  PolarStepForm<rigor::Interval, Derivatives> over;        ///< over the cell
  std::array<double, kCellVariables> half_widths;          ///< upper bounds
  double
      tangent_squared;  ///< of the largest angle to the axis, an upper bound; infinite when it is not acute
};

/// The result of examining a cell.
struct CellVerdict {
  bool holds = false;  ///< true only when the inequality is true everywhere in the cell
  /// The contribution of each variable to the spread of the matrix, to choose where to bisect.
  std::array<double, kCellVariables> influence{};
};

/// Needs the upward mode.
[[nodiscard]] CellVerdict check_cell(const CellForms& forms, const BlockMetric<rigor::Interval>& metric,
                                     const StepConstants<rigor::Interval>& constants,
                                     const BlockMetric<double>& proposed_metric,
                                     const StepConstants<double>& proposed_constants, double multiplier);

}  // namespace veritrack::quadrature
