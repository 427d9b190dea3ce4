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

/// By group, the sums of the norms of classes.
using GroupSums = std::array<double, BallMonomials::kGroups>;

GroupSums sums_of_groups(const BallMonomials& monomials, const double* norms) {
  GroupSums sums{};
  const std::vector<std::uint8_t>& groups = monomials.groups();
  for (std::size_t number = 0; number < groups.size(); ++number) {
    sums.at(groups[number]) += norms[number];
  }
  return sums;
}

/// Whether the product of two groups is dropped, for every two.
using DroppedPairs = std::array<std::array<bool, BallMonomials::kGroups>, BallMonomials::kGroups>;
constexpr DroppedPairs kDropped = [] {
  DroppedPairs dropped{};
  for (std::size_t i = 0; i < BallMonomials::kGroups; ++i) {
    for (std::size_t j = 0; j < BallMonomials::kGroups; ++j) {
      dropped.at(i).at(j) = !BallMonomials::is_kept(i, j);
    }
  }
  return dropped;
}();

/// An upper bound of the products of classes that are not kept: rounded up.
double truncated_product(const BallMonomials& monomials, const double* norms_of_a, const double* norms_of_b) {
  const GroupSums of_a = sums_of_groups(monomials, norms_of_a);
  const GroupSums of_b = sums_of_groups(monomials, norms_of_b);
  // Models of s and z alone have the first ones only.
  const std::size_t groups = monomials.is_plane() ? BallMonomials::kMost + 1 : BallMonomials::kGroups;
  double sum = 0.0;
  for (std::size_t i = 0; i < groups; ++i) {
    if (of_a.at(i) == 0.0) {
      continue;
    }
    double others = 0.0;
    for (std::size_t j = 0; j < groups; ++j) {
      others += kDropped.at(i).at(j) ? of_b.at(j) : 0.0;
    }
    sum += of_a.at(i) * others;
  }
  return sum;
}

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
      numbers_(monomials_->terms() + monomials_->classes().size()) {}

BallModel::BallModel(double constant) : BallModel() {
  terms()[0] = constant;
  norms()[0] = std::fabs(constant);
  error_ = std::isfinite(constant) ? 0.0 : kNothingKnown;
}

BallModel::BallModel(const Interval& range) : BallModel(is_finite(range) ? midpoint(range) : 0.0) {
  error_ = is_finite(range) ? abs(range - Interval(constant())).upper() : kNothingKnown;
}

BallModel BallModel::ball(int index) {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(1, 0, 0, 0);
  // Within the class the first component comes first.
  result.terms()[result.monomials_->classes()[number].first + static_cast<std::size_t>(index)] = 1.0;
  result.norms()[number] = 1.0;
  return result;
}

BallModel BallModel::disturbance(int index) {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(0, 1, 0, 0);
  result.terms()[result.monomials_->classes()[number].first + static_cast<std::size_t>(index)] = 1.0;
  result.norms()[number] = 1.0;
  return result;
}

BallModel BallModel::s() {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(0, 0, 1, 0);
  result.terms()[result.monomials_->classes()[number].first] = 1.0;
  result.norms()[number] = 1.0;
  return result;
}

BallModel BallModel::z() {
  BallModel result;
  const std::size_t number = result.monomials_->class_of(0, 0, 0, 1);
  result.terms()[result.monomials_->classes()[number].first] = 1.0;
  result.norms()[number] = 1.0;
  return result;
}

/// Rounded up, as everything here: a sum of terms that are not negative.
void BallModel::find_norm(std::size_t number) {
  const BallMonomials::Class& here = monomials_->classes()[number];
  const double* coefficients = terms();
  const double* weights = monomials_->weights().data();
  if (here.last == here.first + 1 && weights[here.first] == 1.0) {
    norms()[number] = std::fabs(coefficients[here.first]);
    return;
  }
  double sum = 0.0;
  for (std::size_t i = here.first; i < here.last; ++i) {
    sum += coefficients[i] * coefficients[i] * weights[i];
  }
  norms()[number] = std::sqrt(sum);
}

double BallModel::polynomial_bound() const {
  const double* norms = this->norms();
  const std::size_t classes = monomials_->classes().size();
  // Four sums, which do not wait for each other.
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + 4 <= classes; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      sums[k] += norms[i + k];  // NOLINT(cppcoreguidelines-pro-bounds-constant-array-index)
    }
  }
  double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  for (; i < classes; ++i) {
    sum += norms[i];
  }
  return sum;
}

