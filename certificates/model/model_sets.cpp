#include "certificates/model/model_sets.hpp"

#include <algorithm>
#include <any>
#include <complex>
#include <numbers>
#include <span>
#include <utility>

#include "analysis/model/code/listing_rounding.hpp"
#include "analysis/model/question/proof_choice.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/model/operation_words.hpp"
#include "certificates/model/proof_words.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;

/// The signal's harmonics, for an amplitude of 1, by sampling it: for proposals.
model::Signal spectrum_of(const Model& model, double amplitude) {
  constexpr int kPhases = 128;
  constexpr int kHarmonics = 40;
  const rigor::NearestRounding nearest;
  std::vector<double> inputs;
  for (const language::Constant& constant : model.constants) {
    inputs.push_back(constant.nearest);
  }
  inputs.push_back(amplitude);
  inputs.push_back(0.0);
  model::Signal signal;
  signal.coefficients.assign(model.samples.size(), std::vector<std::complex<double>>(kHarmonics, 0.0));
  std::vector<double> registers;
  std::vector<double> values(model.samples.size());
  for (int j = 0; j < kPhases; ++j) {
    const double phase = 2.0 * std::numbers::pi * j / kPhases;
    inputs.back() = phase;
    model.signal.run(std::span<const double>(inputs), registers, std::span(values));
    for (std::size_t channel = 0; channel < values.size(); ++channel) {
      for (int h = 0; h < kHarmonics; ++h) {
        const double share = (h == 0 ? 1.0 : 2.0) / kPhases / amplitude;
        signal.coefficients[channel][static_cast<std::size_t>(h)] +=
            std::polar(share * values[channel], -h * phase);
      }
    }
  }
  for (auto& coefficients : signal.coefficients) {
    const auto is_small = [](const std::complex<double>& c) { return std::abs(c) < 1e-13; };
    std::replace_if(coefficients.begin(), coefficients.end(), is_small, std::complex<double>(0.0));
    while (coefficients.size() > 1 && coefficients.back() == 0.0) {
      coefficients.pop_back();
    }
  }
  return signal;
}

}  // namespace

model::TrackerModel proved_model(const Model& model, const ModelAssumptions& assume) {
  model::TrackerModel tracker;
  tracker.recursion = &model.recursion;
  tracker.signal = &model.signal;
  for (const language::Constant& constant : model.constants) {
    tracker.constants.push_back(constant.value);
  }
  tracker.amplitude = hull(assume.amplitude[0].value, assume.amplitude[1].value);
  // For a constant one that is known to be in a range, proofs are part by part.
  tracker.amplitude_varies = !assume.one_amplitude;
  tracker.filter = model.filter ? &*model.filter : nullptr;
  return tracker;
}

bool bounds_covariance(const Model& model, const ModelTables& tables) {
  const ModelAssumptions& assume = tables.assume;
  const bool names_covariance =
      std::any_of(assume.start_within.begin(), assume.start_within.end(),
                  [](const NamedText& entry) { return entry.name.text.starts_with("P."); });
  return model.filter && model::covariance_is_bounded(*model.filter, names_covariance);
}

model::TrackedTone proposed_tone(const Model& model, const ModelAssumptions& assume) {
  // Curves and shapes are those of the middle.
  return proposed_tone(model, 0.5 * (assume.amplitude[0].nearest + assume.amplitude[1].nearest),
                       0.5 * (assume.amplitude[1].nearest - assume.amplitude[0].nearest));
}

model::TrackedTone proposed_tone(const Model& model, double amplitude, double deviation) {
  std::vector<double> constants;
  for (const language::Constant& constant : model.constants) {
    constants.push_back(constant.nearest);
  }
  const auto start = [program = model.start, constants, amplitude](double omega) {
    std::vector<double> inputs = constants;
    inputs.push_back(amplitude);
    inputs.push_back(omega);
    std::vector<double> registers;
    std::vector<double> state(program.results().size());
    program.run(std::span<const double>(inputs), registers, std::span(state));
    return state;
  };
  return {model::StepMap(model.recursion, constants),
          spectrum_of(model, amplitude),
          amplitude,
          start,
          model.states,
          nullptr,
          objections_to_operations(model),
          deviation};
}

Interval band_of(const ModelAssumptions& assume) {
  const Interval band = hull(assume.frequency[0].value, assume.frequency[1].value);
  return assume.frequency_in_hertz ? Interval(2.0) * rigor::pi() * band / assume.sample_rate.value().value
                                   : band;
}

