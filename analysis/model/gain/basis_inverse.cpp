#include "analysis/model/gain/basis_inverse.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;

namespace {

class BasisInverse {
 public:
  BasisInverse(std::vector<BallModel> basis, std::size_t n) : n_(n), a_(std::move(basis)), unknown_(n) {
    std::iota(unknown_.begin(), unknown_.end(), std::size_t{0});
  }

  /// Solves for all right sides at once, in place.
  void solve(const std::vector<std::vector<BallModel>*>& sides) {
    for (std::size_t p = 0; p < n_; ++p) {
      bring_pivot_to(p, sides);
      const BallModel reciprocal = BallModel(1.0) / at(p, p);
      for (std::size_t i = 0; i < n_; ++i) {
        if (i == p) {
          continue;
        }
        const BallModel factor = at(i, p) * reciprocal;
        for (std::size_t j = p; j < n_; ++j) {
          at(i, j) -= factor * at(p, j);
        }
        for (auto* side : sides) {
          (*side)[i] -= factor * (*side)[p];
        }
      }
      for (std::size_t j = p; j < n_; ++j) {
        at(p, j) = at(p, j) * reciprocal;
      }
      for (auto* side : sides) {
        (*side)[p] = (*side)[p] * reciprocal;
      }
    }
    for (auto* side : sides) {
      std::vector<BallModel> solved = *side;
      for (std::size_t p = 0; p < n_; ++p) {
        (*side)[unknown_[p]] = std::move(solved[p]);
      }
    }
  }

 private:
  BallModel& at(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }

  /// The entry that is farthest from 0 on all of the cell, in units in which the largest entry of each row is
  /// 1, and then that of each column: states and modes have units.
  void bring_pivot_to(std::size_t p, const std::vector<std::vector<BallModel>*>& sides) {
    std::vector<double> rows(n_, 0.0);
    std::vector<double> columns(n_, 0.0);
    for (std::size_t i = p; i < n_; ++i) {
      for (std::size_t j = p; j < n_; ++j) {
        rows[i] = std::max(rows[i], std::fabs(at(i, j).constant()));
      }
      for (std::size_t j = p; j < n_; ++j) {
        columns[j] = std::max(columns[j], std::fabs(at(i, j).constant()) / rows[i]);
      }
    }
    std::size_t row = p;
    std::size_t column = p;
    double most = 0.0;
    for (std::size_t i = p; i < n_; ++i) {
      for (std::size_t j = p; j < n_; ++j) {
        const Interval range = at(i, j).range();
        const double weight = is_empty(range) ? 0.0 : rigor::mignitude(range) / (rows[i] * columns[j]);
        if (weight > most) {
          most = weight;
          row = i;
          column = j;
        }
      }
    }
    for (std::size_t j = 0; j < n_; ++j) {
      std::swap(at(p, j), at(row, j));
    }
    for (auto* side : sides) {
      std::swap((*side)[p], (*side)[row]);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      std::swap(at(i, p), at(i, column));
    }
    std::swap(unknown_[p], unknown_[column]);
  }

  std::size_t n_;
  std::vector<BallModel> a_;
  std::vector<std::size_t> unknown_;  ///< of each column
};

}  // namespace

void solve_in_basis(std::vector<BallModel> basis, const std::vector<std::vector<BallModel>*>& sides) {
  const std::size_t n = sides.empty() ? 0 : sides.front()->size();
  BasisInverse(std::move(basis), n).solve(sides);
}

}  // namespace veritrack::model
