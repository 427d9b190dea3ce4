#include "analysis/quadrature/falsifier/falsifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "analysis/quadrature/falsifier/falsifier_gradient.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {

namespace {

constexpr double kPi = std::numbers::pi;

/// A periodic disturbance: noise of full size that flips (or turns), slew of full size that flips.
struct Periodic {
  double direction = 0.0;          ///< of the noise, from along the predicted phase, rad
  double angular_frequency = 0.0;  ///< rad/sample: 0 constant, pi alternating
  double noise_phase = 0.0, slew_phase = 0.0;
  bool turning = false;
};

double sign_of_cosine(double angle) {
  return std::cos(angle) >= 0.0 ? 1.0 : -1.0;
}

class Search {
 public:
  Search(const SetClaim& claim, const FalsifierOptions& options)
      : claim_(claim), options_(options), random_(options.seed) {
    result_.from_rim.bound = claim.bound_from_rim();
    result_.from_zero.bound = claim.bound_from_zero();
  }

  Falsification run() {
    const std::array<void (Search::*)(bool), 3> attacks{&Search::gradient, &Search::greedy,
                                                        &Search::periodic};
    for (const auto attack : attacks) {
      for (const bool from_zero : {false, true}) {
        // Without noise and slew zero stays zero.
        if (!result_.alarm && (!from_zero || claim_.bound_from_zero() > 0.0)) {
          (this->*attack)(from_zero);
        }
      }
    }
    return std::move(result_);
  }

 private:
  /// Runs, takes note, and returns what it came to.
  RunOutcome attempt(const Attack& start, const InputPolicy& policy, int steps, bool from_zero) {
    RunOutcome outcome = run_tracker(claim_, start, policy, steps);
    ++result_.runs;
    WorstCase& worst = from_zero ? result_.from_zero : result_.from_rim;
    if (outcome.frequency_error > worst.frequency_error) {
      worst.frequency_error = outcome.frequency_error;
      worst.step = outcome.step;
      worst.attack = outcome.attack;
    }
    result_.largest_level = std::max(result_.largest_level, outcome.largest_level);
    if (!result_.alarm) {
      if (outcome.alarm) {
        result_.alarm = outcome.alarm;
      } else if (!(worst.frequency_error <= worst.bound * (1.0 + 1e-9))) {
        result_.alarm = Alarm{outcome.attack, "the bound on the frequency error", outcome.step};
      }
    }
    return outcome;
  }

  [[nodiscard]] Eigen::Vector3d rim(const Eigen::Vector3d& direction) const {
    return claim_.center() + claim_.inverse_metric() * direction.normalized() * claim_.set().radius;
  }
  [[nodiscard]] Attack start_at(std::string structure, const Eigen::Vector3d& error, double share,
                                bool from_zero) const {
    return {std::move(structure),
            error,
            claim_.covariance_at(share * Eigen::Matrix3d::Identity(), from_zero),
            {}};
  }
  Eigen::Vector3d random_rim() { return rim({random_.normal(), random_.normal(), random_.normal()}); }

  /// The vector of full length against a gradient: what maximises the linearisation.
  [[nodiscard]] Eigen::Vector3d push(const Eigen::Vector3d& gradient) const {
    const double length = std::hypot(gradient[0], gradient[1]);
    const double noise = length > 0.0 ? claim_.set().noise / length : 0.0;
    return {noise * gradient[0], noise * gradient[1],
            gradient[2] >= 0.0 ? claim_.set().slew : -claim_.set().slew};
  }

  /// Steps as far as possible in |T e| or the frequency error, one step at a time.
  void greedy(bool from_zero) {
    for (const bool level : {true, false}) {
      for (int j = 0; j < 2; ++j) {
        const Eigen::Vector3d start = from_zero ? claim_.center() : random_rim();
        const InputPolicy policy = [&](int, const PolarState& state) -> Eigen::Vector3d {
          Vector9 weight = Vector9::Zero();
          Vector12 x = Vector12::Zero();
          x.head<9>() = vector_of(state);
          const Vector9 free = next_state(claim_, x);
          if (level) {
            weight.head<3>() =
                claim_.set().metric.transpose() * (claim_.set().metric * (free.head<3>() - claim_.center()));
          }
          if (weight.isZero(0.0)) {
            weight[2] = free[2] >= 0.0 ? 1.0 : -1.0;
          }
          return push(pulled_back(claim_, weight, state, Eigen::Vector3d::Zero()).tail<3>());
        };
        attempt(start_at("greedy", start, j, from_zero), policy, options_.steps, from_zero);
      }
    }
  }

  /// Maximises the linearisation along the last run over everything at once, runs that, and so on.
  void gradient(bool from_zero) {
    constexpr std::array<int, 10> kHorizons{1, 2, 3, 4, 6, 9, 14, 25, 60, 200};
    for (const int horizon : kHorizons) {
      if (horizon > options_.steps) {
        break;
      }
      for (const bool level : {true, false}) {
        Eigen::Vector3d error = from_zero ? claim_.center() : random_rim();
        Attack start = start_at("gradient", error, 0.5, from_zero);
        std::vector<Eigen::Vector3d> inputs(static_cast<std::size_t>(horizon), Eigen::Vector3d::Zero());
        for (int i = 0; i <= options_.gradient_iterations; ++i) {
          const auto policy = [&](int k, const PolarState&) { return inputs[static_cast<std::size_t>(k)]; };
          const RunOutcome outcome = attempt(start, policy, horizon, from_zero);
          if (outcome.states.size() != inputs.size() + 1) {
            break;  // an alarm, or no run
          }
          ascend(outcome, level, from_zero, start, inputs);
        }
      }
    }
  }

