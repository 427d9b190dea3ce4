#include "papers/claims/spill_over_claims.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/claims/pendulum_horseshoe.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::vanishes;
using rigor::Verdict;

/// 2^31 - 1.
constexpr std::uint64_t kPrime = 2147483647;

std::uint64_t inverse(std::uint64_t value) {
  std::uint64_t result = 1;
  for (std::uint64_t exponent = kPrime - 2; exponent > 0; exponent /= 2) {
    result = exponent % 2 == 1 ? result * value % kPrime : result;
    value = value * value % kPrime;
  }
  return result;
}

/// The rank over the field of kPrime elements, which is at most that over the rationals.
std::size_t rank_of(std::vector<std::vector<std::uint64_t>> rows) {
  std::size_t rank = 0;
  for (std::size_t column = 0; rank < rows.size() && column < rows.front().size(); ++column) {
    std::size_t pivot = rank;
    while (pivot < rows.size() && rows[pivot][column] == 0) {
      ++pivot;
    }
    if (pivot == rows.size()) {
      continue;
    }
    std::swap(rows[rank], rows[pivot]);
    const std::uint64_t scale = inverse(rows[rank][column]);
    for (std::size_t below = rank + 1; below < rows.size(); ++below) {
      const std::uint64_t factor = kPrime - rows[below][column] * scale % kPrime;
      for (std::size_t i = column; i < rows[below].size(); ++i) {
        rows[below][i] = (rows[below][i] + factor * rows[rank][i]) % kPrime;
      }
    }
    ++rank;
  }
  return rank;
}

std::vector<Statement> median_statements() {
  constexpr std::size_t kLargest = 9;
  std::vector<Verdict> verdicts;
  for (std::size_t window = 1; window <= kLargest; ++window) {
    verdicts.push_back(medians_are_a_basis(window));
  }
  return {make_statement(
      "sam/class",
      "The class of subset averaged median filters is that of the threshold Boolean filters with f(x) + f(1 "
      "- x) the "
      "same for all x and f(0) = 0 (extended self-dual), for windows of 1 to 9 inputs.",
      rigor::conjunction(verdicts),
      "Medians are such filters, their space has 2^(N-1) dimensions, one for every pair x, 1 - x, and the "
      "medians of the "
      "2^(N-1) odd subsets have full rank modulo 2^31 - 1, hence over the rationals: the weights are unique.",
      {})};
}

std::vector<Statement> pendulum_statements() {
  const Interval damping = parse_decimal("0.2");
  // x' = y, y' = -b y - sin x, E = y^2/2 + 1 - cos x, by y, sin x and b.
  const Verdict dissipates = vanishes<3>(
      [](const std::array<Interval, 3>& at) {
        const auto& [y, sine, b] = at;
        return y * (-(b * y) - sine) + sine * y + b * square(y);
      },
      2);
  // The characteristic polynomial at rest is t^2 + b t + cos 0.
  const Verdict is_stable =
      rigor::conjunction({decide(Interval(0.0), damping, Strictness::strict),
                          decide(Interval(0.0), rigor::cos(Interval(0.0)), Strictness::strict)});
  const Interval energy = Interval(1.0) - rigor::cos(Interval(0.0));
  long boxes = 0;
  const Verdict horseshoe = has_horseshoe(&boxes);
  return {
      make_statement(
          "pendulum/capture",
          "A choice of the impulses suppresses chaos: with g_k = h from some impulse on, every state with "
          "y^2/2 + 1 - cos x < 2 is driven to the "
          "equilibrium 0 (modulo a turn), for every b > 0.",
          rigor::conjunction({dissipates, decide(energy, Interval(2.0), Strictness::strict)}),
          "The impulses vanish; the energy E = y^2/2 + 1 - cos x has E' = -b y^2, an identity: below 2 the "
          "state stays in one well, in which only the equilibrium has y = 0 for ever (LaSalle). Not every "
          "state is: (pi, 0) stays.",
          {}),
      make_statement("pendulum/exponential",
                     "There the controlled pendulum with b = 0.2 is exponentially stable at 0.", is_stable,
                     "The linearisation has t^2 + b t + 1, with positive coefficients.", {}),
      make_statement("pendulum/chaos",
                     "At b = 0.2, h = 2, tau = 4.32 the pendulum is chaotic (Figure 1): its state from "
                     "impulse to impulse has a "
                     "topological entropy of at least log 2.",
                     horseshoe,
                     horseshoe == Verdict::proved
                         ? "Covering relations by verified integration (" + std::to_string(boxes) +
                               " boxes of starts): the images of two parts of a parallelogram about (4.4375, "
                               "-1.4351) cross it "
                               "and its mirror image from end to end."
                         : "The covering relations are not verified.",
                     {})};
}

}  // namespace

Verdict medians_are_a_basis(std::size_t window) {
  constexpr std::size_t kLargest = 12;
  if (window == 0 || window > kLargest) {
    throw std::invalid_argument("the medians are compared for windows of 1 to 12 inputs");
  }
  const std::uint32_t all = 1U << window;
  std::vector<std::vector<std::uint64_t>> rows;
  for (std::uint32_t subset = 1; subset < all; ++subset) {
    if (std::popcount(subset) % 2 == 0) {
      continue;
    }
    // The median of the threshold signals in which the last input is 1; f(1 - x) = 1 - f(x) has the others.
    std::vector<std::uint64_t> row;
    for (std::uint32_t inputs = all / 2; inputs < all; ++inputs) {
      row.push_back(2 * std::popcount(inputs & subset) > std::popcount(subset) ? 1 : 0);
    }
    rows.push_back(std::move(row));
  }
  return rank_of(std::move(rows)) == std::size_t{1} << (window - 1) ? Verdict::proved : Verdict::undecided;
}

std::vector<Statement> spill_over_claims() {
  std::vector<Statement> statements = median_statements();
  for (Statement& statement : pendulum_statements()) {
    statements.push_back(std::move(statement));
  }
  return statements;
}

}  // namespace veritrack::theorems
