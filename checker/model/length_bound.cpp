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

LengthBound::LengthBound(const std::vector<BallPolynomial>& vector) : size_(vector.size()), of_x_{}, of_v_{} {
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
  of_x_ = gram_of(vector, 0, monomials->balls());
  has_v_ = monomials->variables() > monomials->balls();
  if (has_v_) {
    of_v_ = gram_of(vector, monomials->balls(), monomials->variables());
  }
  const double size = near_largest_eigenvalue(of_x_.terms[0]);
  for (std::size_t k = 1; k < kSide * kSide; ++k) {
    const double share = of_x_.terms[k].length() / (std::sqrt(size) + 1e-300);
    by_phase_ += k >= kSide ? share : 0.0;
    by_frequency_ += k % kSide > 0 ? share : 0.0;
  }
  for (const int degree : {0, 2, 3}) {
    add_parts(vector, degree);
  }
}

void LengthBound::add_parts(const std::vector<BallPolynomial>& vector, int degree) {
  const VectorMonomials::Kind scalar;
  const VectorMonomials* monomials = nullptr;
  for (const BallPolynomial& component : vector) {
    monomials = component.monomials() != nullptr ? component.monomials() : monomials;
  }
  const std::size_t count = degree == 0 ? 1 : monomials->count(degree);
  const std::size_t places = places_up_to(BallPolynomial::kMostDegree - degree);
  for (int of_v = 0; of_v <= (has_v_ ? degree : 0); ++of_v) {
    for (std::size_t place = 0; place < places; ++place) {
      std::vector<double> rows(vector.size() * count, 0.0);
      bool is_zero = true;
      for (std::size_t number = 0; number < count; ++number) {
        const VectorMonomials::Kind& kind = degree == 0 ? scalar : monomials->kinds(degree)[number];
        if (kind.degree_of_v != of_v) {
          continue;
        }
        const double root = std::sqrt(kind.weight) * (1.0 + 0x1p-50);
        for (std::size_t i = 0; i < vector.size(); ++i) {
          const std::span<const double> block = vector[i].block(degree, number);
          const double entry = place < block.size() ? block[place] * root : 0.0;
          rows[i * count + number] = entry;
          is_zero = is_zero && entry == 0.0;
        }
      }
      if (is_zero) {
        continue;
      }
      double norm = length_of(rows);
      if (degree > 0 && vector.size() > 1) {
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
      parts_.push_back({degree - of_v, norm});
      const Powers powers = powers_at(place);
      by_phase_ += powers.of_s > 0 ? norm : 0.0;
      by_frequency_ += powers.of_z > 0 ? norm : 0.0;
    }
  }
}

/// Where N N'/t + B B'/(1 - t) has its least largest eigenvalue, in the middle of the part: a proposal.
double LengthBound::proposed_share(double scale) const {
  const auto share = [](double u) { return 1.0 / (1.0 + std::exp(-u)); };
  const auto eigenvalue = [&](double u) {
    SymmetricMatrix sum(size_);
    sum.add(of_x_.terms[0], scale * scale / share(u));
    sum.add(of_v_.terms[0], 1.0 / (1.0 - share(u)));
    return near_largest_eigenvalue(sum);
  };
  // Golden sections.
  constexpr double kRatio = 0.6180339887498949;
  double low = -4.0;
  double high = 12.0;
  double left = high - kRatio * (high - low);
  double right = low + kRatio * (high - low);
  double at_left = eigenvalue(left);
  double at_right = eigenvalue(right);
  constexpr int kSections = 16;
  for (int i = 0; i < kSections; ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kRatio * (high - low);
      at_left = eigenvalue(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kRatio * (high - low);
      at_right = eigenvalue(right);
    }
  }
  return share(0.5 * (low + high));
}

// A polynomial of degree two in s and in z is a convex combination of its nine Bernstein coefficients: those
// of 1, s, s^2 are (1, 1, 1), (-1, 0, 1), (1, -1, 1).
bool LengthBound::linear_part_is_at_most(double square, double scale, double t) const {
  constexpr std::array<std::array<double, kSide>, kSide> kBernstein{
      std::array<double, kSide>{1.0, -1.0, 1.0}, {1.0, 0.0, -1.0}, {1.0, 1.0, 1.0}};
  const double factor_x = scale * scale / t;
  const double factor_v = has_v_ ? 1.0 / (1.0 - t) : 0.0;
  double slack = (of_x_.others + of_x_.rounding) * factor_x + (of_v_.others + of_v_.rounding) * factor_v;
  for (std::size_t k = 0; k < kSide * kSide; ++k) {
    slack +=
        0x1p-44 * (of_x_.terms[k].length() * factor_x + (has_v_ ? of_v_.terms[k].length() * factor_v : 0.0));
  }
  const double room = square * (1.0 - 0x1p-34) - at_least(slack);
  bool all = true;
  for (std::size_t p = 0; p < kSide && all; ++p) {
    for (std::size_t q = 0; q < kSide && all; ++q) {
      SymmetricMatrix control(size_);
      for (std::size_t l = 0; l < kSide; ++l) {
        for (std::size_t m = 0; m < kSide; ++m) {
          const double weight = kBernstein[p][l] * kBernstein[q][m];
          if (weight != 0.0) {
            control.add(of_x_.terms[l * kSide + m], weight * factor_x);
            if (has_v_) {
              control.add(of_v_.terms[l * kSide + m], weight * factor_v);
            }
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
  if (!is_sensible) {
    return false;
  }
  double share = 1.0;
  if (has_v_) {
    share = proposed_share(scale);
    const bool is_share = share > 0x1p-50 && share < 1.0 - 0x1p-50;
    if (!is_share) {
      return false;
    }
  }
  return linear_part_is_at_most(room * room, scale, share);
}

}  // namespace veritrack::checker
