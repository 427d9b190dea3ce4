#include <array>
#include <optional>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/claims/design_paper_claims.hpp"
#include "papers/claims/steady_loop.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::vanishes;
using rigor::Verdict;

/// The linear loop of Q = q I, R = r I; one of empty intervals, which decide nothing, when it was not
/// verified.
SteadyLoop loop_of(const char* q, const char* epsilon, const char* r) {
  const auto loop =
      steady_loop({parse_decimal(q), parse_decimal(q), parse_decimal(r), parse_decimal(epsilon)});
  return loop.value_or(SteadyLoop{});
}

/// The four designs of the figures.
struct Figures {
  SteadyLoop figure_1 = loop_of("0.0005", "0.05", "0.01");
  SteadyLoop figure_3 = loop_of("0.0065", "0.05", "0.01");
  SteadyLoop figure_4 = loop_of("0.0013", "0.01", "0.01");
  SteadyLoop figure_5 = loop_of("0.0023", "0.01", "0.05");
};

/// Do Q times t, R times t and P times t leave the gain as it is, and P times t afterwards?
Verdict is_scaled() {
  return vanishes<5>(
      [](const std::array<Interval, 5>& at) {
        const auto& [a, b, c, r, t] = at;
        const Interval sum = a + r;
        const Interval scaled = t * a + t * r;
        // Gains, and the three entries of the updated covariance, each multiplied by both sums.
        const std::array<Interval, 5> differences{
            t * a * sum - a * scaled, t * b * sum - b * scaled, t * a * (t * r) * sum - t * (a * r) * scaled,
            t * b * (t * r) * sum - t * (b * r) * scaled,
            (t * c * scaled - square(t * b)) * sum - t * (c * sum - square(b)) * scaled};
        Interval total(0.0);
        for (const Interval& each : differences) {
          total += square(each);
        }
        return total;
      },
      4);
}

Verdict both_less(const SteadyLoop& one, const SteadyLoop& other) {
  return rigor::conjunction({decide(one.phase_gain(), other.phase_gain(), Strictness::strict),
                             decide(one.frequency_gain(), other.frequency_gain(), Strictness::strict)});
}

std::string gain_words(const std::string& of, const SteadyLoop& loop) {
  return of + " " + enclosed(loop.phase_gain()) + " of the innovation's phase to the phase and " +
         enclosed(loop.frequency_gain()) + " to the frequency";
}

Interval noise_of(const SteadyLoop& loop) {
  return loop.noise_variance(parse_decimal("0.01"));
}

/// "Under noise of ... the frequency has the variance".
std::string noise_words(const char* first, const SteadyLoop& one, const char* second,
                        const SteadyLoop& other) {
  return std::string("Under noise of variance 0.01 a channel the frequency has the variance ") +
         enclosed(noise_of(one)) + " (rad/sample)^2 " + first + " and " + enclosed(noise_of(other)) + " " +
         second + ".";
}

/// The frequency error while the frequency rises by 0.04 a sample, as it passes 0.5 rad/sample.
Interval error_in_slew(const SteadyLoop& loop) {
  return loop.error_in_ramp(Interval(0.5), parse_decimal("0.04"));
}

std::vector<Statement> choices_of_q(const Figures& of) {
  return {
      make_statement(
          "paper-1996/small-q",
          "A smaller Q makes the gain smaller: both gains are smaller in Figure 1 than in Figure "
          "3, with the same R and leak.",
          both_less(of.figure_1, of.figure_3),
          gain_words("Figure 1 passes on", of.figure_1) + ", " + gain_words("Figure 3", of.figure_3) + ".",
          {}),
      make_statement("paper-1996/large-q",
                     "A large Q makes the estimate fluctuate more: Figure 3 against Figure 1.",
                     decide(noise_of(of.figure_1), noise_of(of.figure_3), Strictness::strict),
                     noise_words("in Figure 1", of.figure_1, "in Figure 3", of.figure_3), {}),
      make_statement("paper-1996/figure-4/noise",
                     "The filter of Figure 4 is less sensitive to noise than that of Figure 3.",
                     decide(noise_of(of.figure_4), noise_of(of.figure_3), Strictness::strict),
                     noise_words("in Figure 4", of.figure_4, "in Figure 3", of.figure_3), {}),
      make_statement(
          "paper-1996/figure-4/tracking",
          "It follows the largest slew as well as that of Figure 3: at 0.5 rad/sample, with the frequency "
          "rising by 0.04 rad/sample a sample, it lags no further behind.",
          decide(error_in_slew(of.figure_4), error_in_slew(of.figure_3), Strictness::weak),
          "To first order the frequency is too low by " + enclosed(error_in_slew(of.figure_4)) +
              " rad/sample in Figure 4 and " + enclosed(error_in_slew(of.figure_3)) + " in Figure 3.",
          {})};
}

