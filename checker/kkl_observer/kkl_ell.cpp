#include "checker/kkl_observer/kkl_ell.hpp"

#include <algorithm>

#include "checker/document/evidence.hpp"
#include "checker/kkl_observer/moves.hpp"
#include "checker/numbers/slope.hpp"

namespace veritrack::checker {

namespace {

/// Four filters, and what of three of them does not depend on the frequency. |M xi|^2 is the sum over triples
/// of filters of det(xi, lambda, 1)^2.
class Excitation {
 public:
  explicit Excitation(const std::vector<Ball>& lambda) {
    std::copy_n(lambda.begin(), kFilters, lambda_.begin());
    for (std::size_t left_out = 0; left_out < kFilters; ++left_out) {
      Filters three;
      std::copy_if(lambda_.begin(), lambda_.end(), three.begin(),
                   [&](const Ball& rate) { return &rate != &lambda_[left_out]; });
      const auto& [a, b, c, unused] = three;
      Triple& triple = triples_[left_out];
      triple.vandermonde = (a - b) * (b - c) * (a - c);
      triple.sum = a + b + c;
      triple.constant = a * b * c - lambda_[left_out] * (a * b + b * c + c * a);
    }
  }

  /// inf |M T(x)|^2 / |T(x)|^2 over the signals of one frequency: T is linear in (x1, x2), so that this is
  /// the smaller eigenvalue of a pencil (seen, length) of 2x2 matrices, each a sum of squares of rows. Of
  /// such matrices det(seen) + z det(mixed) + z^2 det(length) has sums of squares of 2x2 determinants of the
  /// rows. T is (1, lambda) / (lambda^2 + s), and the row of a triple a, b, c is V (Re z, Im z / w) / |z|^2
  /// with V its Vandermonde determinant and z = (a + jw)(b + jw)(c + jw): so the determinants are these
  /// products, in which nothing cancels that is large.
  template <typename S>
  [[nodiscard]] S at(const S& frequency) const {
    const S s = square(frequency);
    std::array<S, kFilters> over;
    S all(one);
    for (std::size_t i = 0; i < kFilters; ++i) {
      over[i] = reciprocal(square(lambda_[i]) + s);
      all = all * over[i];
    }
    S seen(zero);
    S length(zero);
    S mixed(zero);
    for (std::size_t i = 0; i < kFilters; ++i) {
      const Triple& triple = triples_[i];
      // The row of the triple with that of the filter left out, and with those of its own three.
      mixed = mixed + square(triple.vandermonde * (triple.constant + (lambda_[i] - triple.sum) * s) * all);
      for (std::size_t j = 0; j < kFilters; ++j) {
        if (j == i) {
          continue;
        }
        const Ball others = triple.sum - lambda_[j];
        mixed = mixed + square(triple.vandermonde * others * all * (square(lambda_[i]) + s));
        if (j > i) {
          const Ball apart = lambda_[i] - lambda_[j];
          length = length + square(apart * over[i] * over[j]);
          seen = seen + square(triple.vandermonde * triples_[j].vandermonde * apart * all);
        }
      }
    }
    return two * seen / (mixed + sqrt(square(mixed) - four * seen * length));
  }

 private:
  struct Triple {
    Ball vandermonde, sum, constant;
  };
  Filters lambda_;
  std::array<Triple, kFilters> triples_;  ///< by the filter that is left out
};

/// Walks the frequencies.
class Infimum {
 public:
  Infimum(const Excitation& ratio, Ball bound) : ratio_(ratio), bound_(std::move(bound)) {}

  /// True only when the ratio is at least the bound from `low` to `high`.
  [[nodiscard]] bool is_bound(const Ball& low, const Ball& high, int depth) const {
    const Slope ratio = ratio_.at(Slope::variable(Ball::hull(low, high), 0));
    // cannot bind (ratio.along[0]): no rates are known for which the ratio ever rises with the frequency, and
    // where it does not, the upper end of a cell decides. That it never does is not proved: hence the guard.
    const bool falls = certainly_less(ratio.along[0], zero);
    const bool at_end = (falls && at_least(high)) || (certainly_positive(ratio.along[0]) && at_least(low));
    if (certainly_at_most(bound_, ratio.value) || at_end) {
      return true;
    }
    const Ball middle = (half * (low + high)).lower();
    return depth > 0 && is_bound(low, middle, depth - 1) && is_bound(middle, high, depth - 1);
  }

