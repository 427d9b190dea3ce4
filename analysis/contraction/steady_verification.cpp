#include "analysis/contraction/steady_verification.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/contraction/small_definiteness.hpp"
#include "analysis/contraction/steady_rate.hpp"
#include "analysis/contraction/steady_setting.hpp"
#include "analysis/rigor/decimal.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Interval;
using rigor::Verdict;
using Tube = FixedPointTube<QuadraturePolarLoop::kStates>;
using Design = trackers::QuadratureEkfDesign<Interval>;

Symmetric<Interval> symmetric(const rigor::Matrix<3>& p) {
  return {Interval(p(0, 0)), Interval(p(0, 1)), Interval(p(0, 2)),
          Interval(p(1, 1)), Interval(p(1, 2)), Interval(p(2, 2))};
}

bool is_symmetric(const rigor::Matrix<3>& p) {
  return p(0, 1) == p(1, 0) && p(0, 2) == p(2, 0) && p(1, 2) == p(2, 1) && rigor::is_finite(p);
}

bool certainly_not_negative(const Interval& x) {
  return certainly_less_equal(Interval(0.0), x);
}

/// The first hypothesis on the proposal that does not hold, as a sentence; empty when all hold.
std::string objection(const Design& design, const SteadySet& set) {
  const auto& t = set.metric;
  if (!certainly_positive(design.r) || !certainly_not_negative(design.q1) ||
      !certainly_not_negative(design.q2) || !certainly_not_negative(design.epsilon) ||
      !certainly_less(design.epsilon, Interval(1.0))) {
    return "the design is not one with q1 >= 0, q2 >= 0, r > 0 and 0 <= epsilon < 1.";
  }
  if (!rigor::is_finite(t) || t(1, 0) != 0.0 || t(2, 0) != 0.0 || t(2, 1) != 0.0 ||
      !certainly_positive(Interval(t(0, 0))) || !certainly_positive(Interval(t(1, 1))) ||
      !certainly_positive(Interval(t(2, 2)))) {
    return "the metric does not have the form that the proof needs.";
  }
  if (!certainly_not_negative(Interval(set.noise)) || !certainly_not_negative(Interval(set.slew))) {
    return "noise or slew are no bounds.";
  }
  if (!is_symmetric(set.below) || !is_symmetric(set.above) ||
      !certainly_positive_definite(symmetric(set.below)) ||
      !certainly_positive_definite(symmetric(set.above))) {
    return "the covariance bounds are not certainly positive definite.";
  }
  double end = 1.0;
  for (const LevelRange& range : set.levels) {
    const bool adjoins = range.high == end && range.low > 0.0 && range.low <= range.high &&
                         range.rate >= 0.0 && range.rate <= 1.0;
    if (!adjoins) {
      return "the levels are not a chain of ranges from 1 down.";
    }
    end = range.low;
  }
  return set.levels.empty() ? "there are no levels." : std::string();
}

TriangularMetric<Interval> metric_of(const SteadySet& set) {
  const auto& t = set.metric;
  return {Interval(t(0, 0)), Interval(t(0, 1)), Interval(t(0, 2)),
          Interval(t(1, 1)), Interval(t(1, 2)), Interval(t(2, 2))};
}