Interval slew_of(const ModelAssumptions& assume) {
  if (!assume.slew_in_hertz_per_second) {
    return assume.slew.value;
  }
  const Interval rate = assume.sample_rate.value().value;
  return Interval(2.0) * rigor::pi() * assume.slew.value / (rate * rate);
}

double least_sample_of(const ModelAssumptions& assume) {
  return (Interval(1.0 - model::kMostNoise) * assume.amplitude[0].value).lower();
}

const ModelSets& model_sets(const Certificate& certificate) {
  return std::any_cast<const ModelSets&>(certificate.particulars);
}

namespace {

std::string words_without_bound(const trackers::code::Listing& listing, int number) {
  if (number < 0) {
    return "no bound is known for a wrap";
  }
  const trackers::code::Instruction& at = listing.instructions[static_cast<std::size_t>(number)];
  const trackers::code::OperationName* known = trackers::code::name_of(at.operation);
  const std::string_view name = known != nullptr ? known->name : "a value";
  if (at.place.file < 0 && at.place.line > 0) {
    return fmt::format("no bound is known for `{}` in line {}{}", name, at.place.line,
                       at.operation != trackers::code::Operation::atan2
                           ? ""
                           : ", which jumps at half a turn unless stays_within(..., -3.14, 3.14) limits it");
  }
  return at.place.file < 0 ? fmt::format("no bound is known for an operation `{}`", name)
                           : fmt::format("no bound is known for `{}` in line {} of {}", name, at.place.line,
                                         listing.files[static_cast<std::size_t>(at.place.file)]);
}

/// Of the states, then of the frequency. Throws NoRounding.
std::vector<double> bounds_of(const trackers::code::Listing& listing, const model::code::StepRanges& ranges) {
  int without = -1;
  std::optional<model::code::StepRounding> found = model::code::step_rounding(listing, ranges, &without);
  if (!found) {
    throw model::NoRounding(words_without_bound(listing, without));
  }
  found->next.push_back(found->frequency);
  return std::move(found->next);
}

/// What rounding adds to a step of the program of [code].
model::RoundingOfStep rounding_of(const code::CompiledCode& code, double least_sample) {
  return [&code, least_sample](const std::vector<Interval>& states, const Interval& sample) {
    model::code::StepRanges ranges{states, sample, code.recursion.bases, nullptr, least_sample};
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto angle = code.recursion.ranges.find(code.listing.states[i].input);
      if (angle != code.recursion.ranges.end()) {
        ranges.states[i] = Interval::from_bounds(angle->second.low, angle->second.high);
      }
    }
    return bounds_of(code.replaced, ranges);
  };
}

/// What rounding adds to a step of formulas. Angles are wrapped to half a turn.
model::RoundingOfStep rounding_of(const language::WrittenListing& written, const std::vector<bool>& is_angle,
                                  double least_sample) {
  return [&written, is_angle, least_sample](const std::vector<Interval>& states, const Interval& sample) {
    constexpr double kHalfTurn = 3.1417;  // and what a wrap may be off
    model::code::StepRanges ranges{states, sample, {}, &written.facts, least_sample};
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (is_angle[i]) {
        ranges.states[i] = Interval::from_bounds(-kHalfTurn, kHalfTurn);
      }
    }
    return bounds_of(written.listing, ranges);
  };
}

model::SetQuestion question_of(const Model& model, const ModelTables& tables, bool by_structure) {
  const ModelAssumptions& assume = tables.assume;
  model::SetQuestion question{.tone = proposed_tone(model, assume), .tracker = proved_model(model, assume)};
  const double least_sample = least_sample_of(assume);
  if (tables.model.compiled && tables.model.compiled->recursion.ranges_keep_obligations) {
    question.rounding = rounding_of(*tables.model.compiled, least_sample);
    question.turned = tables.model.compiled->arc_tangent ? tables.model.compiled->arc_tangent->error : 0.0;
  }
  if (model.written) {
    question.rounding = rounding_of(*model.written, model.recursion.is_angle, least_sample);
  }
  question.tone.filter = by_structure && bounds_covariance(model, tables) ? question.tracker.filter : nullptr;
  if (is_constant_in_range(assume)) {
    question.tone_at = [&model, filter = question.tone.filter](double amplitude, double deviation) {
      model::TrackedTone tone = proposed_tone(model, amplitude, deviation);
      tone.filter = filter;
      return tone;
    };
  }
  question.whole_band = band_of(assume);
  question.band = model::searched_band(question.whole_band, model.samples.size());
  question.allows_gains = is_pure_tone(tables) && assume.start_exactly.empty() && !assume.gaussian;
  question.allows_phase_gains = assume.start_exactly.empty() && !assume.gaussian && assume.one_amplitude &&
                                question.tracker.filter == nullptr;
  question.noise = assume.gaussian ? 0.0 : assume.noise.value.upper();
  question.slew = slew_of(assume).upper();
  question.deviations = start_deviations(model, tables.model, assume.start_within);
  question.assumes_start = !assume.start_within.empty();
  if (const auto& required = tables.require.sets.frequency_error_below) {
    question.required_error = required->value;
  }
  return question;
}

