#include "analysis/quadrature/leak/steady_order.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quadrature/leak/steady_rate.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

constexpr std::array<double, 2> kEnds{-1.0, 1.0};

/// share * a - b.
Symmetric<Interval> difference(const Interval& share, const Symmetric<Interval>& a,
                               const Symmetric<Interval>& b) {
  return {share * a.p11 - b.p11, share * a.p12 - b.p12, share * a.p13 - b.p13,
          share * a.p22 - b.p22, share * a.p23 - b.p23, share * a.p33 - b.p33};
}

bool is_within(const CovarianceBand<Interval>& band, const CovarianceStep<Interval>& image,
               const Interval& share) {
  return certainly_positive_definite(plus(image.low, band.below, share)) &&
         certainly_positive_definite(difference(share, band.above, image.high));
}

CovarianceStep<Interval> moved_by(const CovarianceStep<SteadySecant>& step, const SteadyOffset& offset) {
  return {quadrature::moved_by(step.low, offset), quadrature::moved_by(step.high, offset)};
}

/// The width of the slopes in one variable, relative to the band.
double blur_of(const Symmetric<SteadySecant>& image, const Symmetric<Interval>& band, std::size_t variable) {
  const double d1 = std::sqrt(band.p11.upper());
  const double d2 = std::sqrt(band.p22.upper());
  const double d3 = std::sqrt(band.p33.upper());
  const auto share = [variable](const SteadySecant& entry, double scale) {
    return width(entry.slope(variable)) / scale;
  };
  return share(image.p11, d1 * d1) + share(image.p12, d1 * d2) + share(image.p13, d1 * d3) +
         share(image.p22, d2 * d2) + share(image.p23, d2 * d3) + share(image.p33, d3 * d3);
}

/// Into how many parts turns of up to so many rad are cut, an odd number: slopes are known better for a part.
int parts_of(double reach) {
  constexpr double kLittle = 0.02;
  constexpr double kMuch = 0.1;
  return reach < kLittle ? 1 : reach < kMuch ? 3 : 5;
}

}  // namespace

SteadyOrder keeps_covariance(const SteadySettings& settings, const std::vector<SteadyOffset>& corners,
                             const SteadyOffset& box, const SteadyStep<SteadySecant>& step, double level,
                             const Interval& tangent_reach, const Interval& share) {
  const CovarianceBand<Interval>& band = settings.over_cell.band;
  const SteadySecant levels{Interval(level)};
  const SteadySecant mean_tangent = turn_tangent(settings.secants, step, levels);
  const int parts = parts_of(level * tangent_reach.upper());
  const Interval part = Interval(tangent_reach.upper()) / Interval(double(parts));
  SteadyOffset middle;
  middle.fill(Interval(0.0));
  SteadyOrder result;
  result.kept = certainly_positive(share);
  // cannot bind (share): below zero it would ask for a lower bound above the upper one.
  result.hopeless = !result.kept;
  for (int k = 0; k < parts && !result.hopeless; ++k) {
    const SteadySecant tangents =
        mean_tangent + SteadySecant(part * Interval(double(2 * k + 1 - parts))) +
        SteadySecant(part) * SteadySecant::variable(rigor::symmetric(1.0), 0.0, kAcross);
    const CovarianceStep<SteadySecant> image = covariance_step(settings.secants, step, levels, tangents);
    bool known = true;
    for (const std::size_t variable : {kX, kY}) {
      const double blur =
          blur_of(image.low, band.below, variable) + blur_of(image.high, band.above, variable);
      known = known && std::isfinite(blur);
      result.blur[variable] = std::max(result.blur[variable], blur);
    }
    result.hopeless = 2 * k + 1 == parts && known && !is_within(band, moved_by(image, middle), share);
    // Positive definite matrices are a convex set: what is affine in the variables needs to be looked at in
    // the corners only, with whichever slopes there are.
    result.kept = result.kept && known && !result.hopeless &&
                  (is_within(band, moved_by(image, box), share) ||
                   std::all_of(corners.begin(), corners.end(), [&](SteadyOffset corner) {
                     return std::all_of(kEnds.begin(), kEnds.end(), [&](double across) {
                       corner[kAcross] = Interval(across);
                       return is_within(band, moved_by(image, corner), share);
                     });
                   }));
  }
  return result;
}

}  // namespace veritrack::quadrature
