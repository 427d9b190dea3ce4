#include "papers/single_channel/paper_sentences.hpp"

#include <array>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/single_channel/invariant_curve.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::vanishes;
using rigor::Verdict;
using theorems::decide;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

trackers::ToneModel<Interval> example_1(const char* epsilon) {
  return {parse_decimal("0.005"), parse_decimal("0.005"), parse_decimal("0.01"), parse_decimal(epsilon)};
}

/// f with x2 and x3 of the other sign is f with these signs changed, the frequency by its point of the
/// circle.
Verdict is_mirrored() {
  const Verdict first = vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [x1, x2, cosine, sine] = at;
        return (cosine * x1 - (-sine) * (-x2)) - (cosine * x1 - sine * x2);
      },
      1);
  const Verdict second = vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [x1, x2, cosine, sine] = at;
        return ((-sine) * x1 + cosine * (-x2)) + (sine * x1 + cosine * x2);
      },
      1);
  return rigor::conjunction({first, second});
}

Statement mirrored_start() {
  const Interval frequency(1.5);
  const bool settles = settles_exactly(example_1("0"), frequency);
  const Verdict is_exact = decide(Interval(2.0) * frequency, Interval(0.0), Strictness::weak);
  return make_statement(
      "proposition-1/every-start", "With ε = 0 the steady-state estimate is unbiased, whatever the start.",
      settles && is_mirrored() == Verdict::proved ? is_exact : Verdict::undecided,
      "With x2, x3 and the covariances that they share with x1 of the other sign the tracker does the same, "
      "mirrored: an identity. Where a start locks on 1.5 rad/sample, its mirror image settles at -1.5, in "
      "the "
      "same distance of 0.",
      {});
}

std::vector<Statement> zero_frequency() {
  return {make_statement(
      "proposition-1/zero-frequency",
      "At ω = 0 the estimate (A, 0, 0) is a steady state without bias, for every ε and every gain.",
      vanishes<3>(
          [](const std::array<Interval, 3>& at) {
            const auto& [amplitude, gain, kept] = at;
            const Interval innovation = amplitude - (Interval(1.0) * amplitude - Interval(0.0));
            return square(innovation) + square(kept * Interval(0.0) + gain * innovation);
          },
          4),
      "The innovation is A - (cos 0 A - sin 0 0) = 0, and x3 stays 0. It need not attract: its linearisation "
      "does not see x2 and x3.",
      {})};
}

std::vector<Statement> response_statements() {
  // |z^2 - 2 c z + 1| on the circle, by its real and imaginary parts, C^2 + S^2 = 1.
  const Verdict factored =
      rigor::conjunction({vanishes<3>(
                              [](const std::array<Interval, 3>& at) {
                                const auto& [cosine, sine, c] = at;
                                const Interval one = square(cosine) + square(sine);
                                return square(cosine) - square(sine) - Interval(2.0) * c * cosine + one -
                                       Interval(2.0) * cosine * (cosine - c);
                              },
                              2),
                          vanishes<3>(
                              [](const std::array<Interval, 3>& at) {
                                const auto& [cosine, sine, c] = at;
                                return Interval(2.0) * sine * cosine - Interval(2.0) * c * sine -
                                       Interval(2.0) * sine * (cosine - c);
                              },
                              2)});
  const Interval other = rigor::cos(Interval(1.5)) - rigor::cos(-Interval(1.5));
  const bool is_zero_there = rigor::contains(other, 0.0) && factored == Verdict::proved;
  const Interval ripple = Interval(2.0) * (Interval(1.0) - rigor::cos(rigor::pi() / Interval(6.0)));
  // (3) and (4) with cos x3 = 3/5, sin x3 = 4/5, K(1) = (1/2, 1/4), K(2) = 0, y = (1, 0), all times 20.
  const Interval by_filter = Interval(3.0) * Interval(2.0) - Interval(4.0) * Interval(1.0);
  const Interval by_transfer = Interval(6.0) * Interval(2.0);
  return {make_statement(
              "proposition-1/zeros/printed", "The numerator of (6) at e^{jω} is zero if and only if x3 = ω.",
              is_zero_there ? decide(Interval(3.0), Interval(0.0), Strictness::weak) : Verdict::undecided,
              "Its size is 2 |cos ω - cos x3|, the same at x3 = -1.5 as at 1.5 for ω = 1.5: zero.", {}),
          make_statement(
              "proposition-1/zeros/corrected",
              "The numerator of (6) at e^{jω} is zero if and only if x3 = ω, for both in [0, π].", factored,
              "Its size is 2 |cos ω - cos x3|, an identity, and the cosine is one-to-one there.", {}),
          make_statement(
              "proposition-1/constant-sinusoid",
              "(7), a sinusoid that equals the constant ε x3, can hold with x3 other than 0 at ω = π/6, "
              "for constant gains and ε > 0.",
              decide(ripple, Interval(0.0), Strictness::weak),
              "Samples of a sinusoid obey u(t-1) + u(t+1) = 2 cos ω u(t): a constant d has d times " +
                  enclosed(ripple) + " = 0. So both sides are 0.",
              {}),
          make_statement(
              "proposition-1/varying-gain",
              "With gains that vary, (4), corrected, at the gains of now gives the estimates of (3).",
              decide(by_transfer, by_filter, Strictness::weak),
              "cos x3 = 3/5, sin x3 = 4/5, x(0) = 0, K(1) = (1/2, 1/4), K(2) = 0, y(1) = 1, y(2) = 0: 20 "
              "x1(2) is " +
                  enclosed(by_filter) + " by (3) and " + enclosed(by_transfer) + " by (4).",
              {})};
}