/// Progress through parts of a certificate, each of which counts as a number of searches.
class SharedProgress {
 public:
  SharedProgress(const CertifyProgress& progress, double searches)
      : progress_(&progress), searches_(searches) {}

  /// For a part that comes next.
  [[nodiscard]] model::SetProgress next(double searches) {
    const double before = std::exchange(done_, done_ + searches);
    return [this, before, searches](double share) {
      if (*progress_) {
        (*progress_)({(before + share * searches) / searches_, 0.0, 0});
      }
    };
  }

 private:
  const CertifyProgress* progress_;
  double searches_;
  double done_ = 0.0;
};

}  // namespace

ModelSets certify_sets(const ModelTables& tables, Extent extent, const search::Deadline& deadline,
                       const CertifyProgress& progress, bool by_structure) {
  const rigor::UpwardRounding upward;
  const ModelAssumptions& assume = tables.assume;
  const Requirements& require = tables.require.sets;
  const Model model = make_model(tables.model, assume.signal);
  const bool is_everything = extent == Extent::everything;
  model::SetQuestion question = question_of(model, tables, by_structure);
  question.largest_noise = is_everything || require.largest_noise_at_least;
  question.largest_slew = question.slew > 0.0 || require.largest_slew_at_least;
  question.is_thorough = is_everything;
  question.reach_of_assumed = require.frequency_error_radius_at_least.has_value();
  question.deadline = deadline;
  ModelSets sets;
  sets.bounds_covariance = question.tone.filter != nullptr;
  model::FirstProof first = model::prove_by_gains_first(question);
  if (first.objection) {
    sets.objection = objection_words(*first.objection, first.no_gains);
    return sets;
  }
  if (first.is_enough) {
    static_cast<model::ProvedSets&>(sets) = *std::move(first.by_gains);
    return sets;
  }
  if (question.allows_gains && first.no_gains && model.samples.size() > 1) {
    sets.no_gains = gains_words(*first.no_gains);
  }
  const bool follows_start =
      !assume.start_exactly.empty() && (is_everything || tables.require.captured_within);
  const double tasks = static_cast<double>(tasks_of(question).size());
  const double locks = !assume.gaussian ? 0.0 : is_everything ? 2.0 : 1.0;
  SharedProgress shared(progress, tasks + locks + (follows_start ? 1.0 : 0.0));
  if (assume.gaussian && question.band.out_of_reach.empty()) {
    const LockSearch search{
        &tables, &model, &question.tone, &question.tracker, question.band.low, question.band.high, deadline};
    sets.gaussian = certify_model_lock(search, false, shared.next(1.0));
    if (is_everything) {
      sets.lowest_snr = certify_model_lock(search, true, shared.next(1.0));
    }
  }
  model::ChosenProof chosen = model::choose_proof(question, std::move(first.by_gains), shared.next(tasks));
  static_cast<model::ProvedSets&>(sets) = std::move(chosen.sets);
  if (chosen.is_by_gains) {
    sets.bounds_covariance = false;
    return sets;
  }
  if (chosen.no_phase_gains) {
    sets.no_phase_gains = phase_gains_words(*chosen.no_phase_gains);
  }
  if (follows_start) {
    const model::ProvedSet& deciding = sets.deciding();
    sets.capture =
        capture_of(model, question.tracker, exact_start(model, tables.model, assume.start_exactly),
                   deciding.tubes, question.noise, deciding.frequency_error, deadline, shared.next(1.0));
  }
  return sets;
}

}  // namespace veritrack::certificates
