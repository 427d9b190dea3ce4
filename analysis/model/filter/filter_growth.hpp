// The growth of a filter's tube in a step, for proposals.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "analysis/model/filter/filter_numbers.hpp"

namespace veritrack::model::detail {

struct FilterParameters {
  double eta = 0.3;
  double theta = 0.3;
  double lambda = 0.9;
  double noise = 0.0;     ///< V, or the deviation of Gaussian noise
  double slew = 0.0;      ///< W
  double moving = 0.0;    ///< c
  double source = 0.0;    ///< b
  double spread = 0.0;    ///< d
  double exponent = 0.0;  ///< L, for Gaussian noise: see gaussian_drift.hpp; 0: the noise is bounded
  VectorXd process;       ///< the diagonal of W
};

/// A step, from a shape L L' to the next one; gains between K - delta weighted' and K + delta weighted'.
struct FilterStepOnOrbit {
  SmallMatrix before;                ///< L of the shape before
  SmallMatrix after;                 ///< the shape after
  SmallMatrix delta;                 ///< half of the distance of the covariance's bounds
  SmallMatrix gain;                  ///< K in their middle
  SmallMatrix contraction;           ///< I - K H
  SmallMatrix slope;                 ///< the derivative of f
  std::vector<SmallMatrix> changes;  ///< of it, along the columns of L
  SmallVector offset;                ///< on the curve: K times the innovation there, minus its correction
  SmallVector innovation;            ///< on the curve
  SmallVector move;  ///< of the curve with the frequency; empty when the frequency is constant
};

/// The worth of a step.
struct FilterGrowth {
  double whole = 0.0;   ///< approximately |F| for |xi| <= 1
  double linear = 0.0;  ///< of it, without noise
};

/// c0, for proposals.
inline constexpr double kProposedConstant = 5.0;

/// Bounds of the growth, by multipliers for the range of gains. Keeps those that were good at the last step.
class FilterGrowthBound {
 public:
  /// The least bound over the multipliers that are tried. With `enough`, the first one that is at most that,
  /// and infinity when there is none.
  [[nodiscard]] FilterGrowth of(const FilterStepOnOrbit& step, const FilterNumbers& numbers,
                                const FilterParameters& parameters, double enough);

 private:
  /// The root of the least largest eigenvalue of gram/t + other/(1 - t) over some t, or infinity when it is
  /// above `most`; with `any`, the first one that is not. `alone`: the root of the one of gram.
  [[nodiscard]] double with_disturbances(const SmallMatrix& gram, const SmallMatrix& other, double alone,
                                         double most, bool any);

  std::size_t good_share_ = 0, best_share_ = 0, good_split_ = 0;
};

}  // namespace veritrack::model::detail
