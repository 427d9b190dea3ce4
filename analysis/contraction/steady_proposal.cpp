#include "analysis/contraction/steady_proposal.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/contraction/steady_setting.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Matrix;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Symmetric<double> symmetric(const Matrix<3>& m) {
  return Symmetric<double>::from_matrix(m);
}

/// The largest x with x a + b singular: the smallest x such that x a + b >= 0.
double smallest_share(const Eigen::LLT<Matrix<3>>& a, const Matrix<3>& b) {
  const Matrix<3> half = a.matrixL().solve(b);
  const Matrix<3> whole = a.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix<3>> eigen(whole, Eigen::EigenvaluesOnly);
  return -eigen.eigenvalues()[0];
}

/// A set as a few samples see it.
struct SampledSteadySet {
  std::vector<SteadySetting<double>> settings;
  double covariance_share = 0.0;  ///< worst of the samples: which share of its bounds the covariance reaches
};

class Sampler {
 public:
  Sampler(const SteadyRequest& request) : request_(request) {
    const auto& middle = request.steady[request.steady.size() / 2].covariance;
    root_ = Eigen::LLT<Matrix<3>>(middle.matrix()).matrixL();
    inverse_root_ = root_.inverse();
  }

  /// [[e^x0, x3, x4], [0, 1, x2], [0, 0, e^x1]] times the root of the inverse of a steady covariance, which
  /// is the metric that the theory of linear Kalman filters suggests.
  [[nodiscard]] Matrix<3> metric(const Eigen::VectorXd& x) const {
    Matrix<3> change;
    change << std::exp(x[0]), x[3], x[4], 0.0, 1.0, x[2], 0.0, 0.0, std::exp(x[1]);
    const Matrix<3> information = request_.steady.back().covariance.matrix().inverse();
    const Matrix<3> base = Eigen::LLT<Matrix<3>>(information).matrixU();
    return change * base;
  }

  [[nodiscard]] std::vector<SteadySetting<double>> settings(const Matrix<3>& t) const {
    const Matrix<3> inverse = t.inverse();
    Eigen::Matrix<double, 2, 3> rows;
    rows << inverse.row(0), inverse.row(1) + inverse.row(2);
    const Eigen::Matrix2d directions = Eigen::LLT<Eigen::Matrix2d>(rows * rows.transpose()).matrixL();
    std::vector<SteadySetting<double>> result;
    result.reserve(request_.steady.size());
    for (const auto& steady : request_.steady) {
      SteadySetting<double> setting;
      setting.design = request_.design;
      setting.steady = steady;
      setting.metric = {t(0, 0), t(0, 1), t(0, 2), t(1, 1), t(1, 2), t(2, 2)};
      setting.a11 = directions(0, 0);
      setting.a21 = directions(1, 0);
      setting.a22 = directions(1, 1);
      fill_turns(setting);
      result.push_back(setting);
    }
    return result;
  }

  /// Moves the band out until it holds the images of the samples on the rim, with the share `goal` of itself
  /// to spare. False when it runs away.
  bool find_band(std::vector<SteadySetting<double>>& settings, double noise, double goal, int angles) const {
    constexpr int kMostSteps = 30;
    constexpr double kStandstill = 0.003;
    constexpr double kSmallest = 0.02;
    Matrix<3> below = kSmallest * Matrix<3>::Identity();
    Matrix<3> above = below;
    for (int step = 0; step < kMostSteps; ++step) {
      const Matrix<3> old_below = below;
      const Matrix<3> old_above = above;
      for (auto& setting : settings) {
        setting.band = {symmetric(root_ * old_below * root_.transpose()),
                        symmetric(root_ * old_above * root_.transpose())};
        const bool usable = for_each_image(setting, 1.0, noise, angles, [&](const Matrix<3>& low, const Matrix<3>& high) {
          grow(above, enter(high) / goal);
          grow(below, enter(low) / -goal);
        });
        if (!usable) {
          return false;
        }
      }
      const double moved = (above - old_above).norm() / above.norm() + (below - old_below).norm() / below.norm();
      if (!(above.norm() < 30.0) || !(below.norm() < 30.0)) {
        return false;
      }
      if (moved < kStandstill) {
        break;
      }
    }
    for (auto& setting : settings) {
      setting.band = {symmetric(root_ * below * root_.transpose()),
                      symmetric(root_ * above * root_.transpose())};
      const Matrix<3> least = setting.steady.covariance.matrix() - setting.band.below.matrix();
      if (Eigen::LLT<Matrix<3>>(least).info() != Eigen::Success) {
        return false;
      }
    }
    return true;
  }

