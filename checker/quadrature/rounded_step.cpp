#include "checker/quadrature/rounded_step.hpp"

#include "checker/numbers/rounded_value.hpp"
#include "checker/sets/rounded_turn.hpp"

namespace veritrack::checker {

namespace {

Ball length(const Ball& x, const Ball& y) {
  return sqrt(square(x) + square(y));
}

/// The program's values for a covariance: the entries of M on and beside the diagonal, a component of u, d.
struct Factors {
  RoundedValue diagonal, beside, u, d;
};

/// detail::predicted_in_own_frame, with bounds on the eigenvalues of M and on |u|.
struct Predicted {
  Factors p;
  Ball least_m, most_m, u;
  RoundedValue frequency;
};

Predicted predict(const Filter& f, const Held& before) {
  const Ball kept = one - f.epsilon;
  const RoundedValue retention = rounded(kept, zero);
  const RoundedValue d = held(before.most_d);
  const Ball h_size = before.u + before.z;
  const RoundedValue h = rounded(h_size, zero);
  const RoundedValue variance =
      sum(product(product(retention, retention), d), held(f.q2)).within(square(kept) * before.most_d + f.q2);
  // d / (kept^2 d + q2) grows with d.
  const RoundedValue fraction = quotient(d, variance, square(kept) * before.least_d + f.q2,
                                         before.most_d / (square(kept) * before.most_d + f.q2));
  const RoundedValue regression = product(retention, fraction);
  const RoundedValue remaining = product(held(f.q2), fraction);
  const Ball most_m = (before.most_m + f.q1 + remaining.size * square(h_size)).upper();
  Predicted result;
  result.least_m = (before.least_m + f.q1).lower();
  result.most_m = most_m;
  result.u = (regression.size * h_size).upper();
  result.p.diagonal =
      sum(sum(held(before.most_m), held(f.q1)), product(remaining, product(h, h))).within(most_m);
  result.p.beside = sum(held(half * before.most_m), product(product(remaining, h), h)).within(half * most_m);
  result.p.u = product(regression, h).within(result.u);
  result.p.d = variance;
  result.frequency = product(retention, held(before.frequency));
  return result;
}

/// measurement_update: a component of z, the frequency, and the factors.
struct Updated {
  RoundedValue z, frequency;
  Factors p;
};

Updated update(const Filter& f, const Predicted& before, const Held& start, const RoundedValue& innovation) {
  const auto& [diagonal, beside, u, d] = before.p;
  const RoundedValue r = held(f.r);
  const Ball least_w = before.least_m + f.r;
  const RoundedValue w = sum(diagonal, r);
  const RoundedValue determinant_m =
      sum(product(diagonal, diagonal), product(beside, beside)).within(square(before.most_m));
  const RoundedValue determinant_w =
      sum(determinant_m, product(r, sum(diagonal, w))).within(square(before.most_m + f.r));
  const RoundedValue inverse = quotient(held(one), determinant_w, square(least_w), one / square(least_w));
  const RoundedValue scaled = product(r, inverse);
  const RoundedValue isotropic = product(determinant_m, inverse).within(one);
  // The gain is between 0 and I.
  const RoundedValue gain = sum(isotropic, product(scaled, diagonal)).within(one);
  const RoundedValue gain_beside = product(scaled, beside).within(half);
  const Ball t_size = before.u / least_w;
  const RoundedValue t =
      product(sum(product(w, u), product(beside, u)).within((before.most_m + f.r) * before.u), inverse)
          .within(t_size);
  const RoundedValue information = sum(product(u, t), product(u, t)).within(before.u * t_size);
  const RoundedValue variance = quotient(d, sum(held(one), product(d, information)), one, d.size);
  const RoundedValue regression = product(r, t).within(before.u);
  // d |u' W^-1 i| / (1 + d u' W^-1 u) <= sqrt(d / least W) |i| / 2.
  const RoundedValue correction = product(variance, sum(product(t, innovation), product(t, innovation)))
                                      .within(half * sqrt(d.size / least_w) * innovation.size);
  Updated result;
  result.z = sum(sum(sum(held(start.z), product(gain, innovation)), product(gain_beside, innovation)),
                 product(regression, correction));
  result.frequency = sum(before.frequency, correction);
  result.p = {product(r, gain), product(r, gain_beside), regression, variance};
  return result;
}

}  // namespace

void add_covariance(const Matrix3& lower, const Matrix3& upper, Held& held) {
  constexpr int kPieces = 8;
  const auto room = [&](std::size_t i) { return root_of_non_negative(upper[i][i] - lower[i][i]).upper(); };
  const auto complement = [](const Matrix3& p, std::size_t i, std::size_t j) {
    return p[i][j] - p[i][2] * p[j][2] / p[2][2];
  };
  // P_zz - P_z3 P_z3' / P_33 is monotone in the Loewner order.
  held.least_m = max(min(complement(lower, 0, 0), complement(lower, 1, 1)).lower() -
                         abs(complement(lower, 0, 1)).upper(),
                     zero)
                     .lower();
  held.most_m =
      (max(complement(upper, 0, 0), complement(upper, 1, 1)) + abs(complement(upper, 0, 1))).upper();
  held.least_d = lower[2][2].lower();
  held.most_d = upper[2][2].upper();
  // |(P - lower)_i3|^2 <= (P - lower)_ii (P - lower)_33, and so for upper - P, in pieces of the range of d.
  held.u = certainly_positive(held.least_d) ? zero : Ball::everything();
  for (int k = 0; k < kPieces; ++k) {
    const Ball width = held.most_d - held.least_d;
    const Ball from = (held.least_d + Ball(k) / Ball(kPieces) * width).lower();
    const Ball to = (held.least_d + Ball(k + 1) / Ball(kPieces) * width).upper();
    std::array<Ball, 2> most;
    for (std::size_t i = 0; i < 2; ++i) {
      const Ball by_lower = abs(lower[i][2]) + room(i) * root_of_non_negative(to - lower[2][2]);
      const Ball by_upper = abs(upper[i][2]) + room(i) * root_of_non_negative(upper[2][2] - from);
      most[i] = min(by_lower.upper(), by_upper.upper());
    }
    held.u = max(held.u, length(most[0], most[1]) / from).upper();
  }
}

Rounding rounded_step(const Filter& filter, const Held& before) {
  const Ball nothing = Ball::everything();
  const bool in_range = certainly_at_most(Ball(0x1p-60), filter.amplitude) &&
                        certainly_at_most(filter.amplitude, Ball(0x1p60)) && certainly_positive(filter.r) &&
                        certainly_positive(filter.q2) && certainly_not_negative(filter.q1) &&
                        certainly_not_negative(filter.epsilon) && certainly_less(filter.epsilon, one) &&
                        certainly_positive(before.least_d) && before.most_m.finite() && before.u.finite();
  if (!in_range) {
    return {nothing, nothing, nothing, nothing, nothing};
  }
  const RoundedValue measured = turned_component(held(before.measurement)).within(before.measurement);
  const RoundedValue innovation = sum(measured, held(before.z));
  const Predicted predicted = predict(filter, before);
  const Updated updated = update(filter, predicted, before, innovation);
  const RoundedValue z = turned_component(updated.z);
  const RoundedValue u = turned_component(updated.p.u);
  const auto [on_diagonal, off_diagonal] = turned_block(updated.p.diagonal, updated.p.beside);
  const Ball& on = on_diagonal.error;
  const Ball& beside = off_diagonal.error;
  const Ball u_error = length(u.error, u.error);
  const Ball u_computed = predicted.u + u_error;
  const RoundedValue& d = updated.p.d;
  return {length(z.error, z.error).upper(), updated.frequency.error.upper(),
          (two * length(on, beside) + d.error * square(u_computed) +
           d.size * u_error * (predicted.u + u_computed))
              .upper(),
          (d.error * u_computed + d.size * u_error).upper(), d.error.upper()};
}

}  // namespace veritrack::checker
