#include "analysis/quadrature/falsifier/start_attack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/larger_or_nan.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_matrix.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {

namespace {

using Inputs = std::vector<Eigen::Vector3d>;  // as in Attack

/// The ends of the range, and a factor C of their difference: P = X + C S C' with 0 <= S <= I.
struct Range {
  Eigen::Matrix3d lower, factor;
};

Range range_of(const sets::ContractionQuestion& question) {
  if (!question.start_covariance) {
    throw std::invalid_argument("the question names no start covariance");
  }
  Eigen::Matrix3d upper;
  Range range;
  {
    const rigor::UpwardRounding upward;
    range.lower = rigor::midpoint(question.start_covariance->lower_end());
    upper = rigor::midpoint(question.start_covariance->upper_end());
  }
  const Eigen::Matrix3d spread = upper - range.lower;
  range.factor = Eigen::Matrix3d::Zero();
  if (!spread.isZero(1e-15 * upper.norm())) {
    const auto factor = rigor::cholesky(spread);
    if (!factor) {
      throw std::invalid_argument("the range of start covariances contains nothing");
    }
    range.factor = *factor;
  }
  return range;
}

class Attacker {
 public:
  Attacker(const sets::ContractionQuestion& question, const rigor::Interval& band,
           const StartAttackOptions& options)
      : options_(options),
        band_(band),
        range_(range_of(question)),
        random_(options.seed),
        design_{midpoint(question.design.q1), midpoint(question.design.q2), midpoint(question.design.r),
                midpoint(question.design.epsilon)},
        noise_(question.noise.lower()),
        slew_(question.slew.lower()),
        box_(question.initial_amplitude_error.lower(), question.initial_phase_error.lower(),
             question.initial_frequency_error.lower()) {}

  StartAttack run() {
    for (std::int64_t i = 0; i < options_.starts; ++i) {
      attack_from(start(i));
    }
    return std::move(result_);
  }

 private:
  double uniform(double low, double high) { return low + (high - low) * random_.uniform(); }
  double sign() { return random_.uniform() < 0.5 ? -1.0 : 1.0; }

  /// Orthogonal, of random directions.
  Eigen::Matrix3d turn() {
    Eigen::Matrix3d m;
    for (double& entry : m.reshaped()) {
      entry = random_.normal();
    }
    return rigor::symmetric_eigensystem(m + m.transpose()).vectors;
  }

  Attack start(std::int64_t i) {
    Attack attack;
    attack.structure = "start";
    for (int j = 0; j < 3; ++j) {
      attack.start_error[j] = sign() * box_[j];
    }
    // Every third start is on a face instead of in a corner.
    if (i % 3 == 2) {
      const auto face = static_cast<Eigen::Index>(3.0 * random_.uniform());
      for (Eigen::Index j = 0; j < 3; ++j) {
        attack.start_error[j] *= j == face ? 1.0 : uniform(-1.0, 1.0);
      }
    }
    Eigen::Vector3d share = Eigen::Vector3d::Zero();
    switch (i % 6) {
      case 0:
        break;  // X
      case 1:
        share.setOnes();  // Y
        break;
      case 2:
        share[0] = 1.0;  // X and a matrix of rank one
        break;
      case 3:
        share << 1.0, 1.0, 0.0;  // Y less a matrix of rank one
        break;
      case 4:
        share << 1.0, random_.uniform(), 0.0;  // singular differences from both
        break;
      default:
        share << random_.uniform(), random_.uniform(), random_.uniform();
    }
    const Eigen::Matrix3d basis = range_.factor * turn();
    attack.start_covariance = range_.lower + basis * share.asDiagonal() * basis.transpose();
    return attack;
  }

