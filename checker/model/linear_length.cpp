#include "checker/model/linear_length.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "checker/model/place_of_least.hpp"
#include "checker/model/place_powers.hpp"
#include "checker/model/rounding.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr int kDegreeOfLinear = BallPolynomial::kMostDegree - 1;
constexpr std::size_t kSide = 3;  // powers of s, and of z, up to 2

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

double share_of(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

}  // namespace

LinearLength::Gram LinearLength::gram_of(const std::vector<BallPolynomial>& vector, std::size_t first,
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
    // Zeros are left out.
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
  gram.others = bound_on(gram.others);
  // Sums of at most 2 columns and places products each, hence wrong by less than 2^-36 of their size.
  gram.rounding = bound_on(0x1p-36 * size * size);
  return gram;
}

LinearLength::LinearLength(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials)
    : size_(vector.size()) {
  for (std::size_t k = 0; k < VectorMonomials::kVectors; ++k) {
    if (monomials.size(k) > 0) {
      grams_.push_back(gram_of(vector, monomials.first(k), monomials.first(k + 1)));
      grams_.back().is_of_x = k == 0;
    }
  }
  const double size = near_largest_eigenvalue(grams_.front().terms[0]);
  for (std::size_t k = 1; k < kSide * kSide; ++k) {
    const double share = grams_.front().terms[k].length() / (std::sqrt(size) + 1e-300);
    by_phase_ += k >= kSide ? share : 0.0;
    by_frequency_ += k % kSide > 0 ? share : 0.0;
  }
}

std::vector<double> LinearLength::factors(const Shares& shares, double scale) const {
  std::vector<double> result;
  result.reserve(grams_.size());
  for (std::size_t k = 0; k < grams_.size(); ++k) {
    result.push_back((grams_[k].is_of_x ? scale * scale : 1.0) / shares[k]);
  }
  return result;
}

/// The shares for which the largest eigenvalue is approximately least, in the middle of the part: a proposal.
LinearLength::Shares LinearLength::proposed_shares(double scale) const {
  constexpr int kSections = 17;
  constexpr int kSectionsInside = 15;
  constexpr double kLow = -4.0;
  constexpr double kHigh = 20.0;  // slow loops have next to no room for noise in one sample
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
// |w|^2).
bool LinearLength::is_bounded(double square, double scale, const Shares& shares) const {
  double sum_of_shares = 0.0;
  bool are_shares = true;
  for (const double share : shares) {
    are_shares = are_shares && share > 0x1p-50 && share <= 1.0;
    sum_of_shares += share;
  }
  if (!are_shares || !(sum_of_shares <= 1.0 + 0x1p-40)) {
    return false;
  }
  return is_bounded(square, factors(shares, scale));
}

// A polynomial of degree two in s and in z is a convex combination of its nine Bernstein coefficients: those
// of 1, s, s^2 are (1, 1, 1), (-1, 0, 1), (1, -1, 1).
bool LinearLength::is_bounded(double bound, const std::vector<double>& factor) const {
  constexpr std::array<std::array<double, kSide>, kSide> kBernstein{
      std::array<double, kSide>{1.0, -1.0, 1.0}, {1.0, 0.0, -1.0}, {1.0, 1.0, 1.0}};
  double slack = 0.0;
  for (std::size_t k = 0; k < grams_.size(); ++k) {
    slack += (grams_[k].others + grams_[k].rounding) * factor[k];
    for (const SymmetricMatrix& term : grams_[k].terms) {
      slack += 0x1p-44 * term.length() * factor[k];
    }
  }
  // The sum of the shares may exceed 1 by so little.
  const double room = bound * (1.0 - 0x1p-34) - bound_on(slack);
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

bool LinearLength::sum_is_at_most(double bound, double of_x, double of_v) const {
  if (grams_.empty() || grams_.size() > 2 || !(bound > 0x1p-400 && bound < 0x1p400) || !(of_x >= 0.0) ||
      !(of_v >= 0.0)) {
    return false;
  }
  return is_bounded(bound, {of_x, of_v});
}

double LinearLength::near_sum(double of_x, double of_v) const {
  SymmetricMatrix sum(size_);
  for (std::size_t k = 0; k < grams_.size(); ++k) {
    sum.add(grams_[k].terms[0], k == 0 ? of_x : of_v);
  }
  return near_largest_eigenvalue(sum);
}

bool LinearLength::square_is_at_most(double square, double scale) const {
  return !grams_.empty() && is_bounded(square, scale, proposed_shares(scale));
}

}  // namespace veritrack::checker
