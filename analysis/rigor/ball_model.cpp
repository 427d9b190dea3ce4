#include "analysis/rigor/ball_model.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace veritrack::rigor {

namespace {

constexpr double kNothingKnown = std::numeric_limits<double>::quiet_NaN();
/// More than a rounding error, relative, of one operation in any mode; and what underflow can add to a
/// polynomial.
constexpr double kRounding = 0x1p-51;
constexpr double kUnderflow = 0x1p-1000;
/// A coefficient of a product is a sum of at most 2^4 products: exponents of degree 4 have no more parts.
constexpr double kRoundingOfProduct = 20 * 0x1p-52;

/// Degrees of x, v, s and z: 65 with disturbances.
constexpr std::size_t kMostClasses = 65;

thread_local const BallMonomials* current_monomials = nullptr;

}  // namespace

BallModelScope::BallModelScope(int balls, int disturbances) : outer_(current_monomials) {
  current_monomials = &BallMonomials::of(balls, disturbances);
}

BallModelScope::~BallModelScope() {
  current_monomials = outer_;
}

const BallMonomials& BallModelScope::monomials() {
  if (current_monomials == nullptr) {
    throw std::logic_error("a ball model outside a BallModelScope");
  }
  return *current_monomials;
}

BallModel::BallModel()
    : monomials_(&BallModelScope::monomials()),
      coefficients_(monomials_->terms(), 0.0),
      norms_(monomials_->classes().size(), 0.0) {}

BallModel::BallModel(double constant) : BallModel() {
  coefficients_[0] = constant;
  norms_[0] = std::fabs(constant);
  error_ = std::isfinite(constant) ? 0.0 : kNothingKnown;
}

BallModel::BallModel(const Interval& range) : BallModel(is_finite(range) ? midpoint(range) : 0.0) {
  error_ = is_finite(range) ? abs(range - Interval(coefficients_[0])).upper() : kNothingKnown;
}

BallModel BallModel::ball(int index) {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(1, 0, 0, 0);
  // Within the class the first component comes first.
  result.coefficients_[result.monomials_->classes()[number].first + static_cast<std::size_t>(index)] = 1.0;
  result.norms_[number] = 1.0;
  return result;
}

BallModel BallModel::disturbance(int index) {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(0, 1, 0, 0);
  result.coefficients_[result.monomials_->classes()[number].first + static_cast<std::size_t>(index)] = 1.0;
  result.norms_[number] = 1.0;
  return result;
}

BallModel BallModel::s() {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(0, 0, 1, 0);
  result.coefficients_[result.monomials_->classes()[number].first] = 1.0;
  result.norms_[number] = 1.0;
  return result;
}

BallModel BallModel::z() {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(0, 0, 0, 1);
  result.coefficients_[result.monomials_->classes()[number].first] = 1.0;
  result.norms_[number] = 1.0;
  return result;
}

/// Rounded up, as everything here: a sum of terms that are not negative.
void BallModel::find_norm(std::size_t number) {
  const BallMonomials::Class& here = monomials_->classes()[number];
  double sum = 0.0;
  for (std::size_t i = here.first; i < here.last; ++i) {
    sum += coefficients_[i] * coefficients_[i] * monomials_->weights()[i];
  }
  norms_[number] = std::sqrt(sum);
}

double BallModel::polynomial_bound() const {
  double sum = 0.0;
  for (const double norm : norms_) {
    sum += norm;
  }
  return sum;
}

double BallModel::deviation() const {
  double sum = error_;
  for (std::size_t i = 1; i < norms_.size(); ++i) {
    sum += norms_[i];
  }
  return sum;
}

Interval BallModel::range() const {
  const double most = deviation();
  return std::isfinite(most) && std::isfinite(constant())
             ? Interval(constant()) + Interval::from_bounds(-most, most)
             : Interval::empty();
}

Interval BallModel::mean_over_s() const {
  return mean_in_z().range();
}

BallModel::MeanInZ& BallModel::MeanInZ::operator+=(const MeanInZ& other) {
  for (std::size_t d = 0; d < powers.size(); ++d) {
    powers[d] = powers[d] + other.powers[d];
  }
  around += other.around;
  return *this;
}

Interval BallModel::MeanInZ::range() const {
  if (!std::isfinite(around)) {
    return Interval::empty();
  }
  Interval sum = powers[0] + Interval::from_bounds(-around, around);
  for (std::size_t d = 1; d < powers.size(); ++d) {
    // z^d is between -1 and 1, of an even power between 0 and 1.
    sum = sum + hull(d % 2 == 0 ? Interval(0.0) : -powers[d], powers[d]);
  }
  return rigor::is_finite(sum) ? sum : Interval::empty();
}

BallModel::MeanInZ BallModel::mean_in_z() const {
  MeanInZ mean;
  mean.powers.fill(Interval(0.0));
  if (!std::isfinite(error_) || !std::isfinite(constant())) {
    mean.around = std::numeric_limits<double>::quiet_NaN();
    return mean;
  }
  mean.powers[0] = Interval(constant());
  mean.around = error_;
  for (std::size_t number = 1; number < norms_.size(); ++number) {
    const BallMonomials::Class& here = monomials_->classes()[number];
    if (here.ball > 0 || here.disturbance > 0) {
      mean.around += norms_[number];
    } else if (here.s % 2 == 0) {
      // The mean of s^c is 1/(c + 1) for even c, and 0 for odd c.
      Interval& power = mean.powers.at(static_cast<std::size_t>(here.z));
      power = power + Interval(coefficients_[here.first]) / Interval(here.s + 1.0);
    }
  }
  return mean;
}

