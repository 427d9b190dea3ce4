#include "analysis/quadrature/capture/capture.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "analysis/quadrature/capture/capture_rounding.hpp"
#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/taylor_model.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Dual;
using rigor::Interval;
using rigor::TaylorModel;

/// Degrees of the Taylor models of the states and of the derivatives, by the number of variables: chosen by
/// measurement, for the time per proved area.
constexpr int kDegrees[] = {0, 7, 7, 5};
constexpr int kSlopeDegrees[] = {0, 3, 3, 2};
/// Deviations this large (relative amplitude, rad/sample) are beyond all hope.
constexpr double kLargestDeviation = 0.5;
/// Values found on the way are reported a little larger: a checker that encloses the same states by other
/// means may find them larger by as much.
constexpr double kRoom = 1.0 + 1e-6;

template <typename Scalar, typename Constant = Scalar>
trackers::ToneModel<Scalar> embedded(const trackers::ToneModel<Interval>& design) {
  return {Scalar(Constant(design.q1)), Scalar(Constant(design.q2)), Scalar(Constant(design.r)),
          Scalar(Constant(design.epsilon))};
}

/// The derivatives of G for all states described and all inputs that are allowed: first the nine of the
/// state, and after them those of the inputs, when there are any. Taylor models of low degree, as dependences
/// between the states that intervals forget decide how wide this is.
template <int Columns, typename Model>
rigor::IntervalMatrix<kStateSize, Columns> derivatives(const CaptureProblem& problem,
                                                       const trackers::RotatingFrameState<Model>& states) {
  using Scalar = Dual<Model, Columns>;
  trackers::RotatingFrameState<Scalar> state;
  for (int i = 0; i < kStateSize; ++i) {
    state[i] = rigor::variable<Columns>(states[i], i);
  }
  trackers::RotatingFrameInput<Scalar> input{Scalar(0.0), Scalar(0.0), Scalar(0.0),
                                             Scalar(Model(problem.frequency))};
  if constexpr (Columns == kStateSize + kInputSize) {
    const Model noise(rigor::symmetric(problem.noise));
    input.noise_in_phase = rigor::variable<Columns>(noise, kStateSize);
    input.noise_quadrature = rigor::variable<Columns>(noise, kStateSize + 1);
    input.slew = rigor::variable<Columns>(Model(rigor::symmetric(problem.slew)), kStateSize + 2);
  }
  const trackers::RotatingFrameState<Scalar> next =
      trackers::rotating_frame_map<Scalar>(state, input, embedded<Scalar, Model>(problem.design));
  rigor::IntervalMatrix<kStateSize, Columns> slopes;
  for (int i = 0; i < kStateSize; ++i) {
    for (int j = 0; j < Columns; ++j) {
      slopes(i, j) = next[i].derivative(j).range();
    }
  }
  return slopes;
}

/// {p(s) + e : s in [-1, 1]^Variables, e in a zonotope}.
template <std::size_t Variables>
class FollowedStarts {
 public:
  static constexpr int kVariables = static_cast<int>(Variables);
  static constexpr int kSlopeDegree = kSlopeDegrees[Variables];
  using Model = TaylorModel<kVariables, kDegrees[Variables]>;

  /// The states of the rotating frame at the starts: delta = (1 + a) e^{i psi} - 1, P(0) turned by psi.
  FollowedStarts(const CaptureProblem& problem, const std::array<Model, 3>& start) {
    const auto& p0 = problem.initial_covariance;
    const auto [sine, cosine] = sin_cos(start[1]);
    const Model length = Model(1.0) + start[0];
    state_[trackers::kDeltaInPhase] = length * cosine - Model(1.0);
    state_[trackers::kDeltaQuadrature] = length * sine;
    state_[trackers::kFrequencyError] = start[2];
    const Model p11(p0(0, 0));
    const Model p12(p0(0, 1));
    const Model p22(p0(1, 1));
    const Model cross = (sine * cosine) * (p12 + p12);
    state_[trackers::kP11] = square(cosine) * p11 - cross + square(sine) * p22;
    state_[trackers::kP22] = square(sine) * p11 + cross + square(cosine) * p22;
    state_[trackers::kP12] = (sine * cosine) * (p11 - p22) + (square(cosine) - square(sine)) * p12;
    state_[trackers::kP13] = cosine * Model(p0(0, 2)) - sine * Model(p0(1, 2));
    state_[trackers::kP23] = sine * Model(p0(0, 2)) + cosine * Model(p0(1, 2));
    state_[trackers::kP33] = Model(p0(2, 2));
    move_remainders();
  }

  /// False when the set has become too large or was never known. True proves nothing.
  [[nodiscard]] bool usable() const {
    const StateVector deviation = rest_.radii();
    return deviation.allFinite() && deviation.template head<3>().maxCoeff() < kLargestDeviation;
  }

  [[nodiscard]] StateBox hull() const {
    const StateVector deviation = rest_.radii();
    StateBox box;
    for (int i = 0; i < kStateSize; ++i) {
      box[i] = state_[i].range() + rigor::symmetric(deviation[i]);
    }
    return box;
  }

  [[nodiscard]] StateEnclosure enclosure() const {
    StateEnclosure result;
    result.generators.resize(kStateSize, kVariables + rest_.generators().cols());
    for (int i = 0; i < kStateSize; ++i) {
      const Interval curved = state_[i].nonlinear_range() + Interval(state_[i].constant());
      result.center[i] = midpoint(curved);
      result.box[i] = magnitude(curved - Interval(result.center[i]));
      for (int v = 0; v < kVariables; ++v) {
        result.generators(i, v) = state_[i].linear(v);
      }
    }
    result.generators.rightCols(rest_.generators().cols()) = rest_.generators();
    // The mean value theorem wants the center inside, also after rounding.
    result.hull = rigor::hull(hull(), rigor::to_interval(result.center));
    return result;
  }

