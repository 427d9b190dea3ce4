#include "papers/single_channel/printed_recursion_claims.hpp"

#include <array>
#include <string>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using rigor::vanishes;
using rigor::Verdict;
using theorems::decide;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

/// The derivative of the first state's prediction by the frequency.
Interval first_by_frequency(const Interval& x1, const Interval& x2, const Interval& frequency) {
  const auto [sine, cosine] = rigor::sin_cos(frequency);
  return -(sine * x1) - cosine * x2;
}

Statement linearization_point() {
  const Interval frequency(0.5);
  const auto [sine, cosine] = rigor::sin_cos(frequency);
  const Interval before = first_by_frequency(Interval(1.0), Interval(0.0), frequency);
  const Interval now = first_by_frequency(cosine, sine, frequency);
  return make_statement(
      "bittanti-savaresi/linearization-point",
      "F(t) at x(t-1|t-1), as printed, is the derivative by which P(t+1) follows from the estimate x(t|t), "
      "to "
      "nine digits.",
      decide(abs(before - now), Interval(1e-9), Strictness::weak),
      "In exact lock on 0.5 rad/sample with x(t-1|t-1) = (1, 0, 1/2): the entry (1, 3) is " +
          enclosed(before) + " there, and " + enclosed(now) +
          " at x(t|t), from which the state is predicted. Its effect on the figures: reproduce "
          "bittanti-savaresi-2000.",
      {});
}

/// w(t+1)'F(t) = w(t)' for w = (x1, x2, 0), with x1 and x2 that turn by (c, s), c^2 + s^2 = 1.
Verdict amplitude_is_kept() {
  return vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [c, s, x1, x2] = at;
        const Interval u = c * x1 - s * x2;
        const Interval v = s * x1 + c * x2;
        const Interval one = square(c) + square(s);
        return square(c * u + s * v - one * x1) + square(c * v - s * u - one * x2) +
               square(u * (-(s * x1) - c * x2) + v * (c * x1 - s * x2));
      },
      8);
}

Statement printed_unit_matrix() {
  return make_statement(
      "bittanti-savaresi/I3",
      "With I3 = diag(0, 0, 1), as printed, the process noise reaches every error of the tracker that does "
      "not "
      "fade by itself (F(t) and q I3 are stabilisable along a tone), as a stable filter needs.",
      amplitude_is_kept() == Verdict::proved ? Verdict::refuted : Verdict::undecided,
      "The direction w = (x1, x2, 0) of the signal has w(t+1)'F(t) = w(t)' and w'I3 = 0, an identity: the "
      "variance of the amplitude's error gets no noise, and its gain tends to 0. The published figures come "
      "from I3 = I only: reproduce bittanti-savaresi-2000.",
      {});
}

}  // namespace

std::vector<Statement> printed_recursion_claims() {
  return {linearization_point(), printed_unit_matrix()};
}

}  // namespace veritrack::single_channel