/// Sets a11, a21, a22 such that A A' - M M' > 0 for the rows M = ((1,0,0), (0,1,1)) T^-1 of alpha and c:
/// then every M u with |u| <= 1 is an A w with |w| <= 1. False when that is not certain.
bool cover_directions(SteadySetting<Interval>& setting) {
  const auto& t = setting.metric;
  const Interval one(1.0);
  const Interval alpha1 = one / t.t11;
  const Interval alpha2 = -(t.t12 / (t.t11 * t.t22));
  const Interval alpha3 = (t.t12 * t.t23 - t.t13 * t.t22) / (t.t11 * t.t22 * t.t33);
  const Interval c2 = one / t.t22;
  const Interval c3 = (one - t.t23 / t.t22) / t.t33;
  const Interval m11 = square(alpha1) + square(alpha2) + square(alpha3);
  const Interval m12 = alpha2 * c2 + alpha3 * c3;
  const Interval m22 = square(c2) + square(c3);
  constexpr double kMargin = 1.0 + 1e-9;
  const double a11 = kMargin * std::sqrt(midpoint(m11));
  const double a21 = kMargin * midpoint(m12) / std::sqrt(midpoint(m11));
  const double a22 =
      kMargin * std::sqrt(std::max(0.0, midpoint(m22) - midpoint(m12) * midpoint(m12) / midpoint(m11)));
  setting.a11 = Interval(a11);
  setting.a21 = Interval(a21);
  setting.a22 = Interval(a22);
  LowerTriangle<2> gap;
  gap[0][0] = square(setting.a11) - m11;
  gap[1][0] = setting.a11 * setting.a21 - m12;
  gap[1][1] = square(setting.a21) + square(setting.a22) - m22;
  return contraction::certainly_positive_definite<2>(gap) && a11 > 0.0;
}

/// How far a slew of W moves a state in units of the level: the errors and the covariance.
struct Motion {
  Interval errors = Interval(0.0);
  Interval covariance = Interval(0.0);
};

/// The share l of `bound` with l bound - x > 0 and l bound + x > 0; nothing when none is found.
std::optional<Interval> covering_share(const Symmetric<Interval>& bound, const Symmetric<Interval>& x) {
  double share = 1e-6;
  constexpr int kDoublings = 60;
  const auto covers = [&](double l) {
    const Interval factor(l);
    const Symmetric<Interval> scaled{factor * bound.p11, factor * bound.p12, factor * bound.p13,
                                     factor * bound.p22, factor * bound.p23, factor * bound.p33};
    return certainly_positive_definite(plus(scaled, x, Interval(-1.0))) &&
           certainly_positive_definite(plus(scaled, x, Interval(1.0)));
  };
  int doublings = 0;
  while (!covers(share)) {
    share *= 1.5;
    if (++doublings > kDoublings) {
      return std::nullopt;
    }
  }
  return Interval(share);
}

/// Uniform over the branch, since a step may lead from one cell to another.
std::optional<Motion> motion_of(const Design& design, const std::vector<Tube>& branch, const SteadySet& set) {
  Motion motion;
  if (set.slew == 0.0) {
    return motion;
  }
  const QuadraturePolarLoop loop{design};
  const Interval slew(set.slew);
  for (const Tube& tube : branch) {
    const auto slope = enclose_slope(loop, tube);
    if (!slope) {
      return std::nullopt;
    }
    // nu = x3 - omega, and x3 is not moved by a change of omega itself.
    rigor::IntervalVector<3> error = slope->head<3>();
    error[2] += Interval(1.0);
    const Symmetric<Interval> covariance{(*slope)[3], (*slope)[4], (*slope)[5],
                                         (*slope)[6], (*slope)[7], (*slope)[8]};
    const auto above = covering_share(symmetric(set.above), covariance);
    const auto below = covering_share(symmetric(set.below), covariance);
    if (!above || !below) {
      return std::nullopt;
    }
    motion.errors = max(motion.errors, slew * Interval(metric_norm(set, error).upper()));
    motion.covariance = max(motion.covariance, slew * max(*above, *below));
  }
  return motion;
}

struct CellResult {
  bool proved = false;
  std::string reason;
  double noise_gain = 0.0;
  std::int64_t cells = 0;
};

/// X* = center + (p - p0) slope + tight: derivatives in the last variable.
SteadyState<SteadySlope> steady_slopes(const Tube& tube) {
  const rigor::IntervalVector<QuadraturePolarLoop::kStates> box = tube.box();
  const auto entry = [&](Eigen::Index i, const Interval& shift) {
    std::array<Interval, 5> derivatives;
    derivatives.fill(Interval(0.0));
    derivatives[4] = Interval(tube.slope[i]);
    return SteadySlope(box[i] + shift, derivatives);
  };
  const Interval none(0.0);
  return {entry(0, Interval(1.0)),
          entry(1, none),
          entry(2, none),
          {entry(3, none), entry(4, none), entry(5, none), entry(6, none), entry(7, none), entry(8, none)}};
}

