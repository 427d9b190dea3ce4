#include "certificates/model/markdown_model_sets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/set/falsifier.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/model/band_part.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

using model::ProvedSet;
using model::ProvedTube;
using rigor::Direction;
using rigor::to_decimal;

/// A set, and its purpose.
struct NamedSet {
  const ProvedSet* set;
  std::string purpose;
  bool is_given = false;                ///< noise and slew are; otherwise they are searched for
  std::string where = {};               ///< ", over [0.2, 0.4] rad/sample only"; empty for the whole band
  const ProvedSet* long_run = nullptr;  ///< inside it

  [[nodiscard]] double settled_error() const {
    return long_run != nullptr ? long_run->settled_error : set->settled_error;
  }

  [[nodiscard]] bool is_any() const { return set->is_proved() || set->has_part(); }
};

std::vector<NamedSet> named_sets(const ModelSets& sets, const ModelAssumptions& assume) {
  std::vector<NamedSet> named{{&sets.starts, "large starts", true}};
  if (sets.assumed) {
    const model::TubeSet& tubes = sets.assumed->tubes;
    named.push_back({&*sets.assumed,
                     !(tubes.slew > 0.0)    ? "the assumed noise"
                     : !(tubes.noise > 0.0) ? "the assumed slew"
                                            : "the assumed noise and slew",
                     true,
                     {},
                     sets.long_run ? &*sets.long_run : nullptr});
  }
  const bool is_more_assumed = sets.noise && sets.assumed && sets.assumed->is_proved() &&
                               !(sets.assumed->tubes.slew > 0.0) &&
                               sets.noise->tubes.noise < sets.assumed->tubes.noise;
  if (sets.noise && !is_more_assumed) {
    named.push_back({&*sets.noise, "the largest noise", false});
  }
  if (sets.slew) {
    named.push_back({&*sets.slew, "the largest slew", false});
  }
  for (NamedSet& each : named) {
    const auto part = each.set->has_part() ? band_part(assume, each.set->tubes.part) : std::nullopt;
    if (part) {
      each.where = fmt::format(", over [{}, {}] {} only", part->from, part->to,
                               assume.frequency_in_hertz ? "Hz" : "rad/sample");
    }
  }
  return named;
}

/// The number of samples after which every start is at the lowest level.
double samples_to_settle(const ProvedSet& set, const ProvedSet* long_run) {
  double samples = 0.0;
  std::size_t number = 0;  // of the tube, which is that of the long run's
  for (const model::TubeSet& part : model::sets_of_amplitudes(set.tubes)) {
    for (const ProvedTube& tube : part.tubes) {
      const ProvedTube* inner = long_run != nullptr ? &long_run->tubes.tubes[number] : nullptr;
      const double until = inner != nullptr ? samples_until_long_run(tube, *inner, inner->levels.size() - 1)
                                            : samples_until(tube, tube.levels.size() - 1, part.crossing);
      samples = std::isfinite(until) ? std::max(samples, until) : INFINITY;
      ++number;
    }
  }
  return samples;
}

std::string levels_of(const ProvedSet& set) {
  const auto [least, most] = std::minmax_element(
      set.tubes.tubes.begin(), set.tubes.tubes.end(),
      [](const ProvedTube& a, const ProvedTube& b) { return a.levels.size() < b.levels.size(); });
  return least->levels.size() == most->levels.size()
             ? fmt::format("{}", most->levels.size())
             : fmt::format("{} to {}", least->levels.size(), most->levels.size());
}

/// A bound that a disturbance keeps, rounded down; a dash where it was searched for and not found.
std::string bound_in_table(double bound, const std::string& text, bool is_known) {
  return bound > 0.0 ? text : is_known ? "none" : "—";
}

std::string noise_text(const model::TubeSet& set) {
  return to_decimal(set.noise, 4, Direction::down);
}

std::vector<std::string> row_of(const NamedSet& named, const FrequencyUnits& units) {
  const ProvedSet& set = *named.set;
  const bool is_known = named.is_given || named.is_any();
  std::vector<std::string> row{named.purpose + named.where,
                               bound_in_table(set.tubes.noise, noise_text(set.tubes), is_known),
                               bound_in_table(set.tubes.slew, units.slew(set.tubes.slew), is_known)};
  if (!named.is_any()) {
    row.insert(row.end(), {"not proved", "—", "—", "—", "—", "—"});
    return row;
  }
  const double samples = samples_to_settle(set, named.long_run);
  const bool settles = samples > 0.0;
  row.insert(row.end(),
             {fmt::format("{}", set.tubes.tubes.size()), levels_of(set), units.at_most(set.frequency_error),
              settles ? units.at_most(named.settled_error()) : "as for ever",
              settles ? fmt::format("{}", samples) : "—", units.at_least(set.reach)});
  return row;
}

/// "Without noise, at a constant frequency", "With noise of at most 0.02 signal units at every sample, at
/// ...".
std::string disturbances_of(const model::TubeSet& set, const FrequencyUnits& units) {
  const std::string noise =
      set.noise > 0.0 ? fmt::format("With noise of at most {} signal units at every sample", noise_text(set))
                      : std::string("Without noise");
  return set.slew > 0.0
             ? fmt::format("{}, at a frequency that changes by at most {}", noise, units.slew(set.slew))
             : noise + ", at a constant frequency";
}

