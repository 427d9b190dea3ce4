#include "analysis/quadrature/leak/steady_motion.hpp"

#include "analysis/quadrature/leak/steady_rate.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// The share l of `bound` with l bound - x > 0 and l bound + x > 0; nothing when none is found.
std::optional<Interval> covering_share(const Symmetric<Interval>& bound, const Symmetric<Interval>& x) {
  double share = 1e-6;
  constexpr int kDoublings = 60;
  const auto is_enough = [&](double l) {
    const Interval factor(l);
    const Symmetric<Interval> scaled{factor * bound.p11, factor * bound.p12, factor * bound.p13,
                                     factor * bound.p22, factor * bound.p23, factor * bound.p33};
    return certainly_positive_definite(plus(scaled, x, Interval(-1.0))) &&
           certainly_positive_definite(plus(scaled, x, Interval(1.0)));
  };
  int doublings = 0;
  while (!is_enough(share)) {
    share *= 1.5;
    if (++doublings > kDoublings) {
      return std::nullopt;
    }
  }
  return Interval(share);
}

}  // namespace

std::optional<SteadyMotion> steady_motion(const trackers::ToneModel<Interval>& design,
                                          const std::vector<sets::BranchCell>& branch, const SteadySet& set) {
  SteadyMotion motion;
  if (set.slew == 0.0) {
    return motion;
  }
  const sets::QuadraturePolarLoop loop{design};
  const Interval slew(set.slew);
  for (const auto& tube : branch) {
    const auto slope = sets::enclose_slope(loop, tube);
    if (!slope) {
      return std::nullopt;
    }
    // nu = x3 - omega, and x3 is not moved by a change of omega itself.
    rigor::IntervalVector<3> error = slope->head<3>();
    error[2] += Interval(1.0);
    const Symmetric<Interval> covariance{(*slope)[3], (*slope)[4], (*slope)[5],
                                         (*slope)[6], (*slope)[7], (*slope)[8]};
    const auto above = covering_share(to_symmetric(set.above), covariance);
    const auto below = covering_share(to_symmetric(set.below), covariance);
    if (!above || !below) {
      return std::nullopt;
    }
    motion.errors = max(motion.errors, slew * Interval(metric_norm(set, error).upper()));
    motion.covariance = max(motion.covariance, slew * max(*above, *below));
  }
  return motion;
}

}  // namespace veritrack::quadrature
