#include "analysis/model/steady_state/periodic_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>

namespace veritrack::model::detail {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Eigen::VectorXd as_vector(const std::vector<double>& state) {
  return Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size()));
}

}  // namespace

Fraction nearby_fraction(double frequency) {
  constexpr int kFewest = 301;
  constexpr double kMost = 50000.0;
  const double share = frequency / kTurn;
  const int least = std::max(kFewest, static_cast<int>(std::min(std::ceil(5.0 / share), kMost)));
  Fraction best;
  double best_error = INFINITY;
  for (int q = least; q <= 4 * least; ++q) {
    const int p = std::max(1, static_cast<int>(std::lround(share * q)));
    const bool is_prime_to_few = std::gcd(q, 30) == 1 && std::gcd(p, 30) == 1 && std::gcd(p, q) == 1;
    const double error = std::fabs(static_cast<double>(p) / q - share);
    if (is_prime_to_few && error < best_error) {
      best = {p, q};
      best_error = error;
    }
  }
  return best;
}

PeriodicRun::PeriodicRun(const TrackedTone& tone, const Fraction& fraction, const std::vector<double>& start)
    : tone_(&tone), state_(as_vector(start)) {
  const int q = fraction.samples;
  samples_.resize(tone.step.samples(), q);
  for (int k = 0; k < q; ++k) {
    const auto place = static_cast<double>(static_cast<long long>(fraction.turns) * (k + 1) % q);
    samples_.col(k) = samples_of(tone.signal, tone.amplitude, kTurn * place / static_cast<double>(q));
  }
  states_.resize(state_.size(), q + 1);
  wound_ = Eigen::VectorXd::Zero(state_.size());
}

void PeriodicRun::run() {
  trackers::ModelTracker<double> tracker(tone_->step.recursion(), tone_->step.constants(),
                                         std::vector<double>(state_.begin(), state_.end()));
  states_.col(0) = state_;
  mean_frequency_ = 0.0;
  const auto channels = static_cast<std::size_t>(samples_.rows());
  for (Eigen::Index k = 0; k < samples_.cols(); ++k) {
    tracker.step(std::span<const double>(samples_.col(k).data(), channels));
    states_.col(k + 1) = as_vector(tracker.state());
    mean_frequency_ += tracker.frequency() / static_cast<double>(samples_.cols());
  }
  state_ = states_.rightCols(1);
  for (Eigen::Index i = 0; i < state_.size(); ++i) {
    if (tone_->step.recursion().is_angle[static_cast<std::size_t>(i)]) {
      const double turns = std::round(state_[i] / kTurn);
      state_[i] -= kTurn * turns;
      wound_[i] += turns;
    }
  }
}

Eigen::MatrixXd sorted_states(const PeriodicRun& run, const Fraction& fraction,
                              const std::vector<int>& turns) {
  const int q = fraction.samples;
  Eigen::MatrixXd sorted(run.states().rows(), q);
  for (int k = 0; k < q; ++k) {
    const auto passed = static_cast<long long>(fraction.turns) * k;
    const auto place = static_cast<Eigen::Index>(passed % q);
    sorted.col(place) = run.states().col(k);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      sorted(static_cast<Eigen::Index>(i), place) -= turns[i] * kTurn * static_cast<double>(passed) / q;
    }
  }
  return sorted;
}

void History::add(const PeriodicRun& run) {
  ends_.push_back(run.wrapped());
  wound_.push_back(run.wound());
}

Eigen::VectorXd History::change(int periods, const std::vector<bool>& is_angle) const {
  const std::size_t last = ends_.size() - 1;
  Eigen::VectorXd result = ends_[last] - ends_[last - static_cast<std::size_t>(periods)];
  for (std::size_t i = 0; i < is_angle.size(); ++i) {
    if (is_angle[i]) {
      auto& change = result[static_cast<Eigen::Index>(i)];
      change = std::remainder(change, kTurn);
    }
  }
  return result;
}

Eigen::VectorXd History::turns(int periods) const {
  const std::size_t last = ends_.size() - 1;
  const std::size_t first = last - static_cast<std::size_t>(periods);
  const Eigen::VectorXd whole = (ends_[last] - ends_[first]) / kTurn;
  return wound_[last] - wound_[first] + whole.array().round().matrix();
}

}  // namespace veritrack::model::detail
