#include "papers/claims/sine_listing_claims.hpp"

#include <array>
#include <string>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::vanishes;
using rigor::Verdict;
using InTime = rigor::Dual<Interval, 1>;

/// Is `entry` (T) an antiderivative of `integrand` (T) that is 0 at T = 0? Both polynomials of degree 3 at
/// most.
Verdict integrates(InTime (*entry)(const InTime&), Interval (*integrand)(const Interval&)) {
  const Verdict slope = vanishes<1>(
      [&](const std::array<Interval, 1>& at) {
        return entry(InTime(at[0], {Interval(1.0)})).derivative(0) - integrand(at[0]);
      },
      3);
  const bool starts_at_zero = entry(InTime(Interval(0.0))).value() == Interval(0.0);
  return starts_at_zero ? slope : Verdict::undecided;
}

/// The integral of tau^2, three times; of tau, twice; of 1.
Verdict all_integrals() {
  return rigor::conjunction(
      {integrates([](const InTime& t) { return t * t * t; },
                  [](const Interval& t) { return Interval(3.0) * square(t); }),
       integrates([](const InTime& t) { return t * t; }, [](const Interval& t) { return Interval(2.0) * t; }),
       integrates([](const InTime& t) { return t; }, [](const Interval&) { return Interval(1.0); })});
}

Verdict rounds_to(const char* printed, const Interval& value) {
  return decide(abs(parse_decimal(printed) - value), parse_decimal("0.0005"), Strictness::weak);
}

std::vector<Statement> derived_matrices() {
  const Verdict integrals = all_integrals();
  const Interval third = Interval(1.0) / Interval(3.0);
  const Verdict semigroup = vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [t, s] = at;  // the entry (1, 2) of (I + F t)(I + F s)
        return Interval(1.0) * s + t * Interval(1.0) - (t + s);
      },
      1);
  const Verdict oscillator = vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        using Number = rigor::Dual<Interval, 2>;
        const Number x(at[0], {Interval(1.0), Interval(0.0)});
        const Number omega(at[1], {Interval(0.0), Interval(1.0)});
        const Number acceleration = -(omega * omega * x);
        return square(acceleration.derivative(0) + square(at[1])) +
               square(acceleration.derivative(1) + Interval(2.0) * at[1] * at[0]);
      },
      4);
  const std::string integral =
      "The integrals of 1, tau and tau^2 over a sample are TS, TS^2/2 and TS^3/3: an identity of their "
      "slopes.";
  return {make_statement("zarchan/matrices/transition",
                         "The fundamental matrix of the filters with the phase is exact, with two terms.",
                         semigroup, "F^2 = 0, so that (I + F t)(I + F s) = I + F (t + s), an identity.", {}),
          make_statement(
              "zarchan/matrices/phase-noise",
              "The discrete process noise of the filters with the phase, with TS^3/3, TS^2/2 and TS, is "
              "the integral that is given.",
              integrals, integral, {}),
          make_statement("zarchan/matrices/oscillator-noise",
                         "The discrete process noise of the filter of (x, x', omega), with 1.333 TS^3, TS^2 "
                         "and TS, is the integral that "
                         "is given, to the printed digits.",
                         rigor::conjunction({integrals, rounds_to("1.333", Interval(4.0) * third)}), integral,
                         {}),
          make_statement("zarchan/matrices/square-noise",
                         "The discrete process noise of the filter of (x, x', z), with .333 TS^3, .5 TS^2 "
                         "and TS, is the integral that is "
                         "given, to the printed digits.",
                         rigor::conjunction({integrals, rounds_to("0.333", third)}), integral, {}),
          make_statement("zarchan/matrices/oscillator-jacobian",
                         "The second row of F of the filter of (x, x', omega) is (-omega^2, 0, -2 omega x).",
                         oscillator, "The derivatives of -omega^2 x, an identity.", {})};
}

std::vector<Statement> listings() {
  const Interval sample = parse_decimal("0.1");
  const Interval derived = parse_decimal("0.5") * square(sample);
  const Interval cube = sample * square(sample) / Interval(3.0);
  return {make_statement("zarchan/listings/second",
                         "Q(1,2) of the second listing is that of its derivation, per unit of PHIS, to nine "
                         "digits.",
                         decide(abs(-derived - derived), Interval(1e-9), Strictness::weak),
                         "At TS = 0.1 the listing has " + enclosed(-derived) + ", the derivation " +
                             enclosed(derived) + ". The listing runs with PHIS = 0.",
                         {}),
          make_statement("zarchan/listings/fourth",
                         "Q(2,2) of the fourth listing is that of its derivation, per unit of PHIS, to nine "
                         "digits.",
                         decide(abs(square(sample) / Interval(3.0) - cube), Interval(1e-9), Strictness::weak),
                         "At TS = 0.1 and x = 1 the listing, with TS^2, has " +
                             enclosed(square(sample) / Interval(3.0)) + ", the derivation, with TS^3, " +
                             enclosed(cube) + ". The listing runs with PHIS = 0.",
                         {})};
}

}  // namespace

std::vector<Statement> sine_listing_claims() {
  std::vector<Statement> statements = derived_matrices();
  for (Statement& statement : listings()) {
    statements.push_back(std::move(statement));
  }
  return statements;
}

}  // namespace veritrack::theorems
