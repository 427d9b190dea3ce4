#include <array>
#include <cstddef>
#include <string>

#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/dft_block/thesis_claims.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::conjunction;
using rigor::Interval;
using rigor::Verdict;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

/// L of Table 4.1.
constexpr int kBinsAside = 2;
const std::string kNineDigits = ", to nine digits";

std::vector<Statement> row_statements() {
  constexpr int kTableCentre = 300;
  // At each integer offset, outputs over 2 pi x1^2: s_m.
  Interval largest_zero(0.0);
  Interval least_other(1.0);
  for (int offset = -kBinsAside; offset <= kBinsAside; ++offset) {
    const Taps taps = enclose_taps(Interval(static_cast<double>(offset)), kBinsAside);
    for (int row = 1; row <= 2 * kBinsAside + 1; ++row) {
      // Row i is bin M - L - 1 + i, of which M - m is L + 1 - i: m = M + offset is row L + 1 + offset.
      const Interval size = abs(taps.value.at(static_cast<std::size_t>(2 * kBinsAside + 1 - row)));
      if (row == kBinsAside + 1 + offset) {
        least_other = rigor::min(least_other, size);
      } else {
        largest_zero = rigor::max(largest_zero, size);
      }
    }
  }
  return {
      make_statement(
          "chapter-4/zero-rows/printed",
          "At an integer offset the two outputs that are not zero, and the two rows of H, are number M "
          "+ x3 and 2L + 1 further (sections 4.2.2 and 4.3).",
          decide(Interval(static_cast<double>(kTableCentre + 1)),
                 Interval(static_cast<double>(2 * (2 * kBinsAside + 1))), Strictness::weak),
          "M = 300, L = 2, x3 = 1: there are 10 outputs, and none has the number 301. That is the bin.", {}),
      make_statement(
          "chapter-4/zero-rows/corrected",
          "They are number L + 1 + x3 and 2L + 1 further, for L = 2 and every integer |x3| <= 2" +
              kNineDigits + ".",
          conjunction({decide(largest_zero, Interval(1e-9), Strictness::weak),
                       decide(abs(least_other - Interval(1.0)), Interval(1e-9), Strictness::weak)}),
          "In units of 2 pi x1^2 the bin L + 1 + x3 has the size " + enclosed(least_other) +
              ", every other at most " + enclosed(largest_zero) + ".",
          {})};
}

std::vector<Statement> output_statements() {
  const Verdict sizes = rigor::vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [sa, ca, s, c] = at;  // of x2, and of 2 pi x3
        const Interval real = (sa * c + ca * s) - sa;
        const Interval imaginary = ca - (ca * c - sa * s);
        return square(real) + square(imaginary) - (sa * sa + ca * ca) * (s * s + square(Interval(1.0) - c));
      },
      4);
  const Interval root(0.75);
  return {
      make_statement(
          "chapter-4/observability/zero-outputs",
          "A bin (4.27), (4.28) at a non-integer offset is zero only if x1 = 0 (section 4.3.1).", sizes,
          "Its squared size is x1^4 (sin^2(2 pi x3) + (1 - cos(2 pi x3))^2)/d^2, an identity; the bracket "
          "is 0 at integers only.",
          {}),
      make_statement("chapter-4/observability/zero-state",
                     "(4.11) and (4.15) are observable if the zero state is the only one with outputs that "
                     "are zero for ever "
                     "(section 4.3.1), so that these outputs determine the state.",
                     decide(abs(square(root) - square(-root)), Interval(0.0), Strictness::strict),
                     "h is even in x1: (0.75, x2, x3) and (-0.75, x2, x3) give the same outputs in every "
                     "block, none of them "
                     "zero at a non-integer x3. For the linearised system the criterion is right.",
                     {})};
}

std::vector<Statement> ambiguity_statements() {
  constexpr int kLength = 2048;
  // |Y_M| over x1^2: 2 |sin(pi x3)|/x3.
  const auto size = [](double offset) {
    return Interval(2.0) * abs(sin(rigor::pi() * Interval(offset))) / Interval(offset);
  };
  const Interval near = size(0.25);
  const Interval far = size(0.25 + kLength);
  Interval off(0.0);
  constexpr int kShort = 64;
  for (int t = 0; t < kShort; ++t) {
    const Interval turns = Interval(2.0) * rigor::pi() * Interval(static_cast<double>(t) / kShort);
    const Interval offset(16.25);
    const Interval phase(0.5);
    off = rigor::max(off, abs(cos(turns * offset + phase) -
                              cos(turns * (offset + Interval(static_cast<double>(kShort))) + phase)));
    off = rigor::max(
        off, abs(cos(turns * offset + phase) - cos(turns * offset + phase + Interval(2.0) * rigor::pi())));
  }
  // x1+ = x1 - p 8 pi^2 x1 (c + x1^2)/(r + 16 pi^2 p x1^2) for P = diag(p, 0, 0), offset 0, and bins of the
  // amplitude c and the opposite phase.
  const Interval pi_squared = square(rigor::pi());
  const Interval updated =
      Interval(1.0) - Interval(24.0) * pi_squared / (Interval(1.0) + Interval(16.0) * pi_squared);
  return {
      make_statement(
          "chapter-4/ambiguity/printed",
          "In the model (4.11), (4.15) phase and discrete frequency are ambiguous modulo 2 pi (section "
          "4.3.1): an offset of T bins more, 2 pi rad/sample, gives the same outputs.",
          decide(abs(near - far), Interval(1e-9), Strictness::weak),
          "T = 2048, x3 = 0.25, bin M: the outputs of (4.9) have the size " + enclosed(near) + " and " +
              enclosed(far) + " times x1^2. Only the phase is ambiguous.",
          {}),
      make_statement("chapter-4/ambiguity/corrected",
                     "The samples (4.1), and so their transform (4.5), have this ambiguity: 2 pi rad/sample "
                     "more, or a phase of 2 pi more, change nothing, for T = 64" +
                         kNineDigits + ".",
                     decide(off, Interval(1e-9), Strictness::weak),
                     "The samples differ by " + enclosed(off) + " at most.", {}),
      make_statement(
          "chapter-4/square-root/amplitude",
          "The square root in (4.12) keeps the estimated amplitude, 4 pi x1^2, from being negative.",
          rigor::certainly_not_negative(square(Interval::from_bounds(-1.0, 1.0))) ? Verdict::proved
                                                                                  : Verdict::undecided,
          "It is a square, whatever the filter makes of x1.", {}),
      make_statement(
          "chapter-4/square-root/root", "It keeps the estimate of x1 from being negative, too.",
          decide(Interval(0.0), updated, Strictness::weak),
          "Prediction x1 = 1 at offset 0, P = diag(1, 0, 0), R = I, and bins of a tone with x1^2 = 2 and the "
          "opposite phase: the updated x1 is " +
              enclosed(updated) + ". Since h is even in x1 this does no harm.",
          {})};
}

}  // namespace

std::vector<Statement> model_output_claims() {
  std::vector<Statement> statements = row_statements();
  for (auto part : {output_statements(), ambiguity_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::dft_block
