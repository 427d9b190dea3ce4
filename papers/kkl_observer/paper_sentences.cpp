#include "papers/kkl_observer/paper_sentences.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "analysis/kkl_observer/kkl_error_map.hpp"
#include "analysis/kkl_observer/kkl_identities.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using theorems::decide;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;
using Whole = std::int64_t;

/// det(L'L) of five filters, L = (λ, 1, -ξ), with the rates 0, 1, 2, 3, 4: a polynomial in ξ of degree 2.
Verdict sums_triples() {
  return is_zero_polynomial<5>(
      [](const std::array<Whole, 5>& xi) {
        Whole ll = 0;
        Whole l1 = 0;
        Whole lx = 0;
        Whole ox = 0;
        Whole xx = 0;
        Whole sum = 0;
        for (Whole i = 0; i < 5; ++i) {
          const Whole at_i = xi.at(static_cast<std::size_t>(i));
          ll += i * i;
          l1 += i;
          lx -= i * at_i;
          ox -= at_i;
          xx += at_i * at_i;
          for (Whole j = i + 1; j < 5; ++j) {
            for (Whole k = j + 1; k < 5; ++k) {
              const Whole determinant = at_i * (j - k) + xi.at(static_cast<std::size_t>(j)) * (k - i) +
                                        xi.at(static_cast<std::size_t>(k)) * (i - j);
              sum += determinant * determinant;
            }
          }
        }
        return ll * (5 * xx - ox * ox) - l1 * (l1 * xx - ox * lx) + lx * (l1 * ox - 5 * lx) - sum;
      },
      2);
}

std::vector<Statement> steps_of_the_proof() {
  const Verdict rearranged = is_zero_polynomial<6>(
      [](const std::array<Whole, 6>& p) {
        const auto [rate, x1, x2, x3, a, b] = p;
        return rate * x1 + x2 - (rate * rate + x3) * (a * rate + b) -
               (rate * (x1 - a * x3) + (x2 - b * x3) - rate * rate * rate * a - rate * rate * b);
      },
      3);
  const Verdict mean = is_zero_polynomial<4>(
      [](const std::array<Whole, 4>& p) {
        const auto [xa, xb, sa, sb] = p;  // x1 or x2 of both, x3 of both
        return 2 * (sb * xa - sa * xb) - (xa + xb) * (sb - sa) - (sa + sb) * (xa - xb);
      },
      2);
  const Verdict triples = sums_triples();
  return {
      make_statement(
          "kkl-paper/more-filters",
          "With any number of filters above four, too, γ of (8) inverts T where ell is at most twice the "
          "infimum "
          "of (10), |MT|² being the sum over triples of filters of the squared determinant of (λ, 1, T).",
          rigor::conjunction({triples, rearranged}),
          "That sum is det(L'L) (Cauchy and Binet; exactly for five filters of the rates 0 to 4), and "
          "positive on "
          "T(O_r) as for four: mu = 0, and (15) has x as its only solution.",
          {}),
      make_statement(
          "kkl-paper/vandermonde-step",
          "(16) becomes (17) by the common denominator: its numerator is λ(x1 - a x3) + (x2 - b x3) - λ³ "
          "a - λ² b.",
          rearranged, "A polynomial identity in all six variables, evaluated exactly.", {}),
      make_statement(
          "kkl-paper/ell-positive",
          "ell of (10) is positive, for every compact range of frequencies above 0 and any four or more "
          "distinct rates.",
          rearranged,
          "MT = 0 means T = aλ + b, that is (17) = 0 at every rate: a polynomial of degree 3 with four "
          "zeros, so that a = b = 0 and x1 = x2 = 0, against |T| = 1; and the infimum is that of a "
          "continuous function over a compact set.",
          {}),
      make_statement(
          "kkl-paper/scaling", "ξ in T(O_r) implies aξ in T(O_r) for every a (section IV).",
          decide(Interval(1.0), Interval(0.0), Strictness::weak),
          "a = 0: T = 0 needs x1 = x2 = 0 (two rates, a determinant that is not 0), which O_r excludes. "
          "For a other than 0 it is so, (x1, x2) times a.",
          {}),
      make_statement(
          "kkl-paper/triangle-step",
          "|s_b x_a - s_a x_b| + (s_a + s_b)/2 |x_a - x_b| >= (|x_a| + |x_b|)/2 |s_b - s_a| for s = x3 >= 0 "
          "(section IV).",
          mean,
          "s_b x_a - s_a x_b is (x_a + x_b)/2 (s_b - s_a) + (s_a + s_b)/2 (x_a - x_b), an identity: for "
          "equal signs of x the triangle inequality; for different ones the second term alone is (s_a + "
          "s_b)/2 (|x_a| + |x_b|).",
          {})};
}

/// The squared gain of the filters with the rates 1, 2, 3, 4 at a frequency, rad/s.
Interval squared_gain(const Interval& frequency) {
  Interval sum(0.0);
  for (int rate = 1; rate <= 4; ++rate) {
    sum += Interval(1.0) / (square(Interval(rate)) + square(frequency));
  }
  return sum;
}

