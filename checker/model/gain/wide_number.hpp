// Numbers with their errors, in doubles: what bounds by gains are summed up from. Sums of at most 2^13
// products of numbers that are not negative are at most 2^-38 of their size larger than computed, besides
// what is lost to underflow.
#pragma once

#include <optional>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// A number within `radius` of `middle`.
struct WideNumber {
  double middle = 0.0;
  double radius = 0.0;
};
using WideRow = std::vector<WideNumber>;
using Table = std::vector<std::vector<double>>;

/// By how much bounds grow from round to round, so that a search for them ends.
constexpr double kGrowth = 1.0 + 0x1p-20;

/// Not below a sum that was computed as `sum`, of numbers that are not negative.
double up(double sum);
/// Not below the product of numbers that are not negative; exactly 0 where one of them is.
double upward_product(double x, double y);
/// Not below any point, and not negative; infinite where it is not known.
double upper(const Ball& x);
WideNumber wide(const Ball& x);
double largest_size(const WideNumber& x);
/// The sum of at most 32 products. Of exact numbers `middle` is the sum of their products, as computed.
WideNumber dot(const WideRow& x, const WideRow& y);
/// Not below the length of a vector of two.
double length(const WideNumber& x, const WideNumber& y);

/// The powers of the middle of a matrix in doubles, one after the other: G_0 = I, ..., G_(K-1).
class MatrixPowers {
 public:
  /// `columns`: of the matrix. Must outlive this.
  explicit MatrixPowers(const std::vector<WideRow>& columns);
  /// The next one, and the size of its difference to G A, which is added to `defect`. After the last one is
  /// 0.
  void advance(Table& defect, bool is_last);
  /// row G.
  [[nodiscard]] WideRow product(const WideRow& row) const;

 private:
  const std::vector<WideRow>* columns_;
  std::vector<WideRow> rows_;
};

/// A T >= given + M T, or nothing.
std::optional<std::vector<double>> closed(const Table& defect, const std::vector<double>& given);

}  // namespace veritrack::checker
