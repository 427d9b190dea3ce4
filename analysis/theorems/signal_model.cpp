#include "analysis/theorems/signal_model.hpp"

#include "analysis/rigor/elementary.hpp"

namespace veritrack::theorems {

using rigor::Interval;
using rigor::IntervalVector;

Interval signal_magnitude(const IntervalVector<3>& state) {
  return sqrt(square(state(0)) + square(state(1)));
}

IntervalVector<3> transition(const IntervalVector<3>& state, const Interval& epsilon) {
  const auto [sine, cosine] = rigor::sin_cos(state(2));
  IntervalVector<3> next;
  next(0) = cosine * state(0) - sine * state(1);
  next(1) = sine * state(0) + cosine * state(1);
  next(2) = (Interval(1.0) - epsilon) * state(2);
  return next;
}

// F is a rotation times [[I, iz], [0, a]], a = 1 - epsilon. Turning iz into the first axis leaves a 1 (never
// the largest singular value for 0 <= a <= 1) and the block [[1, m], [0, a]], whose singular values have the
// squared sum m^2 + (1 + a)^2 and the squared difference m^2 + (1 - a)^2.
Interval first_derivative_norm(const Interval& m, const Interval& epsilon) {
  const Interval sum = sqrt(square(m) + square(Interval(2.0) - epsilon));
  const Interval difference = sqrt(square(m) + square(epsilon));
  return (sum + difference) / Interval(2.0);
}

// D^2 f is symmetric, so that its norm is attained with equal arguments u = (u_z, u3) (Banach 1938; for a
// vector-valued form, apply it to each component): |2 i u3 u_z - u3^2 z|, largest when the two terms
// are aligned. With |u_z| = sin t, u3 = cos t this is sin 2t + m (1 + cos 2t)/2, of maximum m/2 + sqrt(1 +
// m^2/4).
Interval second_derivative_norm(const Interval& m) {
  return (m + sqrt(square(m) + Interval(4.0))) / Interval(2.0);
}

// Likewise |3 u3^2 u_z + i u3^3 z| <= cos^2 t (3 sin t + m cos t). In tau = tan t this is (3 tau + m)/(1 +
// tau^2)^(3/2), stationary at the positive root of 2 tau^2 + m tau - 1 = 0, where it is 1/(tau sqrt(1 +
// tau^2)).
Interval third_derivative_norm(const Interval& m) {
  const Interval tau = Interval(2.0) / (m + sqrt(square(m) + Interval(8.0)));
  return Interval(1.0) / (tau * sqrt(Interval(1.0) + square(tau)));
}

// The third row is constant, the 2x2 block is multiplication by e^{i x3} - e^{i y3}, of modulus 2 |sin(h)|,
// h = (x3 - y3)/2, and the last column is b = i(e^{i x3} z_x - e^{i y3} z_y), of modulus
// |(z_x - z_y) + (1 - e^{-2ih}) z_y|, 1 - e^{-2ih} = 2 sin h (sin h + i cos h). With A the 2x2 block,
// [A b][A b]' = |e^{i x3} - e^{i y3}|^2 I + b b', whose largest eigenvalue is |e^{i x3} - e^{i y3}|^2 +
// |b|^2.
Interval first_derivative_distance(const IntervalVector<3>& x, const IntervalVector<3>& y) {
  const auto [sine, cosine] = rigor::sin_cos((x(2) - y(2)) / Interval(2.0));
  const Interval chord = Interval(2.0) * sine;
  const Interval b_real = (x(0) - y(0)) + chord * (sine * y(0) - cosine * y(1));
  const Interval b_imaginary = (x(1) - y(1)) + chord * (sine * y(1) + cosine * y(0));
  return sqrt(square(chord) + square(b_real) + square(b_imaginary));
}

// r O(k,1) = H'H + (H F^-1)'(H F^-1) is, up to a rotation, 2 on one axis and [[2, mu], [mu, mu^2]] on the
// others, with mu = m/(1 - epsilon): eigenvalues 2 and (2 + mu^2 -+ sqrt(mu^4 + 4))/2, as in the thesis with
// w3 = mu^2. The 2 is never the smallest nor the largest. The difference is written as a quotient.
GramianEigenvalues observability_eigenvalues(const Interval& m, const Interval& r, const Interval& epsilon) {
  const Interval two(2.0);
  const Interval mu_squared = square(m / (Interval(1.0) - epsilon));
  const Interval sum = two + mu_squared + sqrt(square(mu_squared) + Interval(4.0));
  return {two * mu_squared / sum / r, sum / two / r};
}

}  // namespace veritrack::theorems
