#include "checker/kkl_observer/paper_claims.hpp"

#include <array>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

using Four = std::array<Ball, 4>;
const Four ones{one, one, one, one};

/// A polynomial of at most this degree in each of its variables that vanishes on {0, ..., degree}^n is zero;
/// integers are exact.
template <std::size_t Variables, typename Polynomial>
Verdict vanishes(const Polynomial& polynomial, int degree) {
  std::array<int, Variables> at{};
  for (std::size_t v = 0; v < Variables;) {
    std::array<Ball, Variables> point;
    for (std::size_t i = 0; i < Variables; ++i) {
      point[i] = Ball(at[i]);
    }
    // cannot bind (zero): the identities are true, and do not depend on a certificate.
    if (!certainly_equal(polynomial(point), zero)) {
      return Verdict::undecided;
    }
    for (v = 0; v < Variables && ++at[v] > degree; ++v) {
      at[v] = 0;
    }
  }
  return Verdict::proved;
}

Ball dot(const Four& x, const Four& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3];
}

/// M as printed below (9), times xi.
Four image(const Four& l, const Four& x) {
  return {(l[2] - l[3]) * x[1] + (l[3] - l[1]) * x[2] + (l[1] - l[2]) * x[3],
          (l[3] - l[2]) * x[0] + (l[0] - l[3]) * x[2] + (l[2] - l[0]) * x[3],
          (l[1] - l[3]) * x[0] + (l[3] - l[0]) * x[1] + (l[0] - l[1]) * x[3],
          (l[2] - l[1]) * x[0] + (l[0] - l[2]) * x[1] + (l[1] - l[0]) * x[2]};
}

/// The columns of L(xi).
std::array<Four, 3> columns(const Four& l, const Four& x) {
  return {l, ones, {-x[0], -x[1], -x[2], -x[3]}};
}

/// det(L'L) - |M xi|^2.
Ball determinant_difference(const std::array<Ball, 8>& p) {
  const Four l{p[0], p[1], p[2], p[3]};
  const Four x{p[4], p[5], p[6], p[7]};
  const auto [a, b, c] = columns(l, x);
  const Ball ab = dot(a, b);
  const Ball ac = dot(a, c);
  const Ball bc = dot(b, c);
  const Four seen = image(l, x);
  return dot(a, a) * (dot(b, b) * dot(c, c) - square(bc)) - ab * (ab * dot(c, c) - bc * ac) +
         ac * (ab * bc - dot(b, b) * ac) - dot(seen, seen);
}

/// The residual of (3) for one filter, times lambda^2 + x3: T of (6), x1' = -x2, x2' = x3 x1.
Ball residual(const Four& p) {
  const auto& [lambda, x1, x2, x3] = p;
  return x3 * x1 - lambda * x2 + lambda * (lambda * x1 + x2) - (square(lambda) + x3) * x1;
}

/// Is V'V - t I positive definite? By the pivots of Gauss; V has the rows (l^3, l^2, l, 1).
Verdict above(const std::vector<Ball>& lambda, const Ball& t) {
  std::array<Four, 4> gram;
  for (std::size_t i = 0; i < 4; ++i) {
    gram[i] = {zero, zero, zero, zero};
    gram[i][i] = -t;
  }
  for (const Ball& l : lambda) {
    const Four row{l * square(l), square(l), l, one};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        gram[i][j] += row[i] * row[j];
      }
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (!certainly_positive(gram[k][k])) {
      return certainly_less(gram[k][k], zero) ? Verdict::refuted : Verdict::undecided;
    }
    for (std::size_t i = k + 1; i < 4; ++i) {
      for (std::size_t j = k + 1; j < 4; ++j) {
        gram[i][j] -= gram[i][k] * gram[k][j] / gram[k][k];
      }
    }
  }
  return Verdict::proved;
}

