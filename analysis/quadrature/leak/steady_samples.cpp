#include "analysis/quadrature/leak/steady_samples.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/quadrature/leak/steady_cautious_rate.hpp"
#include "analysis/quadrature/leak/steady_rate.hpp"
#include "analysis/quadrature/leak/steady_setting.hpp"
#include "analysis/rigor/symmetric_three.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Matrix;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Symmetric<double> symmetric(const Matrix<3>& m) {
  return Symmetric<double>::from_matrix(m);
}

/// L with L L' = S; NaN where S is not positive definite: then no sample makes sense.
Matrix<3> root_of(const Matrix<3>& s) {
  return rigor::cholesky_of_three(s).value_or(Matrix<3>::Constant(std::numeric_limits<double>::quiet_NaN()));
}

/// The largest x with x a + b singular, a = L L': the smallest x such that x a + b >= 0.
double smallest_share(const Matrix<3>& l, const Matrix<3>& b) {
  return -rigor::least_eigenvalue_in_units(l, b);
}

struct Sample {
  SteadyStep<double> step;
  SteadyBounds<double> bounds;
};

bool usable(const Sample& sample) {
  constexpr double kLeast = 0.05;
  return sample.bounds.least_along > kLeast && sample.step.along > kLeast &&
         std::fabs(sample.step.swing) < 1.4;
}

SteadyPlace<double> place_at(double level, double share, int angle, int angles) {
  const double beta = 2.0 * std::numbers::pi * angle / angles;
  return {level, share * std::cos(beta), share * std::sin(beta)};
}

Sample sample_at(const SteadySetting<double>& setting, const SteadyPlace<double>& place, double noise) {
  const SteadyStep<double> step = steady_step(setting, place);
  return {step, steady_bounds(step, setting, place.level, noise)};
}

/// bound + the positive part of (x - bound).
void grow(Matrix<3>& bound, const Matrix<3>& x) {
  const rigor::ThreeEigensystem system = rigor::eigensystem_of_three(x - bound);
  for (int i = 0; i < 3; ++i) {
    if (system.values[i] > 0.0) {
      bound += system.values[i] * system.vectors.col(i) * system.vectors.col(i).transpose();
    }
  }
}

}  // namespace

SteadySamples::SteadySamples(const SteadyRequest& request, SteadyJudgement judgement)
    : request_(request), judgement_(judgement) {
  const auto& middle = request.steady[request.steady.size() / 2].covariance;
  root_ = root_of(middle.matrix());
  inverse_root_ = root_.inverse();
}

rigor::Matrix<3> SteadySamples::metric(const Eigen::VectorXd& x) const {
  Matrix<3> change;
  change << std::exp(x[0]), x[3], x[4], 0.0, 1.0, x[2], 0.0, 0.0, std::exp(x[1]);
  const Matrix<3> information = request_.steady.back().covariance.matrix().inverse();
  const Matrix<3> base = root_of(information).transpose();
  return change * base;
}

std::vector<SteadySetting<double>> SteadySamples::settings(const Matrix<3>& t) const {
  std::vector<SteadySetting<double>> result;
  result.reserve(request_.steady.size());
  for (const auto& steady : request_.steady) {
    SteadySetting<double> setting;
    setting.design = request_.design;
    setting.steady = steady;
    setting.metric = {t(0, 0), t(0, 1), t(0, 2), t(1, 1), t(1, 2), t(2, 2)};
    setting.directions = directions_of(setting.metric);
    fill_turns(setting);
    result.push_back(setting);
  }
  return result;
}

bool SteadySamples::find_band(std::vector<SteadySetting<double>>& settings, double noise, double goal,
                              int angles) const {
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
      const bool usable =
          for_each_image(setting, 1.0, noise, angles, [&](const Matrix<3>& low, const Matrix<3>& high) {
            grow(above, enter(high) / goal);
            grow(below, enter(low) / -goal);
          });
      if (!usable) {
        return false;
      }
    }
    const double moved =
        (above - old_above).norm() / above.norm() + (below - old_below).norm() / below.norm();
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
    if (!rigor::cholesky_of_three(least)) {
      return false;
    }
  }
  return true;
}

