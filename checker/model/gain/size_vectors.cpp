#include "checker/model/gain/size_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

std::vector<double> product_above(const Table& matrix, const std::vector<double>& vector) {
  std::vector<double> result(matrix.size(), 0.0);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < vector.size(); ++j) {
      result[i] += upward_product(matrix[i][j], vector[j]);
    }
    result[i] = up(result[i]);
  }
  return result;
}

Table product_above(const Table& x, const Table& y) {
  Table result(x.size(), std::vector<double>(x.size(), 0.0));
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      for (std::size_t k = 0; k < x.size(); ++k) {
        result[i][j] += upward_product(x[i][k], y[k][j]);
      }
      result[i][j] = up(result[i][j]);
    }
  }
  return result;
}

void add_to(std::vector<double>& sum, const std::vector<double>& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = up(sum[i] + more[i]);
  }
}

void raise_all(std::vector<double>& most, const std::vector<double>& values) {
  for (std::size_t i = 0; i < most.size(); ++i) {
    most[i] = std::max(most[i], values[i]);
  }
}

std::optional<std::vector<double>> closed_together(const std::vector<const Table*>& defects,
                                                   const std::vector<std::vector<double>>& given) {
  constexpr int kRounds = 200;
  if (defects.empty() || defects.size() != given.size()) {
    return std::nullopt;
  }
  std::vector<double> bound(given.front().size(), 0.0);
  for (const std::vector<double>& each : given) {
    raise_all(bound, each);
  }
  for (int round = 0; round < kRounds; ++round) {
    bool is_closed = true;
    std::vector<double> raised = bound;
    for (std::size_t part = 0; part < given.size(); ++part) {
      std::vector<double> next = product_above(*defects[part], bound);
      add_to(next, given[part]);
      for (std::size_t i = 0; i < bound.size(); ++i) {
        if (!std::isfinite(next[i])) {
          return std::nullopt;
        }
        is_closed = is_closed && next[i] <= bound[i];
        raised[i] = std::max(raised[i], next[i] * kGrowth);
      }
    }
    if (is_closed) {
      return bound;
    }
    bound = std::move(raised);
  }
  return std::nullopt;
}

}  // namespace veritrack::checker