  void ascend(const RunOutcome& outcome, bool level, bool from_zero, Attack& start,
              std::vector<Eigen::Vector3d>& inputs) const {
    const Eigen::Matrix3d& t = claim_.set().metric;
    Vector9 weight = Vector9::Zero();
    weight[2] = 1.0;
    const Eigen::Vector3d deviation = as_vector(outcome.states.back().error) - claim_.center();
    if (level && !deviation.isZero(0.0)) {
      weight.head<3>() = t.transpose() * (t * deviation);
    }
    for (std::size_t k = inputs.size(); k-- > 0;) {
      const Vector12 gradient = pulled_back(claim_, weight, outcome.states[k], inputs[k]);
      inputs[k] = push(gradient.tail<3>());
      weight = gradient.head<9>() / std::max(gradient.head<9>().norm(), 1e-300);
    }
    if (!from_zero) {
      start.start_error = rim(claim_.inverse_metric().transpose() * weight.head<3>());
    }
    Eigen::Matrix3d lambda;
    lambda << weight[3], 0.5 * weight[4], 0.5 * weight[5], 0.5 * weight[4], weight[6], 0.5 * weight[7],
        0.5 * weight[5], 0.5 * weight[7], weight[8];
    start.start_covariance = claim_.covariance_at(claim_.share_along(lambda), from_zero);
  }

  double periodic_run(const Periodic& shape, const Attack& start, bool from_zero) {
    const double noise = claim_.set().noise;
    const double slew = claim_.set().slew;
    const InputPolicy policy = [&](int k, const PolarState&) -> Eigen::Vector3d {
      const double angle = shape.angular_frequency * k;
      const double direction = shape.direction + (shape.turning ? angle : 0.0);
      const double size = shape.turning ? noise : noise * sign_of_cosine(angle + shape.noise_phase);
      return {size * std::cos(direction), size * std::sin(direction),
              slew * sign_of_cosine(angle + shape.slew_phase)};
    };
    const RunOutcome outcome = attempt(start, policy, options_.steps, from_zero);
    return outcome.alarm ? 1e300 : outcome.frequency_error;
  }

  void periodic(bool from_zero) {
    const double own = own_frequency(claim_, options_.steps);
    struct Family {
      const char* name;
      double angular_frequency;
      bool turning;
    };
    const std::array<Family, 4> families{{{"constant", 0.0, false},
                                          {"alternating", kPi, false},
                                          {"resonant", own, false},
                                          {"turning", own, true}}};
    for (const Family& family : families) {
      // Direction, angular frequency, noise phase, slew phase, share of the covariance, and the two angles of
      // the start on the boundary.
      Eigen::VectorXd first(7);
      first << random_.uniform() * 2.0 * kPi, family.angular_frequency, 0.1, kPi + 0.1, random_.uniform(),
          random_.uniform() * 2.0 * kPi, random_.uniform() * 2.0 - 1.0;
      const auto size = from_zero ? 5 : 7;
      std::string name = family.name;
      const auto value = [&](const Eigen::VectorXd& x) {
        if (result_.alarm) {
          return 0.0;  // enough
        }
        Eigen::Vector3d error = claim_.center();
        if (!from_zero) {
          const double across = std::sqrt(std::max(0.0, 1.0 - x[6] * x[6]));
          error = rim({across * std::cos(x[5]), across * std::sin(x[5]), x[6]});
        }
        return periodic_run({x[0], x[1], x[2], x[3], family.turning}, start_at(name, error, x[4], from_zero),
                            from_zero);
      };
      value(first);
      name += " + search";
      search::SearchSpace space;
      space.start = first.head(size);
      Eigen::VectorXd step(7), lower(7), upper(7);
      step << 0.5, 0.1, 0.5, 0.5, 0.3, 0.5, 0.3;
      lower << -10.0, 0.0, -10.0, -10.0, 0.0, -10.0, -1.0;
      upper << 10.0, kPi, 10.0, 10.0, 1.0, 10.0, 1.0;
      space.step = step.head(size);
      space.lower = lower.head(size);
      space.upper = upper.head(size);
      space.evaluations = options_.search_evaluations;
      static_cast<void>(search::maximize(value, space));
    }
  }

  const SetClaim& claim_;
  FalsifierOptions options_;
  trackers::RandomStream random_;
  Falsification result_;
};

}  // namespace

Falsification try_to_break(const CertifiedSet& set, const trackers::ToneModel<double>& design,
                           const FalsifierOptions& options) {
  const rigor::NearestRounding nearest;
  return try_to_break(SetClaim(set, design), options);
}

Falsification try_to_break(const SetClaim& claim, const FalsifierOptions& options) {
  const rigor::NearestRounding nearest;
  if (options.steps < 1) {
    throw std::invalid_argument("a run has at least one step");
  }
  return Search(claim, options).run();
}

}  // namespace veritrack::quadrature
