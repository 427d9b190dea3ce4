#include <array>
#include <cstddef>
#include <string>

#include "analysis/dft_block/block_map.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/dft_block/thesis_claims.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

using GramMatrix = rigor::IntervalMatrix<3>;
using OutputDual = rigor::Dual<Interval, 3>;

/// L of Table 4.1, and a phase.
constexpr int kHalf = 2;
constexpr double kPhase = 0.5;
const std::string kDigits = ", to nine digits";

Interval nine_digits() {
  return Interval(1e-9);
}

/// H'H of one block, from the derivatives of h = 2 pi x1^2 s_m(x3) e^{j (x2 + pi x3)}: (4.9) without a case
/// distinction at integers.
GramMatrix information_of(double root_amplitude, double offset) {
  std::array<OutputDual, 3> x;
  const std::array<double, 3> at{root_amplitude, kPhase, offset};
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<Interval, 3> direction{Interval(0.0), Interval(0.0), Interval(0.0)};
    direction.at(i) = Interval(1.0);
    x.at(i) = {Interval(at.at(i)), direction};
  }
  const auto taps = block_taps(x[2], kHalf);
  const OutputDual middle = x[1] + OutputDual(rigor::pi()) * x[2];
  const OutputDual size = OutputDual(Interval(2.0) * rigor::pi()) * x[0] * x[0];
  GramMatrix sum = GramMatrix::Constant(Interval(0.0));
  for (const OutputDual& tap : taps.value) {
    for (const OutputDual& part : {size * tap * cos(middle), size * tap * sin(middle)}) {
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
          sum(i, k) += part.derivative(i) * part.derivative(k);
        }
      }
    }
  }
  return sum;
}

/// (4.25) over two blocks, R = I, no leak: `now` and the block before, moved by F^-1.
GramMatrix two_blocks(const GramMatrix& now, const GramMatrix& before) {
  GramMatrix back = GramMatrix::Constant(Interval(0.0));
  back(0, 0) = back(1, 1) = back(2, 2) = Interval(1.0);
  back(1, 2) = Interval(-2.0) * rigor::pi();
  return now + back.transpose() * before * back;
}

/// diag(16 pi^2 x1^2, 4 pi^2 x1^4, 0): H'H with the zeros of section 4.3.
GramMatrix information_with_zeros(double root_amplitude) {
  const Interval x1(root_amplitude);
  GramMatrix result = GramMatrix::Constant(Interval(0.0));
  result(0, 0) = Interval(16.0) * square(rigor::pi()) * square(x1);
  result(1, 1) = Interval(4.0) * square(rigor::pi()) * square(square(x1));
  return result;
}

/// (4.26) with `cross` and `last` in place of its 8 pi^2 and 16 pi^3.
GramMatrix printed_gramian(double now, double before, const Interval& cross, const Interval& last) {
  GramMatrix result = information_with_zeros(now) + information_with_zeros(before);
  const Interval power = square(square(Interval(before)));
  result(1, 2) = result(2, 1) = -(cross * power);
  result(2, 2) = last * power;
  return result;
}

/// Ours: H'H of a block at an integer offset is known in closed form.
GramMatrix gramian_at_integer(double now, double before, int offset) {
  Interval slopes(0.0);  // the sum of 1/d^2 over the bins that are not the tone's
  for (int m = -kHalf; m <= kHalf; ++m) {
    const Interval d(static_cast<double>(m + offset));
    if (m + offset != 0) {
      slopes += Interval(1.0) / square(d);
    }
  }
  GramMatrix result = information_with_zeros(now) + information_with_zeros(before);
  const Interval pi_squared = square(rigor::pi());
  const Interval recent = square(square(Interval(now)));
  const Interval late = square(square(Interval(before)));
  result(1, 2) = result(2, 1) = Interval(4.0) * rigor::pi() * pi_squared * (recent - late);
  result(2, 2) = Interval(4.0) * pi_squared * (pi_squared + slopes) * (recent + late);
  return result;
}

Interval largest_entry(const GramMatrix& matrix) {
  Interval largest(0.0);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      largest = rigor::max(largest, abs(matrix(i, k)));
    }
  }
  return largest;
}

Interval gram_determinant(const GramMatrix& o) {
  return o(0, 0) * (o(1, 1) * o(2, 2) - o(1, 2) * o(2, 1)) -
         o(0, 1) * (o(1, 0) * o(2, 2) - o(1, 2) * o(2, 0)) +
         o(0, 2) * (o(1, 0) * o(2, 1) - o(1, 1) * o(2, 0));
}

