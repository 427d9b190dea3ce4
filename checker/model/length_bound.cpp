#include "checker/model/length_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "checker/model/place_powers.hpp"
#include "checker/model/rounding.hpp"
#include "checker/model/symmetric_matrix.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

LengthBound::LengthBound(const std::vector<BallPolynomial>& vector) {
  double error = 0.0;
  bool is_known = true;
  const VectorMonomials* monomials = nullptr;
  for (const BallPolynomial& component : vector) {
    error += component.error() * component.error();
    is_known = is_known && component.known();
    monomials = component.monomials() != nullptr ? component.monomials() : monomials;
  }
  error_ = bound_on(std::sqrt(error));
  if (monomials == nullptr || !is_known) {
    error_ = std::numeric_limits<double>::infinity();
    return;
  }
  linear_ = LinearLength(vector, *monomials);
  by_phase_ = linear_.by_phase();
  by_frequency_ = linear_.by_frequency();
  for (const int degree : {0, 2, 3}) {
    add_parts(vector, *monomials, degree);
  }
}

void LengthBound::add_parts(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials,
                            int degree) {
  std::array<bool, VectorMonomials::kForms> is_there{};
  for (const VectorMonomials::Kind& kind : monomials.kinds(degree)) {
    is_there[kind.form] = true;
  }
  for (std::size_t form = 0; form < is_there.size(); ++form) {
    if (is_there[form]) {
      add_form(vector, monomials, degree, form);
    }
  }
}

void LengthBound::add_form(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials,
                           int degree, std::size_t form) {
  std::vector<std::size_t> numbers;
  int degree_in_x = 0;
  for (std::size_t number = 0; number < monomials.count(degree); ++number) {
    const VectorMonomials::Kind& kind = monomials.kinds(degree)[number];
    if (kind.form == form) {
      numbers.push_back(number);
      degree_in_x = kind.degree_of_x;
    }
  }
  const std::size_t count = numbers.size();
  std::vector<double> rows(vector.size() * count);
  for (std::size_t place = 0; place < places_up_to(BallPolynomial::kMostDegree - degree); ++place) {
    bool is_zero = true;
    for (std::size_t k = 0; k < count; ++k) {
      const double root = std::sqrt(monomials.kinds(degree)[numbers[k]].weight) * (1.0 + 0x1p-50);
      for (std::size_t i = 0; i < vector.size(); ++i) {
        const std::span<const double> block = vector[i].block(degree, numbers[k]);
        rows[i * count + k] = place < block.size() ? block[place] * root : 0.0;
        is_zero = is_zero && rows[i * count + k] == 0.0;
      }
    }
    if (is_zero) {
      continue;
    }
    double norm = length_of(rows);
    if (count > 1 && vector.size() > 1) {
      SymmetricMatrix gram(vector.size());
      for (std::size_t i = 0; i < vector.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          double entry = 0.0;
          for (std::size_t k = 0; k < count; ++k) {
            entry += rows[i * count + k] * rows[j * count + k];
          }
          gram.add(i, j, entry);
        }
      }
      spend(static_cast<std::int64_t>(vector.size()));
      const double square = eigenvalue_bound(gram) + 0x1p-36 * norm * norm;
      norm = std::min(norm, bound_on(std::sqrt(bound_on(square))));
    }
    parts_.push_back({degree_in_x, form > 0, norm});
    const Powers powers = powers_at(place);
    by_phase_ += powers.of_s > 0 ? norm : 0.0;
    by_frequency_ += powers.of_z > 0 ? norm : 0.0;
  }
}

bool LengthBound::is_cut_off() const {
  double at_zero = 0.0;
  for (const Part& part : parts_) {
    at_zero += part.degree_in_x == 0 ? part.norm : 0.0;
  }
  return error_ > at_zero;
}

double LengthBound::Part::at(double scale) const {
  double value = norm;
  for (int i = 0; i < degree_in_x; ++i) {
    value *= scale;
  }
  return value;
}

double LengthBound::without_noise(double scale) const {
  double sum = error_;
  for (const Part& part : parts_) {
    sum += part.has_noise ? 0.0 : part.at(scale);
  }
  return bound_on(sum);
}

double LengthBound::with_noise(double scale) const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    sum += part.has_noise ? part.at(scale) : 0.0;
  }
  return bound_on(sum);
}

bool LengthBound::is_at_most(double bound, double scale) const {
  double rest = error_;
  for (const Part& part : parts_) {
    rest += part.at(scale);
  }
  const double room = (bound - bound_on(rest)) * (1.0 - 0x1p-34);
  const bool is_sensible = room > 0x1p-400 && room < 0x1p400 && scale > 0x1p-400 && scale <= 0x1p400;
  return is_sensible && linear_.square_is_at_most(room * room, scale);
}

}  // namespace veritrack::checker
