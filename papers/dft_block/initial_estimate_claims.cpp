#include <array>
#include <cstddef>
#include <string>

#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/dft_block/thesis_claims.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::conjunction;
using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using theorems::at_least;
using theorems::at_most;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

/// Sums over the bins of products of s_m, its slope and its bend at one offset.
struct EstimatorSums {
  Interval value_value{0.0}, value_slope{0.0}, slope_slope{0.0}, value_bend{0.0}, slope_bend{0.0};

  EstimatorSums(const Interval& offset, int half_width) {
    const Taps taps = enclose_taps(offset, half_width);
    for (std::size_t i = 0; i <= 2 * static_cast<std::size_t>(half_width); ++i) {
      value_value += square(taps.value.at(i));
      value_slope += taps.value.at(i) * taps.slope.at(i);
      slope_slope += square(taps.slope.at(i));
      value_bend += taps.value.at(i) * taps.bend.at(i);
      slope_bend += taps.slope.at(i) * taps.bend.at(i);
    }
  }

  /// The information of the bins on the offset when amplitude and phase are unknown, with the tone's size in
  /// a bin and the variance of each part of a bin 1.
  [[nodiscard]] Interval information() const { return slope_slope - square(value_slope) / value_value; }

  /// The mean of the error over the variance, to second order in the noise, in the same units (G. E. P. Box,
  /// "Bias in nonlinear estimation", 1971, for these means): -(2 C^3 - C V W - 2 C V S + V^2 U)/(2 D^2), D =
  /// V S - C^2, with V, C, S, W and U in the order above.
  [[nodiscard]] Interval bias() const {
    const Interval& v = value_value;
    const Interval& c = value_slope;
    const Interval determinant = v * slope_slope - square(c);
    const Interval two(2.0);
    return -(two * c * square(c) - c * v * value_bend - two * c * v * slope_slope + square(v) * slope_bend) /
           (two * square(determinant));
  }
};

/// L of Table 4.1.
constexpr int kTableWidth = 2;
/// Cells a bin when a range of offsets is covered; a power of two, so that their borders are exact.
constexpr int kCellsPerBin = 256;

/// The hull of a function of the sums over all offsets in [0, last], last in whole 64ths of a bin; the sums
/// and the size of the bias are the same at -offset.
template <typename Function>
Interval over_offsets(double last, Function&& function) {
  Interval result = function(EstimatorSums(Interval(0.0), kTableWidth));
  for (int i = 0; static_cast<double>(i) < last * kCellsPerBin; ++i) {
    const Interval cell = Interval::from_bounds(static_cast<double>(i) / kCellsPerBin,
                                                static_cast<double>(i + 1) / kCellsPerBin);
    result = hull(result, function(EstimatorSums(cell, kTableWidth)));
  }
  return result;
}

/// 3 information/pi^2: of that in all samples of a long block, the bins of every m together, where the sum of
/// the squared slopes is pi^2/3 and the other two are 1 and 0.
Interval efficiency(const EstimatorSums& sums) {
  return Interval(3.0) * sums.information() / square(rigor::pi());
}

Statement noiseless_statement() {
  const Verdict differ = rigor::vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [j, k, x, y] = at;
        return (j + x) * (k + y) - (k + x) * (j + y) - (j - k) * (y - x);
      },
      1);
  return make_statement("chapter-4/estimator/noiseless",
                        "Without noise (4.35) and (4.36) give offset, amplitude and phase of every tone of "
                        "the model (4.9) with |delta| "
                        "<= L, L >= 1.",
                        differ,
                        "By Cauchy and Schwarz the maximum is where the d_m are a multiple of the tone's: at "
                        "non-integers 1/(j + x) : "
                        "1/(k + x) = 1/(j + y) : 1/(k + y) for two bins leaves (j - k)(y - x) = 0, an "
                        "identity, and at an integer one bin "
                        "alone is not 0, which distinguishes it from all others.",
                        {});
}