std::string sentence_of(const NamedSet& named, const FrequencyUnits& units, const ModelAssumptions& assume) {
  const ProvedSet& set = *named.set;
  std::string text = fmt::format(
      "- *For {}{}*: {}{}, a start in this set stays in it for ever, with a frequency error of at most {}",
      named.purpose, named.where, disturbances_of(set.tubes, units),
      assume.one_amplitude        ? ""
      : assume.constant_amplitude ? ", at any constant amplitude of the range"
                                  : ", at any amplitude of the range at each sample",
      units.at_most(set.frequency_error));
  const double samples = samples_to_settle(set, named.long_run);
  if (samples > 0.0 && std::isfinite(samples) && named.settled_error() < set.frequency_error) {
    text += fmt::format("; from sample {} on the error is at most {}", samples,
                        units.at_most(named.settled_error()));
  }
  return text + ".\n";
}

/// "[0.2, 0.3], [0.4, 0.5] rad/sample": frequencies with a proved tube, rounded inward.
std::string proved_part(const model::TubeSet& set) {
  std::string text;
  for (const auto& [low, high] : set.parts) {
    text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", to_decimal(low, 6, Direction::up),
                        to_decimal(high, 6, Direction::down));
  }
  return text;
}

std::string objections(const NamedSet& named) {
  const model::TubeSet& set = named.set->tubes;
  const std::string part = proved_part(set);
  std::string text =
      fmt::format("The set for {} was not proved by tubes for the whole band. {}\n\n", named.purpose,
                  part.empty() ? std::string("No part of it was proved.")
                               : fmt::format("Frequencies with a proved tube: {} rad/sample.", part));
  constexpr std::size_t kMostReasons = 8;
  for (std::size_t i = 0; i < std::min(kMostReasons, set.reasons.size()); ++i) {
    text += "- " + markdown::escaped(set.reasons[i]) + "\n";
  }
  if (set.reasons.size() > kMostReasons) {
    text += fmt::format("- and {} more of this kind\n", set.reasons.size() - kMostReasons);
  }
  return text + "\n";
}

/// The share of the deciding set's bounds that simulations reach.
std::string attack_on(const NamedSet& named, const model::TrackerModel& tracker,
                      const FrequencyUnits& units) {
  const ProvedSet& set = *named.set;
  const model::TubeAttack attack = attack_tubes(tracker, set.tubes);
  if (attack.level_share > 1.0 || attack.frequency_error > set.frequency_error) {
    return fmt::format(
        "**ALARM**: a simulation left the set for {}. This must not happen: please report it, with the "
        "design "
        "file.\n\n",
        named.purpose);
  }
  return fmt::format(
      "*Simulated, not proved:* an attack on the set for {}, with {} starts on its rim and {} samples "
      "each{}, reached a frequency error of {:.3g} rad/sample{}: {:.2f} of the certified bound. After the "
      "first sample it reached at most {:.3f} of the set's size.\n\n",
      named.purpose, attack.starts, attack.samples,
      set.tubes.noise > 0.0 || set.tubes.slew > 0.0 || tracker.amplitude_varies
          ? " under disturbances that push outward at every sample"
          : "",
      attack.frequency_error,
      units.has_hertz() ? fmt::format(" ({:.3g} Hz)", units.drawn(attack.frequency_error)) : "",
      attack.frequency_error / set.frequency_error, attack.level_share);
}

/// The proved bound compared with the errors in the linear approximation.
std::string linear_comparison(const ModelSets& sets, const FrequencyUnits& units) {
  if (!sets.linear || !sets.assumed || !(sets.linear->disturbed > 0.0)) {
    return "";
  }
  const model::LinearWorstCase& linear = *sets.linear;
  const auto number = [&](double radians) {
    return fmt::format("{:.4g} rad/sample{}", radians,
                       units.has_hertz() ? fmt::format(" ({:.4g} Hz)", units.drawn(radians)) : "");
  };
  const double bound = best_settled_error_of(sets);
  std::string text = fmt::format(
      "*Computed, not proved:* to first order in the errors, the assumed disturbances bring the frequency "
      "error in the long run to about {} at worst, of which {} are there without them. This is the sum of "
      "what "
      "each earlier disturbance adds to the estimate, |h Phi B|, along the curve of the steady state, at the "
      "worst of 5 frequencies and 48 phases; it is exact for small disturbances.",
      number(linear.disturbed), number(linear.undisturbed));
  if (std::isfinite(bound)) {
    text += fmt::format(" The certified bound in the long run is {:.2f} times as large.",
                        bound / linear.disturbed);
  }
  return text + "\n\n";
}

