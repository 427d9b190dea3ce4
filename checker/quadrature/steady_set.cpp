#include "checker/quadrature/steady_set.hpp"

#include <algorithm>

#include "checker/quadrature/steady_level.hpp"

namespace veritrack::checker {

namespace {

const Ball zero(0.0);
const Ball one(1.0);

/// Sets a11, a21, a22 such that A A' - M M' > 0 for the rows M = ((1,0,0), (0,1,1)) T^-1 of alpha and c: then
/// every M u with |u| <= 1 is an A w with |w| <= 1.
bool cover_directions(SteadySetting& setting) {
  const auto inverse = setting.metric.inverse();
  Ball m11(0.0);
  Ball m12(0.0);
  Ball m22(0.0);
  for (std::size_t j = 0; j < 3; ++j) {
    const Ball c = inverse[1][j] + inverse[2][j];
    m11 += square(inverse[0][j]);
    m12 += inverse[0][j] * c;
    m22 += square(c);
  }
  const Ball margin(1.0 + 0x1p-30);
  setting.a11 = (margin * sqrt(m11)).upper();
  setting.a21 = (m12 / setting.a11).upper();
  setting.a22 = (margin * sqrt(m22 - square(m12) / m11)).upper();
  const Ball a = square(setting.a11) - m11;
  const Ball b = setting.a11 * setting.a21 - m12;
  const Ball c = square(setting.a21) + square(setting.a22) - m22;
  return certainly_positive(a) && certainly_positive(a * c - square(b));
}

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

}  // namespace

SteadySet check_steady_set(const Tree& evidence, const Design& design, const std::vector<SteadyCell>& branch,
                           std::int64_t& cells, Objections& objections) {
  SteadySet set;
  set.name = evidence.at("name").text();
  const Tree& numbers = evidence.at("numbers");
  const Tree& matrices = evidence.at("matrices");
  const auto entry = [&](const char* name, std::size_t i, std::size_t j) {
    return from_hexadecimal(matrices.at(name).at(i).at(j).text());
  };
  bool form = true;
  const auto symmetric = [&](const char* name) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        form = form && certainly_equal(entry(name, i, j), entry(name, j, i));
      }
    }
    return Symmetric<Ball>{entry(name, 0, 0), entry(name, 0, 1), entry(name, 0, 2),
                           entry(name, 1, 1), entry(name, 1, 2), entry(name, 2, 2)};
  };
  SteadySetting& s = set.setting;
  s.q1 = design.q1;
  s.q2 = design.q2;
  s.r = design.r;
  s.retention = one - design.epsilon;
  s.metric = {entry("metric", 0, 0), entry("metric", 0, 1), entry("metric", 0, 2),
              entry("metric", 1, 1), entry("metric", 1, 2), entry("metric", 2, 2)};
  form = form && certainly_equal(entry("metric", 1, 0), zero) &&
         certainly_equal(entry("metric", 2, 0), zero) && certainly_equal(entry("metric", 2, 1), zero);
  s.below = symmetric("covariance_below");
  s.above = symmetric("covariance_above");
  set.noise = from_hexadecimal(numbers.at("noise").text());
  set.slew = from_hexadecimal(numbers.at("slew").text());
  bool falls = true;
  while (const Tree* level = numbers.find("s_" + std::to_string(set.levels.size()))) {
    const Ball value = from_hexadecimal(level->text());
    falls = falls && certainly_positive(value) &&
            (set.levels.empty() ? certainly_equal(value, one) : certainly_less(value, set.levels.back()));
    set.levels.push_back(value);
  }
  const auto refuse = [&](const std::string& why) {
    objections.push_back("the set " + set.name + ": " + why);
    return set;
  };
  if (!form || !certainly_positive(s.metric.t11) || !certainly_positive(s.metric.t22) ||
      !certainly_positive(s.metric.t33)) {
    return refuse("the matrices do not have their form");
  }
  if (set.levels.empty() || !falls || !certainly_at_most(zero, set.noise) ||
      !certainly_at_most(zero, set.slew)) {
    return refuse("levels, noise or slew are out of range");
  }
  if (!definite(matrix_of(s.below)) || !definite(matrix_of(s.above)) || !cover_directions(s)) {
    return refuse("the covariance bounds are not positive definite, or the metric has no inverse");
  }
  Ball motion(0.0);
  Ball covariance_motion(0.0);
  for (const SteadyCell& cell : branch) {
    const StateVector at = cell.at(cell.frequency);
    const StateVector& by = cell.derivative;
    Symmetric<Ball> least;
    std::copy(at.begin() + 3, at.end(), least.begin());
    if (!definite(matrix_of(least + scaled(Ball(-1.0), s.below)))) {
      return refuse("P* - below is not certainly positive definite");
    }
    if (!certainly_equal(set.slew, zero)) {
      // x3 - omega moves with the frequency, too.
      const std::array<Ball, 3> push = s.metric.image<Ball>(by[0], by[1], by[2] + one);
      Symmetric<Ball> slope;
      std::copy(by.begin() + 3, by.end(), slope.begin());
      motion =
          max(motion,
              set.slew * root_of_non_negative(square(push[0]) + square(push[1]) + square(push[2])).upper());
      covariance_motion = max(covariance_motion,
                              set.slew * max(covering_share(s.above, slope), covering_share(s.below, slope)));
    }
  }
  const std::size_t steps = std::max<std::size_t>(set.levels.size(), 2) - 1;
  for (const SteadyCell& steady : branch) {
    SteadyCover cover(s, steady);
    bool leads = true;
    for (std::size_t j = 0; j < steps && leads; ++j) {
      const Ball& next = set.levels[std::min(j + 1, set.levels.size() - 1)];
      leads = cover.leads({set.levels[j], next, set.noise, motion, covariance_motion});
    }
    cells += cover.cells();
    if (!leads) {
      return refuse("a step could not be shown to lead to the next level, for frequencies near " +
                    steady.centre.text(4));
    }
  }
  set.verified = true;
  return set;
}

}  // namespace veritrack::checker
