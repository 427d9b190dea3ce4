// The worth of the parameters of a filter's tube, and their coordinates in a search.
#pragma once

#include <functional>
#include <limits>
#include <span>

#include "analysis/model/filter/filter_orbit.hpp"

namespace veritrack::model::detail {

/// Parameters as a point: the logarithm of eta, the logits of theta and of lambda between the square of the
/// rate and 1, the logarithms of b and d, those of the process noise in units of the states, with a slew that
/// of c, and, when it is searched for, that of the noise V or the slew W.
struct FilterCoordinates {
  double rate_squared;
  VectorXd sizes;
  double given_noise;
  bool finds_noise;
  double given_slew = 0.0;
  bool finds_slew = false;
  double exponent = 0.0;  ///< of Gaussian noise; 0: the noise is bounded

  [[nodiscard]] bool moves() const { return given_slew > 0.0 || finds_slew; }
  [[nodiscard]] bool finds() const { return finds_noise || finds_slew; }
  [[nodiscard]] Index size() const { return 5 + sizes.size() + (moves() ? 1 : 0) + (finds() ? 1 : 0); }
  [[nodiscard]] FilterParameters at(const VectorXd& x) const;
};

/// The worth of parameters: the largest growth, that of its linear part without noise, and the largest
/// frequency errors, over the phase.
struct FilterWorth {
  double growth = std::numeric_limits<double>::infinity();
  double linear = 1.0;
  double least_reach = std::numeric_limits<double>::infinity();
  double most_reach = 0.0;
};

/// Where the orbits of the search begin, rad.
inline constexpr double kFirstPhase = 0.3;

/// Over `samples` samples of an orbit, after `before`. With `enough`, the growth is only compared with it: it
/// is at most that, or infinite.
[[nodiscard]] FilterWorth worth_on_orbit(const TrackedTone& tone, const NodeCurve& curve,
                                         const FilterParameters& parameters, int before, int samples,
                                         const Surroundings& around = {},
                                         const Eigen::MatrixXcd* slope = nullptr,
                                         const OrbitPoints* points = nullptr, double enough = 0.0);
/// The worst of several worths.
[[nodiscard]] FilterWorth least_of(std::span<const FilterWorth> each);

/// The number of samples that the shape remembers.
[[nodiscard]] int memory_of(double rate_squared, const FilterParameters& parameters, double share);

/// The least logit of lambda that is searched: nearer to the square of the rate a shape is settled after
/// thousands of samples only, each of which is followed in every trial.
inline constexpr double kLeastLogit = -2.5;
inline constexpr double kLargestGrowth = 0.985;

/// A point of a search and its worth; minus infinity: no worth.
struct ScoredPoint {
  double value = -std::numeric_limits<double>::infinity();
  VectorXd point;
};
[[nodiscard]] const ScoredPoint& best_of(std::span<const ScoredPoint> points);

/// Climbs from `best`, with `evaluations` evaluations of `score`, which may return another point than the
/// requested one. Steps of the logarithms of parameters.
void climb(ScoredPoint& best, double step, int evaluations,
           const std::function<ScoredPoint(const VectorXd&)>& score);

}  // namespace veritrack::model::detail