  /// The largest |frequency error| after the start; with `greedy`, the inputs are chosen on the way.
  double simulate(const Attack& attack, Inputs& inputs, double frequency, bool greedy) {
    double phase = 0.7;
    const double estimated = phase + attack.start_error[1];
    const trackers::QuadratureEstimate<double> own{
        1.0 + attack.start_error[0], 0.0, frequency + attack.start_error[2],
        trackers::FactoredCovariance<double>::from_matrix(attack.start_covariance)};
    trackers::QuadratureEkf<double> tracker(design_,
                                            trackers::turned(own, std::sin(estimated), std::cos(estimated)));
    double largest = 0.0;
    ++result_.runs;
    result_.steps += static_cast<std::int64_t>(inputs.size());
    for (Eigen::Vector3d& input : inputs) {
      const auto before = tracker.filtered();
      const double error = before.frequency - frequency;
      if (greedy) {
        const double outward = error >= 0.0 ? 1.0 : -1.0;
        input = {0.0, outward * noise_, -outward * slew_};
      }
      const double predicted = std::atan2(before.quadrature, before.in_phase) + before.frequency;
      phase = std::remainder(phase + frequency, 2.0 * std::numbers::pi);
      frequency += input[2];
      const double c = std::cos(predicted);
      const double s = std::sin(predicted);
      tracker.step(std::cos(phase) + input[0] * c - input[1] * s,
                   std::sin(phase) + input[0] * s + input[1] * c);
      const double now = std::abs(tracker.filtered().frequency - frequency);
      largest = rigor::larger_or_nan(largest, now);
    }
    return largest;
  }

  void attack_from(const Attack& attack) {
    const double frequency = uniform(band_.lower(), band_.upper());
    result_.at_start = std::max(result_.at_start, std::abs(attack.start_error[2]));
    const auto size = static_cast<std::size_t>(options_.steps);
    Inputs best(size, Eigen::Vector3d::Zero());
    double most = simulate(attack, best, frequency, true);
    constexpr std::array<std::size_t, 8> kPeriods{1000, 1, 2, 3, 4, 6, 9, 14};
    for (const std::size_t half_period : kPeriods) {
      const double direction =
          half_period % 2 == 0 ? 0.5 * std::numbers::pi : uniform(0.0, 2.0 * std::numbers::pi);
      const double first = sign();
      const double slew = sign() * slew_;
      Inputs inputs(size);
      for (std::size_t k = 0; k < size; ++k) {
        const double flip = (k / half_period) % 2 == 0 ? first : -first;
        inputs[k] = {flip * noise_ * std::cos(direction), flip * noise_ * std::sin(direction), flip * slew};
      }
      improve(attack, inputs, frequency, best, most);
    }
    // One sample at a time.
    const auto refined = std::min(size, static_cast<std::size_t>(options_.refined));
    for (std::size_t k = 0; k < refined; ++k) {
      Inputs turned = best;
      turned[k].head<2>() *= -1.0;
      improve(attack, turned, frequency, best, most);
      if (slew_ > 0.0) {
        turned = best;
        turned[k][2] *= -1.0;
        improve(attack, turned, frequency, best, most);
      }
    }
    if (!(most <= result_.frequency_error)) {
      result_.frequency_error = most;
      result_.attack = attack;
      result_.attack.inputs = best;
    }
  }

  void improve(const Attack& attack, Inputs& inputs, double frequency, Inputs& best, double& most) {
    const double found = simulate(attack, inputs, frequency, false);
    if (!(found <= most)) {
      most = found;
      best = inputs;
    }
  }

  StartAttackOptions options_;
  rigor::Interval band_;
  Range range_;
  trackers::RandomStream random_;
  trackers::ToneModel<double> design_;
  double noise_, slew_;
  Eigen::Vector3d box_;
  StartAttack result_;
};

}  // namespace

StartAttack attack_starts(const sets::ContractionQuestion& question, const rigor::Interval& band,
                          const StartAttackOptions& options) {
  const rigor::NearestRounding nearest;
  return Attacker(question, band, options).run();
}

}  // namespace veritrack::quadrature
