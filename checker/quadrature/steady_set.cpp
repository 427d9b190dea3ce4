#include "checker/quadrature/steady_set.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "checker/document/evidence.hpp"
#include "checker/numbers/threads.hpp"
#include "checker/quadrature/rounded_step.hpp"
#include "checker/quadrature/steady_level.hpp"

namespace veritrack::checker {

namespace {

/// A share l, no more than a twentieth above the least, with l bound - x > 0 and l bound + x > 0; everything
/// when none is found.
Ball covering_share(const Symmetric<Ball>& bound, const Symmetric<Ball>& x) {
  Ball share(1e-6);
  for (int i = 0; i < 400; ++i, share = Ball(1.05) * share) {
    if (definite(matrix_of(scaled(share, bound) + x)) &&
        definite(matrix_of(scaled(share, bound) + scaled(Ball(-1.0), x)))) {
      return share;
    }
  }
  return Ball::everything();
}

Symmetric<Ball> entries_of(const Matrix3& p) {
  return {p[0][0], p[0][1], p[0][2], p[1][1], p[1][2], p[2][2]};
}

/// The set as the evidence gives it, and whether its matrices have their form.
std::pair<SteadySet, bool> read_set(const Tree& evidence, const Design& design) {
  const Tree& numbers = evidence.at("numbers");
  const Tree& matrices = evidence.at("matrices");
  const Matrix3 metric = exact_matrix(matrices.at("metric"));
  const Matrix3 below = exact_matrix(matrices.at("covariance_below"));
  const Matrix3 above = exact_matrix(matrices.at("covariance_above"));
  SteadySet set;
  set.name = evidence.at("name").text();
  SteadySetting& s = set.setting;
  s.q1 = design.q1;
  s.q2 = design.q2;
  s.r = design.r;
  s.retention = one - design.epsilon;
  s.metric = {metric[0][0], metric[0][1], metric[0][2], metric[1][1], metric[1][2], metric[2][2]};
  s.below = entries_of(below);
  s.above = entries_of(above);
  set.noise = exact_number(numbers.at("noise"));
  set.slew = exact_number(numbers.at("slew"));
  while (const Tree* level = numbers.find("s_" + std::to_string(set.levels.size()))) {
    set.levels.push_back(exact_number(*level));
  }
  const bool has_form = certainly_equal(metric[1][0], zero) && certainly_equal(metric[2][0], zero) &&
                        certainly_equal(metric[2][1], zero) && symmetric(below) && symmetric(above) &&
                        certainly_positive(s.metric.t11) && certainly_positive(s.metric.t22) &&
                        certainly_positive(s.metric.t33);
  return {set, has_form};
}

/// 1 = s_0 > s_1 > ... > 0.
bool fall_from_one(const std::vector<Ball>& levels) {
  bool fall = !levels.empty() && certainly_equal(levels.front(), one);
  for (std::size_t j = 0; j < levels.size(); ++j) {
    // cannot bind (levels[j]): no step leads to a level that is not positive, and the first one is 1.
    fall = fall && certainly_positive(levels[j]) && (j == 0 || certainly_less(levels[j], levels[j - 1]));
  }
  return fall;
}

/// P* - below > 0 at all frequencies: every P of the set is positive definite.
bool stays_definite(const SteadySetting& s, const std::vector<SteadyCell>& branch) {
  return std::all_of(branch.begin(), branch.end(), [&](const SteadyCell& cell) {
    const Symmetric<Ball> least = covariance_part(cell.at(cell.frequency));
    return definite(matrix_of(least + scaled(Ball(-1.0), s.below)));
  });
}

/// The displacement of the steady state by the slew in a sample: in the metric, and as a share of the bounds.
struct Motion {
  Ball errors = zero, covariance = zero;
};
Motion motion_of(const SteadySet& set, const std::vector<SteadyCell>& branch) {
  const SteadySetting& s = set.setting;
  Motion motion;
  if (certainly_equal(set.slew, zero)) {
    return motion;
  }
  for (const SteadyCell& cell : branch) {
    // x3 - omega moves with the frequency, too.
    const StateVector& by = cell.derivative;
    const std::array<Ball, 3> push = s.metric.image<Ball>(by[0], by[1], by[2] + one);
    const Symmetric<Ball> slope = covariance_part(by);
    const Ball length = root_of_non_negative(square(push[0]) + square(push[1]) + square(push[2])).upper();
    motion.errors = max(motion.errors, set.slew * length);
    motion.covariance = max(motion.covariance,
                            set.slew * max(covering_share(s.above, slope), covering_share(s.below, slope)));
  }
  return motion;
}

/// The contribution of rounding to a step from anywhere in the set.
Motion rounding_of(const SteadySet& set, const std::vector<SteadyCell>& branch, const Design& design) {
  const SteadySetting& s = set.setting;
  const auto inverse = s.metric.inverse();
  const auto reach = [&](std::size_t i) {
    return sqrt(square(inverse[i][0]) + square(inverse[i][1]) + square(inverse[i][2]));
  };
  Rounding worst{zero, zero, zero, zero, zero};
  Ball least_z = one;
  Ball most_zz = zero;
  Ball most_33 = zero;
  for (const SteadyCell& cell : branch) {
    const StateVector x = cell.at(cell.frequency);
    const Symmetric<Ball> steady = covariance_part(x);
    const Matrix3 lower = matrix_of(steady + scaled(Ball(-1.0), s.below));
    const Matrix3 upper = matrix_of(steady + s.above);
    Held held;
    held.z = (one + x[0] + reach(0)).upper();
    held.frequency = (max(design.largest_frequency, pi()) + abs(x[2]) + reach(2)).upper();
    held.measurement = one + set.noise;
    add_covariance(lower, upper, held);
    const Rounding here = rounded_step({s.q1, s.q2, s.r, design.epsilon, design.amplitude}, held);
    worst = {max(worst.z, here.z), max(worst.frequency, here.frequency), max(worst.p_zz, here.p_zz),
             max(worst.p_z3, here.p_z3), max(worst.p_33, here.p_33)};
    least_z = min(least_z, one + x[0] - reach(0)).lower();
    most_zz = max(most_zz, upper[0][0] + upper[1][1]).upper();
    most_33 = max(most_33, upper[2][2]).upper();
  }
  const PolarRounding polar = polar_rounding(worst, least_z, most_zz, most_33);
  // |T e| over a box: every sign of its entries.
  Ball largest = zero;
  for (const double sign_of_phase : {-1.0, 1.0}) {
    for (const double sign_of_frequency : {-1.0, 1.0}) {
      const std::array<Ball, 3> image = s.metric.image<Ball>(
          polar.amplitude, Ball(sign_of_phase) * polar.phase, Ball(sign_of_frequency) * polar.frequency);
      largest = max(largest, sqrt(square(image[0]) + square(image[1]) + square(image[2])));
    }
  }
  return {largest.upper(),
          max(rounding_share(matrix_of(s.below), polar), rounding_share(matrix_of(s.above), polar))};
}

/// The parts of the set's promise that are not proved; empty when all are.
std::string refusal_of(SteadySet& set, const std::vector<SteadyCell>& branch, const Design& design,
                       std::int64_t& cells) {
  SteadySetting& s = set.setting;
  if (!fall_from_one(set.levels) || !certainly_not_negative(set.noise) || !certainly_not_negative(set.slew)) {
    return "levels, noise or slew are out of range";
  }
  s.set_directions();
  if (!definite(matrix_of(s.below)) || !definite(matrix_of(s.above)) || !certainly_positive(s.a11)) {
    return "the covariance bounds are not positive definite, or the metric has no inverse";
  }
  if (!stays_definite(s, branch)) {
    return "P* - below is not proved positive definite";
  }
  Motion motion = motion_of(set, branch);
  const Motion rounding = rounding_of(set, branch, design);
  if (!rounding.errors.finite() || !rounding.covariance.finite()) {
    return "the rounding of a step in double precision is not bounded";
  }
  motion.errors += rounding.errors;
  motion.covariance += rounding.covariance;
  const std::size_t steps = std::max<std::size_t>(set.levels.size(), 2) - 1;
  std::atomic<std::int64_t> looked_at = 0;
  const auto level_at = [&](std::size_t j) {
    const Ball& level = set.levels[j];
    const Ball& next = set.levels[std::min(j + 1, set.levels.size() - 1)];
    return SteadyLevel{level, ((next - motion.errors) / level).lower(),
                       ((next - motion.covariance) / level).lower(), set.noise};
  };
  // Other frequencies need much the same cells as those in the middle do.
  constexpr std::size_t kSeveral = 3;
  DiscDivision division;
  if (branch.size() >= kSeveral) {
    SteadyCover middle(s, branch[branch.size() / 2]);
    static_cast<void>(middle.maps_into_next(level_at(0)));
    division = middle.division();
    looked_at += middle.cells();
  }
  const std::size_t failed = first_failure(branch.size(), [&](std::size_t k) {
    SteadyCover cover(s, branch[k], division);
    bool maps = true;
    for (std::size_t j = 0; j < steps && maps; ++j) {
      maps = cover.maps_into_next(level_at(j));
    }
    looked_at += cover.cells();
    return maps;
  });
  cells += looked_at;
  return failed == branch.size() ? std::string()
                                 : "a step is not certain to end in the next level, for frequencies near " +
                                       branch[failed].centre.text(4);
}

}  // namespace

SteadySet check_steady_set(const Tree& evidence, const Design& design, const std::vector<SteadyCell>& branch,
                           std::int64_t& cells, Objections& objections) {
  auto [set, has_form] = read_set(evidence, design);
  const std::string refusal =
      has_form ? refusal_of(set, branch, design, cells) : "the matrices do not have the required form";
  set.verified = refusal.empty();
  if (!set.verified) {
    objections.push_back("the set " + set.name + ": " + refusal);
  }
  return set;
}

}  // namespace veritrack::checker
