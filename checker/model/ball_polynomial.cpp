#include "checker/model/ball_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "checker/model/rounding.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
  error_ = kInfinity;
  if (error >= 0.0 && error < kInfinity) {
    error_ = error;
  }
}

BallPolynomial& BallPolynomial::widen(double distance) {
  set_error(distance == 0.0 ? error_ : bound_on(error_ + distance));
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
    norm = norm == 0.0 && degree_ < 1 ? 0.0 : bound_on(norm);
    norms_.all += norm;
  }
  norms_.all = bound_on(norms_.all);
  if (std::isnan(norms_.all)) {
    norms_.all = kInfinity;  // "not a number" bounds nothing
  }
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
  return Ball(constant()) + Ball::within(Ball(bound_on(width)));
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
  mean.set_error(bound_on(rest + 8.0 * kRounding * norms().all));
  return mean;
}

BallPolynomial& BallPolynomial::add(const BallPolynomial& y, double factor) {
  if (y.is_zero() && std::isfinite(factor)) {
    return *this;
  }
  spend();
  // Each product and each sum is rounded once.
  const double size = std::abs(factor) * y.norms().all;
  const double rounding = 2.0 * kRounding * (norms().all + size);
  const double error = bound_on(error_ + std::abs(factor) * y.error_ + rounding);
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

}  // namespace veritrack::checker