/// The number of parts into which the range of a constant amplitude is cut.
std::string parts_sentence(const ModelSets& sets) {
  std::size_t parts = sets.starts.tubes.amplitudes.size();
  for (const std::optional<ProvedSet>* set : {&sets.assumed, &sets.noise, &sets.slew}) {
    parts = *set ? std::max(parts, (*set)->tubes.amplitudes.size()) : parts;
  }
  return fmt::format(
      "The amplitude is constant and somewhere in its range. The range is cut into {}, each with tubes of "
      "its "
      "own that are proved for every amplitude of the part: a start in the set is one in a tube of the part "
      "in which the amplitude is. The numbers below are the worst of all parts.\n\n",
      parts > 0 ? fmt::format("{} part{}", parts, parts == 1 ? "" : "s") : std::string("parts"));
}

/// Bounds by gains are mostly better: why there are none.
std::string without_gains(const ModelSets& sets) {
  std::vector<std::string> reasons;
  if (!sets.no_gains.empty()) {
    reasons.push_back("with one linear recursion for all phases: " + sets.no_gains);
  }
  if (!sets.no_phase_gains.empty()) {
    reasons.push_back("phase by phase: " + sets.no_phase_gains);
  }
  return reasons.empty() ? std::string()
                         : fmt::format(
                               "Gains, which mostly prove more than tubes, were tried and prove "
                               "nothing here ({}).\n\n",
                               markdown::escaped(fmt::format("{}", fmt::join(reasons, "; "))));
}

}  // namespace

std::string model_picture(const MarkdownOptions& options, std::string_view file) {
  for (const FigureReference& figure : options.figures) {
    if (figure.path.ends_with(file)) {
      return picture(figure);
    }
  }
  return "";
}

std::string model_sets_section(const Certificate& certificate, const Model& model,
                               const MarkdownOptions& options) {
  const ModelAssumptions& assume = model_tables(certificate.design).assume;
  const ModelSets& sets = model_sets(certificate);
  const FrequencyUnits units(assume.sample_rate);
  std::string text = "## The certified sets\n\n";
  if (!sets.objection.empty()) {
    return text + "Nothing is certified: " + markdown::escaped(sets.objection) + ".\n\n";
  }
  text +=
      "A certified set is a tube: for each phase of the signal and each frequency of the band, an ellipsoid "
      "of "
      "states around the state in which the tracker settles. A start in the tube never leaves it. The band "
      "is divided into cells of frequencies, each with its own tube. A tube is divided into nested levels, "
      "from the whole tube to its core; the errors shrink from level to level. The last column says how far "
      "the tube reaches: at every phase it contains states with a frequency error of that size, in both "
      "directions.";
  text +=
      sets.bounds_covariance
          ? " The ellipsoids are those of the filter's estimate. Its covariance is between two matrices at "
            "every phase: a start in the set has such a covariance, and with each of them the errors shrink "
            "as "
            "much as is said.\n\n"
          : "\n\n";
  if (is_constant_in_range(assume)) {
    text += parts_sentence(sets);
  }
  const std::vector<NamedSet> all = named_sets(sets, assume);
  std::vector<std::vector<std::string>> rows;
  std::string meanings;
  std::string failures;
  const NamedSet* attacked = nullptr;
  for (const NamedSet& named : all) {
    rows.push_back(row_of(named, units));
    if (named.is_any()) {
      meanings += sentence_of(named, units, assume);
    }
    if (!named.set->is_proved()) {
      failures += objections(named);
    }
    attacked = named.is_any() && named.is_given ? &named : attacked;
  }
  text += markdown::table({"For", "Noise, at most, signal units", "Slew, at most", "Cells of frequencies",
                           "Levels", "Frequency error for ever, at most", "In the long run, at most",
                           "Long run: from sample", "Reach, at least"},
                          rows) +
          "\n" + meanings + (meanings.empty() ? "" : "\n") + failures;
  if (sets.long_run) {
    text +=
        "The long run in the assumed noise is that of a second set, `long-run`, inside the lowest levels of "
        "the first: when errors are small, the covariance comes between two narrower matrices.\n\n";
  }
  const ProvedSet& deciding = sets.deciding();
  if (model_tables(certificate.design).require.sets.frequency_error_below &&
      (deciding.is_proved() || deciding.has_part())) {
    text +=
        "The set that decides the required frequency error is used only at the levels that keep that error, "
        "if the assumed starts are inside them.\n\n";
  }
  if (!assume.start_within.empty() && (deciding.is_proved() || deciding.has_part()) &&
      std::isfinite(deciding.start_share)) {
    text += fmt::format("The assumed starts reach at most {} of the size of the set for {}{}.\n\n",
                        to_decimal(deciding.start_share, 4, Direction::up),
                        attacked != nullptr ? attacked->purpose : "",
                        deciding.start_share <= 1.0 ? ", and are inside it" : ": some are outside");
  }
  if (sets.capture && !sets.capture->is_proved) {
    text += fmt::format(
        "That the tracker comes from its start, `start_exactly`, into the set is not proved: {}.\n\n",
        markdown::escaped(sets.capture->reason));
  }
  if (attacked != nullptr) {
    text += attack_on(*attacked, proved_model(model, assume), units);
  }
  text += linear_comparison(sets, units) + without_gains(sets);
  return text + model_picture(options, "reach.svg") + model_picture(options, "tolerance.svg") +
         model_picture(options, "tube.svg");
}

}  // namespace veritrack::certificates