  /// One sample on.
  void step(const CaptureProblem& problem, const trackers::ToneModel<Model>& design) {
    const StateVector deviation = rest_.radii();
    trackers::RotatingFrameState<TaylorModel<kVariables, kSlopeDegree>> states;
    for (int i = 0; i < kStateSize; ++i) {
      states[i] = state_[i].template lowered<kSlopeDegree>().widened(deviation[i]);
    }
    if (problem.noise == 0.0 && problem.slew == 0.0) {
      rest_.transform(derivatives<kStateSize>(problem, states));
    } else {
      const auto slopes = derivatives<kStateSize + kInputSize>(problem, states);
      rest_.transform(slopes.template leftCols<kStateSize>());
      rest_.add_image(slopes.template rightCols<kInputSize>(),
                      rigor::Vector<kInputSize>(problem.noise, problem.noise, problem.slew));
    }
    rest_.add_box(followed_rounding(problem, hull()));
    const trackers::RotatingFrameInput<Model> quiet{Model(0.0), Model(0.0), Model(0.0),
                                                    Model(problem.frequency)};
    state_ = trackers::rotating_frame_map<Model>(state_, quiet, design);
    move_remainders();
  }

  /// How much each variable bends the errors.
  [[nodiscard]] std::array<double, Variables> curvatures() const {
    std::array<double, Variables> sums{};
    for (int row = 0; row < 3; ++row) {
      for (std::size_t i = 1 + Variables; i < Model::kTerms; ++i) {
        for (std::size_t v = 0; v < Variables; ++v) {
          sums[v] += std::fabs(state_[row].coefficients()[i]) *
                     static_cast<double>(Model::Monomials::kExponents[i][v]);
        }
      }
    }
    return sums;
  }

 private:
  /// The remainders of the Taylor models go into the zonotope, where they are followed linearly.
  void move_remainders() {
    StateVector remainders;
    for (int i = 0; i < kStateSize; ++i) {
      remainders[i] = state_[i].remainder();
      state_[i] = state_[i].polynomial();
    }
    rest_.add_box(remainders);
  }

  trackers::RotatingFrameState<Model> state_;
  Zonotope rest_;
};

/// As follow_starts; `directions` are the coordinates of the box that have a width.
template <std::size_t Variables>
CaptureResult follow(const CaptureProblem& problem, const CaptureTarget& target,
                     const std::array<Interval, 3>& box, const std::array<int, Variables>& directions) {
  using Model = typename FollowedStarts<Variables>::Model;
  std::array<Model, 3> start = {Model(box[0]), Model(box[1]), Model(box[2])};
  for (std::size_t v = 0; v < Variables; ++v) {
    const auto direction = static_cast<std::size_t>(directions[v]);
    start[direction] = Model::variable(box[direction], static_cast<int>(v));
  }
  const auto design = embedded<Model>(problem.design);
  FollowedStarts<Variables> states(problem, start);
  CaptureResult result;
  auto curvatures = states.curvatures();
  while (states.usable()) {
    const Interval frequency_error = states.hull()[trackers::kFrequencyError];
    result.frequency_errors.push_back(is_finite(frequency_error)
                                          ? rigor::mul_up(kRoom, magnitude(frequency_error))
                                          : std::numeric_limits<double>::infinity());
    if (const std::optional<Settled> settled = target.settled(states.enclosure())) {
      result.outcome = settled->turns == 0 ? CaptureOutcome::locked : CaptureOutcome::locked_elsewhere;
      result.turns = settled->turns;
      result.level = settled->level;
      return result;
    }
    if (result.samples >= problem.most_samples) {
      result.outcome = CaptureOutcome::out_of_samples;
      break;
    }
    curvatures = states.curvatures();
    states.step(problem, design);
    ++result.samples;
  }
  std::size_t widest = 0;
  for (std::size_t v = 1; v < Variables; ++v) {
    widest = curvatures[v] > curvatures[widest] ? v : widest;
  }
  result.widest_direction = directions[widest];
  return result;
}

}  // namespace

std::string_view to_string(CaptureOutcome outcome) noexcept {
  switch (outcome) {
    case CaptureOutcome::enclosure_lost:
      return "the enclosure of the states grew too large";
    case CaptureOutcome::out_of_samples:
      return "not settled within the samples allowed";
    case CaptureOutcome::locked:
      return "locked";
    case CaptureOutcome::locked_elsewhere:
      return "locked at a wrong frequency";
  }
  return "unknown";
}

CaptureResult follow_starts(const CaptureProblem& problem, const CaptureTarget& target,
                            const StartBox& starts) {
  const rigor::UpwardRounding upward;
  const auto& design = problem.design;
  const bool finite = is_finite(starts.amplitude_error) && is_finite(starts.phase_error) &&
                      is_finite(starts.frequency_error) && is_finite(problem.frequency) &&
                      is_finite(design.q1) && is_finite(design.q2) && is_finite(design.r) &&
                      is_finite(design.epsilon) && std::isfinite(problem.noise) &&
                      std::isfinite(problem.slew);
  const bool sensible =
      finite && starts.amplitude_error.lower() > -1.0 && problem.noise >= 0.0 && problem.slew >= 0.0;
  if (!sensible) {
    return {};
  }
  const std::array<Interval, 3> box = {starts.amplitude_error, starts.phase_error, starts.frequency_error};
  const bool one_amplitude = starts.amplitude_error.lower() == starts.amplitude_error.upper();
  return one_amplitude ? follow<2>(problem, target, box, {1, 2}) : follow<3>(problem, target, box, {0, 1, 2});
}

}  // namespace veritrack::quadrature
