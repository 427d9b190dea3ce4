// The bias of the quadrature tracker with the same design values, for comparison: the frequency error of the
// fixed point of its step that continues the exact estimate at frequency 0.
#pragma once

#include <vector>

#include "checker/numbers/matrix.hpp"
#include "checker/sets/tone_step.hpp"

namespace veritrack::checker {

/// The branch of fixed points, followed as far as it is asked for.
class QuadratureBranch {
 public:
  explicit QuadratureBranch(const TrackerValues<Ball>& values) : values_(values) {}

  /// Contains nu*(frequency), rad/sample; a ball of everything where the branch could not be followed.
  [[nodiscard]] Ball error_at(const Ball& frequency);

 private:
  /// At every frequency there is exactly one fixed point in middle + slope (frequency - center) + unique, and
  /// it is in the same with `tight` for `unique`.
  struct Cell {
    Ball frequencies, center;
    Matrix middle, slope, unique, tight;
    [[nodiscard]] Matrix around(const Ball& frequency, const Matrix& deviation) const {
      return middle + (frequency - center) * slope + deviation;
    }
  };
  [[nodiscard]] bool add_cell(const Ball& frequencies);

  TrackerValues<Ball> values_;
  std::vector<Cell> cells_;
  bool lost_ = false;
};

}  // namespace veritrack::checker
