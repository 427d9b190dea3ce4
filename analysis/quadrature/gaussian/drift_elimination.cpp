#include "analysis/quadrature/gaussian/drift_elimination.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/mean_value_definiteness.hpp"
#include "analysis/search/golden_section.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// The rest of l after elimination with the determinant of the other rows as that of the noise; and the
/// quality that the choice of a multiplier is to make large. Where a pivot is too small, less and less, so
/// that a search finds its way out.
struct Elimination {
  double rest, quality;
};
Elimination eliminated(DriftForm<double> form) {
  constexpr double kLeastPivot = 1e-3;
  const auto logarithm = [](double x) {
    return x > kLeastPivot ? std::log(x) : std::log(kLeastPivot) + x / kLeastPivot - 1.0;
  };
  double log_determinant = 0.0;
  for (std::size_t k = 0; k < kLeft; ++k) {
    double& pivot = form[k][k];
    log_determinant += logarithm(pivot);
    pivot = std::max(kLeastPivot, pivot);
    for (std::size_t i = k + 1; i < form.size(); ++i) {
      const double factor = form[i][k] / pivot;
      for (std::size_t j = k + 1; j <= i; ++j) {
        form[i][j] -= factor * form[j][k];
      }
    }
  }
  const double rest = form[kLeft][kLeft] + log_determinant;
  return {rest, log_determinant + logarithm(rest)};
}

/// The rows but the last.
template <typename Scalar>
rigor::LowerTriangle<5, Scalar> without_last(const DriftForm<Scalar>& form) {
  rigor::LowerTriangle<5, Scalar> rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(form[i].begin(), rows.size(), rows[i].begin());
  }
  return rows;
}

}  // namespace

MultiplierChoice choose_multiplier(const LockSetting<double>& next, const LevelImages<double>& images,
                                   double left) {
  const SymmetricMatrix<double>& delta = images.half_spread;
  const SymmetricMatrix<double> spread = transformed(next.metric, delta);
  const auto at = [&](double log_multiplier) {
    return eliminated(drift_form(next, images, left, std::exp(log_multiplier)));
  };
  const double least = spread[0][0] + spread[1][1] + spread[2][2];
  const double most = next.design.r * next.design.r / (next.noise_variance * (delta[0][0] + delta[1][1]));
  constexpr int kSteps = 12;
  const double low = std::log(std::max(least, 1e-12)) - 0.7;
  const double high = std::max(low + 1.0, std::min(std::log(most) + 0.7, low + 12.0));
  const search::GoldenPoint best =
      search::golden_section(low, high, kSteps, [&](double x) { return -at(x).quality; });
  return {std::exp(best.point), at(best.point).rest};
}

bool certainly_left_over(const LockSettings& next, const CellStep& step, const CellLeft& left,
                         std::array<double, 3>& influence) {
  const Interval& r = next.enclosed.design.r;
  const Interval in_the_middle = Interval(0.5) * (left.at[0] + left.at[1]);
  const Interval multiplier(choose_multiplier(next.rough, images_at(step.roughly, 0.0, next.rough.design.r),
                                              midpoint(in_the_middle))
                                .multiplier);
  // The rows but the last bound the determinant of the noise for all covariances: docs/gaussian.md.
  std::array<DriftForm<Interval>, 2> at;
  std::array<DriftForm<CellDerivatives>, 2> over;
  Interval determinant(1.0);
  for (std::size_t end = 0; end < 2; ++end) {
    const Interval& away = step.ends[end];
    at[end] = drift_form(next.enclosed, images_at(step.at, away, r), left.at[end], multiplier);
    over[end] = drift_form(next.enclosed, images_at(step.over, away, r), left.over[end], multiplier);
    determinant = min(determinant, rigor::least_determinant_over<5, 3>(
                                       without_last(at[end]), without_last(over[end]), step.half_widths));
  }
  const Interval noise = -rigor::log(determinant);
  bool holds = certainly_positive(multiplier) && is_finite(noise);
  const Interval& reach = next.enclosed.leak_reach;
  const bool one_frequency = reach == Interval(0.0);
  for (std::size_t end = 0; end < 2 && holds; ++end) {
    at[end][kLeft][kLeft] -= Interval(noise.upper());
    over[end][kLeft][kLeft] -= Interval(noise.upper());
    // The matrix is affine in the frequency, so that the ends of its range decide.
    for (const Interval& way : {reach, -reach}) {
      const std::array<Interval, 3> moved =
          image(next.enclosed.metric, Interval(0.0), Interval(0.0), one_frequency ? Interval(0.0) : way);
      auto at_frequency = at[end];
      auto over_frequency = over[end];
      for (std::size_t i = 0; i < 3; ++i) {
        at_frequency[kLeft][kError + i] += moved[i];
        over_frequency[kLeft][kError + i] = over_frequency[kLeft][kError + i] + moved[i];
      }
      holds = holds &&
              rigor::certainly_definite_over<6, 3>(at_frequency, over_frequency, step.half_widths, influence);
      if (one_frequency) {
        break;
      }
    }
  }
  return holds;
}

}  // namespace veritrack::quadrature