double BallModel::deviation() const {
  const double* norms = this->norms();
  const std::size_t classes = monomials_->classes().size();
  double sum = error_;
  for (std::size_t i = 1; i < classes; ++i) {
    sum += norms[i];
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
  for (std::size_t number = 1; number < monomials_->classes().size(); ++number) {
    const BallMonomials::Class& here = monomials_->classes()[number];
    if (here.ball > 0 || here.disturbance > 0) {
      mean.around += norm(number);
    } else if (here.s % 2 == 0) {
      // The mean of s^c is 1/(c + 1) for even c, and 0 for odd c.
      Interval& power = mean.powers.at(static_cast<std::size_t>(here.z));
      power = power + Interval(coefficients()[here.first]) / Interval(here.s + 1.0);
    }
  }
  return mean;
}

BallModel BallModel::without_constant() const {
  BallModel result = *this;
  result.terms()[0] = 0.0;
  result.norms()[0] = 0.0;
  return result;
}

BallModel BallModel::lifted() const {
  BallModel result;
  result.error_ = error_;
  if (monomials_->is_plane() && result.monomials_->is_plane()) {
    result.numbers_ = numbers_;
    return result;
  }
  const std::vector<BallMonomials::Class>& classes = monomials_->classes();
  for (std::size_t number = 0; number < classes.size(); ++number) {
    const BallMonomials::Class& here = classes[number];
    const bool is_nothing = norm(number) == 0.0;
    if (here.ball > 0 || here.disturbance > 0) {
      if (!is_nothing) {
        throw std::logic_error("a ball model that depends on more than s and z");
      }
      continue;
    }
    if (!is_nothing) {
      const std::size_t there = result.monomials_->class_of(0, 0, here.s, here.z);
      result.terms()[result.monomials_->classes()[there].first] = coefficients()[here.first];
      result.norms()[there] = norm(number);
    }
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

/// The terms of the other times the factor: classes without terms, or with terms so small that their squares
/// vanish, are left out; those stand in the error.
void BallModel::add_terms(const BallModel& other, double factor) {
  double* to = terms();
  const double* from = other.numbers_.data();
  if (monomials_->is_plane()) {
    double* norm = norms();
    const std::size_t count = monomials_->terms();
    for (std::size_t i = 0; i < count; ++i) {
      to[i] += factor * from[i];
      norm[i] = std::fabs(to[i]);
    }
    return;
  }
  const double* norms_of_other = other.norms();
  const std::size_t classes = monomials_->classes().size();
  for (std::size_t number = 0; number < classes; ++number) {
    if (norms_of_other[number] == 0.0) {
      continue;
    }
    const BallMonomials::Class& here = monomials_->classes()[number];
    for (std::size_t i = here.first; i < here.last; ++i) {
      to[i] += factor * from[i];
    }
    find_norm(number);
  }
}

void BallModel::add(const BallModel& other, double sign) {
  if (monomials_ != other.monomials_) {
    throw std::logic_error("ball models of different scopes");
  }
  error_ += other.error_ + kRounding * (polynomial_bound() + other.polynomial_bound()) + kUnderflow;
  add_terms(other, sign);
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
  add_terms(other, factor);
}

BallModel operator-(const BallModel& a) {
  BallModel result = a;
  double* terms = result.terms();
  for (std::size_t i = 0; i < result.monomials_->terms(); ++i) {
    terms[i] = -terms[i];
  }
  return result;
}

/// For a model that is zero: the terms of the product of two models of s and z alone.
void BallModel::multiply_in_plane(const BallModel& a, const BallModel& b) {
  double* to = terms();
  const double* of_a = a.numbers_.data();
  const double* of_b = b.numbers_.data();
  for (const BallMonomials::Product& product : monomials_->products()) {
    to[product.c] += of_a[product.a] * of_b[product.b];
  }
  double* norm = norms();
  for (std::size_t i = 0; i < monomials_->terms(); ++i) {
    norm[i] = std::fabs(to[i]);
  }
}

/// The same for any two models.
void BallModel::multiply_by_classes(const BallModel& a, const BallModel& b) {
  double* to = terms();
  const double* of_a = a.numbers_.data();
  const double* of_b = b.numbers_.data();
  const double* norms_of_a = a.norms();
  const double* norms_of_b = b.norms();
  const std::vector<BallMonomials::Class>& classes = monomials_->classes();
  const BallMonomials::Product* products = monomials_->products().data();
  std::array<bool, kMostClasses> is_touched{};
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (norms_of_a[i] == 0.0) {
      continue;
    }
    for (const BallMonomials::ClassProduct& pair : monomials_->pairs_of(i)) {
      if (norms_of_b[pair.b] == 0.0) {
        continue;
      }
      is_touched.at(pair.c) = true;
      if (!pair.is_multiple) {
        for (std::size_t k = pair.first; k < pair.last; ++k) {
          to[products[k].c] += of_a[products[k].a] * of_b[products[k].b];
        }
        continue;
      }
      const BallMonomials::Class& class_of_a = classes[i];
      const bool is_one_of_a = class_of_a.ball + class_of_a.disturbance == 0;
      const double factor = is_one_of_a ? of_a[class_of_a.first] : of_b[classes[pair.b].first];
      const double* from = is_one_of_a ? of_b + classes[pair.b].first : of_a + class_of_a.first;
      double* place = to + classes[pair.c].first;
      const std::size_t count = classes[pair.c].last - classes[pair.c].first;
      for (std::size_t k = 0; k < count; ++k) {
        place[k] += factor * from[k];
      }
    }
  }
  for (std::size_t number = 0; number < classes.size(); ++number) {
    if (is_touched.at(number)) {
      find_norm(number);
    }
  }
}

BallModel operator*(const BallModel& a, const BallModel& b) {
  const BallMonomials& monomials = a.monomials();
  if (&monomials != &b.monomials()) {
    throw std::logic_error("ball models of different scopes");
  }
  BallModel result;
  if (monomials.is_plane()) {
    result.multiply_in_plane(a, b);
  } else {
    result.multiply_by_classes(a, b);
  }
  const double bound_of_a = a.polynomial_bound();
  const double bound_of_b = b.polynomial_bound();
  result.error_ = a.error_ * (bound_of_b + b.error_) + b.error_ * bound_of_a +
                  truncated_product(monomials, a.norms(), b.norms()) +
                  kRoundingOfProduct * bound_of_a * bound_of_b + kUnderflow;
  return result;
}

BallModel square(const BallModel& x) {
  return x * x;
}

}  // namespace veritrack::rigor
