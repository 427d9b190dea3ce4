// Does every step map one level of a set around the steady state into the next one? With a leak.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/quadrature/leak/steady_order.hpp"

namespace veritrack::quadrature {

/// The joint result of the cells that cover a level.
struct SteadyContraction {
  bool proved = false;
  std::string reason;      ///< one sentence when not proved
  std::int64_t cells = 0;  ///< examined
};

/// The disturbances of the tracker.
struct SteadyDisturbance {
  rigor::Interval noise;  ///< |v| <= noise
  /// Upper bounds on how far slew and rounding carry e+ - e*, in the metric, and P+ - P*, as a share of its
  /// bounds.
  rigor::Interval motion, covariance_motion;
};

/// The cells into which a level was cut: the one below it is much like it, and begins with them.
class SteadyDivision {
 public:
  /// The cell of the first node is the whole level.
  static constexpr std::size_t kWhole = 0;

  SteadyDivision() : nodes_(1) {}

  /// Is the cell to be cut without being examined again? Yes where it failed at a slightly higher level, or
  /// where its parts were cut, too.
  [[nodiscard]] bool skips(std::size_t node, double level) const;
  /// The cell is proved: it needs no parts.
  void close(std::size_t node) { nodes_[node].first = 0; }
  /// The cell fails at this level: it gets parts, cut across this side, if it has none.
  void open(std::size_t node, double level, std::size_t side);

  [[nodiscard]] std::size_t first_part(std::size_t node) const { return nodes_[node].first; }
  [[nodiscard]] std::size_t side(std::size_t node) const { return nodes_[node].side; }

 private:
  struct Node {
    std::size_t first = 0;  ///< of its two parts, which are neighbours; 0 when it has none
    std::size_t side = 0;
    double failed_at = 0.0;
  };
  std::vector<Node> nodes_;
};

/// Covers all states of this level s by cells in (x, y), bisected until every step from them maps into the
/// level `next` = kappa s: |T (e+ - e*)| <= kappa s and -kappa s below <= P+ - P* <= kappa s above, kappa <=
/// 1. For the covariance it is enough to look at the images of the two bounds: P <= P* + s above implies
/// Phi(P, rho) <= Phi(P* + s above, rho), as the Riccati step is monotone for positive definite covariances
/// (riccati_order.hpp; the leak changes F only), and a turn keeps the order. Needs P* - s below > 0, and the
/// upward mode. Gives up after `most_cells`. Begins with the cells of `division`, and leaves its own there.
[[nodiscard]] SteadyContraction prove_contraction(const SteadySettings& settings, double level, double next,
                                                  const SteadyDisturbance& disturbance,
                                                  std::int64_t most_cells, SteadyDivision& division);

}  // namespace veritrack::quadrature