  /// The share of the level s to which a step leads from it: errors and covariance, noise and slew included.
  [[nodiscard]] double rate(const std::vector<SteadySetting<double>>& settings, double level, double noise, int angles) const {
    double worst = 0.0;
    for (std::size_t k = 0; k < settings.size(); ++k) {
      const auto& setting = settings[k];
      for (int j = 0; j < angles; ++j) {
        for (const double share : {1.0, 0.5}) {
          const Sample sample = sample_at(setting, level, noise, share, j, angles);
          if (!usable(sample)) {
            return kInfinity;
          }
          const double motion = request_.slew > 0.0 && !request_.slopes.empty() ? motion_of(setting, k) : 0.0;
          worst = std::max(worst, std::sqrt(propose_rate(sample.step, sample.bounds, 0.0).rate_squared) +
                                      (1.1 * sample.bounds.noise_gain * noise + motion) / level);
          if (!(worst < 2.0)) {
            return kInfinity;
          }
        }
      }
      const Eigen::LLT<Matrix<3>> below(setting.band.below.matrix());
      const Eigen::LLT<Matrix<3>> above(setting.band.above.matrix());
      const double motion = covariance_motion(below, above, k) / level;
      const bool fine = for_each_image(setting, level, noise, angles, [&](const Matrix<3>& low, const Matrix<3>& high) {
        worst = std::max({worst, smallest_share(above, -high) + motion, smallest_share(below, low) + motion});
      });
      if (!fine) {
        return kInfinity;
      }
    }
    return worst;
  }

 private:
  struct Sample {
    SteadyStep<double> step;
    SteadyBounds<double> bounds;
  };

  static bool usable(const Sample& sample) {
    constexpr double kLeast = 0.05;
    return sample.bounds.least_along > kLeast && sample.step.along > kLeast &&
           std::fabs(sample.step.swing) < 1.4;
  }

  static Sample sample_at(const SteadySetting<double>& setting, double level, double noise, double share,
                          int angle, int angles) {
    const double beta = 2.0 * std::numbers::pi * angle / angles;
    const SteadyStep<double> step = steady_step(setting, {level, share * std::cos(beta), share * std::sin(beta)});
    return {step, steady_bounds(step, setting, level, noise)};
  }

  /// Calls `use` with (P+ - P*)/s of both bounds for the samples on the rim, at both ends of the turn.
  template <typename Use>
  static bool for_each_image(const SteadySetting<double>& setting, double level, double noise, int angles,
                             const Use& use) {
    for (int j = 0; j < angles; ++j) {
      const Sample sample = sample_at(setting, level, noise, 1.0, j, angles);
      if (!usable(sample)) {
        return false;
      }
      const double tangent = turn_tangent(setting, sample.step, level);
      for (const double side : {-1.0, 1.0}) {
        const auto image =
            covariance_step(setting, sample.step, level, tangent + side * sample.bounds.tangent_reach);
        use(image.low.matrix(), image.high.matrix());
      }
    }
    return true;
  }

  [[nodiscard]] Matrix<3> enter(const Matrix<3>& p) const {
    return inverse_root_ * p * inverse_root_.transpose();
  }

  /// bound + the positive part of (x - bound).
  static void grow(Matrix<3>& bound, const Matrix<3>& x) {
    const Eigen::SelfAdjointEigenSolver<Matrix<3>> eigen(x - bound);
    for (int i = 0; i < 3; ++i) {
      if (eigen.eigenvalues()[i] > 0.0) {
        bound += eigen.eigenvalues()[i] * eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose();
      }
    }
  }

