#include "analysis/model/gain/basis_inverse.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;

namespace {

class BasisInverse {
 public:
  BasisInverse(std::vector<BallModel> basis, std::size_t n) : n_(n), a_(std::move(basis)) {}

  /// Solves for all right sides at once, in place.
  void solve(const std::vector<std::vector<BallModel>*>& sides) {
    for (std::size_t p = 0; p < n_; ++p) {
      std::size_t pivot = p;
      for (std::size_t i = p + 1; i < n_; ++i) {
        pivot = weight(i, p) > weight(pivot, p) ? i : pivot;
      }
      for (std::size_t j = 0; j < n_; ++j) {
        std::swap(at(p, j), at(pivot, j));
      }
      for (auto* side : sides) {
        std::swap((*side)[p], (*side)[pivot]);
      }
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
  }

 private:
  BallModel& at(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }
  /// How far an entry is from 0, relative to its row: states have units.
  double weight(std::size_t i, std::size_t p) {
    double row = 0.0;
    for (std::size_t j = p; j < n_; ++j) {
      row = std::max(row, std::fabs(at(i, j).constant()));
    }
    const Interval range = at(i, p).range();
    return is_empty(range) ? 0.0 : rigor::mignitude(range) / row;
  }

  std::size_t n_;
  std::vector<BallModel> a_;
};

}  // namespace

void solve_in_basis(std::vector<BallModel> basis, const std::vector<std::vector<BallModel>*>& sides) {
  const std::size_t n = sides.empty() ? 0 : sides.front()->size();
  BasisInverse(std::move(basis), n).solve(sides);
}

}  // namespace veritrack::model
