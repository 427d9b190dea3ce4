// Proposals for ball.hpp, in floating point: a metric and a radius. Nothing here is evidence.
#pragma once

#include <optional>
#include <vector>

#include "analysis/contraction/ball_derivatives.hpp"
#include "analysis/contraction/fixed_point.hpp"

namespace veritrack::contraction {

/// The derivatives of a closed loop at one fixed point, laid out as in ball_derivatives.hpp; N states.
struct LocalModel {
  rigor::DynamicMatrix linear;     ///< N x N
  rigor::DynamicMatrix quadratic;  ///< N x N^2
  rigor::DynamicMatrix cubic;      ///< N x N^3
  rigor::DynamicMatrix noise;      ///< N x kNoises
};

/// The local model at the middle of a tube. Holds its own rounding mode.
template <typename Loop>
[[nodiscard]] LocalModel local_model(const Loop& loop, const FixedPointTube<Loop::kStates>& tube) {
  constexpr int kSize = Loop::kStates;
  using rigor::Interval;
  const rigor::UpwardRounding upward;
  const Interval parameter(tube.parameter_center);
  const rigor::IntervalVector<kSize> state = rigor::to_interval(tube.center);
  const rigor::IntervalMatrix<kSize> identity = rigor::IntervalMatrix<kSize>::Identity();
  LocalModel model;
  model.linear = midpoint(linearize_loop<Loop, Interval>(loop, state, parameter).jacobian);
  model.quadratic = midpoint(unfolded<kSize>(second_derivatives(loop, state, parameter), identity, identity));
  model.cubic = midpoint(unfolded<kSize>(third_derivatives(loop, state, parameter), identity, identity));
  using Input = rigor::Dual<Interval, Loop::kNoises + 1>;
  Column<Input, kSize> x;
  for (int i = 0; i < kSize; ++i) {
    x[i] = Input(state[i]);
  }
  const rigor::IntervalVector<Loop::kNoises + 1> quiet =
      rigor::IntervalVector<Loop::kNoises + 1>::Constant(Interval(0.0));
  const Column<Input, kSize> image =
      loop(x, Input(parameter), Column<Input, Loop::kNoises + 1>(variables(quiet)));
  model.noise.resize(kSize, Loop::kNoises);
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < Loop::kNoises; ++j) {
      model.noise(i, j) = midpoint(image[i].derivative(j));
    }
  }
  return model;
}

/// What a ball should be large for.
enum class BallAim {
  state,  ///< the largest |X_i - X*_i| in the ball, for one i
  noise   ///< the largest noise that keeps it invariant
};

struct MetricSearch {
  BallAim aim = BallAim::state;
  int state = 0;               ///< i, with BallAim::state
  double cubic_factor = 20.0;  ///< how much larger |D3G| is expected over the ball than at its center
  int evaluations = 600;
};

struct MetricProposal {
  rigor::DynamicMatrix metric;  ///< upper triangular
  double radius = 0.0;
  double cubic = 0.0;  ///< |D3G| at the worst of the models, without the factor
  double value = 0.0;  ///< of the aim
};

/// A metric T and a radius for which the ball promises to contract around each of the models' fixed points:
/// T'T = X solves X = (A/k)' X (A/k) + W for the middle model's A, with k and the diagonal of W chosen by
/// search. Nothing when no model is stable enough. Throws std::invalid_argument without models. Holds its own
/// rounding mode.
[[nodiscard]] std::optional<MetricProposal> propose_metric(const std::vector<LocalModel>& models,
                                                           const MetricSearch& search);

}  // namespace veritrack::contraction
