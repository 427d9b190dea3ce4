#include "reports/recording/chi_square.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::reports {

double mean_square_quantile(double freedom, double deviate) {
  const double spread = 2.0 / (9.0 * freedom);
  const double root = std::max(0.0, 1.0 - spread + deviate * std::sqrt(spread));
  return root * root * root;
}

}  // namespace veritrack::reports
