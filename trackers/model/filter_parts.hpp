// An extended Kalman filter by its parts, for a proof that bounds the covariance by matrices.
#pragma once

#include <span>
#include <vector>

#include "trackers/model/straight_line_program.hpp"

namespace veritrack::trackers {

/// A filter with a linear measurement, y = H x + h_0 + noise, H constant. From the filtered estimate x and
/// the covariance P: x^ = f(x), P^ = F P F' + Q, then P+ = P^ - P^ H' (H P^ H' + R)^-1 H P^ and x+ = x^ + P+
/// H' R^-1 (y - H x^ - h_0).
struct FilterParts {
  /// Inputs: constants, x, samples. Results: x^ and then, row by row, F, the innovation y - H x^ - h_0, H, Q
  /// and R; the last three depend on the constants only.
  StraightLineProgram program{0};
  int states = 0;
  int samples = 0;
  /// F is given by the user, and need not be the derivative of f. Proofs take it as a function of x.
  bool has_given_jacobian = false;
};

/// The results of the program, in their places.
template <typename Scalar>
struct FilterValues {
  std::vector<Scalar> predicted;   ///< x^, n
  std::vector<Scalar> jacobian;    ///< F, n x n
  std::vector<Scalar> innovation;  ///< one for each sample
  std::vector<Scalar> measured;    ///< H, samples x n
  std::vector<Scalar> process;     ///< Q, n x n
  std::vector<Scalar> noise;       ///< R, samples x samples
};

/// Runs the program; `inputs` are constants, x and samples.
template <typename Scalar>
[[nodiscard]] FilterValues<Scalar> filter_values(const FilterParts& parts,
                                                 const std::vector<Scalar>& inputs) {
  std::vector<Scalar> registers;
  std::vector<Scalar> results(parts.program.results().size());
  parts.program.run(std::span<const Scalar>(inputs), registers, std::span<Scalar>(results));
  FilterValues<Scalar> values;
  const int n = parts.states;
  const int c = parts.samples;
  auto next = results.begin();
  const auto take = [&next](std::vector<Scalar>& list, int count) {
    list.assign(next, next + count);
    next += count;
  };
  take(values.predicted, n);
  take(values.jacobian, n * n);
  take(values.innovation, c);
  take(values.measured, c * n);
  take(values.process, n * n);
  take(values.noise, c * c);
  return values;
}

}  // namespace veritrack::trackers
