#include "checker/quadrature/certified_set.hpp"

#include "checker/quadrature/set_inequality.hpp"

namespace veritrack::checker {

namespace {

const Ball zero(0.0);
const Ball one(1.0);

/// A covariance of exact numbers that is below every one in the balls, in the Loewner order, or above.
Covariance<Ball> beyond(const Covariance<Ball>& p, bool above) {
  Covariance<Ball> point = p;
  Ball radius;
  arb_get_mid_arb(point.p23.raw(), p.p23.raw());
  arb_get_rad_arb(radius.raw(), p.p23.raw());
  point.p11 = above ? p.p11.upper() : p.p11.lower();
  point.p22 = above ? (p.p22 + radius).upper() : (p.p22 - radius).lower();
  point.p33 = above ? (p.p33 + radius).upper() : (p.p33 - radius).lower();
  return point;
}

}  // namespace

bool positive_definite(const Covariance<Ball>& p) {
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

Ball largest_level(const Metric& t, const Ball& amplitude, const Ball& phase, const Ball& frequency) {
  return sqrt(square(t.amplitude * amplitude) + square(t.phase * phase + abs(t.coupling) * frequency) +
              square(t.frequency * frequency));
}

Ball ultimate_level(const Setting& s, const Design& d) {
  const Ball pushed = square(s.noise_gain * d.noise) + square(s.slew_gain * d.slew);
  return sqrt(pushed / (one - square(s.rate)));
}

bool bears(const Setting& s, const Design& d) {
  return certainly_at_most(d.noise, s.noise) && certainly_at_most(d.slew, s.slew);
}

bool settled(const Setting& s, const Design& d, const Ball& start, const Ball& frequency_error,
             const Ball& samples) {
  const Ball level = frequency_error * s.metric.frequency;
  const Ball ultimate = square(ultimate_level(s, d));
  if (!certainly_less(ultimate, square(level))) {
    return false;
  }
  if (certainly_at_most(start, level)) {
    return true;
  }
  const Ball log_shrunk = samples * log(square(s.rate));
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

Matrix3 steady_covariance(const Setting& set) {
  constexpr int kIterations = 1000;
  Covariance<Ball> lower = set.lower;
  Covariance<Ball> upper = set.upper;
  for (int k = 0; k < kIterations; ++k) {
    lower = beyond(update(set, lower, one).filtered, false);
    upper = beyond(update(set, upper, one).filtered, true);
  }
  const Covariance<Ball> gap = upper - lower;
  const std::array<Ball, 3> width{sqrt(gap.p11), sqrt(gap.p22), sqrt(gap.p33)};
  Matrix3 p = whole(lower);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      p[i][j] += Ball::within(width[i] * width[j]);
    }
  }
  return p;
}

CertifiedSet check_set(const Tree& tree, const Design& design, std::int64_t& cells, Objections& objections) {
  CertifiedSet set;
  set.purpose = tree.at("purpose").text();
  Setting& s = set.setting;
  const auto number = [&](const char* name) { return from_hexadecimal(tree.at(name).text()); };
  const auto entry = [&](const char* name, std::size_t i, std::size_t j) {
    return from_hexadecimal(tree.at(name).at(i).at(j).text());
  };
  const auto block = [&](const char* name) {
    return Covariance<Ball>{entry(name, 0, 0), entry(name, 1, 1), entry(name, 1, 2), entry(name, 2, 2)};
  };
  bool form = certainly_equal(entry("metric", 2, 1), zero);
  for (const char* name : {"metric", "covariance_lower", "covariance_upper"}) {
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
      form = form && certainly_equal(entry(name, 0, i), zero) && certainly_equal(entry(name, i, 0), zero);
    }
  }
  for (const char* name : {"covariance_lower", "covariance_upper"}) {
    form = form && certainly_equal(entry(name, 1, 2), entry(name, 2, 1));
  }
  s.q1 = design.q1;
  s.q2 = design.q2;
  s.r = design.r;
  s.metric = {entry("metric", 0, 0), entry("metric", 1, 1), entry("metric", 1, 2), entry("metric", 2, 2)};
  s.lower = block("covariance_lower");
  s.upper = block("covariance_upper");
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
  const Ball reach =
      square(s.rate * s.radius) + square(s.noise_gain * s.noise) + square(s.slew_gain * s.slew);
  const auto refuse = [&](const char* why) {
    objections.push_back(set.purpose + ": " + why);
    return set;
  };
  if (!certainly_equal(design.epsilon, zero) || !certainly_positive(design.q2) ||
      !certainly_positive(design.r)) {
    return refuse("certified sets are for epsilon = 0, q2 > 0, r > 0");
  }
  if (!form || !certainly_positive(s.metric.amplitude) || !certainly_positive(s.metric.phase) ||
      !certainly_positive(s.metric.frequency)) {
    return refuse("the matrices do not have their form");
  }
  if (!certainly_positive(s.radius) || !certainly_at_most(zero, s.noise) ||
      !certainly_at_most(zero, s.slew) || !certainly_at_most(zero, s.rate) || !certainly_less(s.rate, one) ||
      !certainly_at_most(zero, s.noise_gain) || !certainly_at_most(zero, s.slew_gain) ||
      !certainly_less(s.largest_amplitude, one)) {
    return refuse("radius, noise, slew, rate or gains are out of range");
  }
  if (!positive_definite(s.lower) || !positive_definite(s.upper - s.lower)) {
    return refuse("the covariance bounds are not positive definite and in order");
  }
  if (!certainly_at_most(reach, square(s.radius))) {
    return refuse("(c) noise and slew lead out of the set");
  }
  if (!keeps_covariance(s)) {
    return refuse("(b) the covariance does not certainly stay between its bounds");
  }
  if (!contracts(s, cells)) {
    return refuse("(a) the step inequality does not certainly hold");
  }
  set.verified = true;
  return set;
}

}  // namespace veritrack::checker
