// Products of ball polynomials.
#include "checker/model/ball_polynomial.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "checker/model/rounding.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

/// The products of two polynomials in s and z that are not above a degree.
template <int degree>
constexpr auto products_up_to() {
  struct Product {
    std::size_t x, y, sum;
  };
  constexpr auto kCount = [] {
    std::size_t n = 0;
    for (int first = 0; first <= degree; ++first) {
      n += static_cast<std::size_t>(first + 1) * places_up_to(degree - first);
    }
    return n;
  }();
  std::array<Product, kCount> all{};
  std::size_t n = 0;
  const auto place = [](int d, int of_z) { return static_cast<std::size_t>(d * (d + 1) / 2 + of_z); };
  for (int first = 0; first <= degree; ++first) {
    for (int second = 0; first + second <= degree; ++second) {
      for (int a = 0; a <= first; ++a) {
        for (int b = 0; b <= second; ++b) {
          all[n++] = {place(first, a), place(second, b), place(first + second, a + b)};
        }
      }
    }
  }
  return all;
}

/// sum += x y, up to a degree in s and z.
template <int degree>
void add_product(const double* x, const double* y, double* sum) {
  static constexpr auto kProducts = products_up_to<degree>();
  for (const auto& product : kProducts) {
    sum[product.sum] += x[product.x] * y[product.y];
  }
}
void add_product_up_to(int degree, const double* x, const double* y, double* sum) {
  switch (degree) {
    case 1:
      return add_product<1>(x, y, sum);
    case 2:
      return add_product<2>(x, y, sum);
    case 3:
      return add_product<3>(x, y, sum);
    default:
      return add_product<4>(x, y, sum);
  }
}

/// Blocks that are not zero, with their numbers.
std::vector<std::pair<std::size_t, const double*>> blocks_of(const BallPolynomial& x, int degree) {
  std::vector<std::pair<std::size_t, const double*>> blocks;
  if (x.vector_degree() < degree) {
    return blocks;
  }
  const std::size_t count = degree == 0 ? 1 : x.monomials()->count(degree);
  blocks.reserve(count);
  for (std::size_t number = 0; number < count; ++number) {
    const std::span<const double> block = x.block(degree, number);
    if (std::any_of(block.begin(), block.end(), [](double c) { return c != 0.0; })) {
      blocks.emplace_back(number, block.data());
    }
  }
  return blocks;
}

}  // namespace

/// A bound on the terms of the product that are of too high a degree.
double BallPolynomial::cut_off(const Norms& x, const Norms& y) {
  double sum = 0.0;
  for (int w = 0; w <= kMostOfVectors; ++w) {
    for (int d = 0; d + w <= kMostDegree; ++d) {
      const double norm = x.of[group(w, d)];
      if (norm == 0.0) {
        continue;
      }
      double others = 0.0;
      for (int v = 0; v <= kMostOfVectors; ++v) {
        const int first = w + v > kMostOfVectors ? 0 : std::max(0, kMostDegree + 1 - w - d - v);
        for (int e = first; e + v <= kMostDegree; ++e) {
          others += y.of[group(v, e)];
        }
      }
      sum += norm * others;
    }
  }
  return sum;
}

BallPolynomial BallPolynomial::full_product(const BallPolynomial& x, const BallPolynomial& y) {
  BallPolynomial result;
  result.grow(std::min(kMostOfVectors, x.degree_ + y.degree_),
              x.monomials_ != nullptr ? x.monomials_ : y.monomials_);
  const VectorMonomials* monomials = result.monomials_;
  double* const sums = result.coefficients_.data();
  std::int64_t products = 1;
  for (int w = 0; w <= std::min(x.degree_, kMostOfVectors); ++w) {
    const auto from_x = blocks_of(x, w);
    for (int v = 0; v <= std::min(y.degree_, kMostOfVectors - w); ++v) {
      const auto from_y = blocks_of(y, v);
      const int degree = w + v;
      double* const begin = sums + result.begin_of(degree);
      const std::size_t size = size_of_block(degree);
      products += static_cast<std::int64_t>(from_x.size() * from_y.size());
      for (const auto& one_of_x : from_x) {
        for (const auto& one_of_y : from_y) {
          const std::size_t i = one_of_x.first;
          const std::size_t j = one_of_y.first;
          const std::size_t number = w == 0        ? j
                                     : v == 0      ? i
                                     : degree == 2 ? monomials->pair(i, j)
                                     : w == 1      ? monomials->triple(i, j)
                                                   : monomials->triple(j, i);
          add_product_up_to(kMostDegree - degree, one_of_x.second, one_of_y.second, begin + number * size);
        }
      }
    }
  }
  spend(1 + products / 4);
  return result;
}

BallPolynomial operator*(const BallPolynomial& x, const BallPolynomial& y) {
  if (!x.known() || !y.known()) {
    return BallPolynomial::everything();
  }
  if (x.is_zero() || y.is_zero()) {
    return {};
  }
  const auto scaled = [](const BallPolynomial& constant, const BallPolynomial& z) {
    if (constant.error_ == 0.0 && constant.constant() == 1.0) {
      return z;
    }
    BallPolynomial result = constant.constant() * z;
    return result.widen(constant.error_ * (z.norms().all + z.error_));
  };
  if (x.coefficients_.size() <= 1) {
    return scaled(x, y);
  }
  if (y.coefficients_.size() <= 1) {
    return scaled(y, x);
  }
  BallPolynomial result = BallPolynomial::full_product(x, y);
  const double size_of_x = x.norms().all;
  const double size_of_y = y.norms().all;
  // At most 16 products add up to a coefficient.
  constexpr double kOperations = 20.0;
  result.set_error(bound_on(x.error_ * size_of_y + y.error_ * size_of_x + x.error_ * y.error_ +
                            BallPolynomial::cut_off(x.norms(), y.norms()) +
                            kOperations * kRounding * (size_of_x * size_of_y)));
  return result;
}

}  // namespace veritrack::checker
