#include "checker/numbers/polynomial.hpp"

#include <algorithm>
#include <array>

namespace veritrack::checker {

namespace {

/// All monomials, by degree, and the positions of their products.
struct Monomials {
  std::vector<std::array<std::size_t, Polynomial::kVariables>> exponents;
  std::vector<std::size_t> degrees;
  std::array<std::size_t, Polynomial::kMostDegree + 1> up_to{};  ///< how many of each degree or less
  std::vector<std::vector<std::size_t>> products;
  std::vector<Ball> ranges;  ///< on [-1, 1]: [0, 1] for a square, else [-1, 1]

  Monomials() {
    for (std::size_t degree = 0; degree <= Polynomial::kMostDegree; ++degree) {
      for (std::size_t i = 0; i <= degree; ++i) {
        for (std::size_t j = 0; i + j <= degree; ++j) {
          exponents.push_back({degree - i - j, j, i});
          degrees.push_back(degree);
        }
      }
      up_to[degree] = exponents.size();
    }
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      const bool is_square = std::all_of(exponents[i].begin(), exponents[i].end(),
                                         [](std::size_t power) { return power % 2 == 0; });
      ranges.push_back(is_square ? Ball::hull(zero, one) : Ball::within(one));
      products.emplace_back();
      for (std::size_t j = 0; j < up_to[Polynomial::kMostDegree - degrees[i]]; ++j) {
        auto sum = exponents[i];
        for (std::size_t v = 0; v < sum.size(); ++v) {
          sum[v] += exponents[j][v];
        }
        products[i].push_back(
            static_cast<std::size_t>(std::find(exponents.begin(), exponents.end(), sum) - exponents.begin()));
      }
    }
  }
};

const Monomials& monomials() {
  static const Monomials all;
  return all;
}

std::size_t degree_of(const std::vector<Ball>& terms) {
  return terms.empty() ? 0 : monomials().degrees[terms.size() - 1];
}

/// Bounds on the terms of each degree together.
std::array<Ball, Polynomial::kMostDegree + 1> sizes(const std::vector<Ball>& terms) {
  std::array<Ball, Polynomial::kMostDegree + 1> sums;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    sums[monomials().degrees[i]] += abs(terms[i]);
  }
  return sums;
}

void add_error(Ball& x, const Ball& error) {
  arb_add_error(x.raw(), error.raw());
}

/// The first Taylor coefficients about every point of a ball, by one of Arb's functions of series.
template <typename Function>
std::vector<Ball> taylor(const Function& function, const Ball& point, std::size_t count) {
  arb_poly_t argument;
  arb_poly_t result;
  arb_poly_init(argument);
  arb_poly_init(result);
  arb_poly_set_coeff_arb(argument, 0, point.raw());
  arb_poly_set_coeff_si(argument, 1, 1);
  function(result, argument, static_cast<slong>(count), precision());
  std::vector<Ball> coefficients(count);
  for (std::size_t i = 0; i < count; ++i) {
    arb_poly_get_coeff_arb(coefficients[i].raw(), result, static_cast<slong>(i));
  }
  arb_poly_clear(argument);
  arb_poly_clear(result);
  return coefficients;
}

}  // namespace

Polynomial Polynomial::variable(const Ball& range, std::size_t index) {
  Polynomial x;
  x.terms_.resize(kVariables + 1);
  x.terms_[0] = range.middle();
  x.terms_[monomials().up_to[0] + index] = range.radius();
  return x;
}

Ball Polynomial::range() const {
  Ball sum;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    sum += i == 0 ? terms_[0] : terms_[i] * monomials().ranges[i];
  }
  return sum;
}

Polynomial Polynomial::lowered(std::size_t degree, const Ball& distance) const {
  Polynomial x = *this;
  x.limit_ = std::min(limit_, degree);
  x.terms_.resize(std::clamp<std::size_t>(terms_.size(), 1, monomials().up_to[x.limit_]));
  add_error(x.terms_[0], distance);
  for (std::size_t i = x.terms_.size(); i < terms_.size(); ++i) {
    add_error(x.terms_[0], terms_[i]);
  }
  return x;
}

Ball Polynomial::round() {
  Ball distance;
  for (Ball& term : terms_) {
    distance += term.radius();
    arb_get_mid_arb(term.raw(), term.raw());
  }
  return distance;
}

Polynomial operator+(const Polynomial& x, const Polynomial& y) {
  const bool longer = x.terms_.size() >= y.terms_.size();
  Polynomial z = longer ? x : y;
  const Polynomial& other = longer ? y : x;
  z.limit_ = std::min(x.limit_, y.limit_);
  for (std::size_t i = 0; i < other.terms_.size(); ++i) {
    z.terms_[i] += other.terms_[i];
  }
  return z.terms_.size() > monomials().up_to[z.limit_] ? z.lowered(z.limit_, zero) : z;
}

Polynomial operator*(const Ball& x, const Polynomial& y) {
  Polynomial z = y;
  for (Ball& term : z.terms_) {
    term = x * term;
  }
  return z;
}

Polynomial operator*(const Polynomial& x, const Polynomial& y) {
  Polynomial z;
  z.limit_ = std::min(x.limit_, y.limit_);
  if (x.is_zero() || y.is_zero()) {
    return z;
  }
  const Monomials& all = monomials();
  const std::size_t degree = degree_of(x.terms_) + degree_of(y.terms_);
  z.terms_.resize(all.up_to[std::min(z.limit_, degree)]);
  for (std::size_t i = 0; i < x.terms_.size() && all.degrees[i] <= z.limit_; ++i) {
    if (arb_is_zero(x.terms_[i].raw()) != 0) {
      continue;
    }
    const std::size_t partners = std::min(y.terms_.size(), all.up_to[z.limit_ - all.degrees[i]]);
    for (std::size_t j = 0; j < partners; ++j) {
      arb_addmul(z.terms_[all.products[i][j]].raw(), x.terms_[i].raw(), y.terms_[j].raw(), precision());
    }
  }
  if (degree > z.limit_) {
    const auto sizes_x = sizes(x.terms_);
    const auto sizes_y = sizes(y.terms_);
    for (std::size_t i = 0; i < sizes_x.size(); ++i) {
      for (std::size_t j = z.limit_ >= i ? z.limit_ + 1 - i : 0; j < sizes_y.size(); ++j) {
        add_error(z.terms_[0], sizes_x[i] * sizes_y[j]);
      }
    }
  }
  return z;
}

// f(c + h) = sum_k f_k(c) h^k + f_n(xi) h^n, xi between c and c + h: Taylor's theorem, f_k the Taylor
// coefficients.
Polynomial Polynomial::composed(Series series) const {
  if (terms_.size() < 2) {
    return taylor(series, constant(), 1)[0];
  }
  Polynomial h = *this;
  h.terms_[0] = zero;
  const Ball way = h.range();
  const std::vector<Ball> coefficients = taylor(series, constant(), limit_ + 1);
  Polynomial sum(coefficients[0]);
  Polynomial power(one);
  Ball largest(1.0);
  for (std::size_t k = 1; k <= limit_; ++k) {
    power = power * h;
    largest = largest * way;
    sum = sum + coefficients[k] * power;
  }
  return sum + Polynomial(taylor(series, constant() + way, limit_ + 2)[limit_ + 1] * largest * way);
}

Polynomial reciprocal(const Polynomial& x) {
  return x.composed(arb_poly_inv_series);
}
Polynomial sqrt(const Polynomial& x) {
  return x.composed(arb_poly_sqrt_series);
}
Polynomial sin(const Polynomial& x) {
  return x.composed(arb_poly_sin_series);
}
Polynomial cos(const Polynomial& x) {
  return x.composed(arb_poly_cos_series);
}
Polynomial arctangent(const Polynomial& x) {
  return x.composed(arb_poly_atan_series);
}

}  // namespace veritrack::checker
