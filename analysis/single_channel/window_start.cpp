#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "analysis/single_channel/window_grid.hpp"

namespace veritrack::single_channel {

using detail::Covariance;
using detail::Matrix3;

StartProposal propose_start(const WindowRequest& request, const WindowClaim& claim, const StartBox& box) {
  const rigor::UpwardRounding upward;
  const auto window = static_cast<int>(claim.shares.size());
  StartProposal best{detail::kInfinity, 0.5};
  for (const double weight : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
    const double signal = box.signal * box.signal / weight;
    const double frequency = box.frequency * box.frequency / (1.0 - weight);
    double level = 0.0;
    detail::follow_grid(request, claim.assumption, window,
                        [&](int m, const Covariance& /*upper*/, const Covariance& lower, const Covariance&) {
                          if (m == window) {
                            const Eigen::LLT<Matrix3> factor(detail::matrix_of(lower));
                            const Matrix3 wanted = rigor::Vector<3>(signal, signal, frequency).asDiagonal();
                            const Matrix3 half = factor.matrixL().solve(wanted);
                            const Matrix3 both = factor.matrixL().solve(half.transpose());
                            level = std::max(
                                level, -detail::smallest_eigenvalue<3>(-0.5 * (both + both.transpose())));
                          }
                        });
    if (std::sqrt(level) < best.level) {
      best = {std::sqrt(level), weight};
    }
  }
  return best;
}

}  // namespace veritrack::single_channel
