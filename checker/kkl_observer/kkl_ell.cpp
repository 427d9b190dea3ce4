#include "checker/kkl_observer/kkl_ell.hpp"

#include <bit>
#include <utility>

#include "checker/document/evidence.hpp"
#include "checker/numbers/slope.hpp"

namespace veritrack::checker {

namespace {

/// |M xi|^2 is the sum over triples of filters of det(xi, lambda, 1)^2, for any number of filters.
///
/// inf |M T(x)|^2 / |T(x)|^2 over the signals of one frequency w: T is linear in (x1, x2), so that this is
/// the smaller eigenvalue of a pencil (seen, length) of 2x2 matrices, each a sum of squares of rows. For such
/// matrices the coefficients of det(seen) + z det(mixed) + z^2 det(length) are sums of squares of 2x2
/// determinants of the rows. The row of a set of filters is V (Re z, Im z / w) / |z|^2 with V its Vandermonde
/// determinant and z the product of its rates + jw: for one filter that is T, for three the determinant of
/// the triple. So the determinant of the rows of P and Q is V V' Im(conj(z) z') / w over |z|^2 |z'|^2, from
/// which the filters in both sets cancel: with z and z' of P \ Q and Q \ P it is over the |z|^2 of all
/// filters in P or Q.
class Excitation {
 public:
  explicit Excitation(const std::vector<Ball>& lambda) : lambda_(lambda) {
    std::vector<unsigned> single;
    std::vector<unsigned> triples;
    for (unsigned set = 1; set < 1U << lambda.size(); ++set) {
      const int size = std::popcount(set);
      if (size == 1) {
        single.push_back(set);
      } else if (size == 3) {
        triples.push_back(set);
      }
    }
    length_ = pairs_of(single);
    seen_ = pairs_of(triples);
    for (const unsigned triple : triples) {
      for (const unsigned filter : single) {
        mixed_.push_back(pair_of(triple, filter));
      }
    }
  }

  template <typename S>
  [[nodiscard]] S at(const S& frequency) const {
    const S s = square(frequency);
    std::vector<S> over(std::size_t{1} << lambda_.size());  // 1/|z|^2, by set
    over[0] = S(one);
    for (std::size_t set = 1; set < over.size(); ++set) {
      const Ball& first = lambda_[static_cast<std::size_t>(std::countr_zero(set))];
      over[set] = over[set & (set - 1)] * reciprocal(square(first) + s);
    }
    const auto sum = [&](const std::vector<Pair>& pairs) {
      S total(zero);
      for (const Pair& pair : pairs) {
        // The powers of s that do not occur have no coefficient.
        S imaginary(pair.coefficients.back());
        for (std::size_t i = pair.coefficients.size() - 1; i-- > 0;) {
          imaginary = S(pair.coefficients[i]) + imaginary * s;
        }
        total = total + square(pair.vandermonde * (imaginary * over[pair.all]));
      }
      return total;
    };
    const S seen = sum(seen_);
    const S mixed = sum(mixed_);
    const S length = sum(length_);
    return two * seen / (mixed + sqrt(square(mixed) - four * seen * length));
  }

 private:
  /// The determinant of the rows of two sets: V V', Im(conj(z) z') / w by powers of s, and all their filters.
  struct Pair {
    Ball vandermonde;
    std::vector<Ball> coefficients;
    unsigned all;
  };

  [[nodiscard]] Pair pair_of(unsigned p, unsigned q) const {
    // The product of l - X over P \ Q and of l + X over Q \ P, in powers of X = jw.
    std::vector<Ball> product{one};
    for (std::size_t i = 0; i < lambda_.size(); ++i) {
      if (((p ^ q) >> i & 1U) == 0) {
        continue;
      }
      const Ball sign = (p >> i & 1U) != 0 ? -one : one;
      std::vector<Ball> next(product.size() + 1, zero);
      for (std::size_t k = 0; k < product.size(); ++k) {
        next[k] += lambda_[i] * product[k];
        next[k + 1] += sign * product[k];
      }
      product = std::move(next);
    }
    // X, X^3 and X^5 are jw, -jw s and jw s^2.
    Pair pair{vandermonde(p) * vandermonde(q), {}, p | q};
    for (std::size_t k = 1; k < product.size(); k += 2) {
      pair.coefficients.push_back(k % 4 == 1 ? product[k] : -product[k]);
    }
    return pair;
  }

  [[nodiscard]] std::vector<Pair> pairs_of(const std::vector<unsigned>& sets) const {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      for (std::size_t j = i + 1; j < sets.size(); ++j) {
        pairs.push_back(pair_of(sets[i], sets[j]));
      }
    }
    return pairs;
  }

  [[nodiscard]] Ball vandermonde(unsigned set) const {
    Ball product = one;
    for (std::size_t i = 0; i < lambda_.size(); ++i) {
      for (std::size_t j = i + 1; j < lambda_.size(); ++j) {
        if ((set >> i & set >> j & 1U) != 0) {
          product = product * (lambda_[i] - lambda_[j]);
        }
      }
    }
    return product;
  }

  std::vector<Ball> lambda_;
  std::vector<Pair> length_, mixed_, seen_;
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

constexpr int kFrequencyDepth = 60;

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
         Infimum(ratio, low).is_bound(design.frequency_low, design.frequency_high, kFrequencyDepth);
}

std::optional<EllEnclosure> check_kkl_ell(const Tree& claimed, const KklDesign& design,
                                          Objections& objections) {
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
  const bool located = enclosed &&
                       no_minimizer(ratio, design.frequency_low, attained, high, false, kFrequencyDepth) &&
                       no_minimizer(ratio, last, design.frequency_high, high, true, kFrequencyDepth);
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