BallModel BallModel::without_constant() const {
  BallModel result = *this;
  result.coefficients_[0] = 0.0;
  result.norms_[0] = 0.0;
  return result;
}

BallModel BallModel::lifted() const {
  BallModel result;
  result.error_ = error_;
  for (std::size_t number = 0; number < norms_.size(); ++number) {
    const BallMonomials::Class& here = monomials_->classes()[number];
    if (here.ball > 0 || here.disturbance > 0) {
      if (norms_[number] != 0.0) {
        throw std::logic_error("a ball model that depends on more than s and z");
      }
      continue;
    }
    const std::size_t there = result.monomials_->class_of(0, 0, here.s, here.z);
    result.coefficients_[result.monomials_->classes()[there].first] = coefficients_[here.first];
    result.norms_[there] = norms_[number];
  }
  return result;
}

BallModel BallModel::without_error() const {
  BallModel result = *this;
  result.error_ = std::isfinite(error_) ? 0.0 : kNothingKnown;
  return result;
}

BallModel BallModel::widened(double more) const {
  BallModel result = *this;
  result.error_ = more >= 0.0 ? result.error_ + more : kNothingKnown;
  return result;
}

void BallModel::add(const BallModel& other, double sign) {
  if (monomials_ != other.monomials_) {
    throw std::logic_error("ball models of different scopes");
  }
  error_ += other.error_ + kRounding * (polynomial_bound() + other.polynomial_bound()) + kUnderflow;
  for (std::size_t number = 0; number < norms_.size(); ++number) {
    if (other.norms_[number] == 0.0) {
      continue;  // no terms, or terms so small that their squares vanish: those stand in the error
    }
    const BallMonomials::Class& here = monomials_->classes()[number];
    for (std::size_t i = here.first; i < here.last; ++i) {
      coefficients_[i] += sign * other.coefficients_[i];
    }
    find_norm(number);
  }
}

void BallModel::add_multiple(const BallModel& other, double factor) {
  if (monomials_ != other.monomials_) {
    throw std::logic_error("ball models of different scopes");
  }
  // Two rounding errors a coefficient: of the product, and of the sum.
  const double size = std::fabs(factor);
  error_ += size * other.error_ + 2.0 * kRounding * (polynomial_bound() + size * other.polynomial_bound()) +
            kUnderflow;
  if (!std::isfinite(factor)) {
    error_ = kNothingKnown;
  }
  for (std::size_t number = 0; number < norms_.size(); ++number) {
    if (other.norms_[number] == 0.0) {
      continue;  // as in add
    }
    const BallMonomials::Class& here = monomials_->classes()[number];
    for (std::size_t i = here.first; i < here.last; ++i) {
      coefficients_[i] += factor * other.coefficients_[i];
    }
    find_norm(number);
  }
}

BallModel operator+(const BallModel& a, const BallModel& b) {
  BallModel result = a;
  result.add(b, 1.0);
  return result;
}

BallModel operator-(const BallModel& a, const BallModel& b) {
  BallModel result = a;
  result.add(b, -1.0);
  return result;
}

BallModel operator-(const BallModel& a) {
  BallModel result = a;
  for (double& coefficient : result.coefficients_) {
    coefficient = -coefficient;
  }
  return result;
}

BallModel operator*(const BallModel& a, const BallModel& b) {
  const BallMonomials& monomials = a.monomials();
  if (&monomials != &b.monomials()) {
    throw std::logic_error("ball models of different scopes");
  }
  BallModel result;
  const std::size_t classes = monomials.classes().size();
  std::array<bool, kMostClasses> is_touched{};
  std::array<std::size_t, kMostClasses> of_b{};
  std::size_t count_of_b = 0;
  for (std::size_t j = 0; j < classes; ++j) {
    if (b.norms_[j] != 0.0) {
      of_b[count_of_b++] = j;
    }
  }
  const double bound_of_a = a.polynomial_bound();
  const double bound_of_b = b.polynomial_bound();
  double truncated = 0.0;
  for (std::size_t i = 0; i < classes; ++i) {
    if (a.norms_[i] == 0.0) {
      continue;
    }
    for (std::size_t n = 0; n < count_of_b; ++n) {
      const BallMonomials::ClassProduct& pair = monomials.product(i, of_b[n]);
      if (pair.c == classes) {
        truncated += a.norms_[i] * b.norms_[of_b[n]];
        continue;
      }
      is_touched[pair.c] = true;
      for (std::size_t k = pair.first; k < pair.last; ++k) {
        const BallMonomials::Product& product = monomials.products()[k];
        result.coefficients_[product.c] += a.coefficients_[product.a] * b.coefficients_[product.b];
      }
    }
  }
  for (std::size_t number = 0; number < classes; ++number) {
    if (is_touched[number]) {
      result.find_norm(number);
    }
  }
  result.error_ = a.error_ * (bound_of_b + b.error_) + b.error_ * bound_of_a + truncated +
                  kRoundingOfProduct * bound_of_a * bound_of_b + kUnderflow;
  return result;
}

BallModel square(const BallModel& x) {
  return x * x;
}

}  // namespace veritrack::rigor
