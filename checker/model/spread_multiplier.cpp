#include "checker/model/spread_multiplier.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "checker/model/place_of_least.hpp"
#include "checker/model/symmetric_matrix.hpp"

namespace veritrack::checker {

namespace {

constexpr double kNotBounded = std::numeric_limits<double>::infinity();

/// (m, p) in the middle of a part, as sums of squares of their coefficients: N N' and so on.
class StackedLength {
 public:
  StackedLength(const PlaceMatrix& spread, const std::vector<BallPolynomial>& deviation,
                const std::vector<BallPolynomial>& aside, const VectorMonomials& monomials,
                double of_gaussian)
      : states_(deviation.size()),
        size_(deviation.size() + aside.size()),
        of_gaussian_(of_gaussian),
        of_x_(size_),
        of_others_(size_),
        of_squares_(size_),
        spread_(states_) {
    std::vector<const BallPolynomial*> rows;
    rows.reserve(size_);
    for (const std::vector<BallPolynomial>* part : {&deviation, &aside}) {
      for (const BallPolynomial& row : *part) {
        rows.push_back(&row);
        is_known_ = is_known_ && row.known();
      }
    }
    if (!is_known_) {
      return;
    }
    add(rows, monomials, 1, 0, monomials.first(1), of_x_);
    add(rows, monomials, 1, monomials.first(1), monomials.variables(), of_others_);
    add(rows, monomials, 2, 0, monomials.count(2), of_squares_);
    has_others_ = of_others_.trace() > 0.0;
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        is_known_ = is_known_ && spread[i][j].known();
        spread_.add(i, j, spread[i][j].constant());
      }
    }
  }

  [[nodiscard]] bool known() const { return is_known_; }
  [[nodiscard]] bool has_others() const { return has_others_; }
  [[nodiscard]] double largest_spread() const { return near_largest_eigenvalue(spread_); }

  /// For one mu.
  struct Turned {
    SymmetricMatrix of_x, of_others;
    double of_squares = kNotBounded;  ///< infinite for a mu that is not above the spread
  };
  [[nodiscard]] Turned turned(double mu) const {
    std::vector<std::vector<double>> rest(states_, std::vector<double>(states_, 0.0));
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = 0; j < states_; ++j) {
        rest[i][j] = (i == j ? 1.0 : 0.0) - spread_(i, j) / mu;
      }
    }
    const std::vector<std::vector<double>> inverse = near_inverse_root(rest);
    if (inverse.empty()) {
      return {SymmetricMatrix(size_), SymmetricMatrix(size_)};
    }
    const bool is_gaussian = of_gaussian_ > 0.0;
    return {turned(of_x_, inverse, mu),
            has_others_ ? turned(of_others_, inverse, mu) : SymmetricMatrix(size_),
            is_gaussian ? 0.0 : root(near_largest_eigenvalue(turned(of_squares_, inverse, mu)))};
  }

  /// Where |x| counts as t of the unit ball of all vectors.
  [[nodiscard]] double at(const Turned& of_mu, double t) const {
    if (!std::isfinite(of_mu.of_squares)) {
      return kNotBounded;
    }
    SymmetricMatrix linear(size_);
    if (of_gaussian_ > 0.0) {
      linear.add(of_mu.of_x, 1.0);
      linear.add(of_mu.of_others, of_gaussian_);
      return near_largest_eigenvalue(linear);
    }
    linear.add(of_mu.of_x, has_others_ ? 1.0 / t : 1.0);
    if (has_others_) {
      linear.add(of_mu.of_others, 1.0 / (1.0 - t));
    }
    return root(near_largest_eigenvalue(linear)) + of_mu.of_squares;
  }

 private:
  static double root(double square) { return std::sqrt(std::max(0.0, square)); }

  static void add(const std::vector<const BallPolynomial*>& rows, const VectorMonomials& monomials,
                  int degree, std::size_t first, std::size_t last, SymmetricMatrix& gram) {
    std::vector<double> column(rows.size());
    for (std::size_t number = first; number < last; ++number) {
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::span<const double> block = rows[i]->block(degree, number);
        column[i] = block.empty() ? 0.0 : block[0];
      }
      const double weight = monomials.kinds(degree)[number].weight;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          gram.add(i, j, weight * column[i] * column[j]);
        }
      }
    }
  }

  /// K G K', K = (T^-1, 0; 0, sqrt(mu) I).
  [[nodiscard]] SymmetricMatrix turned(const SymmetricMatrix& gram,
                                       const std::vector<std::vector<double>>& inverse, double mu) const {
    const double root_of_mu = std::sqrt(mu);
    const auto factor = [&](std::size_t i, std::size_t k) {
      return i < states_ ? (k <= i ? inverse[i][k] : 0.0) : i == k ? root_of_mu : 0.0;
    };
    std::vector<double> half(size_ * size_, 0.0);  // K G
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = i < states_ ? 0 : i; k <= i; ++k) {
        for (std::size_t j = 0; j < size_; ++j) {
          half[i * size_ + j] += factor(i, k) * gram(k, j);
        }
      }
    }
    SymmetricMatrix result(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double entry = 0.0;
        for (std::size_t k = j < states_ ? 0 : j; k <= j; ++k) {
          entry += half[i * size_ + k] * factor(j, k);
        }
        result.add(i, j, entry);
      }
    }
    return result;
  }

  std::size_t states_;
  std::size_t size_;
  double of_gaussian_;
  bool is_known_ = true;
  bool has_others_ = false;
  SymmetricMatrix of_x_, of_others_, of_squares_;
  SymmetricMatrix spread_;
};

}  // namespace

double near_best_multiplier(const PlaceMatrix& spread, const std::vector<BallPolynomial>& deviation,
                            const std::vector<BallPolynomial>& aside, const VectorMonomials& monomials,
                            double of_gaussian) {
  const StackedLength length(spread, deviation, aside, monomials, of_gaussian);
  if (!length.known()) {
    return 0.0;
  }
  const double largest = length.largest_spread();
  const double unit = std::max(largest, 0.0) + std::numeric_limits<double>::min();
  // mu = (1 + e^u) times the largest eigenvalue of the spread.
  const auto multiplier = [&](double u) { return unit * (1.0 + std::exp(u)); };
  const auto share = [](double logit) { return 1.0 / (1.0 + std::exp(-logit)); };
  constexpr double kLow = -4.5;
  constexpr double kHigh = 6.0;
  // The minimum over the shares falls and then rises with mu. Searching one after the other does not end
  // there: the valley is narrow, along neither of them, and has edges.
  const bool is_shared = length.has_others() && !(of_gaussian > 0.0);
  const auto best_logit = [&](const StackedLength::Turned& of_mu, double middle, double width, int sections) {
    return place_of_least(middle - width, middle + width, sections,
                          [&](double logit) { return length.at(of_mu, share(logit)); });
  };
  const auto best_u = [&](double low, double high, int sections, double middle, double width, int inside) {
    return place_of_least(low, high, sections, [&](double u) {
      const StackedLength::Turned of_mu = length.turned(multiplier(u));
      return length.at(of_mu, is_shared ? share(best_logit(of_mu, middle, width, inside)) : 1.0);
    });
  };
  double u = best_u(kLow, kHigh, 7, 2.5, 6.0, 6);
  const double logit = best_logit(length.turned(multiplier(u)), 2.5, 6.0, 9);
  u = best_u(u - 0.5, u + 0.5, 6, logit, 0.6, 6);
  const double mu = multiplier(u);
  return std::isfinite(mu) && std::isfinite(length.turned(mu).of_squares) ? mu : 0.0;
}

}  // namespace veritrack::checker
