#include "analysis/quadrature/contraction/turn_bounds.hpp"

#include <algorithm>

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

constexpr int kAmplitudes = 64;
constexpr int kPhases = 24;

/// The largest |chi| of the ellipse where the amplitude error is in `a`.
Interval largest_chi(const StepSetting<Interval>& setting, const Interval& a) {
  const Interval share = rigor::abs(a) / setting.largest_amplitude;
  const Interval rest = Interval(1.0) - rigor::square(Interval(share.lower()));
  return setting.largest_chi * rigor::sqrt(rigor::max(rest, Interval(0.0)));
}

}  // namespace

std::vector<TurnBound> bound_turns(const StepSetting<Interval>& setting) {
  rigor::require_upward_rounding();
  const Interval one(1.0);
  const auto node = [](int i, int count, const Interval& low, const Interval& high) {
    return low + Interval(static_cast<double>(i) / count) * (high - low);
  };
  std::vector<TurnBound> turns;
  turns.reserve(kAmplitudes);
  for (int i = 0; i < kAmplitudes; ++i) {
    // The nodes are exact as fractions: neighbours share them, and the last is A itself.
    const Interval a =
        rigor::hull(node(i, kAmplitudes, -setting.largest_amplitude, setting.largest_amplitude),
                    node(i + 1, kAmplitudes, -setting.largest_amplitude, setting.largest_amplitude));
    const Interval chi_end = largest_chi(setting, a);
    double tangent = 0.0;
    for (int j = 0; j < kPhases; ++j) {
      const Interval chi =
          rigor::hull(node(j, kPhases, Interval(0.0), chi_end), node(j + 1, kPhases, Interval(0.0), chi_end));
      const Correction<Interval, Interval> correction = correction_at<Interval, Interval>(setting, a, chi);
      if (!certainly_positive(correction.least_along) || !is_finite(correction.turn_tangent)) {
        return {};
      }
      tangent = std::max(tangent, correction.turn_tangent.upper());
    }
    turns.push_back({one + a, tangent});
  }
  return turns;
}

}  // namespace veritrack::quadrature
