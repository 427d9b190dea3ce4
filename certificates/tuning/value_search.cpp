#include "certificates/tuning/value_search.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/gaussian_noise.hpp"
#include "certificates/tuning/shortfall.hpp"
#include "certificates/tuning/trial_run.hpp"

namespace veritrack::certificates {

namespace {

constexpr double kDecades = 4.0;  // around a start
constexpr double kMissingMerit = 20.0;
constexpr double kWeightOfOpen = 1e3;  // requirements come first
constexpr double kNoLeakBelow = 1e-3;  // of the given leak
constexpr double kMostLeak = 0.5;
constexpr int kTradeOffDesigns = 8;
constexpr int kChangeDesigns = 28;  // at most, to find changes that would work

/// Thrown to end a search whose time is over, or that has examined enough designs.
struct Enough {};

/// Three digits: more are of no use.
std::string decimal(double value) {
  return fmt::format("{:.3g}", value);
}

/// The variance of the assumed noise in each channel, signal units squared; 0 where none is assumed. For
/// noise with a bound, that of the uniform distribution in the disc.
double noise_variance(const Assumptions& assume) {
  if (assume.gaussian) {
    const double deviation = nearest_deviation(assume) * assume.amplitude.nearest;
    return deviation * deviation;
  }
  return 0.25 * assume.noise.nearest * assume.noise.nearest;
}

bool gives_covariance(const Assumptions& assume) {
  return assume.initial_covariance.has_value() || assume.covariance_range.has_value();
}

class Search {
 public:
  Search(const TuningProblem& problem, const TuningRequest& request)
      : problem_(problem),
        request_(request),
        needed_(needed(problem.objective, *problem.assume, *problem.require)),
        asks_for_proofs_(asks_for_proofs(problem.objective, *problem.require)),
        free_r_(gives_covariance(*problem.assume)) {
    const double variance = noise_variance(*problem.assume);
    r_ = variance > 0.0 && !free_r_ ? decimal(variance) : problem.given.r;
  }

  TuningOutcome run() {
    TuningOutcome outcome;
    const DesignValues& given = problem_.given;
    outcome.before = certified(given);  // whatever the limits
    DesignValues best = given;
    try {
      Eigen::VectorXd start = point_of(given);
      double best_score = score(given);
      std::vector<Eigen::VectorXd> others{kalman_point()};
      if (leak_is_free()) {
        others.push_back(start);
        others.back()(start.size() - 1) = -kDecades;
      }
      for (const Eigen::VectorXd& other : others) {
        const double found = score(values_at(other));
        if (found > best_score) {
          start = other;
          best_score = found;
        }
      }
      improve(start);
    } catch (const Enough&) {
    }
    for (const auto& [values, found] : known_) {
      best = score_of(found) > score(best) ? values : best;
    }
    outcome.chosen = best;
    outcome.after = known_.at(best);
    outcome.is_met = shortage_of(outcome.after) == 0.0;
    outcome.looked_at = static_cast<int>(known_.size());
    if (request_.with_trade_off) {
      tell_trade_off(best, outcome);
    }
    if (!outcome.is_met) {
      tell_changes(best, outcome);
    }
    outcome.was_stopped = request_.deadline.has_struck();
    return outcome;
  }

