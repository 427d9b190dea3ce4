#include "analysis/quadrature/contraction/step_inequality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/rigor/mean_value_definiteness.hpp"
#include "analysis/search/golden_section.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The smallest k with k q >= offset + P' W^-1 P on the axis, in (x, nu), W the Schur block; infinity when W
/// is not definite.
double rate_squared_with(const PolarStepForm<double, double>& f, const BlockMetric<double>& metric,
                         const ReducedForm<double, double>& reduced) {
  const Gram<double>& w = reduced.schur;
  // Cholesky of W, and X = L^-1 P.
  if (!(w.g11 > 0.0)) {
    return kInfinity;
  }
  const double l11 = std::sqrt(w.g11);
  const double l21 = w.g12 / l11;
  const double l31 = w.g13 / l11;
  const double w22 = w.g22 - l21 * l21;
  if (!(w22 > 0.0)) {
    return kInfinity;
  }
  const double l22 = std::sqrt(w22);
  const double l32 = (w.g23 - l31 * l21) / l22;
  const double w33 = w.g33 - l31 * l31 - l32 * l32;
  if (!(w33 > 0.0)) {
    return kInfinity;
  }
  const double l33 = std::sqrt(w33);
  const std::array<double, 3>& c = reduced.centre[0];
  const double x1 = c[0] / l11;
  const double x2 = (c[1] - l21 * x1) / l22;
  const double x3 = (c[2] - l31 * x1 - l32 * x2) / l33;
  const double y2 = metric.coupling / l22;
  const double y3 = (metric.frequency - l32 * y2) / l33;
  const double n11 = x1 * x1 + x2 * x2 + x3 * x3 + reduced.offset11;
  const double n12 = x2 * y2 + x3 * y3;
  const double n22 = y2 * y2 + y3 * y3;
  // The larger root k of det(n - k q) = 0.
  const Gram<double>& q = f.size;
  const double leading = q.g11 * q.g33 - q.g13 * q.g13;
  const double half = 0.5 * (n11 * q.g33 + n22 * q.g11) - n12 * q.g13;
  const double last = n11 * n22 - n12 * n12;
  if (!(leading > 0.0)) {
    return kInfinity;
  }
  return (half + std::sqrt(std::max(0.0, half * half - leading * last))) / leading;
}

/// The multipliers worth a look, as logarithms: above the norm of Gamma, and so small that noise of that gain
/// could be tolerated at all.
struct Range {
  double low, high;
};
Range range_of_multipliers(const PolarStepForm<double, double>& form,
                           const StepConstants<double>& constants) {
  const double trace = std::log(form.gram.g11 + form.gram.g22 + form.gram.g33);
  Range range{trace - 0.7, trace + 5.0};
  if (constants.noisy) {
    for (std::size_t j = 0; j < 2; ++j) {
      const auto& c = form.gain[j];
      const double room = constants.noise_gain_squared - (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
      if (form.spread[j] > 0.0) {
        range.high = std::min(range.high, std::log(room / form.spread[j]));
      }
    }
  }
  return range;
}

}  // namespace

double rate_squared_with(const PolarStepForm<double, double>& form, const BlockMetric<double>& metric,
                         const StepConstants<double>& constants, double multiplier) {
  return rate_squared_with(form, metric, reduced_form(form, metric, constants, multiplier));
}

RayRate propose_rate(const PolarStepForm<double, double>& form, const BlockMetric<double>& metric,
                     const StepConstants<double>& constants, double enough) {
  const auto bound = [&](double log_lambda) {
    return rate_squared_with(form, metric, constants, std::exp(log_lambda));
  };
  const auto [low, high] = range_of_multipliers(form, constants);
  if (!(low < high)) {
    return {kInfinity, 0.0};
  }
  constexpr int kSteps = 12;
  const search::GoldenPoint best = search::golden_section(low, high, kSteps, bound, enough);
  return {best.cost, std::exp(best.point)};
}

double propose_angle_multiplier(const PolarStepForm<double, double>& form, const BlockMetric<double>& metric,
                                const StepConstants<double>& constants, double multiplier,
                                double tangent_squared) {
  using detail::kAcrossRow;
  using detail::kAlongRow;
  rigor::LowerTriangle<6, double> a =
      detail::remaining_matrix(form, metric, constants, reduced_form(form, metric, constants, multiplier));
  if (!std::isfinite(tangent_squared) || !rigor::eliminate(a, kAcrossRow)) {
    return 0.0;
  }
  // The rest is a form in (y, x): (s_xx - tau t^2)(s_yy + tau) is largest half way between its roots.
  const double middle = 0.5 * (a[kAlongRow][kAlongRow] / tangent_squared - a[kAcrossRow][kAcrossRow]);
  return middle > 0.0 ? middle : 0.0;
}

CellVerdict check_cell(const CellForms& forms, const BlockMetric<Interval>& metric,
                       const StepConstants<Interval>& constants, const BlockMetric<double>& proposed_metric,
                       const StepConstants<double>& proposed_constants, double multiplier) {
  CellVerdict verdict;
  const Interval lambda(multiplier);
  if (!certainly_positive(lambda)) {
    return verdict;
  }
  const double tau = propose_angle_multiplier(forms.proposal, proposed_metric, proposed_constants, multiplier,
                                              forms.tangent_squared);
  const ReducedForm<Interval, Interval> middle = reduced_form(forms.middle, metric, constants, lambda);
  const ReducedForm<Interval, Derivatives> over = reduced_form(forms.over, metric, constants, lambda);
  if (!certainly_positive(over.noise_pivots[0]) || !certainly_positive(over.noise_pivots[1])) {
    return verdict;
  }
  rigor::LowerTriangle<6> at_middle = detail::remaining_matrix(forms.middle, metric, constants, middle);
  if (tau > 0.0) {
    detail::add_angle(at_middle, Interval(tau), Interval(forms.tangent_squared));
  }
  verdict.holds = rigor::certainly_definite_over<6, kCellVariables>(
      at_middle, detail::remaining_matrix(forms.over, metric, constants, over), forms.half_widths,
      verdict.influence);
  return verdict;
}

}  // namespace veritrack::quadrature
