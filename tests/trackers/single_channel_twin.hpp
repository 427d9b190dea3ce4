// The single-channel tracker in double precision beside its twin in long double: what rounding does, without
// any analysis.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::test {

using Wide = long double;
using WideMatrix = Eigen::Matrix<Wide, 3, 3>;

/// Q = diag(q1, q1, q2), r; no leak.
struct SingleChannelValues {
  double q1 = 0.0, q2 = 0.0, r = 0.0;
};

template <typename To, typename From>
trackers::SingleChannelEstimate<To> estimate_as(const trackers::SingleChannelEstimate<From>& e) {
  const auto& p = e.covariance;
  const auto to = [](From x) { return static_cast<To>(x); };
  return {to(e.in_phase),
          to(e.quadrature),
          to(e.frequency),
          {to(p.conditional_11), to(p.conditional_12), to(p.conditional_22), to(p.regression_1),
           to(p.regression_2), to(p.frequency_variance)}};
}

template <typename Scalar>
trackers::SingleChannelEstimate<Scalar> stepped(const SingleChannelValues& values,
                                                const trackers::SingleChannelEstimate<Scalar>& start,
                                                double measurement) {
  trackers::SingleChannelEkf<Scalar> tracker(
      {trackers::diagonal_process_noise<Scalar>(values.q1, values.q2), values.r, 0.0}, start);
  tracker.step(measurement);
  return tracker.filtered();
}

/// What a step in double and the same from the very same numbers in long double differ by.
struct TwinDifference {
  double z = 0.0, frequency = 0.0, p_zz = 0.0, p_z3 = 0.0, p_33 = 0.0;
  double covariance = 0.0;  ///< the least m with -m P <= difference <= m P, P the exact step's
  double error = 0.0;       ///< the length of the estimates' difference in the metric of the program's P^-1
};
inline TwinDifference twin_difference(const SingleChannelValues& values,
                                      const trackers::SingleChannelEstimate<double>& start,
                                      double measurement) {
  const auto computed = estimate_as<Wide>(stepped(values, start, measurement));
  const auto exact = stepped(values, estimate_as<Wide>(start), measurement);
  const WideMatrix p = exact.covariance.matrix();
  const WideMatrix d = computed.covariance.matrix() - p;
  const Eigen::Matrix2d zz = d.topLeftCorner<2, 2>().cast<double>();
  const Eigen::Matrix<Wide, 3, 1> e = computed.state() - exact.state();
  return {static_cast<double>(e.head<2>().norm()),
          static_cast<double>(std::fabs(e(2))),
          oracle::symmetric_eigenvalues(zz).cwiseAbs().maxCoeff(),
          static_cast<double>(std::hypot(d(0, 2), d(1, 2))),
          static_cast<double>(std::fabs(d(2, 2))),
          static_cast<double>(oracle::relative_radius(d, p)),
          static_cast<double>(std::sqrt(e.dot(computed.covariance.matrix().inverse() * e)))};
}

/// States within these bounds, at an amplitude of 1: lengths of z and u, eigenvalues of M, and d.
struct StateLimits {
  double z = 0.0, frequency = 0.0, least_m = 0.0, most_m = 0.0, u = 0.0, least_d = 0.0, most_d = 0.0;
};

/// One of them, often at an end.
inline trackers::SingleChannelEstimate<double> random_state(Random& random, const StateLimits& limits) {
  const auto between = [&](double low, double high) {
    constexpr double kInside = 1e-9;
    const double share = random.below(3) == 0 ? random.uniform() : static_cast<double>(random.below(2));
    return low + (high - low) * std::clamp(share, kInside, 1.0 - kInside);
  };
  const double phase = random.uniform(0.0, 2.0 * M_PI);
  const double direction = random.uniform(0.0, 2.0 * M_PI);
  const double axis = random.uniform(0.0, M_PI);
  const double z = between(0.0, limits.z);
  const double u = between(0.0, limits.u);
  const double mean = between(limits.least_m, limits.most_m);
  const double room = std::min(mean - limits.least_m, limits.most_m - mean);
  const double half = between(0.0, room);
  return {
      z * std::cos(phase),
      z * std::sin(phase),
      between(-limits.frequency, limits.frequency),
      {mean + half * std::cos(2.0 * axis), half * std::sin(2.0 * axis), mean - half * std::cos(2.0 * axis),
       u * std::cos(direction), u * std::sin(direction), between(limits.least_d, limits.most_d)}};
}

/// The state and the filter in another unit of length.
inline trackers::SingleChannelEstimate<double> in_unit(trackers::SingleChannelEstimate<double> state,
                                                       double amplitude) {
  auto& p = state.covariance;
  for (double* x : {&state.in_phase, &state.quadrature, &p.regression_1, &p.regression_2}) {
    *x *= amplitude;
  }
  for (double* x : {&p.conditional_11, &p.conditional_12, &p.conditional_22}) {
    *x *= amplitude * amplitude;
  }
  return state;
}
inline SingleChannelValues in_unit(const SingleChannelValues& values, double amplitude) {
  return {values.q1 * amplitude * amplitude, values.q2, values.r * amplitude * amplitude};
}

}  // namespace veritrack::test