std::vector<Statement> bandwidth_statements() {
  const Interval half = squared_gain(Interval(0.0)) / Interval(2.0);
  const Interval low = parse_decimal("1.2");
  const Interval high = parse_decimal("1.3");
  const Verdict between = rigor::conjunction({decide(half, squared_gain(low), Strictness::strict),
                                              decide(squared_gain(high), half, Strictness::strict)});
  return {make_statement(
      "kkl-paper/bandwidth",
      "The bandwidth of the filters of section V is about 1 rad/s: the slowest has half its power at "
      "1 rad/s, all four together between 1.2 and 1.3 rad/s.",
      between,
      "1/(1 + 1) is half of 1/(1 + 0). The sum of squared gains is " + enclosed(squared_gain(low)) +
          " at 1.2 rad/s and " + enclosed(squared_gain(high)) + " at 1.3, half of that at 0 is " +
          enclosed(half) + ".",
      {})};
}

using ErrorMap = KklErrorMap<Interval>;
using InTime = rigor::Dual<Interval, 1>;

/// The relative errors of amplitude and frequency in 2 sin 3t + 0.2 sin Wt, settled.
template <typename Number>
struct RelativeErrors {
  Number frequency, amplitude;
};

/// At this time, s, in phase with both sinusoids.
template <typename Number>
RelativeErrors<Number> relative_errors(const ErrorMap& map, int disturbance, const Number& time) {
  const Number share(parse_decimal("0.1"));
  const Number period(Interval(1.0) / Interval(disturbance));
  const auto signal = map.signal(Number(3.0), Number(Number(3.0) * time));
  const auto response = map.response(signal, period, Number(Number(static_cast<double>(disturbance)) * time));
  ErrorMap::Filters<Number> u;
  for (std::size_t i = 0; i < u.size(); ++i) {
    u.at(i) = share * response.filters.at(i);
  }
  const std::array<Number, 2> y{signal.projected[0] + share * response.projected[0],
                                signal.projected[1] + share * response.projected[1]};
  const Number squared =
      (y[0] * (share * response.pull[0]) + y[1] * (share * response.pull[1])) / ErrorMap::squared_norm(y);
  return {ErrorMap::frequency_error(signal, squared) / Number(3.0), map.amplitude_error(signal, u, squared)};
}

/// The largest over all times, from what some time reaches to what none exceeds. Both sinusoids have the
/// period 2 pi s.
RelativeErrors<Interval> largest_errors(const ErrorMap& map, int disturbance) {
  const int cells = std::max(2000, 64 * disturbance);
  const Interval width = Interval(2.0) * rigor::pi() / Interval(cells);
  // A little more than half a cell to either side of its middle, which is rounded: the cells overlap.
  const Interval reach = width * parse_decimal("0.501");
  const Interval around = hull(-reach, reach);
  RelativeErrors<Interval> below{Interval(0.0), Interval(0.0)};
  RelativeErrors<Interval> above = below;
  for (int k = 0; k <= cells; ++k) {
    const Interval middle(midpoint(width * Interval(k)));
    const auto here = relative_errors(map, disturbance, middle);
    const auto over = relative_errors(map, disturbance, InTime(middle + around, {Interval(1.0)}));
    below = {max(below.frequency, abs(here.frequency)), max(below.amplitude, abs(here.amplitude))};
    above = {max(above.frequency, abs(here.frequency + over.frequency.derivative(0) * around)),
             max(above.amplitude, abs(here.amplitude + over.amplitude.derivative(0) * around))};
  }
  return {Interval::from_bounds(below.frequency.lower(), above.frequency.upper()),
          Interval::from_bounds(below.amplitude.lower(), above.amplitude.upper())};
}

std::vector<Statement> error_statements() {
  const ErrorMap map(rigor::to_interval(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0)));
  std::vector<Statement> statements;
  for (const auto& [disturbance, percent, part] :
       {std::tuple{10, "10 %", "0.1"}, std::tuple{100, "1 %", "0.01"}, std::tuple{1000, "0.1 %", "0.001"}}) {
    const RelativeErrors<Interval> errors = largest_errors(map, disturbance);
    const Interval printed = parse_decimal(part);
    const Interval half = printed / Interval(2.0);
    const Interval twice = Interval(2.0) * printed;
    const Verdict verdict = rigor::conjunction({decide(half, errors.frequency, Strictness::strict),
                                                decide(errors.frequency, twice, Strictness::strict),
                                                decide(half, errors.amplitude, Strictness::strict),
                                                decide(errors.amplitude, twice, Strictness::strict)});
    const std::string at = std::to_string(disturbance);
    statements.push_back(make_statement(
        "kkl-paper/section-v-errors/" + at,
        "At " + at + " rad/s the steady-state errors of amplitude and frequency are about " + percent +
            " (section V): the largest are between half and twice that, with mu = 0 along the run.",
        verdict,
        "The largest error of the frequency is in " + enclosed(errors.frequency) +
            " of 3 rad/s, that of the "
            "amplitude in " +
            enclosed(errors.amplitude) + " of 2.",
        {}));
  }
  return statements;
}

}  // namespace

std::vector<Statement> paper_sentences() {
  const rigor::UpwardRounding upward;
  std::vector<Statement> statements = steps_of_the_proof();
  for (auto part : {bandwidth_statements(), error_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::kkl_observer
