#include "certificates/model/model_lock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/tube/false_lock.hpp"
#include "analysis/model/tube/tube_errors.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/model/model_words.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Direction;
using rigor::Interval;
using rigor::Verdict;

constexpr double kUsualProbability = 1e-6;

/// A thousandth more; infinity when nothing is known.
double with_some_room(double bound) {
  return std::isfinite(bound) ? (Interval(bound) * Interval(1.001)).upper() : INFINITY;
}

/// 10 log10(amplitude^2/(2 deviation^2)), rounded up to a decimal.
std::string decibels_of(double deviation, const Interval& amplitude) {
  const Interval ratio = amplitude / (Interval(deviation) * rigor::sqrt(Interval(2.0)));
  const Interval decibels = Interval(20.0) * rigor::log(ratio) / rigor::log(Interval(10.0));
  constexpr int kDigits = 4;
  return rigor::is_finite(decibels) ? rigor::to_decimal(decibels.upper(), kDigits, Direction::up) : "";
}

std::string shown(double value) {
  return rigor::to_decimal(value, 4, Direction::up);
}

/// "within any 1e6 successive samples, however late".
std::string stretch_of(const ModelAssumptions& assume) {
  return fmt::format("within any {} successive samples, however late", assume.samples.value().text);
}

Claim reported_claim(const char* id, const ModelLock& lock, std::string hypotheses,
                     const ModelAssumptions& assume) {
  Claim claim;
  claim.id = id;
  claim.verdict = Verdict::proved;
  const std::string error = shown(lock.frequency_error);
  const std::string probability = shown(lock.probability);
  claim.values = {{"frequency_error", error}, {"probability", probability}};
  claim.hypotheses = std::move(hypotheses);
  claim.statement = fmt::format(
      "{}, the probability that the tracker loses its lock {}, its frequency error exceeding {} at one of "
      "them, is at most {}.",
      claim.hypotheses, stretch_of(assume), FrequencyUnits(assume.sample_rate).at_most(error), probability);
  return claim;
}

}  // namespace

bool names_lock(double frequency_error, double half_distance) {
  return std::isfinite(frequency_error) &&
         rigor::certainly_less(rigor::parse_decimal(shown(frequency_error)), Interval(half_distance));
}

std::string lock_objection(double frequency_error, double half_distance) {
  return std::isfinite(frequency_error)
             ? fmt::format(
                   "Its frequency error may reach {} rad/sample, and from {} rad/sample on it may be "
                   "nearer to a false lock: no lock can be named",
                   shown(frequency_error), rigor::to_decimal(half_distance, 4, Direction::down))
             : "Its frequency is not defined everywhere in it: no lock can be named";
}

ModelLock certify_model_lock(const LockSearch& search, bool lowest_snr, const model::SetProgress& progress) {
  const auto& [table, assume, require] = *search.tables;
  const Interval samples = assume.samples.value().value;
  std::vector<Interval> deviations = start_deviations(*search.model, table, assume.start_within);
  if (search.tone->filter != nullptr) {  // its covariance is bounded: those of the estimate
    deviations.resize(static_cast<std::size_t>(search.tone->filter->states));
  }
  model::GaussianTask task;
  task.name = lowest_snr ? "lowest-snr" : "gaussian";
  task.largest_deviation = lowest_snr;
  task.deviation =
      (deviation_at_unit_amplitude(*assume.gaussian, assume.amplitude[0]) * assume.amplitude[0].value)
          .upper();
  task.samples = samples.upper();
  const auto& required = require.sets.probability_of_losing_lock_below;
  task.probability = required ? required->value.lower() : kUsualProbability;
  task.start_share = kStartShare;
  task.deadline = search.deadline;
  if (!assume.start_within.empty()) {
    task.deviations = deviations;
  }
  ModelLock lock;
  lock.tubes =
      model::prove_gaussian_set(*search.tone, *search.tracker, search.low, search.high, task, progress);
  lock.frequency_error = lock.start_share = lock.probability = INFINITY;
  if (!lock.tubes.is_complete || !lock.tubes.gaussian) {
    lock.tubes.is_complete = false;
    return lock;
  }
  lock.frequency_error = 0.0;
  lock.start_share = assume.start_within.empty() ? kStartShare : 0.0;
  for (const model::ProvedTube& proved : lock.tubes.tubes) {
    const double radius = proved.levels.front();
    const Interval error = model::bound_errors(*search.tracker, proved.tube, radius, {}).error;
    const double size = rigor::is_finite(error) ? rigor::magnitude(error) : INFINITY;
    lock.frequency_error = std::max(lock.frequency_error, with_some_room(size));
    if (!assume.start_within.empty()) {
      const double level = model::bound_start(*search.tracker, proved.tube, deviations, {});
      const Interval share = Interval(with_some_room(level)) / Interval(radius);
      lock.start_share = std::max(lock.start_share, rigor::is_finite(share) ? share.upper() : INFINITY);
    }
  }
  lock.half_distance =
      model::half_distance_to_false_lock(*search.tracker, Interval::from_bounds(search.low, search.high));
  const model::GaussianTerms& terms = *lock.tubes.gaussian;
  lock.probability = with_some_room(
      model::leaving_probability(terms, search.tracker->recursion->samples, samples, lock.start_share));
  lock.snr_db = decibels_of(terms.deviation, assume.amplitude[0].value);
  return lock;
}