/// The known steady states, and whether all are proved.
struct Biases {
  SteadyStateBias low, high, below_top, top;
};

Verdict if_proved(const SteadyStateBias& one, const SteadyStateBias& other, Verdict verdict) {
  return one.verdict == Verdict::proved && other.verdict == Verdict::proved ? verdict : Verdict::undecided;
}

std::string two_biases(const char* first, const SteadyStateBias& one, const char* second,
                       const SteadyStateBias& other) {
  return std::string("Example 1 with ε = 0.05, the mean over the phase: ") + enclosed(one.mean_bias) +
         " at " + first + " and " + enclosed(other.mean_bias) + " at " + second + " rad/sample.";
}

std::vector<Statement> bias_statements(const Biases& biases) {
  return {make_statement("proposition-1/estimate-is-constant",
                         "On a noise-free tone the frequency estimate reaches a constant x3 (the proof of "
                         "Proposition 1), in Example 1 with ε = 0.05 at π/6 rad/sample.",
                         if_proved(biases.low, biases.low,
                                   decide(biases.low.max_error, biases.low.min_error, Strictness::weak)),
                         "In the steady state the error runs from " + enclosed(biases.low.min_error) +
                             " to " + enclosed(biases.low.max_error) + " rad/sample over the phase.",
                         {}),
          make_statement(
              "proposition-1/bias-grows/example",
              "The bias is larger at the second frequency of Example 1, 2π/3, than at the first, π/6.",
              if_proved(biases.low, biases.high,
                        decide(abs(biases.low.mean_bias), abs(biases.high.mean_bias), Strictness::strict)),
              two_biases("π/6", biases.low, "2π/3", biases.high), {}),
          make_statement("proposition-1/bias-grows/everywhere", "The bias grows with the frequency, up to π.",
                         if_proved(biases.below_top, biases.top,
                                   decide(abs(biases.below_top.mean_bias), abs(biases.top.mean_bias),
                                          Strictness::strict)),
                         two_biases("2.6", biases.below_top, "2.8", biases.top), {})};
}

std::vector<Statement> leak_statements() {
  const Interval left = pow(Interval(1.0) - parse_decimal("0.05"), 100);
  return {make_statement("proposition-1/indistinguishable",
                         "The stability properties with ε = 0 and with ε = 0.05 are the same (section II).",
                         decide(Interval(1.0), left, Strictness::weak),
                         "Without a signal, x1 = x2 = y = 0, the innovation is 0: after 100 samples " +
                             enclosed(left) +
                             " of the estimated frequency is left with ε = 0.05, all of it with ε = 0.",
                         {}),
          make_statement(
              "example-2/zero-lambda",
              "With λ = 0 noise is rejected worst: x1(t|t) is the measurement, whatever it is, wherever "
              "P(t) has a positive p11.",
              vanishes<3>(
                  [](const std::array<Interval, 3>& at) {
                    const auto& [p11, x1, y] = at;  // times p11 + λ = p11
                    return p11 * x1 + p11 * (y - x1) - p11 * y;
                  },
                  1),
              "K1 = p11/(p11 + 0) = 1: an identity.", {})};
}

}  // namespace

std::vector<Statement> paper_sentences() {
  Biases biases;
  {
    const rigor::UpwardRounding upward;
    const auto leaking = example_1("0.05");
    const auto at = [&](const Interval& frequency) { return steady_state_bias(leaking, frequency); };
    biases = {at(rigor::pi() / Interval(6.0)), at(Interval(2.0) * rigor::pi() / Interval(3.0)),
              at(parse_decimal("2.6")), at(parse_decimal("2.8"))};
  }
  const rigor::UpwardRounding upward;
  std::vector<Statement> statements = zero_frequency();
  statements.push_back(mirrored_start());
  for (auto part : {response_statements(), bias_statements(biases), leak_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::single_channel
