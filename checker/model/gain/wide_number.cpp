#include "checker/model/gain/wide_number.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

namespace {

constexpr double kMargin = 1.0 + 0x1p-36;
constexpr double kUnderflow = 0x1p-1000;
/// The error of a sum of products of any sign, relative to the sum of absolute values: far above 132
/// roundings.
constexpr double kError = 0x1p-45;
const double kInfinity = HUGE_VAL;

}  // namespace

double up(double sum) {
  return sum * kMargin;
}

double upward_product(double x, double y) {
  return x == 0.0 || y == 0.0 ? 0.0 : x * y + kUnderflow;
}

double upper(const Ball& x) {
  const double bound = x.finite() ? x.upper_double() : kInfinity;
  return bound >= 0.0 ? bound : bound < 0.0 ? 0.0 : kInfinity;
}

WideNumber wide(const Ball& x) {
  const double middle = x.near();
  return {middle, upper(abs(x - Ball(middle)))};
}

double largest_size(const WideNumber& x) {
  return up(std::abs(x.middle) + x.radius);
}

WideNumber dot(const WideRow& x, const WideRow& y) {
  WideNumber result;
  double spread = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // Products of factors that keep their signs are between those of the ends, whose mean is the product of
    // the middles and that of the radii. Where a radius is larger than the middle, the part of it that is
    // not adds to the radius.
    const double product = x[i].middle * y[i].middle;
    const double of_x = std::abs(x[i].middle);
    const double of_y = std::abs(y[i].middle);
    const double shared_x = std::min(of_x, x[i].radius);
    const double shared_y = std::min(of_y, y[i].radius);
    result.middle += product + std::copysign(shared_x * shared_y, product);
    spread += upward_product(of_x, y[i].radius + upward_product(kError, of_y)) +
              upward_product(x[i].radius, of_y + (y[i].radius - shared_y)) +
              upward_product(shared_y, x[i].radius - shared_x);
  }
  result.radius = up(spread);
  return result;
}

double length(const WideNumber& x, const WideNumber& y) {
  const double first = largest_size(x);
  const double second = largest_size(y);
  return second == 0.0 ? first
                       : up(std::sqrt(up(upward_product(first, first) + upward_product(second, second))));
}

MatrixPowers::MatrixPowers(const std::vector<WideRow>& columns) : columns_(&columns), rows_(columns.size()) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    rows_[i].assign(columns.size(), {0.0, 0.0});
    rows_[i][i].middle = 1.0;
  }
}

void MatrixPowers::advance(Table& defect, bool is_last) {
  spend(static_cast<std::int64_t>(rows_.size() * rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    WideRow next(rows_.size());
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      const WideNumber entry = dot(rows_[i], (*columns_)[j]);
      defect[i][j] = up(defect[i][j] + (is_last ? largest_size(entry) : entry.radius));
      next[j] = {is_last ? 0.0 : entry.middle, 0.0};
    }
    rows_[i] = std::move(next);
  }
}

WideRow MatrixPowers::product(const WideRow& row) const {
  WideRow result(rows_.size());
  WideRow column(rows_.size());
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      column[i] = rows_[i][j];
    }
    result[j] = dot(row, column);
  }
  return result;
}

std::optional<std::vector<double>> closed(const Table& defect, const std::vector<double>& given) {
  constexpr int kRounds = 100;
  std::vector<double> bound = given;
  for (int round = 0; round < kRounds; ++round) {
    bool is_closed = true;
    std::vector<double> next(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      double sum = given[i];
      for (std::size_t j = 0; j < given.size(); ++j) {
        sum += upward_product(defect[i][j], bound[j]);
      }
      next[i] = up(sum);
      is_closed = is_closed && std::isfinite(next[i]) && next[i] <= bound[i];
    }
    if (is_closed) {
      return bound;
    }
    for (std::size_t i = 0; i < given.size(); ++i) {
      bound[i] = next[i] * kGrowth;
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::checker
