#include <string>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/dft_block/thesis_claims.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

struct ComplexNumber {
  Interval real{0.0}, imaginary{0.0};

  ComplexNumber& operator+=(const ComplexNumber& other) {
    real += other.real;
    imaginary += other.imaginary;
    return *this;
  }
};

Interval number(int value) {
  return Interval(static_cast<double>(value));
}

Interval size_of(const ComplexNumber& a) {
  return sqrt(square(a.real) + square(a.imaginary));
}

ComplexNumber difference(const ComplexNumber& a, const ComplexNumber& b) {
  return {a.real - b.real, a.imaginary - b.imaginary};
}

/// e^{j 2 pi places/length}.
ComplexNumber turned(int places, int length) {
  const auto [sine, cosine] =
      rigor::sin_cos(Interval(2.0) * rigor::pi() * number(places % length) / number(length));
  return {cosine, sine};
}

/// T times tap i of h_m, as printed and as it should be.
ComplexNumber printed_tap(int bin, int i, int length) {
  return turned(-bin * i, length);
}
ComplexNumber corrected_tap(int bin, int i, int length) {
  return turned(bin * (i + 1), length);
}

/// |sum of taps e^{-j 2 pi bin i/T}|/T: the response of h_m at the frequency of bin m.
template <typename Tap>
Interval response_at_own_bin(Tap&& tap, int bin, int length) {
  ComplexNumber sum;
  for (int i = 0; i < length; ++i) {
    const ComplexNumber a = tap(bin, i, length);
    const ComplexNumber b = turned(-bin * i, length);
    sum += {a.real * b.real - a.imaginary * b.imaginary, a.real * b.imaginary + a.imaginary * b.real};
  }
  return size_of(sum) / number(length);
}

std::vector<Statement> filter_statements() {
  constexpr int kShort = 4;
  constexpr int kLong = 64;
  const Interval nine_digits(1e-9);
  // A sample of 1 at t = 1, T = 4, m = 1: bin and output of the filter at the end of the block.
  const ComplexNumber bin = turned(-1, kShort);
  const ComplexNumber output = printed_tap(1, kShort - 1 - 1, kShort);
  const Interval off = size_of(difference(bin, output)) / number(kShort);
  Interval largest(0.0);
  Interval least_response(1.0);
  for (int m = 0; m < kLong; ++m) {
    for (int t = 0; t < kLong; ++t) {
      const ComplexNumber apart = difference(turned(-m * t, kLong), corrected_tap(m, kLong - 1 - t, kLong));
      largest = rigor::max(largest, size_of(apart));
    }
    least_response = rigor::min(least_response, response_at_own_bin(corrected_tap, m, kLong));
  }
  const Interval printed_response = response_at_own_bin(printed_tap, 1, kShort);
  return {
      make_statement(
          "chapter-4/filter-bank/printed",
          "The filters h_m, with the taps e^{-j 2 pi m i/T}/T, give the transform (4.4) at the end of "
          "each block (section 4.2).",
          decide(off, nine_digits, Strictness::weak),
          "T = 4, m = 1, a sample of 1 at t = 1: the bin is -j/4, the filter gives -1/4, " + enclosed(off) +
              " apart. They give the bin's conjugate, turned by e^{j 2 pi m/T}.",
          {}),
      make_statement(
          "chapter-4/filter-bank/corrected",
          "With the taps e^{j 2 pi m (i + 1)/T}/T they do, for T = 64 and every m, to nine digits.",
          decide(largest, nine_digits, Strictness::weak),
          "Tap by tap, e^{j 2 pi m (T - t)/T} and e^{-j 2 pi m t/T} differ by " + enclosed(largest) +
              " at most.",
          {}),
      make_statement(
          "chapter-4/filter-bank/centre",
          "The main lobe of h_m, with the printed taps, is centred on m/T: it passes a tone there "
          "unchanged in size.",
          decide(abs(printed_response - Interval(1.0)), nine_digits, Strictness::weak),
          "T = 4, m = 1: its gain at 1/4 is " + enclosed(printed_response) + "; the lobe is at -m/T.", {}),
      make_statement("chapter-4/filter-bank/centre-corrected",
                     "With the corrected taps it is, for T = 64 and every m, to nine digits.",
                     decide(abs(least_response - Interval(1.0)), nine_digits, Strictness::weak),
                     "The gain of h_m at m/T is " + enclosed(least_response) + " or more.", {})};
}

