#include "checker/kkl_observer/kkl_ell.hpp"

#include "checker/document/evidence.hpp"
#include "checker/numbers/slope.hpp"

namespace veritrack::checker {

namespace {

/// inf |M T(x)|^2 / |T(x)|^2 over the signals of one frequency: T is linear in (x1, x2), so that this is the
/// smaller eigenvalue of a pencil of 2x2 matrices. |M xi|^2 is the sum over triples of filters of det(lambda,
/// 1, xi)^2.
template <typename S>
S ratio_at(const std::vector<Ball>& lambda, const S& frequency) {
  const S s = square(frequency);
  std::vector<std::array<S, 2>> t;
  t.reserve(lambda.size());
  for (const Ball& rate : lambda) {
    const S over = reciprocal(square(rate) + s);
    t.push_back({over * rate, over});
  }
  std::array<S, 3> seen;    // T'M'M T, by (1,1), (1,2), (2,2)
  std::array<S, 3> length;  // T'T
  const auto add = [](std::array<S, 3>& sum, const std::array<S, 2>& row) {
    sum[0] = sum[0] + square(row[0]);
    sum[1] = sum[1] + row[0] * row[1];
    sum[2] = sum[2] + square(row[1]);
  };
  for (std::size_t i = 0; i < lambda.size(); ++i) {
    add(length, t[i]);
    for (std::size_t j = i + 1; j < lambda.size(); ++j) {
      for (std::size_t k = j + 1; k < lambda.size(); ++k) {
        const auto minor = [&](std::size_t c) {
          return (lambda[j] - lambda[k]) * t[i][c] - (lambda[i] - lambda[k]) * t[j][c] +
                 (lambda[i] - lambda[j]) * t[k][c];
        };
        add(seen, {minor(0), minor(1)});
      }
    }
  }
  const S over = reciprocal(length[0] * length[2] - square(length[1]));
  const S sum = (seen[0] * length[2] + seen[2] * length[0] - two * (seen[1] * length[1])) * over;
  const S product = (seen[0] * seen[2] - square(seen[1])) * over;
  return two * product / (sum + sqrt(square(sum) - four * product));
}

/// Walks the frequencies.
class Infimum {
 public:
  Infimum(const KklDesign& design, Ball bound) : design_(design), bound_(std::move(bound)) {}

  /// True only when the ratio is at least the bound from `low` to `high`.
  [[nodiscard]] bool is_bound(const Ball& low, const Ball& high, int depth) const {
    const Slope ratio = ratio_at(design_.lambda, Slope::variable(Ball::hull(low, high), 0));
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
    return certainly_at_most(bound_, ratio_at(design_.lambda, frequency));
  }

  const KklDesign& design_;
  Ball bound_;
};

/// True only when no frequency of [low, high) is a minimizer: the ratio is above `least`, or falls there.
/// With `rises`, none of (low, high]: it is above, or rises.
bool no_minimizer(const KklDesign& design, const Ball& low, const Ball& high, const Ball& least, bool rises,
                  int depth) {
  if (certainly_at_most(high, low)) {
    return true;  // an empty stretch
  }
  const Slope ratio = ratio_at(design.lambda, Slope::variable(Ball::hull(low, high), 0));
  if (certainly_less(least, ratio.value) || certainly_positive(rises ? ratio.along[0] : -ratio.along[0])) {
    return true;
  }
  const Ball middle = (half * (low + high)).lower();
  return depth > 0 && no_minimizer(design, low, middle, least, rises, depth - 1) &&
         no_minimizer(design, middle, high, least, rises, depth - 1);
}

constexpr int kDepth = 60;

}  // namespace

Ball excitation_ratio(const std::vector<Ball>& lambda, const Ball& frequency) {
  return ratio_at(lambda, frequency);
}

// The minimum is at least `low` if every cell says so, and at most `high` if one frequency does.
bool is_true(const EllEnclosure& enclosure, const KklDesign& design) {
  const auto& [low, high, attained] = enclosure;
  const bool inside =
      certainly_at_most(design.frequency_low, attained) && certainly_at_most(attained, design.frequency_high);
  return inside && certainly_at_most(ratio_at(design.lambda, attained), high) &&
         Infimum(design, low).is_bound(design.frequency_low, design.frequency_high, kDepth);
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
  const bool located = enclosed &&
                       no_minimizer(design, design.frequency_low, attained, high, false, kDepth) &&
                       no_minimizer(design, last, design.frequency_high, high, true, kDepth);
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