 private:
  [[nodiscard]] bool at_least(const Ball& frequency) const {
    return certainly_at_most(bound_, ratio_.at(frequency));
  }

  const Excitation& ratio_;
  Ball bound_;
};

/// True only when no frequency of [low, high) is a minimizer: the ratio is above `least`, or falls there.
/// With `rises`, none of (low, high]: it is above, or rises.
bool no_minimizer(const Excitation& ratio_of, const Ball& low, const Ball& high, const Ball& least,
                  bool rises, int depth) {
  if (certainly_at_most(high, low)) {
    return true;  // an empty stretch
  }
  const Slope ratio = ratio_of.at(Slope::variable(Ball::hull(low, high), 0));
  if (certainly_less(least, ratio.value) || certainly_positive(rises ? ratio.along[0] : -ratio.along[0])) {
    return true;
  }
  const Ball middle = (half * (low + high)).lower();
  return depth > 0 && no_minimizer(ratio_of, low, middle, least, rises, depth - 1) &&
         no_minimizer(ratio_of, middle, high, least, rises, depth - 1);
}

constexpr int kDepth = 60;

}  // namespace

Ball excitation_ratio(const std::vector<Ball>& lambda, const Ball& frequency) {
  return Excitation(lambda).at(frequency);
}

// The minimum is at least `low` if every cell says so, and at most `high` if one frequency does.
bool is_true(const EllEnclosure& enclosure, const KklDesign& design) {
  const auto& [low, high, attained] = enclosure;
  const bool inside =
      certainly_at_most(design.frequency_low, attained) && certainly_at_most(attained, design.frequency_high);
  const Excitation ratio(design.lambda);
  return inside && certainly_at_most(ratio.at(attained), high) &&
         Infimum(ratio, low).is_bound(design.frequency_low, design.frequency_high, kDepth);
}

std::optional<EllEnclosure> check_kkl_ell(const Tree& claimed, const KklDesign& design,
                                          Objections& objections) {
  if (!design.has_four_filters()) {
    objections.emplace_back("ell is defined for four filters");
    return std::nullopt;
  }
  Derivation found;
  found.title = "The constant of (10): the distance of T(x) from the singular set of the inverse";
  const Tree& quantities = claimed.at("quantities");
  const Tree* ell = quantities.find("ell");
  const Tree* minimizer = quantities.find("argmin_omega");
  if (ell == nullptr || minimizer == nullptr) {
    objections.emplace_back("there is no enclosure of ell, or no frequency where it is attained");
    return std::nullopt;
  }
  const Ball low = low_of(*ell);
  const Ball high = high_of(*ell);
  const Ball attained = low_of(*minimizer);
  const bool enclosed = is_true({low, high, attained}, design);
  const Ball last = high_of(*minimizer);
  const Excitation ratio(design.lambda);
  const bool located = enclosed && no_minimizer(ratio, design.frequency_low, attained, high, false, kDepth) &&
                       no_minimizer(ratio, last, design.frequency_high, high, true, kDepth);
  const Ball nothing = Ball::everything();
  const Ball value = enclosed ? low : nothing;
  found.quantities = {{"ell", enclosed ? Range(low, high) : Range(nothing)},
                      {"argmin_omega", located ? Range(attained, last) : Range(nothing)}};
  const Ball width = (high - low) / abs(low);
  const Ball nine_digits(1e-9);
  found.conditions = {
      {"enclosed", R"((\ell_{hi} - \ell_{lo}) / \ell_{lo} \le 10^{-9})",
       proved_if(enclosed && certainly_at_most(width, nine_digits)), width, nine_digits},
      {"positive", R"(\ell > 0)", proved_if(certainly_positive(value)), Range(low, high), zero}};
  check_derivation(claimed, found, objections);
  // A wide enclosure would let its lower end, which is the ell of a design that names none, be chosen at
  // will.
  const bool narrow = enclosed && certainly_at_most(width, nine_digits);
  return narrow ? std::optional(EllEnclosure{low, high, attained}) : std::nullopt;
}

}  // namespace veritrack::checker
