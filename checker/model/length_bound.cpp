#include "checker/model/length_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr int kDegreeOfLinear = BallPolynomial::kMostDegree - 1;
constexpr std::size_t kSide = 3;  // powers of s, and of z, up to 2

double at_least(double x) {
  return x * (1.0 + 0x1p-34) + 0x1p-500;
}

/// The powers of s and z at a place.
struct Powers {
  int of_s = 0;
  int of_z = 0;
};
Powers powers_at(std::size_t place) {
  int degree = 0;
  while (places_up_to(degree) <= place) {
    ++degree;
  }
  const int of_z = static_cast<int>(place) - degree * (degree + 1) / 2;
  return {degree - of_z, of_z};
}

/// The coefficients of the linear terms number first to last - 1 that stand with s^l z^m, a row for each
/// component.
std::vector<double> linear_terms(const std::vector<BallPolynomial>& vector, std::size_t first,
                                 std::size_t last, std::size_t place) {
  std::vector<double> rows;
  rows.reserve(vector.size() * (last - first));
  for (const BallPolynomial& component : vector) {
    for (std::size_t j = first; j < last; ++j) {
      const std::span<const double> block = component.block(1, j);
      rows.push_back(block.empty() ? 0.0 : block[place]);
    }
  }
  return rows;
}

double length_of(const std::vector<double>& entries) {
  double sum = 0.0;
  for (const double entry : entries) {
    sum += entry * entry;
  }
  return at_least(std::sqrt(sum));
}

}  // namespace

LengthBound::Gram LengthBound::gram_of(const std::vector<BallPolynomial>& vector, std::size_t first,
                                       std::size_t last) {
  const std::size_t n = vector.size();
  const std::size_t columns = last - first;
  Gram gram{std::vector<SymmetricMatrix>(kSide * kSide, SymmetricMatrix(n)), 0.0, 0.0};
  constexpr std::size_t kPlacesOfLinear = places_up_to(kDegreeOfLinear);
  std::array<std::vector<double>, kPlacesOfLinear> terms;
  // Terms of N N' cancel when N turns, so that they are added up first.
  constexpr std::size_t kHighSide = 2 * kDegreeOfLinear + 1;
  std::vector<SymmetricMatrix> high(kHighSide * kHighSide, SymmetricMatrix(n));
  double size = 0.0;
  for (std::size_t place = 0; place < kPlacesOfLinear; ++place) {
    terms[place] = linear_terms(vector, first, last, place);
    const double length = length_of(terms[place]);
    // What is zero is left out.
    terms[place] = length > 0x1p-490 ? terms[place] : std::vector<double>();
    size += length;
  }
  for (std::size_t p = 0; p < kPlacesOfLinear; ++p) {
    for (std::size_t q = p; q < kPlacesOfLinear; ++q) {
      if (terms[p].empty() || terms[q].empty()) {
        continue;
      }
      const Powers a = powers_at(p);
      const Powers b = powers_at(q);
      const int of_s = a.of_s + b.of_s;
      const int of_z = a.of_z + b.of_z;
      const bool is_low = of_s < static_cast<int>(kSide) && of_z < static_cast<int>(kSide);
      SymmetricMatrix& sum =
          is_low ? gram.terms[static_cast<std::size_t>(of_s) * kSide + static_cast<std::size_t>(of_z)]
                 : high[static_cast<std::size_t>(of_s) * kHighSide + static_cast<std::size_t>(of_z)];
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          double entry = 0.0;
          for (std::size_t k = 0; k < columns; ++k) {
            entry += terms[p][i * columns + k] * terms[q][j * columns + k];
            entry += p == q ? 0.0 : terms[q][i * columns + k] * terms[p][j * columns + k];
          }
          sum.add(i, j, entry);
        }
      }
    }
  }
  spend(static_cast<std::int64_t>(n * n));
  for (const SymmetricMatrix& term : high) {
    gram.others += term.length();
  }
  gram.others = at_least(gram.others);
  // Sums of at most 2 columns and places products each, hence wrong by less than 2^-36 of their size.
  gram.rounding = at_least(0x1p-36 * size * size);
  return gram;
}

LengthBound::LengthBound(const std::vector<BallPolynomial>& vector) : size_(vector.size()) {
  double error = 0.0;
  const VectorMonomials* monomials = nullptr;
  for (const BallPolynomial& component : vector) {
    error +=
        component.known() ? component.error() * component.error() : std::numeric_limits<double>::infinity();
    monomials = component.monomials() != nullptr ? component.monomials() : monomials;
  }
  error_ = at_least(std::sqrt(error));
  if (monomials == nullptr) {
    error_ = std::numeric_limits<double>::infinity();
    return;
  }
  for (std::size_t k = 0; k < VectorMonomials::kVectors; ++k) {
    if (monomials->size(k) > 0) {
      grams_.push_back(gram_of(vector, monomials->first(k), monomials->first(k + 1)));
      grams_.back().is_of_x = k == 0;
    }
  }
  const double size = near_largest_eigenvalue(grams_.front().terms[0]);
  for (std::size_t k = 1; k < kSide * kSide; ++k) {
    const double share = grams_.front().terms[k].length() / (std::sqrt(size) + 1e-300);
    by_phase_ += k >= kSide ? share : 0.0;
    by_frequency_ += k % kSide > 0 ? share : 0.0;
  }
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
      norm = std::min(norm, at_least(std::sqrt(at_least(square))));
    }
    parts_.push_back({degree_in_x, norm});
    const Powers powers = powers_at(place);
    by_phase_ += powers.of_s > 0 ? norm : 0.0;
    by_frequency_ += powers.of_z > 0 ? norm : 0.0;
  }
}