std::vector<Statement> choices_of_r(const Figures& of) {
  const SteadyLoop larger = loop_of("0.0013", "0.01", "0.05");
  const bool all_oscillate = of.figure_4.oscillates() && larger.oscillates();
  const Verdict slower =
      all_oscillate ? decide(of.figure_4.squared_factor(), larger.squared_factor(), Strictness::strict)
                    : Verdict::undecided;
  return {
      make_statement(
          "paper-1996/r-lowers-gain",
          "A larger R reduces the gain and the speed of response: R = 0.05 in place of 0.01 with Q "
          "and leak of Figure 4.",
          rigor::conjunction({both_less(larger, of.figure_4), slower}),
          gain_words("R = 0.01 passes on", of.figure_4) + ", " + gain_words("R = 0.05", larger) +
              "; the squared size of the factors by which a sample multiplies errors is " +
              enclosed(of.figure_4.squared_factor()) + " and " + enclosed(larger.squared_factor()) + ".",
          {}),
      make_statement(
          "paper-1996/r-and-variation",
          "R affects how much the estimates vary: less with R = 0.05 than with 0.01, Q and leak of "
          "Figure 4.",
          decide(noise_of(larger), noise_of(of.figure_4), Strictness::strict),
          noise_words("with R = 0.05", larger, "with R = 0.01", of.figure_4), {}),
      make_statement(
          "paper-1996/r-less-critical",
          "The gains react less to R than to Q = q I: a change of R changes them less than the inverse "
          "change "
          "of q does.",
          is_scaled() == Verdict::proved ? Verdict::refuted : Verdict::undecided,
          "Q, R and P times t leave every gain as it is, an identity: R times t does what q/t does. Near the "
          "best ratio q/r the error is flat in both.",
          {}),
      make_statement(
          "paper-1996/slew-by-variance",
          "The largest slew that the tracker follows is determined by q2 and the leak, whatever R: with a "
          "fivefold R, and Q and leak of Figure 4, it lags by the same, to a tenth.",
          decide(error_in_slew(larger), parse_decimal("1.1") * error_in_slew(of.figure_4), Strictness::weak),
          "To first order, as the frequency passes 0.5 rad/sample, rising by 0.04 a sample, the estimate "
          "is " +
              enclosed(error_in_slew(of.figure_4)) + " rad/sample behind with R = 0.01 and " +
              enclosed(error_in_slew(larger)) + " with R = 0.05.",
          {})};
}

std::vector<Statement> figure_5_statements(const Figures& of) {
  const SteadyLoop same_leak = loop_of("0.0023", "0.05", "0.05");
  const Interval figure_1 = of.figure_1.lag(of.figure_1.epsilon);
  const Interval figure_5 = of.figure_5.lag(of.figure_5.epsilon);
  return {
      make_statement("paper-1996/figure-5/noise", "The filter of Figure 5 varies less than that of Figure 4.",
                     decide(noise_of(of.figure_5), noise_of(of.figure_4), Strictness::strict),
                     noise_words("in Figure 5", of.figure_5, "in Figure 4", of.figure_4), {}),
      make_statement(
          "paper-1996/figure-5/over-design",
          "It is Q and R above their actual values that make the filter of Figure 5 better than that of "
          "Figure 1: with the same leak, 0.05, it lags less behind a frequency that rises.",
          decide(error_in_slew(same_leak), error_in_slew(of.figure_1), Strictness::strict),
          "q/r is 0.046 in Figure 5 and 0.05 in Figure 1: at the same leak, as the frequency passes 0.5 "
          "rad/sample, rising by 0.04 a sample, the estimates are " +
              enclosed(error_in_slew(same_leak)) + " and " + enclosed(error_in_slew(of.figure_1)) +
              " rad/sample behind. It is the leak that differs: of a constant frequency it takes the share " +
              enclosed(figure_1) + " in Figure 1 and " + enclosed(figure_5) + " in Figure 5.",
          {})};
}

}  // namespace

std::vector<Statement> design_paper_loop_claims() {
  const Figures figures;
  std::vector<Statement> statements = choices_of_q(figures);
  for (auto part : {choices_of_r(figures), figure_5_statements(figures)}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems
