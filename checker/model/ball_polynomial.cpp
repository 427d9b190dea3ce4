#include "checker/model/ball_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr double kUnit = 0x1p-52;  // of any rounding, relative
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// At least x, whatever roundings of up to 2^17 operations on non-negative numbers, and underflows, took
/// away.
double inflated(double x) {
  return x * (1.0 + 0x1p-34) + 0x1p-500;
}

constexpr std::size_t size_of_block(int degree) {
  return places_up_to(BallPolynomial::kMostDegree - degree);
}

/// The products of two polynomials in s and z that are not above a degree.
template <int degree>
constexpr auto products_up_to() {
  struct Product {
    std::size_t x, y, sum;
  };
  constexpr auto count = [] {
    std::size_t n = 0;
    for (int first = 0; first <= degree; ++first) {
      n += static_cast<std::size_t>(first + 1) * places_up_to(degree - first);
    }
    return n;
  }();
  std::array<Product, count> all{};
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

BallPolynomial::BallPolynomial(double constant) {
  if (constant != 0.0) {
    degree_ = 0;
    coefficients_ = {constant};
  }
  set_error(std::isfinite(constant) ? 0.0 : kInfinity);
}

BallPolynomial::BallPolynomial(const Ball& constant)
    : BallPolynomial(constant.finite() ? constant.near() : 0.0) {
  const double middle = this->constant();
  set_error(!constant.finite()                        ? kInfinity
            : certainly_equal(constant, Ball(middle)) ? 0.0
                                                      : abs(constant - Ball(middle)).upper_double());
}

BallPolynomial BallPolynomial::everything() {
  BallPolynomial result;
  result.error_ = kInfinity;
  return result;
}

BallPolynomial BallPolynomial::affine(double constant, double by_phase, double by_frequency, double error) {
  BallPolynomial result;
  result.degree_ = 0;
  result.coefficients_.assign(kPlaces, 0.0);
  result.coefficients_[0] = constant;
  result.coefficients_[1] = by_phase;
  result.coefficients_[2] = by_frequency;
  result.set_error(error);
  return result;
}

BallPolynomial BallPolynomial::of_places(std::span<const double, kPlaces> coefficients, double error) {
  BallPolynomial result;
  result.degree_ = 0;
  result.coefficients_.assign(coefficients.begin(), coefficients.end());
  result.set_error(error);
  return result;
}

BallPolynomial BallPolynomial::phase() {
  return affine(0.0, 1.0, 0.0, 0.0);
}
BallPolynomial BallPolynomial::frequency() {
  return affine(0.0, 0.0, 1.0, 0.0);
}

BallPolynomial BallPolynomial::variable(const VectorMonomials& monomials, std::size_t number) {
  BallPolynomial result;
  result.grow(1, &monomials);
  result.coefficients_.at(result.begin_of(1) + number * size_of_block(1)) = 1.0;
  return result;
}

void BallPolynomial::set_error(double error) {
  error_ = error >= 0.0 && error < kInfinity ? error : kInfinity;
}

BallPolynomial& BallPolynomial::widen(double distance) {
  set_error(distance == 0.0 ? error_ : inflated(error_ + distance));
  return *this;
}

bool BallPolynomial::known() const {
  return error_ < kInfinity && norms().all < kInfinity;
}

std::size_t BallPolynomial::begin_of(int degree) const {
  std::size_t begin = 0;
  for (int d = 0; d < degree; ++d) {
    begin += size_of_block(d) * (d == 0 ? 1 : monomials_->count(d));
  }
  return begin;
}

std::span<const double> BallPolynomial::block(int degree, std::size_t number) const {
  if (degree > degree_) {
    return {};
  }
  if (coefficients_.size() == 1) {
    return coefficients_;
  }
  return {coefficients_.data() + begin_of(degree) + number * size_of_block(degree), size_of_block(degree)};
}

void BallPolynomial::grow(int degree, const VectorMonomials* monomials) {
  monomials_ = monomials_ == nullptr ? monomials : monomials_;
  if (degree >= 0 && (degree > degree_ || coefficients_.size() < kPlaces)) {
    degree_ = std::max(degree, degree_);
    coefficients_.resize(begin_of(degree_ + 1), 0.0);
  }
  norms_are_known_ = false;
}

const BallPolynomial::Norms& BallPolynomial::norms() const {
  if (norms_are_known_) {
    return norms_;
  }
  norms_ = {};
  if (degree_ >= 0) {
    std::size_t at = 0;
    for (int d = 0; d <= (coefficients_.size() == 1 ? 0 : kMostDegree); ++d) {
      for (int m = 0; m <= d; ++m) {
        norms_.of[group(0, d)] += std::abs(coefficients_[at++]);
      }
    }
    for (int w = 1; w <= degree_; ++w) {
      std::array<std::array<double, size_of_block(1)>, VectorMonomials::kForms> squares{};
      const std::size_t size = size_of_block(w);
      for (const VectorMonomials::Kind& kind : monomials_->kinds(w)) {
        auto& sums = squares[kind.form];
        for (std::size_t place = 0; place < size; ++place) {
          sums[place] += kind.weight * coefficients_[at] * coefficients_[at];
          ++at;
        }
      }
      for (const auto& sums : squares) {
        std::size_t place = 0;
        for (int d = 0; d <= kMostDegree - w; ++d) {
          for (int m = 0; m <= d; ++m) {
            const double square = sums[place++];
            norms_.of[group(w, d)] += square != 0.0 ? std::sqrt(square) : 0.0;
          }
        }
      }
    }
  }
  for (double& norm : norms_.of) {
    norm = norm == 0.0 && degree_ < 1 ? 0.0 : inflated(norm);
    norms_.all += norm;
  }
  norms_.all = inflated(norms_.all);
  // What is not a number bounds nothing.
  norms_.all = norms_.all < kInfinity ? norms_.all : kInfinity;
  norms_are_known_ = true;
  return norms_;
}

double BallPolynomial::norm(int vector_degree, int place_degree) const {
  return norms().of[group(vector_degree, place_degree)];
}

Ball BallPolynomial::range() const {
  if (!known()) {
    return Ball::everything();
  }
  double width = error_;
  for (std::size_t i = 1; i < kGroups; ++i) {
    width += norms().of[i];
  }
  return Ball(constant()) + Ball::within(Ball(inflated(width)));
}

BallPolynomial BallPolynomial::mean_over_phase() const {
  BallPolynomial mean;
  double rest = error_;
  if (degree_ >= 0) {
    mean.grow(0, nullptr);
    std::size_t place = 0;
    for (int d = 0; d <= (coefficients_.size() == 1 ? 0 : kMostDegree); ++d) {
      for (int of_z = 0; of_z <= d; ++of_z, ++place) {
        const int of_s = d - of_z;
        if (of_s % 2 == 0) {
          const auto to = static_cast<std::size_t>(of_z * (of_z + 1) / 2 + of_z);
          mean.coefficients_[to] += coefficients_[place] / static_cast<double>(of_s + 1);
        }
      }
    }
  }
  for (std::size_t i = group(1, 0); i < kGroups; ++i) {
    rest += norms().of[i];
  }
  mean.set_error(inflated(rest + 8.0 * kUnit * norms().all));
  return mean;
}

BallPolynomial& BallPolynomial::add(const BallPolynomial& y, double factor) {
  if (y.is_zero() && std::isfinite(factor)) {
    return *this;
  }
  spend();
  // Each product and each sum is rounded once.
  const double size = std::abs(factor) * y.norms().all;
  const double rounding = 2.0 * kUnit * (norms().all + size);
  const double error = inflated(error_ + std::abs(factor) * y.error_ + rounding);
  if (y.degree_ == 0 && y.coefficients_.size() == 1 && degree_ <= 0 && coefficients_.size() <= 1) {
    if (coefficients_.empty()) {
      degree_ = 0;
      coefficients_ = {0.0};
    }
  } else {
    grow(y.degree_, y.monomials_);
  }
  for (std::size_t i = 0; i < y.coefficients_.size(); ++i) {
    coefficients_[i] += factor * y.coefficients_[i];
  }
  norms_are_known_ = false;
  set_error(error);
  return *this;
}

BallPolynomial operator*(double factor, const BallPolynomial& x) {
  BallPolynomial result;
  result.add(x, factor);
  return result;
}

BallPolynomial operator-(const BallPolynomial& x) {
  BallPolynomial result = x;
  for (double& coefficient : result.coefficients_) {
    coefficient = -coefficient;
  }
  return result;
}

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
  constexpr double kRoundings = 20.0;
  result.set_error(inflated(x.error_ * size_of_y + y.error_ * size_of_x + x.error_ * y.error_ +
                            BallPolynomial::cut_off(x.norms(), y.norms()) +
                            kRoundings * kUnit * (size_of_x * size_of_y)));
  return result;
}

}  // namespace veritrack::checker