std::vector<Statement> gramian_statements() {
  constexpr double kNow = 1.0;
  constexpr double kBefore = 0.5;
  const Interval eight_pi_2 = Interval(8.0) * square(rigor::pi());
  const Interval sixteen_pi_3 = Interval(16.0) * square(rigor::pi()) * rigor::pi();
  const GramMatrix printed = printed_gramian(kNow, kBefore, eight_pi_2, sixteen_pi_3);
  const GramMatrix from_zeros = two_blocks(information_with_zeros(kNow), information_with_zeros(kBefore));
  const GramMatrix with_pi =
      printed_gramian(kNow, kBefore, eight_pi_2 * rigor::pi(), sixteen_pi_3 * rigor::pi());
  const GramMatrix actual = two_blocks(information_of(kNow, 0.0), information_of(kBefore, 0.0));
  Interval off(0.0);
  Interval least_slopes(1e9);
  for (int offset = -kHalf; offset <= kHalf; ++offset) {
    const double at = offset;
    off = rigor::max(
        off, largest_entry(GramMatrix(two_blocks(information_of(kNow, at), information_of(kBefore, at)) -
                                      gramian_at_integer(kNow, kBefore, offset))));
    // det (H'H) of one block is 256 pi^6 x1^10 times the sum of the squared slopes.
    const Interval determinant = gram_determinant(information_of(kNow, at));
    least_slopes =
        rigor::min(least_slopes, determinant / (Interval(256.0) * square(rigor::pi() * square(rigor::pi()))));
  }
  const std::string blocks = "x1(k) = 1, x1(k-1) = 1/2, L = 2, R = I, no leak";
  return {
      make_statement(
          "chapter-4/gramian/as-printed", "At an integer offset (4.26) is the observability Gramian (4.25).",
          decide(largest_entry(GramMatrix(actual - printed)), nine_digits(), Strictness::weak),
          blocks + ", offset 0: its entry (2, 3) is " + enclosed(actual(1, 2)) + ", that of (4.26) is " +
              enclosed(printed(1, 2)) +
              ", which leaves out the third column of H: it is not zero (chapter-4/integer-offset).",
          {}),
      make_statement("chapter-4/gramian/from-zeros",
                     "(4.26) follows from (4.25) with the zeros that section 4.3 has in H.",
                     decide(largest_entry(GramMatrix(from_zeros - printed)), nine_digits(), Strictness::weak),
                     blocks +
                         ": (4.25) has 8 pi^3 and 16 pi^4 times x1(k-1)^4 in the third column, (4.26) has 8 "
                         "pi^2 and 16 pi^3; the entry (3, 3) is " +
                         enclosed(from_zeros(2, 2)) + " against " + enclosed(printed(2, 2)) + ".",
                     {}),
      make_statement(
          "chapter-4/gramian/from-zeros-corrected",
          "With 8 pi^3 and 16 pi^4 in place of 8 pi^2 and 16 pi^3 it does, for " + blocks + kDigits + ".",
          decide(largest_entry(GramMatrix(from_zeros - with_pi)), nine_digits(), Strictness::weak),
          "The entries differ by " + enclosed(largest_entry(GramMatrix(from_zeros - with_pi))) + " at most.",
          {}),
      make_statement(
          "chapter-4/gramian/corrected",
          "At an integer offset (4.25) over two blocks without leak has the first row and the entry (2, 2) "
          "of (4.26), "
          "(2, 3) = 4 pi^3 (x1(k)^4 - x1(k-1)^4) and (3, 3) = 4 pi^2 (pi^2 + s)(x1(k)^4 + x1(k-1)^4), s the "
          "sum of "
          "1/d^2 over the other bins, d off: for " +
              blocks + ", every integer |x3| <= 2" + kDigits + ".",
          decide(off, nine_digits(), Strictness::weak),
          "The entries differ by " + enclosed(off) + " at most from those by the derivatives of (4.9).", {}),
      make_statement(
          "chapter-4/gramian/rank",
          "At an integer offset, if x1 is not 0, the Gramian has full rank (section 4.3.1): one block is "
          "enough, for L = 2, x1 = 1.",
          decide(Interval(1.0), least_slopes, Strictness::weak),
          "det H'H is 256 pi^6 x1^10 s, s the sum of 1/d^2 over the other bins, at least " +
              enclosed(Interval(least_slopes.lower())) + " for |x3| <= 2, and at least 1 for every L >= 1.",
          {})};
}

/// O = J + F^-T J F^-1 of one bin, J = u u' + w w', u = (2a, 0, x b), w = (0, x a, 0), in the frame of the
/// phase in the middle of the block: a and b are sinc and its slope, x is x1, f is 2 pi.
Interval one_bin_determinant(const std::array<Interval, 4>& at) {
  const auto& [a, b, x, f] = at;
  const std::array<std::array<Interval, 3>, 4> vectors{{{Interval(2.0) * a, Interval(0.0), x * b},
                                                        {Interval(0.0), x * a, Interval(0.0)},
                                                        {Interval(2.0) * a, Interval(0.0), x * b},
                                                        {Interval(0.0), x * a, -(f * x * a)}}};
  GramMatrix o = GramMatrix::Constant(Interval(0.0));
  for (const auto& vector : vectors) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        o(i, k) += vector.at(static_cast<std::size_t>(i)) * vector.at(static_cast<std::size_t>(k));
      }
    }
  }
  return gram_determinant(o);
}

Statement one_pair_statement() {
  const Verdict one_bin = rigor::vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [a, b, x, f] = at;
        return one_bin_determinant(at) - Interval(8.0) * pow(a, 6) * pow(x, 4) * square(f);
      },
      8);
  return make_statement(
      "chapter-4/observability/one-pair",
      "One pair of outputs is enough (section 4.3.1): at a non-integer offset, x1 not 0, no leak, any "
      "one "
      "bin makes the linearised system observable over two blocks.",
      one_bin,
      "With R = I the Gramian of a bin has the determinant 8 a^6 x1^4 (2 pi)^2 (2 pi x1)^6, a = "
      "sin(pi d)/(pi d): an identity in a, its slope, x1 and 2 pi, before the factor (2 pi x1)^6.",
      {});
}

}  // namespace

std::vector<Statement> observability_claims() {
  std::vector<Statement> statements = gramian_statements();
  statements.push_back(one_pair_statement());
  return statements;
}

}  // namespace veritrack::dft_block