/// Table 4.1: T, M and L.
constexpr int kBlockLength = 2048;
constexpr int kCentre = 300;
constexpr int kWidth = 2;

Statement second_term_statement() {
  // sin grows up to the middle of (0, pi), and (M + m + delta)/T is at most 604/2048 there.
  const Interval lowest = rigor::pi() * number(2 * kCentre - 2 * kWidth) / number(kBlockLength);
  const Interval most = Interval(1.0) / (number(2 * kBlockLength) * sin(lowest));
  return make_statement(
      "chapter-4/second-term",
      "The second term of (4.5) may be left out: with T = 2048, M = 300 and L = 2 it is at most "
      "0.00031 of the tone's amplitude in every bin, for |delta| <= 2.",
      decide(most, parse_decimal("0.00031"), Strictness::weak),
      "It is at most rho/(2T |sin(pi (M + m + delta)/T)|), " + enclosed(most) +
          " times rho: of the order 1/T, where section 4.2 has O(1).",
      {});
}

/// Sums over the samples of a block: of cos^2, sin^2 and their product, over T/2.
struct BinNoise {
  Interval real{0.0}, imaginary{0.0}, product{0.0};
};

BinNoise noise_in_a_bin(int bin) {
  BinNoise noise;
  for (int t = 0; t < kBlockLength; ++t) {
    const ComplexNumber phasor = turned(bin * t, kBlockLength);
    noise.real += square(phasor.real);
    noise.imaginary += square(phasor.imaginary);
    noise.product += phasor.real * phasor.imaginary;
  }
  const Interval scale = Interval(1.0) / number(kBlockLength / 2);
  return {noise.real * scale, noise.imaginary * scale, noise.product * scale};
}

std::vector<Statement> noise_statements() {
  const Interval nine_digits(1e-9);
  Interval off(0.0);
  for (int bin = kCentre - kWidth; bin <= kCentre + kWidth; ++bin) {
    const BinNoise noise = noise_in_a_bin(bin);
    for (const Interval& each :
         {noise.real - Interval(1.0), noise.imaginary - Interval(1.0), noise.product}) {
      off = rigor::max(off, abs(each));
    }
  }
  // |sum of e^{-j omega tau}, -T <= tau <= T| <= 1/|sin(omega/2)|, omega = pi/2, T = 2048.
  const Interval density = Interval(1.0) / (sin(rigor::pi() / Interval(4.0)) * number(2 * kBlockLength));
  return {make_statement(
              "chapter-4/spectral-density/printed",
              "(4.10) is the spectral density of the noise: for white noise of variance 1 it is 1 at pi/2 "
              "rad/sample, as (4.32) needs.",
              decide(Interval(1.0), density, Strictness::weak),
              "|sum of e^{-j omega tau}| is at most 1/|sin(omega/2)|, so that the quotient with 2T is at "
              "most " +
                  enclosed(density) +
                  " at T = 2048, and 0 in the limit: (4.10) has the variance where the "
                  "covariance at lag tau is meant, and divides by 2T.",
              {}),
          make_statement(
              "chapter-4/spectral-density/corrected",
              "With S(omega) = sum of e^{-j omega tau} E[e_t e_{t+tau}] (4.30) is right for white noise: S "
              "= sigma^2, and real and imaginary part of a bin have the variance S/(2T), T = 2048, bins 298 "
              "to 302, to nine digits.",
              decide(off, nine_digits, Strictness::weak),
              "(2/T) times the sums of cos^2 and of sin^2 over the block, less 1, are at most " +
                  enclosed(off) + " in size.",
              {}),
          make_statement(
              "chapter-4/noise-in-a-bin",
              "(4.32): white noise makes real and imaginary part of a bin uncorrelated, with the variance "
              "sigma^2/(2T) each, T = 2048, bins 298 to 302, to nine digits.",
              decide(off, nine_digits, Strictness::weak),
              "(2/T) times the sums of cos^2, sin^2 and sin cos over the block differ from 1, 1 and 0 by " +
                  enclosed(off) + " at most. In bins 0 and T/2 it is not so.",
              {})};
}

}  // namespace

std::vector<Statement> filter_bank_claims() {
  std::vector<Statement> statements = filter_statements();
  statements.push_back(second_term_statement());
  for (Statement& statement : noise_statements()) {
    statements.push_back(std::move(statement));
  }
  return statements;
}

}  // namespace veritrack::dft_block