  [[nodiscard]] double motion_of(const SteadySetting<double>& setting, std::size_t k) const {
    const auto& t = setting.metric;
    const rigor::Vector<9>& x = request_.slopes[k];
    const double frequency = 1.0 + x[2];
    return 1.02 * request_.slew *
           std::hypot(t.t11 * x[0] + t.t12 * x[1] + t.t13 * frequency, t.t22 * x[1] + t.t23 * frequency,
                      t.t33 * frequency);
  }

  [[nodiscard]] double covariance_motion(const Eigen::LLT<Matrix<3>>& below, const Eigen::LLT<Matrix<3>>& above,
                                         std::size_t k) const {
    if (!(request_.slew > 0.0) || request_.slopes.empty()) {
      return 0.0;
    }
    const auto& x = request_.slopes[k];
    Matrix<3> slope;
    slope << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
    // The verification doubles its guess by halves until it holds.
    return 1.55 * request_.slew *
           std::max({smallest_share(above, slope), smallest_share(above, -slope), smallest_share(below, slope),
                     smallest_share(below, -slope)});
  }

  SteadyRequest request_;
  Matrix<3> root_;
  Matrix<3> inverse_root_;
};

/// How much is to spare: of its own bounds for the covariance, and of the level.
struct Strictness {
  double covariance, rate;
};
constexpr int kCoarse = 12;
constexpr int kFine = 24;

/// Is a set of this metric invariant, as far as coarse samples can tell?
bool holds(const Sampler& sampler, const Matrix<3>& metric, double noise, const Strictness& strictness) {
  auto settings = sampler.settings(metric);
  return sampler.find_band(settings, noise, strictness.covariance, kCoarse) &&
         sampler.rate(settings, 1.0, noise, kCoarse) < strictness.rate;
}

/// How far a small set of this metric is from being invariant, for a search that has found none yet.
double failure(const Sampler& sampler, const Matrix<3>& metric, const Strictness& strictness) {
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
double largest_radius(const Sampler& sampler, const Matrix<3>& metric, double noise, double guess,
                      const Strictness& strictness) {
  const auto fits = [&](double radius) { return holds(sampler, metric / radius, noise, strictness); };
  constexpr double kStep = 1.6;
  double good = 0.0;
  double bad = guess;
  if (fits(guess)) {
    for (good = guess; good < 100.0 * guess && fits(kStep * good);) {
      good *= kStep;
    }
    bad = kStep * good;
  } else {
    for (double trial = guess / kStep; trial > 0.003 * guess && good == 0.0; trial /= kStep) {
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

std::optional<SteadyShape> propose_steady_shape(const SteadyRequest& request) {
  const rigor::NearestRounding nearest;
  const Sampler sampler(request);
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
                                            double fraction, bool invariance_only) {
  const rigor::NearestRounding nearest;
  const Sampler sampler(request);
  SteadySet set;
  set.metric = shape.metric / fraction;
  set.noise = request.noise;
  set.slew = request.slew;
  std::vector<SteadySetting<double>> settings;
  double at_high = kInfinity;
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
  if (invariance_only) {
    constexpr double kRoom = 0.96;
    set.levels = {{1.0, 1.0, 1.0}};
    return at_high < kRoom ? std::optional<SteadySet>(set) : std::nullopt;
  }
  // Ranges of levels, each half of the one before, down to where the noise holds the state.
  constexpr double kLowest = 0.01;
  constexpr double kSlowest = 0.96;
  double high = 1.0;
  while (high > kLowest && at_high < kSlowest) {
    double low = 0.5 * high;
    double at_low = sampler.rate(settings, low, set.noise, kFine);
    for (int i = 0; i < 2 && !(at_low < kSlowest); ++i) {
      low = 0.5 * (low + high);
      at_low = sampler.rate(settings, low, set.noise, kFine);
    }
    if (!(at_low < kSlowest)) {
      break;
    }
    const double worst = std::max(at_low, at_high);
    set.levels.push_back({low, high, worst + 0.4 * (1.0 - worst)});
    high = low;
    at_high = at_low;
  }
  return set.levels.empty() ? std::nullopt : std::optional<SteadySet>(set);
}

}  // namespace veritrack::contraction