std::vector<double> LengthBound::factors(const Shares& shares, double scale) const {
  std::vector<double> result;
  result.reserve(grams_.size());
  for (std::size_t k = 0; k < grams_.size(); ++k) {
    result.push_back((grams_[k].is_of_x ? scale * scale : 1.0) / shares[k]);
  }
  return result;
}

namespace {

/// The least value of a function that falls and then rises, by golden sections.
template <typename Function>
double place_of_least(double low, double high, int sections, const Function& function) {
  constexpr double kRatio = 0.6180339887498949;
  double left = high - kRatio * (high - low);
  double right = low + kRatio * (high - low);
  double at_left = function(left);
  double at_right = function(right);
  for (int i = 0; i < sections; ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kRatio * (high - low);
      at_left = function(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kRatio * (high - low);
      at_right = function(right);
    }
  }
  return 0.5 * (low + high);
}

double share_of(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

}  // namespace

/// Where the largest eigenvalue is about the least, in the middle of the part: a proposal.
LengthBound::Shares LengthBound::proposed_shares(double scale) const {
  constexpr int kSections = 16;
  constexpr int kSectionsInside = 10;
  constexpr double kLow = -4.0;
  constexpr double kHigh = 12.0;
  const auto eigenvalue = [&](const Shares& shares) {
    const std::vector<double> factor = factors(shares, scale);
    SymmetricMatrix sum(size_);
    for (std::size_t k = 0; k < grams_.size(); ++k) {
      sum.add(grams_[k].terms[0], factor[k]);
    }
    return near_largest_eigenvalue(sum);
  };
  if (grams_.size() == 1) {
    return {1.0};
  }
  if (grams_.size() == 2) {
    const auto shares = [](double u) { return Shares{share_of(u), 1.0 - share_of(u)}; };
    return shares(place_of_least(kLow, kHigh, kSections, [&](double u) { return eigenvalue(shares(u)); }));
  }
  const auto shares = [](double u, double v) {
    const double rest = 1.0 - share_of(u);
    return Shares{share_of(u), rest * share_of(v), rest * (1.0 - share_of(v))};
  };
  const auto best_inside = [&](double u) {
    return place_of_least(-6.0, 6.0, kSectionsInside, [&](double v) { return eigenvalue(shares(u, v)); });
  };
  const double u = place_of_least(kLow, kHigh, kSectionsInside, [&](double outside) {
    return eigenvalue(shares(outside, best_inside(outside)));
  });
  return shares(u, best_inside(u));
}

// With p + q + r <= 1, |N x + B v + D w|^2 <= |[N/sqrt p, B/sqrt q, D/sqrt r]|^2 (p |x|^2 + q |v|^2 + r
// |w|^2). A polynomial of degree two in s and in z is a convex combination of its nine Bernstein
// coefficients: those of 1, s, s^2 are (1, 1, 1), (-1, 0, 1), (1, -1, 1).
bool LengthBound::linear_part_is_at_most(double square, double scale, const Shares& shares) const {
  constexpr std::array<std::array<double, kSide>, kSide> kBernstein{
      std::array<double, kSide>{1.0, -1.0, 1.0}, {1.0, 0.0, -1.0}, {1.0, 1.0, 1.0}};
  double sum_of_shares = 0.0;
  bool are_shares = true;
  for (const double share : shares) {
    are_shares = are_shares && share > 0x1p-50 && share <= 1.0;
    sum_of_shares += share;
  }
  if (!are_shares || !(sum_of_shares <= 1.0 + 0x1p-40)) {
    return false;
  }
  const std::vector<double> factor = factors(shares, scale);
  double slack = 0.0;
  for (std::size_t k = 0; k < grams_.size(); ++k) {
    slack += (grams_[k].others + grams_[k].rounding) * factor[k];
    for (const SymmetricMatrix& term : grams_[k].terms) {
      slack += 0x1p-44 * term.length() * factor[k];
    }
  }
  // The sum of the shares may exceed 1 by so little.
  const double room = square * (1.0 - 0x1p-34) - at_least(slack);
  bool all = true;
  for (std::size_t p = 0; p < kSide && all; ++p) {
    for (std::size_t q = 0; q < kSide && all; ++q) {
      SymmetricMatrix control(size_);
      for (std::size_t l = 0; l < kSide; ++l) {
        for (std::size_t m = 0; m < kSide; ++m) {
          const double weight = kBernstein[p][l] * kBernstein[q][m];
          for (std::size_t k = 0; k < grams_.size() && weight != 0.0; ++k) {
            control.add(grams_[k].terms[l * kSide + m], weight * factor[k]);
          }
        }
      }
      all = certainly_bounded(control, room);
    }
  }
  spend(static_cast<std::int64_t>(size_ * size_));
  return all;
}

bool LengthBound::is_at_most(double bound, double scale) const {
  double rest = error_;
  for (const Part& part : parts_) {
    double norm = part.norm;
    for (int i = 0; i < part.degree_in_x; ++i) {
      norm *= scale;
    }
    rest += norm;
  }
  const double room = (bound - at_least(rest)) * (1.0 - 0x1p-34);
  const bool is_sensible = room > 0x1p-400 && room < 0x1p400 && scale > 0x1p-400 && scale <= 0x1p400;
  return is_sensible && linear_part_is_at_most(room * room, scale, proposed_shares(scale));
}

}  // namespace veritrack::checker