 private:
  /// log10 of q1/r and q2/r; of r where it matters by itself; of the leak's share where it is free.
  [[nodiscard]] Eigen::VectorXd point_of(const DesignValues& values) const {
    const rigor::NearestRounding nearest;
    const double r = number_of(values.r).nearest;
    const double q2 = number_of(values.q2).nearest;
    const double q1 = std::max(number_of(values.q1).nearest, 1e-3 * q2);
    std::vector<double> x{std::log10(q1 / r), std::log10(q2 / r)};
    if (free_r_) {
      x.push_back(std::log10(r));
    }
    if (leak_is_free()) {
      x.push_back(0.0);
    }
    return Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
  [[nodiscard]] DesignValues values_at(const Eigen::VectorXd& x) const {
    const rigor::NearestRounding nearest;
    DesignValues values = problem_.given;
    values.r = free_r_ ? decimal(std::pow(10.0, x(2))) : r_;
    const double r = number_of(values.r).nearest;
    values.q1 = decimal(r * std::pow(10.0, x(0)));
    values.q2 = decimal(r * std::pow(10.0, x(1)));
    if (leak_is_free()) {
      const double share = std::pow(10.0, x(x.size() - 1));
      const double leak = share * number_of(problem_.given.epsilon).nearest;
      values.epsilon = share < kNoLeakBelow ? "0" : decimal(std::min(leak, kMostLeak));
    }
    return values;
  }
  [[nodiscard]] bool leak_is_free() const {
    return problem_.free_leak && number_of(problem_.given.epsilon).nearest > 0.0;
  }
  /// The values of the Kalman filter for noise and steps of the frequency of the assumed deviations; its q1
  /// is that of the signal, 0, plus a little.
  [[nodiscard]] Eigen::VectorXd kalman_point() const {
    const rigor::NearestRounding nearest;
    constexpr double kLeastRatio = 1e-6;  // of variances, where nothing is assumed
    const Assumptions& assume = *problem_.assume;
    const double noise = noise_variance(assume);
    const double step = frequency_walks(assume) ? assume.frequency_walk->nearest : assume.slew.nearest;
    const double ratio = noise > 0.0 ? std::max(step * step / noise, kLeastRatio) : 1.0;
    Eigen::VectorXd x = point_of(problem_.given);
    x(1) = std::log10(ratio);
    x(0) = x(1) - 1.0;
    if (leak_is_free()) {
      x(x.size() - 1) = -kDecades;
    }
    return x;
  }

  void improve(const Eigen::VectorXd& start) {
    search::SearchSpace space;
    space.start = start;
    space.step = Eigen::VectorXd::Constant(start.size(), 0.5);
    space.lower = start.array() - kDecades;
    space.upper = start.array() + kDecades;
    space.evaluations = 10 * request_.most_designs;  // `certified` counts those that differ
    space.tolerance = 1e-3;
    static_cast<void>(
        search::maximize([this](const Eigen::VectorXd& x) { return score(values_at(x)); }, space));
  }

  /// More is better.
  double score(const DesignValues& values) { return score_of(certified(values)); }
  [[nodiscard]] double score_of(const CertifiedValues& found) const {
    const double merit = merit_of(found, problem_.objective);
    return -kWeightOfOpen * shortage_of(found) + (std::isfinite(merit) ? merit : -kMissingMerit);
  }
  [[nodiscard]] double shortage_of(const CertifiedValues& found) const {
    return asks_for_proofs_ ? shortage(found, *problem_.assume, *problem_.require) : 0.0;
  }
  const CertifiedValues& certified(const DesignValues& values) {
    const auto known = known_.find(values);
    if (known != known_.end()) {
      return known->second;
    }
    const bool is_first = known_.empty();
    if (!is_first &&
        (static_cast<int>(known_.size()) >= request_.most_designs || request_.deadline.is_over())) {
      throw Enough();
    }
    return known_.emplace(values, looked_at(values, *problem_.assume)).first->second;
  }
  CertifiedValues looked_at(const DesignValues& values, const Assumptions& assume) {
    ++count_;
    if (request_.progress) {
      request_.progress(count_, request_.most_designs + kTradeOffDesigns + kChangeDesigns);
    }
    return problem_.certify(values, assume, needed_);
  }

  [[nodiscard]] TriedDesign reported(const DesignValues& values, const CertifiedValues& found,
                                     TriedDesign::Role role) const {
    TriedDesign design;
    design.role = role;
    design.values = {{"q1", values.q1}, {"q2", values.q2}, {"r", values.r}, {"epsilon", values.epsilon}};
    const double value = value_of(found, problem_.objective);
    if (std::isfinite(value) && (is_to_be_small(problem_.objective) || value > 0.0)) {
      design.value = in_unit(value);
    }
    design.meets = shortage_of(found) == 0.0;
    design.response = response_samples(problem_.design_with(values), *problem_.assume);
    return design;
  }
  [[nodiscard]] bool is_frequency() const {
    return problem_.objective != Objective::noise && problem_.objective != Objective::slew &&
           problem_.objective != Objective::lowest_snr;
  }
  [[nodiscard]] double in_unit(double value) const {
    const FrequencyUnits units(problem_.assume->sample_rate);
    return is_frequency() ? units.drawn(value) : value;
  }
  [[nodiscard]] std::string unit() const {
    const FrequencyUnits units(problem_.assume->sample_rate);
    return is_frequency()                                ? units.drawn_unit()
           : problem_.objective == Objective::lowest_snr ? "dB"
           : problem_.objective == Objective::noise      ? "of the amplitude"
                                                         : "rad/sample per sample";
  }
  /// The requirement of [require] on the objective itself.
  [[nodiscard]] std::optional<double> required() const {
    const Requirements& require = *problem_.require;
    const auto nearest = [&](const std::optional<Number>& number) {
      return number ? std::optional(in_unit(number->nearest)) : std::nullopt;
    };
    switch (problem_.objective) {
      case Objective::long_run:
        return nearest(require.settled_below);
      case Objective::for_ever:
        return nearest(require.frequency_error_below);
      case Objective::radius:
        return nearest(require.frequency_error_radius_at_least);
      case Objective::noise:
        return require.largest_noise_at_least ? std::optional(require.largest_noise_at_least->nearest /
                                                              problem_.assume->amplitude.nearest)
                                              : std::nullopt;
      case Objective::slew:
        return nearest(require.largest_slew_at_least);
      case Objective::rms:
        return nearest(require.rms_frequency_error_below);
      case Objective::lowest_snr:
        return require.probability_of_losing_lock_below && problem_.assume->gaussian->snr_db
                   ? std::optional(problem_.assume->gaussian->snr_db->nearest)
                   : std::nullopt;
      case Objective::simulated_rms:
        return std::nullopt;
    }
    return std::nullopt;
  }

  /// The chosen design made faster and slower: a time scale of T has q1 by T^-2 and q2 by T^-4.
  void tell_trade_off(const DesignValues& best, TuningOutcome& outcome) {
    TradeOff& trade_off = outcome.trade_off;
    const ObjectiveWords& words = words_of(problem_.objective);
    trade_off.words = words.words;
    trade_off.unit = unit();
    trade_off.is_to_be_small = is_to_be_small(problem_.objective);
    trade_off.is_simulated = problem_.objective == Objective::simulated_rms;
    trade_off.is_estimated = problem_.assume->gaussian.has_value() && !trade_off.is_simulated;
    trade_off.required = required();
    for (const auto& [values, found] : known_) {
      const auto role = values == best             ? TriedDesign::Role::chosen
                        : values == problem_.given ? TriedDesign::Role::given
                                                   : TriedDesign::Role::tried;
      trade_off.designs.push_back(reported(values, found, role));
    }
    const Eigen::VectorXd x = point_of(best);
    for (int k = -kTradeOffDesigns / 2; k <= kTradeOffDesigns / 2 && !request_.deadline.is_over(); ++k) {
      Eigen::VectorXd scaled = x;
      const double decades = 0.15 * k;  // of the time scale
      scaled(0) -= 2.0 * decades;
      scaled(1) -= 4.0 * decades;
      DesignValues values = k == 0 ? best : values_at(scaled);
      values.epsilon = best.epsilon;
      const auto known = known_.find(values);
      const CertifiedValues found =
          known != known_.end() ? known->second : looked_at(values, *problem_.assume);
      trade_off.designs.push_back(reported(values, found, TriedDesign::Role::trade_off));
    }
  }

  void tell_changes(const DesignValues& best, TuningOutcome& outcome) {
    const Assumptions& assume = *problem_.assume;
    outcome.changes = unmet_requirements(outcome.after, assume, *problem_.require);
    if (request_.deadline.is_over()) {
      return;
    }
    try {
      const std::vector<std::string> would_do = changes_that_would_do(
          [&](const Assumptions& less, const Number& leak) {
            if (request_.deadline.is_over()) {
              throw Enough();
            }
            DesignValues values = best;
            values.epsilon = leak.text;
            return looked_at(values, less);
          },
          assume, *problem_.require, number_of(best.epsilon));
      outcome.changes.insert(outcome.changes.end(), would_do.begin(), would_do.end());
    } catch (const Enough&) {
    }
  }

  const TuningProblem& problem_;
  const TuningRequest& request_;
  std::set<Objective> needed_;
  bool asks_for_proofs_;
  bool free_r_;
  std::string r_;
  std::map<DesignValues, CertifiedValues> known_;
  int count_ = 0;
};

}  // namespace

TuningOutcome search_values(const TuningProblem& problem, const TuningRequest& request) {
  return Search(problem, request).run();
}

Objective chosen_objective(const std::string& name, const Assumptions& assume) {
  const auto fits = [&](const ObjectiveWords& words) {
    return assume.gaussian ? words.with_gaussian : words.with_bound;
  };
  std::vector<std::string_view> fitting;
  for (const ObjectiveWords& words : kObjectiveWords) {
    if (fits(words)) {
      fitting.push_back(words.name);
    }
  }
  const std::optional<Objective> objective = objective_called(name.empty() ? fitting.front() : name);
  if (!objective || !fits(words_of(*objective))) {
    throw RequestError(
        fmt::format("veritrack tune: the objective {} does not fit {}; allowed: {}", name,
                    assume.gaussian ? "Gaussian noise" : "noise with a bound", fmt::join(fitting, ", ")),
        "assume.noise");
  }
  return *objective;
}

std::vector<std::string> notes_of(const TuningProblem& problem, const TuningOutcome& outcome) {
  std::vector<std::string> notes;
  const DesignValues& before = problem.given;
  const DesignValues& after = outcome.chosen;
  std::vector<std::string> changes;
  const auto add = [&](const char* key, const std::string& old_value, const std::string& new_value) {
    if (old_value != new_value) {
      changes.push_back(fmt::format("{} = {} -> {}", key, old_value, new_value));
    }
  };
  add("q1", before.q1, after.q1);
  add("q2", before.q2, after.q2);
  add("r", before.r, after.r);
  add("epsilon", before.epsilon, after.epsilon);
  const Objective objective = problem.objective;
  const auto words = words_of(objective).words;
  if (changes.empty()) {
    notes.push_back(fmt::format("None of {} designs is better than the given one: {} is {}.",
                                outcome.looked_at, words, shown(outcome.after, objective, *problem.assume)));
  } else {
    notes.push_back(fmt::format("{}: {} goes from {} to {}.", fmt::join(changes, ", "), words,
                                shown(outcome.before, objective, *problem.assume),
                                shown(outcome.after, objective, *problem.assume)));
  }
  if (before.r != after.r && !gives_covariance(*problem.assume)) {
    notes.emplace_back(
        "r is the variance of the assumed noise in a channel; the estimates depend on the ratios "
        "of q1, q2 and r only.");
  }
  if (outcome.was_stopped) {
    notes.push_back(
        fmt::format("The time limit ended the search after {} designs; more time may find better "
                    "ones.",
                    outcome.looked_at));
  }
  return notes;
}

}  // namespace veritrack::certificates