CellResult verify_cell(const Design& design, const Tube& tube, const SteadySet& set, const Motion& motion) {
  const rigor::UpwardRounding upward;
  CellResult result;
  SteadySettings settings;
  SteadySetting<Interval>& setting = settings.over_cell;
  setting.design = design;
  setting.steady = steady_state(tube, tube.parameter);
  setting.metric = metric_of(set);
  setting.band = {symmetric(set.below), symmetric(set.above)};
  fill_turns(setting);
  const Symmetric<Interval> least = plus(setting.steady.covariance, setting.band.below, Interval(-1.0));
  if (!certainly_positive_definite(least) || !certainly_positive_definite(setting.steady.covariance)) {
    result.reason = "the lower covariance bound is not certainly positive definite.";
    return result;
  }
  if (!cover_directions(setting)) {
    result.reason = "the directions of the set could not be covered.";
    return result;
  }
  settings.frequencies = tube.parameter - Interval(tube.parameter_center);
  settings.at_middle = setting;
  settings.at_middle.steady = steady_state(tube, Interval(tube.parameter_center));
  fill_turns(settings.at_middle);
  settings.slopes = convert<SteadySlope>(setting);
  settings.slopes.steady = steady_slopes(tube);
  fill_turns(settings.slopes);
  for (const LevelRange& range : set.levels) {
    const SteadyContraction contraction =
        prove_contraction(settings, range, {Interval(set.noise), motion.errors, motion.covariance});
    result.cells += contraction.cells;
    result.noise_gain = std::max(result.noise_gain, contraction.noise_gain);
    if (!contraction.proved) {
      result.reason = contraction.reason;
      return result;
    }
  }
  result.proved = true;
  return result;
}

}  // namespace

SteadyState<Interval> steady_state(const Tube& cell, const Interval& part) {
  const rigor::IntervalVector<QuadraturePolarLoop::kStates> x = cell.at(part);
  return {Interval(1.0) + x[0], x[1], x[2], {x[3], x[4], x[5], x[6], x[7], x[8]}};
}

SteadyVerification verify_steady_set(const Design& design, const std::vector<Tube>& branch,
                                     const SteadySet& proposal) {
  const rigor::UpwardRounding upward;
  SteadyVerification result;
  result.set = proposal;
  result.reason = objection(design, proposal);
  if (!result.reason.empty()) {
    return result;
  }
  const auto motion = motion_of(design, branch, proposal);
  if (branch.empty() || !motion) {
    result.reason = "how the steady state moves with the frequency could not be enclosed.";
    return result;
  }
  // In blocks, so that a failure is found early, and the same one whatever the number of threads.
  constexpr std::size_t kBlock = 8;
  std::vector<CellResult> results(branch.size());
  for (std::size_t begin = 0; begin < branch.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, branch.size());
    tbb::parallel_for(begin, end,
                      [&](std::size_t i) { results[i] = verify_cell(design, branch[i], proposal, *motion); });
    for (std::size_t i = begin; i < end; ++i) {
      result.cells += results[i].cells;
      result.noise_gain = std::max(result.noise_gain, results[i].noise_gain);
      if (!results[i].proved) {
        result.failed_frequency = branch[i].parameter;
        result.reason = "for frequencies near " +
                        rigor::to_decimal(midpoint(branch[i].parameter), 4, rigor::Direction::down) +
                        " rad/sample: " + results[i].reason;
        return result;
      }
    }
  }
  result.verdict = Verdict::proved;
  result.reason = "every step from the set leads back into it and contracts.";
  return result;
}

}  // namespace veritrack::contraction