/// The smallest eigenvalue of V'V: above `low`, and not above `high`.
Range smallest_eigenvalue(const std::vector<Ball>& lambda) {
  Range found(zero, zero);
  for (const Ball& l : lambda) {
    found.high += square(square(l) * l) + square(square(l)) + square(l) + one;  // the trace
  }
  found.high = found.high.upper();
  for (int step = 0; step < 150; ++step) {
    const Ball middle = (half * (found.low + found.high)).lower();
    const Verdict verdict = above(lambda, middle);
    if (verdict == Verdict::undecided) {
      break;
    }
    (verdict == Verdict::proved ? found.low : found.high) = middle;
  }
  return found;
}

/// A bound on the slope of gamma on an annulus that contains T of the assumed range: docs/kkl-observer.md,
/// Continuity.
Ball continuity_modulus(const KklDesign& design, const Ball& ell) {
  const auto& l = design.lambda;
  Ball squares(0.0);
  Ball gram(0.0);  // |lambda|^2 |1|^2 - (lambda'1)^2, without its cancellation
  Ball largest(0.0);
  Ball gains(0.0);
  for (const Ball& rate : l) {
    for (const Ball& other : l) {
      gram += half * square(rate - other);
    }
    squares += square(rate);
    largest = max(largest, square(rate));
    gains += one / (square(rate) + square(design.frequency_low));
  }
  // |T_i| <= A / sqrt(lambda_i^2 + w^2), and the first and last filter give (x1, x2) back.
  const Ball upper = design.amplitude_high * sqrt(gains);
  const Ball first = square(l.front()) + square(design.frequency_high);
  const Ball last = square(l.back()) + square(design.frequency_high);
  const Ball given_back =
      sqrt(square(first) + square(last) +
           (square(l.front() * last) + square(l.back() * first)) / square(design.frequency_low)) /
      abs(l.front() - l.back());
  const Ball lower = design.amplitude_low / given_back;

  const Ball filters(static_cast<double>(l.size()));
  const Ball determinant = min(gram, half) * ell * square(lower);
  const Ball trace = squares + filters + square(upper) * (one + Ball(3.0) * ell);
  const Ball smallest = determinant / square(trace / two);
  const Ball length = sqrt(squares + filters + square(upper));  // of L
  const Ball driven = largest * upper;                          // of F^2 xi
  const Ball gamma = length * driven / smallest;
  // |M|^2 <= (m - 2) gram: each difference of the rates of m filters is in the determinants of m - 2 triples.
  const Ball phi_slope = two * length + two * ell * upper + four * (filters - two) * gram * upper;
  return (driven + length * largest + phi_slope * gamma) / smallest;
}

/// First the claims that are true, or false, for every design; then section V, with lambda = (1, 2, 3, 4) and
/// w = 3.
std::vector<Condition> claims_of_every_design() {
  const Ball column_count(static_cast<double>(columns(ones, ones).size()));
  const Ball largest = two * excitation_ratio({one, two, Ball(3.0), four}, Ball(3.0));
  const Ball printed(5.0);
  return {{"invariance", R"(\tfrac{\partial T}{\partial x} f = F T + G h)", vanishes<4>(residual, 2)},
          // The scan has lost (4), which would be needed to decide it: no statement may be made about it.
          {"phase-formula",
           R"(\Phi = \tan^{-1}(\sqrt{x_{30}}\, x_{10} / x_{20}) \text{ where } T \text{ of (6) solves (3)})",
           Verdict::undecided},
          {"determinant", R"(\det(L^T L) = |M\xi|^2)", vanishes<8>(determinant_difference, 2)},
          {"null-space", R"(M\lambda = 0,\ M 1 = 0)",
           vanishes<4>(
               [](const Four& l) {
                 const Four by_rates = image(l, l);
                 const Four by_ones = image(l, ones);
                 return dot(by_rates, by_rates) + dot(by_ones, by_ones);
               },
               4)},
          {"dimensions", R"(\Phi = L^T L + \mu I,\ I \in R^{4 \times 4}: \dim I \le \dim L^T L)",
           decide_at_most(four, column_count), four, column_count},
          {"section-v-ell", R"(5 \le 2 \inf |MT|^2 / |T|^2 \text{ at } \omega = 3,\ \lambda = (1, 2, 3, 4))",
           decide_at_most(printed, largest), printed, largest}};
}