std::vector<Statement> bias_statements() {
  // Bins of a noiseless tone 1.5 bins off: what (4.35) compares, at 1.5 and at the end of the range.
  const Taps tone = enclose_taps(Interval(1.5), kTableWidth);
  const Taps end = enclose_taps(Interval(2.0), kTableWidth);
  Interval at_tone(0.0), product(0.0), weight(0.0), odd(0.0);
  const Taps mirrored = enclose_taps(Interval(-1.5), kTableWidth);
  for (std::size_t i = 0; i <= 2 * static_cast<std::size_t>(kTableWidth); ++i) {
    at_tone += square(tone.value.at(i));
    product += tone.value.at(i) * end.value.at(i);
    weight += square(end.value.at(i));
    odd = rigor::max(
        odd, abs(tone.value.at(i) - mirrored.value.at(2 * static_cast<std::size_t>(kTableWidth) - i)));
  }
  const Interval at_end = square(product) / weight;
  constexpr double kInside = 1.421875;
  const Interval bias = over_offsets(kInside, [](const EstimatorSums& sums) { return sums.bias(); });
  const Interval quarter = EstimatorSums(Interval(0.25), kTableWidth).bias();
  return {make_statement(
              "chapter-4/estimator/unbiased",
              "For constant delta the estimator (4.35) is unbiased (section 4.5.2), for every |delta| <= L.",
              decide(at_tone, at_end, Strictness::weak),
              "delta = L = 2: no estimate is above 2. With the bins of a tone at 1.5 the sum in (4.35) is " +
                  enclosed(at_tone) + " at 1.5 and " + enclosed(at_end) +
                  " at 2, and so for all bins near them, which Gaussian noise of any variance reaches: the "
                  "mean of the estimate is below 2.",
              {}),
          make_statement(
              "chapter-4/estimator/unbiased-middle", "At delta = 0 it is unbiased, at every noise level.",
              decide(odd, Interval(1e-9), Strictness::weak),
              "d_{M-j}(-delta) is the conjugate of d_{M+j}(delta) (for L = 2 the factors agree to " +
                  enclosed(odd) +
                  " at 1.5): bins mirrored and conjugated, as likely as before, have the estimate mirrored.",
              {}),
          make_statement("chapter-4/estimator/unbiased-inside",
                         "Inside the range its bias vanishes with the variance of the noise: for L = 2 and "
                         "|delta| <= 1.42 it is, to "
                         "second order in the noise, at most 0.2 v bins, v the variance of each part of a "
                         "bin over (rho/2)^2; but not "
                         "0, for instance at delta = 1/4.",
                         conjunction({decide(abs(bias), parse_decimal("0.2"), Strictness::weak),
                                      decide(quarter, Interval(0.0), Strictness::strict)}),
                         "Box's formula in intervals over all offsets: within " + enclosed(bias) + ", and " +
                             enclosed(quarter) + " at 1/4. Set 1 starts with v = 0.01, set 3 with v = 0.98.",
                         {})};
}

std::vector<Statement> efficiency_statements() {
  const EstimatorSums middle(Interval(0.0), kTableWidth);
  const Interval share = efficiency(middle);
  const Interval information =
      over_offsets(2.0, [](const EstimatorSums& sums) { return sums.information(); });
  // (6/pi^2) (1 + 1/4 + ... + 1/L^2).
  Interval sum(0.0);
  std::array<Interval, 3> shares;
  Interval apart(0.0);
  for (int width = 1; width <= kMostHalfWidth; ++width) {
    sum += Interval(1.0) / Interval(static_cast<double>(width * width));
    const Interval formula = Interval(6.0) * sum / square(rigor::pi());
    apart = rigor::max(apart, abs(formula - efficiency(EstimatorSums(Interval(0.0), width))));
    if (width <= 2) {
      shares.at(static_cast<std::size_t>(width - 1)) = formula;
    }
    shares[2] = formula;
  }
  // v = 2 sigma^2/(T rho^2) at the far end of the sets of Table 4.1.
  const auto least_variance = [&](const char* noise_to_signal) {
    return Interval(2.0) * parse_decimal(noise_to_signal) / Interval(2048.0) / information;
  };
  const Interval first = sqrt(least_variance("10"));
  const Interval third = sqrt(least_variance("1000"));
  return {
      make_statement("chapter-4/estimator/efficient",
                     "With respect to its bins, (4.35) is asymptotically efficient (section 4.5.2): for L = "
                     "2 and every |delta| < 2 "
                     "its variance tends to the Cramer-Rao bound v/i as v falls, i the bins' information.",
                     decide(Interval(0.0), information, Strictness::strict),
                     "It is maximum likelihood in white Gaussian noise, and i, between " +
                         enclosed(information) + ", is positive for every |delta| <= 2.",
                     {}),
      make_statement(
          "chapter-4/estimator/efficient-samples",
          "With respect to the samples of the block, it is asymptotically efficient for L = 2 and every "
          "|delta| < 2.",
          decide(parse_decimal("0.99"), share, Strictness::weak),
          "At delta = 0 the five bins have " + enclosed(share) +
              " of the information that all bins have together.",
          {}),
      make_statement(
          "chapter-4/estimator/efficient-samples-corrected",
          "At delta = 0 its efficiency with respect to the samples of a long block is (6/pi^2) times the sum "
          "of 1/k^2, k = 1 ... L, to nine digits for L <= 8: it tends to 1 as L grows.",
          decide(apart, Interval(1e-9), Strictness::weak),
          enclosed(shares[0]) + " for L = 1, " + enclosed(shares[1]) + " for L = 2, " + enclosed(shares[2]) +
              " for L = 8.",
          {}),
      make_statement("chapter-4/estimator/variance",
                     "The variance of the estimator is relatively large (section 4.5.3): at the far range of "
                     "set 3 no unbiased "
                     "estimate of delta from the bins of one block has a standard error below 0.5 bins, for "
                     "L = 2, |delta| <= 2.",
                     decide(parse_decimal("0.5"), third, Strictness::weak),
                     "The Cramer-Rao bound is " + at_least(third) + " bins there at least, and " +
                         at_least(first) + " to " + at_most(first) + " bins at the far range of set 1.",
                     {})};
}

}  // namespace

std::vector<Statement> initial_estimate_claims() {
  std::vector<Statement> statements{noiseless_statement()};
  for (auto part : {bias_statements(), efficiency_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::dft_block
