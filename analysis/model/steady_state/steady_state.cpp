#include "analysis/model/steady_state/steady_state.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "analysis/model/steady_state/periodic_run.hpp"
#include "analysis/model/step/undefined_operation.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::model {

namespace {

constexpr double kResolved = 1e-8;  ///< of a rate

using detail::Fraction;
using detail::History;
using detail::PeriodicRun;

/// The growth of errors over the last period, and the mode that grows or lasts the longest.
void find_slowest_mode(const TrackedTone& tone, const PeriodicRun& run, const Eigen::VectorXd& size,
                       SteadyState& result) {
  const Eigen::Index n = size.size();
  Eigen::MatrixXd product = Eigen::MatrixXd::Identity(n, n);
  double logarithm = 0.0;
  for (Eigen::Index k = 0; k < run.samples().cols(); ++k) {
    product = (tone.step.jacobian(run.states().col(k), run.samples().col(k)).leftCols(n) * product).eval();
    const double largest = product.cwiseAbs().maxCoeff();
    if (!(largest > 0.0) || !std::isfinite(largest)) {
      result.rate = 0.0;
      return;
    }
    product /= largest;
    logarithm += std::log(largest);
  }
  // In units of the states' size, D^-1 Phi D.
  const Eigen::VectorXd unit = size.unaryExpr([](double s) { return s > 0.0 ? s : 1.0; });
  const Eigen::MatrixXd scaled = unit.cwiseInverse().asDiagonal() * product * unit.asDiagonal();
  const Eigen::MatrixXd transposed = scaled.transpose();
  const auto [radius, mode] = rigor::dominant_mode(transposed);
  result.rate = std::exp((logarithm + std::log(radius)) / static_cast<double>(run.samples().cols()));
  Eigen::Index largest = 0;
  mode.cwiseAbs().maxCoeff(&largest);
  result.mode = mode / mode[largest];
}

/// The size of each state over a period; of an angle, 1.
Eigen::VectorXd size_of(const Eigen::MatrixXd& states, const std::vector<bool>& is_angle) {
  Eigen::VectorXd size = states.cwiseAbs().rowwise().maxCoeff();
  for (std::size_t i = 0; i < is_angle.size(); ++i) {
    size[static_cast<Eigen::Index>(i)] = is_angle[i] ? 1.0 : size[static_cast<Eigen::Index>(i)];
  }
  return size;
}

/// The effect on each state of a sample that is wrong by the whole amplitude, within as many steps as there
/// are states: a state that rests at 0 has no other size.
Eigen::VectorXd response_of(const TrackedTone& tone, const PeriodicRun& run) {
  const Eigen::Index n = run.states().rows();
  const Eigen::MatrixXd slope = tone.step.jacobian(run.states().col(0), run.samples().col(0));
  Eigen::MatrixXd effect = slope.rightCols(slope.cols() - n);
  Eigen::VectorXd response = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n && effect.allFinite(); ++k) {
    response = response.cwiseMax(effect.rowwise().norm());
    effect = (slope.leftCols(n) * effect).eval();
  }
  return tone.amplitude * response;
}

bool is_small(const Eigen::VectorXd& change, const Eigen::VectorXd& size) {
  constexpr double kReturned = 1e-9;
  return (change.cwiseAbs().array() <= kReturned * size.array()).all();
}

/// Whether a state that returns also stays there: its movement in all periods to come, if it settles by the
/// rate of the last one, is small for its size now. A covariance that decays like 1/N returns compared with
/// its start, but half of its decay is still to come.
bool is_at_rest(const SteadyState& result, const Eigen::VectorXd& size_now,
                const Eigen::VectorXd& first_size) {
  constexpr double kLittle = 1e-3;
  constexpr double kRounding = 1e-12;
  constexpr double kNothing = 1e-14;  // a state that is 0 apart from rounding
  const double left = 1.0 - std::pow(result.rate, result.period);
  return (result.drift.cwiseAbs().array() <=
          kLittle * left *
              size_now.cwiseMax(kRounding * first_size).array().max(kNothing * size_now.maxCoeff()))
      .all();
}

/// The tone's words for the first operation that was undefined in the last period; or empty.
std::string objection_of(const TrackedTone& tone, const PeriodicRun& run) {
  const trackers::StraightLineProgram& step = tone.step.recursion().step;
  for (Eigen::Index k = 0; k < run.samples().cols(); ++k) {
    if (!run.states().col(k).allFinite() || run.states().col(k + 1).allFinite()) {
      continue;
    }
    std::vector<double> inputs = tone.step.constants();
    inputs.insert(inputs.end(), run.states().col(k).begin(), run.states().col(k).end());
    inputs.insert(inputs.end(), run.samples().col(k).begin(), run.samples().col(k).end());
    std::vector<double> registers;
    std::vector<double> next(step.results().size());
    step.run(std::span<const double>(inputs), registers, std::span(next));
    const int found = first_unknown(step, registers, [](double value) { return std::isfinite(value); });
    const auto number = static_cast<std::size_t>(found);
    return found >= 0 && number < tone.objections.size() ? tone.objections[number] : std::string();
  }
  return {};
}

}  // namespace

double error_from_amplitude(const TrackedTone& tone) {
  constexpr int kPhases = 64;
  double most = 0.0;
  for (int k = 0; k < kPhases && tone.amplitude_deviation > 0.0; ++k) {
    const double phase = 2.0 * std::numbers::pi * k / kPhases;
    most = std::max(most, samples_of(tone.signal, tone.amplitude_deviation, phase).norm());
  }
  return most;
}

