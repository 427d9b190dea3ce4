#include "checker/quadrature/certified_set.hpp"

#include <set>

#include "checker/document/evidence.hpp"
#include "checker/quadrature/rounded_step.hpp"
#include "checker/quadrature/set_inequality.hpp"

namespace veritrack::checker {

bool amplitude_is_apart(const Matrix3& m) {
  return certainly_equal(m[0][1], zero) && certainly_equal(m[0][2], zero) && certainly_equal(m[1][0], zero) &&
         certainly_equal(m[2][0], zero);
}

namespace {

Covariance<Ball> covariance_of(const Matrix3& p) {
  return {p[0][0], p[1][1], p[1][2], p[2][2]};
}

/// The set, and whether its matrices have their form.
std::pair<Setting, bool> read_setting(const Tree& tree, const Design& design) {
  const auto number = [&](const char* name) { return exact_number(tree.at(name)); };
  const Matrix3 metric = exact_matrix(tree.at("metric"));
  const Matrix3 lower = exact_matrix(tree.at("covariance_lower"));
  const Matrix3 upper = exact_matrix(tree.at("covariance_upper"));
  Setting s;
  s.q1 = design.q1;
  s.q2 = design.q2;
  s.r = design.r;
  s.metric = {metric[0][0], metric[1][1], metric[1][2], metric[2][2]};
  s.lower = covariance_of(lower);
  s.upper = covariance_of(upper);
  s.radius = number("radius");
  s.noise = number("noise");
  s.slew = number("slew");
  s.rate = number("rate");
  s.noise_gain = number("noise_gain");
  s.slew_gain = number("slew_gain");
  s.noisy = !certainly_equal(s.noise, zero);
  s.slewing = !certainly_equal(s.slew, zero);
  s.largest_amplitude = (s.radius / s.metric.amplitude).upper();
  s.largest_chi = (s.radius * sqrt(square(one / s.metric.phase) +
                                   square((one - s.metric.coupling / s.metric.phase) / s.metric.frequency)))
                      .upper();
  const bool has_form = amplitude_is_apart(metric) && certainly_equal(metric[2][1], zero) &&
                        amplitude_is_apart(lower) && symmetric(lower) && amplitude_is_apart(upper) &&
                        symmetric(upper) && certainly_positive(s.metric.amplitude) &&
                        certainly_positive(s.metric.phase) && certainly_positive(s.metric.frequency);
  return {s, has_form};
}

/// Fills in what the rounding of a step may add to the state, also where the set is shifted by whole turns of
/// the frequency error.
void bound_rounding(Setting& s, const Design& design) {
  const std::array<Ball, 3> rows = inverse_rows(s.metric);
  Held held;
  held.z = one + s.radius * rows[0];
  held.frequency = max(design.largest_frequency, pi()) + two * kMostTurns * pi() + s.radius * rows[2];
  held.measurement = one + s.noise;
  add_covariance(whole(s.lower), whole(s.upper), held);
  const Rounding rounding = rounded_step({s.q1, s.q2, s.r, zero, design.amplitude}, held);
  const PolarRounding polar =
      polar_rounding(rounding, one - s.radius * rows[0], max(s.upper.p11, s.upper.p22), s.upper.p33);
  s.error_rounding = largest_level(s.metric, polar.amplitude, polar.phase, polar.frequency).upper();
  s.covariance_rounding = rounding_share(whole(s.lower), polar);
}

/// The hypotheses of the theorem that are not proved; empty when all are.
std::string refusal_of(const Setting& s, std::int64_t& cells) {
  if (!certainly_positive(s.radius) || !certainly_not_negative(s.noise) || !certainly_not_negative(s.slew) ||
      !certainly_not_negative(s.rate) || !certainly_less(s.rate, one) ||
      !certainly_not_negative(s.noise_gain) || !certainly_not_negative(s.slew_gain) ||
      !certainly_less(s.largest_amplitude, one)) {
    return "radius, noise, slew, rate or gains are out of range";
  }
  if (!positive_definite(s.lower) || !positive_definite(s.upper - s.lower)) {
    return "the covariance bounds are not positive definite and in order";
  }
  if (!s.error_rounding.finite() || !s.covariance_rounding.finite()) {
    return "the rounding of a step in double precision is not bounded";
  }
  if (!certainly_at_most(next_level(s, s.radius, s.noise, s.slew), s.radius)) {
    return "(c) noise, slew and rounding can push the errors out of the set";
  }
  if (!keeps_covariance(s)) {
    return "(b) the covariance is not proved to stay between its bounds";
  }
  if (!contracts(s, cells)) {
    return "(a) the step inequality is not certain";
  }
  return {};
}

}  // namespace

bool positive_definite(const Covariance<Ball>& p CHECKER_DECLARED_PLACE) {
  CHECKER_IF_FORCED
  return certainly_positive(p.p11) && certainly_positive(p.p22) &&
         certainly_positive(p.p22 * p.p33 - square(p.p23));
}

Covariance<Ball> operator-(const Covariance<Ball>& x, const Covariance<Ball>& y) {
  return {x.p11 - y.p11, x.p22 - y.p22, x.p23 - y.p23, x.p33 - y.p33};
}

Matrix3 whole(const Covariance<Ball>& c) {
  Matrix3 result = diagonal(c.p11, c.p22, c.p33);
  result[2][1] = result[1][2] = c.p23;
  return result;
}

bool between(const Matrix3& p, const Covariance<Ball>& lower, const Covariance<Ball>& upper) {
  return definite(p - whole(lower)) && definite(whole(upper) - p);
}

std::array<Ball, 3> inverse_rows(const Metric& t) {
  return {one / t.amplitude, sqrt(square(one / t.phase) + square(t.coupling / (t.phase * t.frequency))),
          one / t.frequency};
}

Ball frequency_errors(const Setting& set) {
  return set.radius * inverse_rows(set.metric)[2];
}

Ball largest_level(const Metric& t, const Ball& amplitude, const Ball& phase, const Ball& frequency) {
  return sqrt(square(t.amplitude * amplitude) + square(t.phase * phase + abs(t.coupling) * frequency) +
              square(t.frequency * frequency));
}

Ball next_level(const Setting& s, const Ball& level, const Ball& noise, const Ball& slew) {
  return sqrt(square(s.rate * level) + square(s.noise_gain * noise) + square(s.slew_gain * slew)) +
         s.error_rounding;
}

Ball ultimate_level(const Setting& s, const Design& d) {
  // (u - rounding)^2 = rate^2 u^2 + pushed.
  const Ball pushed = square(s.noise_gain * d.noise) + square(s.slew_gain * d.slew);
  const Ball left = one - square(s.rate);
  return (s.error_rounding + sqrt(square(s.rate * s.error_rounding) + left * pushed)) / left;
}

bool tolerates(const Setting& s, const Design& d) {
  return certainly_at_most(d.noise, s.noise) && certainly_at_most(d.slew, s.slew);
}

bool settled(const Setting& s, const Design& d, const Ball& start, const Ball& frequency_error,
             const Ball& samples) {
  const Ball level = frequency_error * s.metric.frequency;
  const Ball limit = ultimate_level(s, d);
  const Ball ultimate = square(limit);
  if (!certainly_positive(level) || !certainly_less(ultimate, square(level))) {
    return false;
  }
  if (certainly_at_most(start, level)) {
    return true;
  }
  // A step maps l - u, l >= u, to at most rate (l - u): the next level has a slope of at most rate.
  if (certainly_at_most(samples * log(s.rate) + log(start - limit), log(level - limit))) {
    return true;
  }
  // And l^2 - u^2 to at most rate^2 (l^2 - u^2) u/(u - rounding), which is sharper where noise outweighs
  // rounding.
  const Ball log_shrunk = samples * log(square(s.rate) * limit / (limit - s.error_rounding));
  return certainly_at_most(log_shrunk + log(square(start) - ultimate), log(square(level) - ultimate));
}

const Setting* first_of(const std::vector<CertifiedSet>& sets, const std::string& purpose) {
  for (const CertifiedSet& set : sets) {
    if (set.verified && set.purpose == purpose) {
      return &set.setting;
    }
  }
  return nullptr;
}

CertifiedSet check_set(const Tree& tree, const Design& design, std::int64_t& cells, Objections& objections) {
  CertifiedSet set;
  set.purpose = tree.at("purpose").text();
  static const std::set<std::string> purposes{"start-error",           "largest-noise",  "largest-slew",
                                              "frequency-error-bound", "ultimate-error", "settling"};
  if (purposes.count(set.purpose) == 0) {
    objections.emplace_back("no set is for this purpose");
    return set;
  }
  const auto [setting, has_form] = read_setting(tree, design);
  set.setting = setting;
  bound_rounding(set.setting, design);
  // cannot bind (design.q2, design.r): (b) is false without them. The lower bound grows in p33 by less than
  // q2, and for r <= 0 a variance p is not between the bounds after p r / (p + r).
  const bool applies = design.without_leak() && certainly_positive(design.q2) && certainly_positive(design.r);
  const std::string refusal = !applies    ? "certified sets are for epsilon = 0, q2 > 0, r > 0"
                              : !has_form ? "the matrices do not have the required form"
                                          : refusal_of(set.setting, cells);
  set.verified = refusal.empty();
  if (!set.verified) {
    objections.push_back(set.purpose + ": " + refusal);
  }
  return set;
}

}  // namespace veritrack::checker