double SteadySamples::rate(const std::vector<SteadySetting<double>>& settings, double level, double noise,
                           int angles) const {
  double worst = 0.0;
  for (std::size_t k = 0; k < settings.size(); ++k) {
    const auto& setting = settings[k];
    const double slew = request_.slew > 0.0 && !request_.slopes.empty() ? motion_of(setting, k) : 0.0;
    for (int j = 0; j < angles; ++j) {
      for (const double share : {1.0, 0.5, 0.0}) {
        if (share == 0.0 && (j > 0 || judgement_ == SteadyJudgement::cautious)) {
          continue;
        }
        const auto errors = error_share(setting, place_at(level, share, j, angles), noise);
        worst = std::max(worst, errors.value_or(kInfinity) + slew / level);
        if (!(worst < 2.0)) {
          return kInfinity;
        }
      }
    }
    const auto below = rigor::cholesky_of_three(setting.band.below.matrix());
    const auto above = rigor::cholesky_of_three(setting.band.above.matrix());
    if (!below || !above) {
      return kInfinity;
    }
    const double motion = covariance_motion(*below, *above, k) / level;
    const bool fine =
        for_each_image(setting, level, noise, angles, [&](const Matrix<3>& low, const Matrix<3>& high) {
          worst =
              std::max({worst, smallest_share(*above, -high) + motion, smallest_share(*below, low) + motion});
        });
    if (!fine) {
      return kInfinity;
    }
  }
  return worst;
}

std::optional<double> SteadySamples::error_share(const SteadySetting<double>& setting,
                                                 const SteadyPlace<double>& place, double noise) const {
  const Sample sample = sample_at(setting, place, noise);
  if (!usable(sample)) {
    return std::nullopt;
  }
  if (judgement_ == SteadyJudgement::cautious) {
    return cautious_rate(setting, place, sample.step, sample.bounds, noise);
  }
  const SteadyReach reach = reach_of(sample.step, sample.bounds, setting, place.level, noise);
  return std::sqrt(propose_rate(reach, 0.0).rate_squared) + sample.bounds.remainder;
}

template <typename Use>
bool SteadySamples::for_each_image(const SteadySetting<double>& setting, double level, double noise,
                                   int angles, const Use& use) const {
  const int inside = angles / 4;
  for (int j = 0; j <= angles + inside; ++j) {
    const double share = j < angles ? 1.0 : j < angles + inside ? 0.5 : 0.0;
    const Sample sample = sample_at(setting, place_at(level, share, j, j < angles ? angles : inside), noise);
    if (!usable(sample)) {
      return false;
    }
    const double tangent = turn_tangent(setting, sample.step, level);
    for (const double side : {-1.0, 0.0, 1.0}) {
      if (side == 0.0 && judgement_ == SteadyJudgement::cautious) {
        continue;
      }
      const auto image =
          covariance_step(setting, sample.step, level, tangent + side * sample.bounds.tangent_reach);
      use(image.low.matrix(), image.high.matrix());
    }
  }
  return true;
}

rigor::Matrix<3> SteadySamples::enter(const Matrix<3>& p) const {
  return inverse_root_ * p * inverse_root_.transpose();
}

double SteadySamples::motion_of(const SteadySetting<double>& setting, std::size_t k) const {
  const auto& t = setting.metric;
  const rigor::Vector<9>& x = request_.slopes[k];
  const double frequency = 1.0 + x[2];
  return 1.02 * request_.slew *
         std::hypot(t.t11 * x[0] + t.t12 * x[1] + t.t13 * frequency, t.t22 * x[1] + t.t23 * frequency,
                    t.t33 * frequency);
}

double SteadySamples::covariance_motion(const Matrix<3>& below, const Matrix<3>& above, std::size_t k) const {
  if (!(request_.slew > 0.0) || request_.slopes.empty()) {
    return 0.0;
  }
  const auto& x = request_.slopes[k];
  Matrix<3> slope;
  slope << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
  // The verification raises its guess by halves until it holds.
  return 1.55 * request_.slew *
         std::max({smallest_share(above, slope), smallest_share(above, -slope), smallest_share(below, slope),
                   smallest_share(below, -slope)});
}

}  // namespace veritrack::quadrature