namespace {

/// The end of a simulation.
struct Settling {
  Eigen::VectorXd size;     ///< of the states
  bool returns = false;     ///< after a period, apart from its drift
  bool is_resting = false;  ///< and does not change any more
};

/// Runs until nothing changes, at most as long as the settings allow; empty when it diverges, as the result
/// then states.
std::optional<Settling> settle(const TrackedTone& tone, const SteadyStateSettings& settings, PeriodicRun& run,
                               History& history, SteadyState& result) {
  constexpr double kHuge = 1e9;
  const auto& is_angle = tone.step.recursion().is_angle;
  Settling settling;
  Eigen::VectorXd first_size;
  for (int next_look = 0;;) {
    run.run();
    history.add(run);
    result.samples += result.period;
    const Eigen::VectorXd size_now = size_of(run.states(), is_angle);
    first_size = first_size.size() == 0 ? size_now : first_size;
    if (!run.states().allFinite() || size_now.maxCoeff() > kHuge * std::max(1.0, first_size.maxCoeff())) {
      result.outcome = SteadyStateOutcome::diverges;
      result.undefined = objection_of(tone, run);
      return std::nullopt;
    }
    settling.size = size_now.cwiseMax(first_size).cwiseMax(response_of(tone, run));
    result.drift = history.change(1, is_angle);
    result.drift.cwiseAbs().cwiseQuotient(settling.size.cwiseMax(1e-300)).maxCoeff(&result.slowest_state);
    settling.returns = is_small(result.drift, settling.size);
    const bool is_last = result.samples + result.period > settings.samples || settings.deadline.is_over();
    if (is_last || (settling.returns && result.samples >= next_look)) {
      find_slowest_mode(tone, run, settling.size, result);
      settling.is_resting = settling.returns && is_at_rest(result, size_now, first_size);
      if (is_last || settling.is_resting || !(result.rate < 1.0 - kResolved)) {
        return settling;
      }
      next_look = 2 * result.samples;
    }
  }
}

bool are_whole(const Eigen::VectorXd& turns) {
  return (turns - turns.array().round().matrix()).cwiseAbs().maxCoeff() < 1e-9;
}

}  // namespace

SteadyState find_steady_state(const TrackedTone& tone, double frequency,
                              const SteadyStateSettings& settings) {
  const rigor::NearestRounding nearest;
  constexpr int kLongestRepetition = 8;
  SteadyState result;
  result.names = tone.names;
  if (!(frequency > 0.0 && frequency < std::numbers::pi)) {
    throw std::invalid_argument("a steady state belongs to a frequency between 0 and pi");
  }
  const Fraction fraction = detail::nearby_fraction(frequency);
  result.asked_frequency = frequency;
  result.frequency = 2.0 * std::numbers::pi * fraction.turns / fraction.samples;
  result.period = fraction.samples;
  // Start at the tone that is simulated: a slow loop does not lock to another one in any number of samples.
  const std::vector<double> start = tone.start(result.frequency);
  const auto& is_angle = tone.step.recursion().is_angle;
  if (static_cast<int>(start.size()) != tone.step.states() || is_angle.size() != start.size()) {
    throw std::invalid_argument("wrong number of states at the start of a simulation");
  }
  PeriodicRun run(tone, fraction, start);
  History history;
  history.add(run);
  const auto settling = settle(tone, settings, run, history, result);
  if (!settling) {
    return result;
  }
  // While it settles, an estimate may be undefined (an arc cosine beyond 1).
  result.mean_frequency = run.mean_frequency();
  if (!std::isfinite(result.mean_frequency)) {
    result.outcome = SteadyStateOutcome::diverges;
    result.undefined = "the estimated frequency is not finite";
    return result;
  }
  result.mean_error = result.mean_frequency - result.frequency;
  const double resolved = settling->is_resting ? kResolved : 4.0 / static_cast<double>(result.samples);
  const Eigen::VectorXd turns = history.turns(1) / static_cast<double>(fraction.turns);
  const bool returns = settling->returns;
  const bool is_whole = are_whole(turns);
  for (int m = 2; (!returns || !is_whole) && m <= kLongestRepetition && history.reaches(m); ++m) {
    const Eigen::VectorXd together = history.turns(m) / static_cast<double>(fraction.turns);
    if (is_small(history.change(m, is_angle), settling->size) && are_whole(together)) {
      result.repetition = m;
      result.outcome = SteadyStateOutcome::repeats_later;
      return result;
    }
  }
  // Errors may grow on the way to a steady state; that does not show whether they grow in it.
  const bool is_unstable = !(result.rate <= 1.0 - resolved) && (returns || result.rate <= 1.0 + resolved);
  if (is_unstable && result.rate > 0.0) {
    result.outcome = SteadyStateOutcome::not_exponentially_stable;
    if (result.rate <= 1.0 + resolved) {  // what grows is something else
      result.neutral = find_neutral_turn(tone.step, run.states().col(0), settling->size);
    }
  } else if (std::fabs(result.mean_error) > settings.largest_mean_error) {
    result.outcome = SteadyStateOutcome::locked_elsewhere;
  } else if (!returns || !is_whole) {
    result.outcome = SteadyStateOutcome::still_drifts;
  } else {
    result.outcome = SteadyStateOutcome::settled;
    for (std::size_t i = 0; i < is_angle.size(); ++i) {
      result.turns.push_back(is_angle[i] ? static_cast<int>(std::lround(turns[static_cast<Eigen::Index>(i)]))
                                         : 0);
    }
    result.states = detail::sorted_states(run, fraction, result.turns);
  }
  return result;
}

}  // namespace veritrack::model
