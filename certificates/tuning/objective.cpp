#include "certificates/tuning/objective.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/rigor/decimal.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

constexpr int kDigits = 3;

}  // namespace

const ObjectiveWords& words_of(Objective objective) {
  const auto* const found = std::find_if(kObjectiveWords.begin(), kObjectiveWords.end(),
                                         [&](const auto& each) { return each.objective == objective; });
  if (found == kObjectiveWords.end()) {
    throw std::logic_error("an objective without words");
  }
  return *found;
}

std::optional<Objective> objective_called(std::string_view name) {
  for (const ObjectiveWords& each : kObjectiveWords) {
    if (each.name == name) {
      return each.objective;
    }
  }
  return std::nullopt;
}

double value_of(const CertifiedValues& values, Objective objective) {
  switch (objective) {
    case Objective::long_run:
      return values.long_run;
    case Objective::for_ever:
      return values.for_ever;
    case Objective::radius:
      return values.radius;
    case Objective::noise:
      return values.noise;
    case Objective::slew:
      return values.slew;
    case Objective::lowest_snr:
      return values.lowest_snr;
    case Objective::rms:
      return values.rms;
    case Objective::simulated_rms:
      return values.simulated_rms;
  }
  throw std::logic_error("an objective without a value");
}

bool is_to_be_small(Objective objective) {
  return objective != Objective::radius && objective != Objective::noise && objective != Objective::slew;
}

double merit_of(const CertifiedValues& values, Objective objective) {
  const double value = value_of(values, objective);
  if (objective == Objective::lowest_snr) {
    return -value * std::log(10.0) / 20.0;
  }
  const double merit = is_to_be_small(objective) ? -std::log(value) : std::log(value);
  return std::isnan(merit) ? -CertifiedValues::kInfinite : merit;
}

std::string shown(const CertifiedValues& values, Objective objective, const Assumptions& assume) {
  return shown(values, objective, assume.sample_rate, "of the amplitude");
}

std::string shown(const CertifiedValues& values, Objective objective,
                  const std::optional<Number>& sample_rate, std::string_view noise_unit) {
  const double value = value_of(values, objective);
  const FrequencyUnits units(sample_rate);
  const bool is_known = std::isfinite(value) && (is_to_be_small(objective) || value > 0.0);
  if (!is_known) {
    return "nothing certified";
  }
  switch (objective) {
    case Objective::radius:
      return units.at_least(value, kDigits);
    case Objective::noise:
      return fmt::format("{} {}", rigor::to_decimal(value, kDigits, rigor::Direction::down), noise_unit);
    case Objective::slew:
      return units.slew(value, kDigits);
    case Objective::lowest_snr:
      return fmt::format("about {:.1f} dB", value);
    case Objective::rms:
      return "about " + units.at_most(value, kDigits);
    case Objective::simulated_rms:
      return fmt::format("{}, ± {:.0f} %", units.at_most(value, kDigits),
                         100.0 * values.simulated_deviation / value);
    default:
      return units.at_most(value, kDigits);
  }
}

bool asks_for_proofs(Objective objective, const Requirements& require) {
  const bool is_required = require.frequency_error_below || require.settled_below ||
                           require.largest_noise_at_least || require.largest_slew_at_least ||
                           require.frequency_error_radius_at_least ||
                           require.probability_of_losing_lock_below || require.rms_frequency_error_below;
  return objective != Objective::simulated_rms || is_required;
}

std::set<Objective> needed(Objective objective, const Assumptions& assume, const Requirements& require) {
  std::set<Objective> all{objective};
  if (!asks_for_proofs(objective, require)) {
    return all;
  }
  if (assume.gaussian) {
    if (require.rms_frequency_error_below) {
      all.insert(Objective::rms);
    }
    return all;
  }
  all.insert(Objective::for_ever);
  if (require.settled_below) {
    all.insert(Objective::long_run);
  }
  if (require.largest_noise_at_least) {
    all.insert(Objective::noise);
  }
  if (require.largest_slew_at_least) {
    all.insert(Objective::slew);
  }
  if (require.frequency_error_radius_at_least) {
    all.insert(Objective::radius);
  }
  return all;
}

}  // namespace veritrack::certificates
