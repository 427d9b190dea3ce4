#include "checker/single_channel/rounded_step.hpp"

#include "checker/numbers/rounded_value.hpp"
#include "checker/sets/rounded_turn.hpp"

namespace veritrack::checker {

namespace {

/// The largest share of P for which a bound is given.
constexpr double kMostShare = 0x1p-8;

/// The program's values for a covariance: the entries of M on and beside the diagonal, a component of u, d.
/// The largest eigenvalue of M and |u| are also known.
struct RoundedFactors {
  RoundedValue diagonal, beside, u, d;
  Ball most_m, most_u;
};

/// time_update: a component of z, the frequency, the covariance.
struct PredictedTone {
  RoundedValue z, frequency;
  RoundedFactors p;
};

PredictedTone predict(const SingleChannelDesign& f, const HeldTone& before) {
  const RoundedValue none = held(zero);
  const RoundedValue retention = rounded(one, zero);  // 1 - epsilon, without a leak
  const RoundedValue d = product(product(retention, retention), held(before.most_d)).within(before.most_d);
  const Ball h = before.u + before.z;
  const RoundedValue regression =
      turned_component(quotient(sum(held(before.u), held(before.z)), retention, one, h)).within(h);
  const auto [turned_diagonal, turned_beside] = turned_block(held(before.most_m), held(half * before.most_m));
  PredictedTone result;
  result.z = turned_component(held(before.z)).within(before.z);
  result.frequency = product(retention, held(before.frequency)).within(before.frequency);
  // sum(..., Q): d/(d + q2) grows with d, and M by q1 I and q2 d/(d + q2) h h'.
  const RoundedValue variance = sum(d, held(f.q2));
  const Ball most_share = (before.most_d / (before.most_d + f.q2)).upper();
  const RoundedValue share = quotient(d, variance, before.least_d + f.q2, most_share);
  const RoundedValue difference = sum(regression, none).within(h);
  const RoundedValue spread = product(held(f.q2), share).within(f.q2 * most_share);
  RoundedFactors& p = result.p;
  p.most_m = (before.most_m + f.q1 + f.q2 * most_share * square(h)).upper();
  p.most_u = (most_share * h).upper();
  p.diagonal = sum(sum(turned_diagonal.within(before.most_m), held(f.q1)),
                   product(spread, product(difference, difference)))
                   .within(p.most_m);
  p.beside = sum(sum(turned_beside.within(half * before.most_m), none),
                 product(product(spread, difference), difference))
                 .within(half * p.most_m);
  p.u = sum(none, product(share, difference)).within(p.most_u);
  p.d = variance;
  return result;
}

/// The errors after measurement_update; the larger one of the two components.
ToneRounding update(const SingleChannelDesign& f, const HeldTone& held_before, const PredictedTone& before) {
  const RoundedFactors& p = before.p;
  const RoundedValue r = held(f.r);
  const Ball least_w = (held_before.least_m + f.q1 + f.r).lower();
  const RoundedValue w = sum(p.diagonal, r);
  const RoundedValue by_frequency = product(p.d, product(p.u, p.u));
  const RoundedValue p11 = sum(p.diagonal, by_frequency);
  const RoundedValue p13 = product(p.d, p.u);
  const RoundedValue s = sum(w, by_frequency);
  const RoundedValue innovation = sum(held(held_before.measurement), before.z);
  const RoundedValue weighted = quotient(innovation, s, least_w, innovation.size / least_w);
  // P11/s is at most 1, and P1i/s at most sqrt(Pii/s), as P1i^2 <= P11 Pii.
  const Ball root = sqrt(least_w);
  const Ball most_p = p.most_m + p.d.size * square(p.most_u);
  const RoundedValue p12 = sum(p.beside, product(p13, p.u)).within(half * most_p);
  const RoundedValue z1 = sum(before.z, product(p11, weighted).within(innovation.size));
  const RoundedValue z2 = sum(before.z, product(p12, weighted).within(sqrt(most_p) / root * innovation.size));
  const RoundedValue frequency =
      sum(before.frequency, product(p13, weighted).within(sqrt(p.d.size) / root * innovation.size));
  const RoundedValue d = product(p.d, quotient(w, s, least_w, one)).within(p.d.size);
  // M11/w and M22 M11/w less M12^2/w likewise.
  const RoundedValue left = quotient(r, w, least_w, f.r / least_w);
  const RoundedValue gain = quotient(p.beside, w, least_w, sqrt(p.most_m) / root);
  const RoundedValue determinant =
      sum(product(p.diagonal, p.diagonal), product(p.beside, p.beside)).within(square(p.most_m));
  const RoundedValue m11 = product(left, p.diagonal);
  const RoundedValue m12 = product(left, p.beside);
  const RoundedValue m22 =
      sum(product(left, p.diagonal), quotient(determinant, w, least_w, p.most_m)).within(p.most_m);
  const RoundedValue u1 = product(left, p.u);
  const RoundedValue u2 = sum(p.u, product(gain, p.u));
  const auto length = [](const Ball& x, const Ball& y) { return sqrt(square(x) + square(y)); };
  const Ball u_size = length(u1.size, u2.size);
  const Ball u_error = length(u1.error, u2.error);
  const Ball m_error = sqrt(square(m11.error) + square(m22.error) + two * square(m12.error));
  return {
      length(z1.error, z2.error).upper(), frequency.error.upper(),
      (m_error + d.error * square(u_size + u_error) + d.size * u_error * (two * u_size + u_error)).upper(),
      (d.error * (u_size + u_error) + d.size * u_error).upper(), d.error.upper()};
}

ToneRounding larger(const ToneRounding& a, const ToneRounding& b) {
  return {max(a.z, b.z), max(a.frequency, b.frequency), max(a.p_zz, b.p_zz), max(a.p_z3, b.p_z3),
          max(a.p_33, b.p_33)};
}

}  // namespace

ToneRounding rounded_step(const SingleChannelDesign& design, const HeldTone& before) {
  const Ball nothing = Ball::everything();
  const bool in_range = certainly_at_most(Ball(0x1p-60), design.amplitude) &&
                        certainly_at_most(design.amplitude, Ball(0x1p60)) && design.without_leak() &&
                        certainly_positive(design.r) && certainly_positive(design.q2) &&
                        certainly_not_negative(design.q1) && certainly_not_negative(before.least_m) &&
                        certainly_positive(before.least_d) && before.most_m.finite() &&
                        before.most_d.finite() && before.u.finite();
  if (!in_range) {
    return {nothing, nothing, nothing, nothing, nothing};
  }
  return update(design, before, predict(design, before));
}

StepRounding step_rounding(const SingleChannelDesign& design, const WindowStatement& window,
                           const Ball& noise, const std::optional<DiagonalStart>& start) {
  const Ball& a = window.frequency_variance;
  const Ball& b = window.signal_variance;
  // The remainder of Q after a measurement: diag(floor, floor, q2). Every prediction exceeds Q.
  const Ball floor = (design.q1 * design.r / (design.q1 + design.r)).lower();
  const Ball kept = one - Ball(kMostShare);
  HeldTone states;
  states.z = (one + window.radius * sqrt(b)).upper();
  states.frequency = (max(abs(design.lowest), abs(design.highest)) + window.radius * sqrt(a)).upper();
  states.measurement = (one + noise).upper();
  states.least_m = kept * floor;
  states.most_m = b;
  states.least_d = kept * design.q2;
  states.most_d = a;
  states.u = sqrt(b / states.least_d);  // |d u|^2 <= |P_zz| d
  ToneRounding rounding = rounded_step(design, states);
  if (start) {
    // M is monotone in P, and |(P - from M)_z3|^2 <= |(P - from M)_zz| (P - from M)_33.
    states.least_m = start->from * start->signal;
    states.most_m = start->to * start->signal;
    states.least_d = start->from * start->frequency;
    states.most_d = start->to * start->frequency;
    states.u = (start->to - start->from) * sqrt(start->signal * start->frequency) / states.least_d;
    rounding = larger(rounding, rounded_step(design, states));
  }
  // 2 |x_z| |x_3| <= s |x_z|^2 + |x_3|^2 / s.
  const Ball s = sqrt(floor / design.q2);
  const Ball share =
      max((rounding.p_zz + s * rounding.p_z3) / floor, (rounding.p_33 + rounding.p_z3 / s) / design.q2)
          .upper();
  if (!certainly_at_most(share, Ball(kMostShare))) {
    return {Ball::everything(), Ball::everything()};
  }
  const Ball error =
      sqrt((square(rounding.z) / floor + square(rounding.frequency) / design.q2) / (one - share));
  return {error.upper(), share};
}

}  // namespace veritrack::checker
