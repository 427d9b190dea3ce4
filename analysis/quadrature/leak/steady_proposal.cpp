#include "analysis/quadrature/leak/steady_proposal.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/quadrature/leak/steady_samples.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Matrix;

/// How much is to spare: of its own bounds for the covariance, and of the level.
struct Strictness {
  double covariance, rate;
};
constexpr int kCoarse = 12;
constexpr int kFine = 24;

/// Is a set of this metric invariant, as far as coarse samples can tell?
bool holds(const SteadySamples& sampler, const Matrix<3>& metric, double noise,
           const Strictness& strictness) {
  auto settings = sampler.settings(metric);
  return sampler.find_band(settings, noise, strictness.covariance, kCoarse) &&
         sampler.rate(settings, 1.0, noise, kCoarse) < strictness.rate;
}

/// How far a small set of this metric is from being invariant, for a search that has found none yet.
double failure(const SteadySamples& sampler, const Matrix<3>& metric, const Strictness& strictness) {
  constexpr double kSmall = 0.1;
  constexpr double kWorst = 10.0;
  auto settings = sampler.settings(metric / kSmall);
  for (const double goal : {strictness.covariance, 1.5, 3.0, 6.0}) {
    if (sampler.find_band(settings, 0.0, goal, kCoarse)) {
      return std::min(kWorst, goal + sampler.rate(settings, 1.0, 0.0, kCoarse));
    }
  }
  return kWorst;
}

/// The largest R for which T/R holds; 0 when there is none.
double largest_radius(const SteadySamples& sampler, const Matrix<3>& metric, double noise, double guess,
                      const Strictness& strictness) {
  const auto fits = [&](double radius) { return holds(sampler, metric / radius, noise, strictness); };
  constexpr double kStep = 1.6;
  double good = 0.0;
  double bad = guess;
  if (fits(guess)) {
    constexpr int kGrowth = 10;
    good = guess;
    for (int i = 0; i < kGrowth && fits(kStep * good); ++i) {
      good *= kStep;
    }
    bad = kStep * good;
  } else {
    constexpr int kShrinking = 12;
    double trial = guess;
    for (int i = 0; i < kShrinking && good == 0.0; ++i) {
      trial /= kStep;
      (fits(trial) ? good : bad) = trial;
    }
  }
  for (int i = 0; i < 4 && good > 0.0; ++i) {
    const double middle = std::sqrt(good * bad);
    (fits(middle) ? good : bad) = middle;
  }
  return good;
}

/// How many times the assumed start fits into {|T (e - e*)| <= 1} around all the steady states.
double start_room(const SteadyRequest& request, const Matrix<3>& metric) {
  double worst = 0.0;
  for (const auto& steady : request.steady) {
    const rigor::Vector<3> center(steady.rho - 1.0, steady.phase, steady.frequency);
    for (int corner = 0; corner < 8; ++corner) {
      rigor::Vector<3> start = request.start;
      for (int i = 0; i < 3; ++i) {
        start[i] *= (corner >> i) % 2 == 0 ? 1.0 : -1.0;
      }
      worst = std::max(worst, (metric * (start - center)).norm());
    }
  }
  return 1.0 / worst;
}

search::SearchSpace space_of(int evaluations) {
  search::SearchSpace space;
  space.start = Eigen::VectorXd::Zero(5);
  space.step.resize(5);
  space.step << 0.5, 0.5, -0.5, 0.3, 0.3;
  space.lower = Eigen::VectorXd::Constant(5, -4.0);
  space.upper = Eigen::VectorXd::Constant(5, 4.0);
  space.evaluations = evaluations;
  return space;
}

}  // namespace

std::optional<SteadyShape> propose_steady_shape(const SteadyRequest& request, SteadyJudgement judgement) {
  const rigor::NearestRounding nearest;
  const SteadySamples sampler(request, judgement);
  // With room for the proof first; where there is no such set, with less.
  for (const Strictness& strictness : {Strictness{0.9, 0.96}, Strictness{0.97, 0.985}}) {
    double guess = 1.0;
    Matrix<3> best_metric = Matrix<3>::Zero();
    double best_value = 0.0;
    static_cast<void>(search::maximize(
        [&](const Eigen::VectorXd& x) {
          const Matrix<3> metric = sampler.metric(x);
          const double radius = largest_radius(sampler, metric, request.noise, guess, strictness);
          if (!(radius > 0.0)) {
            return -failure(sampler, metric, strictness);
          }
          guess = radius;
          const double frequency = radius * metric.inverse().row(2).norm();
          const double room = std::min(1.0, start_room(request, metric / radius) / 1.15);
          const double value = frequency * room * room;
          if (value > best_value) {
            best_value = value;
            best_metric = metric / radius;
          }
          return value;
        },
        space_of(request.evaluations)));
    if (best_value > 0.0) {
      return SteadyShape{best_metric};
    }
  }
  return std::nullopt;
}

std::optional<SteadySet> propose_steady_set(const SteadyRequest& request, const SteadyShape& shape,
                                            double fraction, SteadyJudgement judgement) {
  const rigor::NearestRounding nearest;
  const SteadySamples sampler(request, judgement);
  SteadySet set;
  set.metric = shape.metric / fraction;
  set.noise = request.noise;
  set.slew = request.slew;
  std::vector<SteadySetting<double>> settings;
  double at_high = std::numeric_limits<double>::infinity();
  for (const double goal : {0.95, 0.9, 0.85, 0.8, 0.75, 0.7}) {
    auto trial = sampler.settings(set.metric);
    if (!sampler.find_band(trial, set.noise, goal, kFine)) {
      break;
    }
    const double rate = sampler.rate(trial, 1.0, set.noise, kFine);
    if (rate < at_high) {
      at_high = rate;
      settings = std::move(trial);
    }
  }
  if (settings.empty()) {
    return std::nullopt;
  }
  set.below = settings.front().band.below.matrix();
  set.above = settings.front().band.above.matrix();
  set.levels = {1.0};
  // Down to where the noise holds the state, each step leaving a share of what samples gain to the proof.
  constexpr double kLowest = 0.01;
  constexpr double kSlowest = 0.96;
  constexpr double kRoom = 0.4;
  double rate = at_high;
  while (set.levels.back() > kLowest && rate < kSlowest) {
    set.levels.push_back(set.levels.back() * (rate + kRoom * (1.0 - rate)));
    rate = sampler.rate(settings, set.levels.back(), set.noise, kFine);
  }
  return set.levels.size() < 2 ? std::nullopt : std::optional<SteadySet>(set);
}

}  // namespace veritrack::quadrature