/// mu of (9) on T(O_r), and the consequences for gamma.
void add_inverse(const KklDesign& design, const Ball& ell, const EllEnclosure& infimum, const Tree& claimed,
                 Derivation& found) {
  // The given enclosure, if it is true; otherwise the verified one of (10).
  Range limit(two * infimum.low, two * infimum.high);
  for (const Tree& condition : claimed.at("conditions").elements()) {
    const Tree* side = condition.at("id").text() == "mu-vanishes" ? condition.find("rhs") : nullptr;
    if (side != nullptr) {
      const Range given(low_of(*side), high_of(*side));
      if (is_true({given.low / two, given.high / two, infimum.attained}, design)) {
        limit = given;
      }
    }
  }
  const bool vanishes_everywhere = certainly_at_most(ell, limit.low);
  // At one frequency mu is positive for one signal: there (L'L + mu I)(gamma - x) = -mu x is not zero.
  const bool positive_somewhere = certainly_less(limit.high, ell);
  const Verdict vanishing = vanishes_everywhere  ? Verdict::proved
                            : positive_somewhere ? Verdict::refuted
                                                 : Verdict::undecided;
  // Where mu = 0, det(L'L) = |M xi|^2 > 0 leaves x alone.
  // cannot bind (infimum.low): the enclosure is narrow relative to it, and contains a positive number.
  const Verdict inverse =
      vanishing == Verdict::proved ? proved_if(certainly_positive(infimum.low)) : vanishing;
  const Ball modulus = continuity_modulus(design, ell);
  found.quantities.push_back({"continuity_modulus", modulus, Sense::bounds_above});
  // cannot bind (ell): the design's, which is positive, or the lower end of the enclosure.
  found.conditions.insert(
      found.conditions.end(),
      {{"mu-vanishes", R"(\ell \le 2 \inf_{O_r} |MT|^2 / |T|^2)", vanishing, ell, limit},
       {"left-inverse", R"(\gamma(T(x)) = x \text{ on } O_r)", inverse},
       {"positive-definite", R"(\Phi(\xi) > 0 \text{ for all } \xi \ne 0)",
        proved_if(certainly_positive(ell)), ell},
       {"continuity",
        R"(|\gamma(\xi) - \gamma(\xi')| \le \tfrac{\pi}{2} K |\xi - \xi'| \text{ on an annulus that holds } T(\mathcal R))",
        proved_if(modulus.finite() && certainly_positive(ell)), modulus, std::nullopt, Sense::bounds_above}});
}

}  // namespace

void check_paper_claims(const Tree& claimed, const KklDesign& design, const Ball& ell,
                        const std::optional<EllEnclosure>& infimum, Objections& objections) {
  static const std::vector<Condition> of_every_design = claims_of_every_design();
  Derivation found{"The claims of the paper", {}, of_every_design};
  const Range eigenvalue = smallest_eigenvalue(design.lambda);
  const Ball singular_value = sqrt(eigenvalue.low);
  Ball largest_rate(0.0);
  for (const Ball& rate : design.lambda) {
    largest_rate = max(largest_rate, rate);
  }
  const Ball s = square(design.frequency_high);
  found.quantities = {{"vandermonde_singular_value", {singular_value, sqrt(eigenvalue.high)}},
                      {"injectivity_constant",
                       sqrt(two * square(one + s) + two) * square(square(largest_rate) + s) / singular_value,
                       Sense::bounds_above}};
  found.conditions.push_back({"injectivity",
                              R"(|\Delta x_1| + |\Delta x_2| + c |\Delta x_3| \le d\, |\Delta T|)",
                              proved_if(certainly_positive(eigenvalue.low)), eigenvalue});
  if (infimum) {
    add_inverse(design, ell, *infimum, claimed, found);
  }
  // A slip of the paper is not one of the design.
  if (verdict_of(claimed) != Verdict::undecided) {
    objections.emplace_back("the paper's claims must not have an overall verdict");
  }
  check_derivation(claimed, found, objections);
}

}  // namespace veritrack::checker