void add_lock_claims(Certificate& certificate) {
  const ModelTables& tables = model_tables(certificate.design);
  const ModelAssumptions& assume = tables.assume;
  const ModelSets& sets = model_sets(certificate);
  const ModelWords words(tables, std::nullopt, sets.starts_in(sets.deciding()));
  const auto is_told = [](const ModelLock& lock) {
    return lock.is_proved() && lock.probability < 1.0 && names_lock(lock.frequency_error, lock.half_distance);
  };
  if (const auto& lock = sets.gaussian; lock && is_told(*lock)) {
    certificate.claims.push_back(reported_claim("model/losing-lock", *lock,
                                                words.constant_tone() +
                                                    gaussian_words(*assume.gaussian, assume.amplitude[0]) +
                                                    words.start_inside("gaussian"),
                                                assume));
  }
  if (const auto& lock = sets.lowest_snr; lock && is_told(*lock) && !lock->snr_db.empty()) {
    GaussianNoise noise;
    noise.snr_db = Number{};
    noise.snr_db->text = lock->snr_db;
    noise.snr_db->value = rigor::parse_decimal(lock->snr_db);
    Claim claim = reported_claim(
        "model/lowest-snr", *lock,
        words.constant_tone() + gaussian_words(noise, assume.amplitude[0]) + words.start_inside("lowest-snr"),
        assume);
    claim.values.emplace_back("snr_db", lock->snr_db);
    certificate.claims.push_back(std::move(claim));
  }
}

Claim required_lock_claim(const Certificate& certificate) {
  const ModelTables& tables = model_tables(certificate.design);
  const ModelAssumptions& assume = tables.assume;
  const Number& required = *tables.require.sets.probability_of_losing_lock_below;
  const ModelSets& sets = model_sets(certificate);
  const ModelWords words(tables, std::nullopt, sets.starts_in(sets.deciding()));
  Claim claim;
  claim.id = "model/probability-of-losing-lock";
  claim.required = true;
  claim.position = required.position;
  // With the frequency error that a loss of lock exceeds, once it is known.
  const auto say = [&](const std::string& exceeding) {
    claim.requirement = fmt::format("the probability of losing lock{} is below {} {}", exceeding,
                                    required.text, stretch_of(assume));
    claim.statement = words.constant_tone() + gaussian_words(*assume.gaussian, assume.amplitude[0]) +
                      words.start_inside("gaussian") + ", " + claim.requirement + ".";
  };
  say("");
  if (!sets.gaussian || !sets.gaussian->is_proved() || !std::isfinite(sets.gaussian->probability)) {
    claim.reason = "No set of tubes was proved for this noise over the whole band";
    if (sets.gaussian && !sets.gaussian->tubes.reasons.empty()) {
      claim.reason += ": " + sets.gaussian->tubes.reasons.front();
    } else if (!sets.objection.empty()) {
      claim.reason += ": " + sets.objection;
    }
    claim.reason += ".";
    return claim;
  }
  const double probability = sets.gaussian->probability;
  if (!names_lock(sets.gaussian->frequency_error, sets.gaussian->half_distance)) {
    claim.reason = fmt::format("A set is left with a probability of at most {}. {}.", shown(probability),
                               lock_objection(sets.gaussian->frequency_error, sets.gaussian->half_distance));
    return claim;
  }
  const bool is_below = rigor::certainly_less(Interval(probability), required.value);
  claim.verdict = is_below ? Verdict::proved : Verdict::undecided;
  if (is_below) {
    const std::string error = shown(sets.gaussian->frequency_error);
    claim.values = {{"frequency_error", error}};
    say(fmt::format(", its frequency error exceeding {},",
                    FrequencyUnits(assume.sample_rate).at_most(error)));
  }
  claim.reason = fmt::format(
      "It is at most {}; while the tracker is in lock, its frequency error is at most {} "
      "rad/sample{}.",
      shown(probability), shown(sets.gaussian->frequency_error),
      is_below ? "" : fmt::format("; {} was required", required.text));
  return claim;
}

}  // namespace veritrack::certificates
