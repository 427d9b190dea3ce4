#include "certificates/model/model_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <utility>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/tube/false_lock.hpp"
#include "analysis/model/tube/tube_errors.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/sets/harder_questions.hpp"
#include "certificates/model/model_amplitudes.hpp"
#include "certificates/model/operation_words.hpp"

namespace veritrack::certificates {

namespace {

using model::ShapeObjective;
using model::TubeSet;
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

/// A little more; infinity when nothing is known.
double with_room(double bound) {
  constexpr double kRoom = 1.001;
  return std::isfinite(bound) ? (Interval(bound) * Interval(kRoom)).upper() : INFINITY;
}

/// The larger one; infinity when nothing is known of one. (std::max forgets what is not a number.)
double larger(double a, double b) {
  return std::isfinite(a) && std::isfinite(b) ? std::max(a, b) : INFINITY;
}

/// The largest absolute value; infinity when nothing is known.
double size_of(const Interval& range) {
  return rigor::is_finite(range) ? std::max(std::fabs(range.lower()), std::fabs(range.upper())) : INFINITY;
}

/// What follows from tubes, for the frequencies that they cover.
ModelSet conclude_of_tubes(const model::TrackerModel& tracker, TubeSet tubes,
                           const std::vector<Interval>& deviations, std::vector<ModelCell>* cells) {
  const rigor::UpwardRounding upward;
  ModelSet set;
  set.tubes = std::move(tubes);
  set.frequency_error = set.settled_error = set.ripple = set.start_share = INFINITY;
  if (set.tubes.tubes.empty()) {
    return set;
  }
  set.frequency_error = set.settled_error = set.ripple = set.start_share = 0.0;
  set.reach = INFINITY;
  const model::Tube& lowest = set.tubes.tubes.front().tube;
  const model::Tube& highest = set.tubes.tubes.back().tube;
  set.half_distance = model::half_distance_to_false_lock(
      tracker, hull(Interval(lowest.frequency) - Interval(lowest.half_width),
                    Interval(highest.frequency) + Interval(highest.half_width)));
  const model::ErrorGrid grid;
  bool is_first = true;
  for (const model::ProvedTube& proved : set.tubes.tubes) {
    const double radius = proved.levels.front();
    const double reach = model::bound_reach(tracker, proved.tube, radius, grid) * 0.999;
    // Of a filter whose covariance is bounded, those of the estimate.
    const std::vector<Interval> of_tube(
        deviations.begin(), deviations.begin() + static_cast<std::ptrdiff_t>(proved.tube.curve.size()));
    const double start = model::bound_start(tracker, proved.tube, of_tube, grid);
    constexpr model::ErrorGrid kFine{128, 16, 16};  // the bias changes with the frequency
    const model::TubeErrors settled =
        model::bound_errors(tracker, proved.tube, proved.levels.back(), cells != nullptr ? kFine : grid);
    const Interval whole = model::bound_errors(tracker, proved.tube, radius, grid).error;
    // A tenth of what is unknown where it is least, and what rounding comes to.
    double unknown = INFINITY;
    for (const model::TubeErrors::Slice& slice : settled.slices) {
      unknown = std::min(unknown, slice.mean.upper() - slice.mean.lower());
    }
    const double room = rigor::is_finite(settled.mean) ? 0.05 * unknown + 1e-12 : INFINITY;
    const Interval mean = rigor::is_finite(settled.mean) ? settled.mean + Interval::from_bounds(-room, room)
                                                         : Interval::empty();
    set.frequency_error = larger(set.frequency_error, with_room(size_of(whole)));
    set.settled_error = larger(set.settled_error, with_room(size_of(settled.error)));
    constexpr double kOfRipple = 2e-5;
    set.ripple = larger(set.ripple, settled.ripple + std::min(0.01 * settled.ripple,
                                                              kOfRipple * settled.ripple + 0.05 * unknown));
    set.reach = reach < set.reach ? reach : set.reach;
    set.start_share = larger(set.start_share, (Interval(with_room(start)) / Interval(radius)).upper());
    // Once nothing is known of one tube, nothing is known.
    const bool is_known = rigor::is_finite(mean) && (is_first || rigor::is_finite(set.bias));
    set.bias = !is_known ? Interval::empty() : is_first ? mean : hull(set.bias, mean);
    is_first = false;
    if (cells != nullptr) {
      for (const model::TubeErrors::Slice& slice : settled.slices) {
        cells->push_back({slice.low, slice.high, slice.mean, slice.ripple, reach});
      }
    }
  }
  return set;
}

/// Over the frequencies, what is true in each of several lists of cells; where all of them say something.
std::vector<ModelCell> worst_of(const std::vector<std::vector<ModelCell>>& lists) {
  std::vector<double> ends;
  for (const std::vector<ModelCell>& list : lists) {
    for (const ModelCell& cell : list) {
      ends.insert(ends.end(), {cell.low, cell.high});
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<ModelCell> all;
  double low = ends.empty() ? 0.0 : ends.front();
  for (const double high : ends) {
    constexpr double kNothing = 1e-9;  // neighbouring cells overlap by so little
    if (!(high - low > kNothing * high)) {
      continue;
    }
    ModelCell worst{low, high, Interval::empty(), 0.0, INFINITY};
    bool is_covered = true;
    bool is_known = true;
    bool is_first = true;
    for (const std::vector<ModelCell>& list : lists) {
      bool is_here = false;
      for (const ModelCell& cell : list) {
        // A list whose cells end inside, up to the overlap, counts with both.
        if (cell.low < high - 0.5 * kNothing * high && cell.high > low + 0.5 * kNothing * high) {
          is_here = true;
          is_known = is_known && rigor::is_finite(cell.bias);
          worst.bias = is_first ? cell.bias : hull(worst.bias, cell.bias);
          worst.ripple = larger(worst.ripple, cell.ripple);
          worst.reach = cell.reach < worst.reach ? cell.reach : worst.reach;
          is_first = false;
        }
      }
      is_covered = is_covered && is_here;
    }
    if (!is_known) {
      worst.bias = Interval::empty();
    }
    if (is_covered) {
      all.push_back(worst);
    }
    low = high;
  }
  return all;
}

/// The same; of several parts of the amplitudes what is true for all of them.
ModelSet conclude(const model::TrackerModel& tracker, TubeSet tubes, const std::vector<Interval>& deviations,
                  std::vector<ModelCell>* cells) {
  if (tubes.amplitudes.size() <= 1) {
    return conclude_of_tubes(tracker, std::move(tubes), deviations, cells);
  }
  ModelSet worst;
  bool is_first = true;
  std::vector<std::vector<ModelCell>> of_parts;
  for (TubeSet& part : model::sets_of_amplitudes(tubes)) {
    std::vector<ModelCell>* of_part = cells != nullptr ? &of_parts.emplace_back() : nullptr;
    ModelSet set = conclude_of_tubes(tracker, std::move(part), deviations, of_part);
    if (is_first) {
      worst = std::move(set);
      is_first = false;
      continue;
    }
    worst.frequency_error = larger(worst.frequency_error, set.frequency_error);
    worst.half_distance = std::min(worst.half_distance, set.half_distance);
    worst.settled_error = larger(worst.settled_error, set.settled_error);
    worst.ripple = larger(worst.ripple, set.ripple);
    worst.start_share = larger(worst.start_share, set.start_share);
    worst.reach = set.reach < worst.reach ? set.reach : worst.reach;
    const bool is_known = rigor::is_finite(worst.bias) && rigor::is_finite(set.bias);
    worst.bias = is_known ? hull(worst.bias, set.bias) : Interval::empty();
  }
  if (cells != nullptr) {
    *cells = worst_of(of_parts);
  }
  worst.tubes = std::move(tubes);
  return worst;
}

/// The same set, begun at a lower level: a smaller tube, and the same proof.
TubeSet from_level(TubeSet set, std::size_t level) {
  const auto drop = [&](std::vector<double>& factors) {
    // Of a single level, what the last pair shrinks by.
    const std::size_t kept = std::max<std::size_t>(factors.size(), level + 1) - level;
    factors.erase(factors.begin(),
                  factors.end() - static_cast<std::ptrdiff_t>(std::min(kept, factors.size())));
  };
  for (model::ProvedTube& proved : set.tubes) {
    proved.levels.erase(proved.levels.begin(), proved.levels.begin() + static_cast<std::ptrdiff_t>(level));
    drop(proved.shrinking);
  }
  drop(set.crossing);
  for (model::AmplitudePart& part : set.amplitudes) {
    drop(part.crossing);
  }
  return set;
}

/// The set that decides a requirement on the frequency error: begun at the first level that keeps it, where
/// the assumed starts are still inside; as it is when there is none.
ModelSet meeting(const model::TrackerModel& tracker, ModelSet set, const std::vector<Interval>& deviations,
                 const Number& required) {
  std::size_t most = set.tubes.tubes.empty() ? 0 : SIZE_MAX;
  for (const model::ProvedTube& proved : set.tubes.tubes) {
    most = std::min(most, proved.levels.size());
  }
  const rigor::UpwardRounding upward;
  for (std::size_t level = 1; level < most; ++level) {
    if (rigor::certainly_less(Interval(set.frequency_error), required.value)) {
      break;
    }
    ModelSet lower = conclude(tracker, from_level(set.tubes, level), deviations, nullptr);
    if (!(lower.start_share <= 1.0)) {
      break;
    }
    if (rigor::certainly_less(Interval(lower.frequency_error), required.value)) {
      return lower;
    }
  }
  return set;
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
  // Of a constant one that is known to be in a range nothing is proved but part by part.
  tracker.amplitude_varies = !assume.one_amplitude;
  tracker.filter = model.filter ? &*model.filter : nullptr;
  return tracker;
}

bool bounds_covariance(const Model& model, const ModelTables& tables) {
  const ModelAssumptions& assume = tables.assume;
  const bool names_covariance =
      std::any_of(assume.start_within.begin(), assume.start_within.end(),
                  [](const NamedText& entry) { return entry.name.text.starts_with("P."); });
  // With another F than the derivative no tube was found for Zarchan's third filter in this way, and one in
  // the other; with more states than these the other is out of reach.
  constexpr int kMostWithCovariance = 3;
  const bool prefers_states =
      model.filter && model.filter->has_given_jacobian && model.filter->states <= kMostWithCovariance;
  return model.filter && !names_covariance && !prefers_states;
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

SearchedBand searched_band(const Interval& band, std::size_t channels) {
  SearchedBand searched{band.lower(), band.upper(), {}};
  constexpr double kRoundedPi = 3.142;  // somebody may write pi with a few digits
  if (!(band.lower() >= 0.0) || !(band.upper() <= kRoundedPi) || !(band.lower() < band.upper())) {
    return {};
  }
  const bool is_one = channels == 1;
  const double margin = (band.upper() - band.lower()) / 256.0;
  if (!(band.lower() > 0.0)) {
    searched.low = margin;
    searched.out_of_reach.push_back(fmt::format(
        "out of reach between 0 and {:.4g} rad/sample: {}", margin,
        is_one ? "at 0 the samples are constant, and one channel does not tell the amplitude from "
                 "the phase: there is no steady state to settle in"
               : "at 0 the phase stands still, and the search for a steady state needs one that "
                 "turns"));
  }
  if (!rigor::certainly_less(Interval(band.upper()), rigor::pi())) {
    searched.high = rigor::pi().lower() - margin;
    searched.out_of_reach.push_back(fmt::format(
        "out of reach above {:.6g} rad/sample: {}", searched.high,
        is_one ? "at pi, half the sample rate, the samples of one channel only change their sign, "
                 "and do not tell the amplitude from the phase: there is no steady state to "
                 "settle in"
               : "frequencies above pi, half the sample rate, cannot be told from lower ones"));
  }
  return searched;
}

Interval slew_of(const ModelAssumptions& assume) {
  if (!assume.slew_in_hertz_per_second) {
    return assume.slew.value;
  }
  const Interval rate = assume.sample_rate.value().value;
  return Interval(2.0) * rigor::pi() * assume.slew.value / (rate * rate);
}

double settled_error_of(const ModelSets& sets) {
  return sets.long_run ? sets.long_run->settled_error : sets.assumed ? sets.assumed->settled_error : INFINITY;
}

const ModelSets& model_sets(const Certificate& certificate) {
  return std::any_cast<const ModelSets&>(certificate.particulars);
}

ModelSets certify_sets(const ModelTables& tables, Extent extent, const search::Deadline& deadline,
                       const CertifyProgress& progress, bool by_structure) {
  const rigor::UpwardRounding upward;
  const ModelAssumptions& assume = tables.assume;
  const Requirements& require = tables.require.sets;
  const Model model = make_model(tables.model, assume.signal);
  const model::TrackerModel tracker = proved_model(model, assume);
  model::TrackedTone tone = proposed_tone(model, assume);
  tone.filter = by_structure && bounds_covariance(model, tables) ? tracker.filter : nullptr;
  const std::vector<Interval> deviations = start_deviations(model, tables.model, assume.start_within);
  const Interval band = band_of(assume);
  ModelSets sets;
  sets.bounds_covariance = tone.filter != nullptr;
  sets.starts.frequency_error = sets.starts.settled_error = INFINITY;
  constexpr std::size_t kMostStates = 16;
  if (!sets.bounds_covariance && model.states.size() > kMostStates) {
    sets.objection = fmt::format("{} states are too many: at most {}", model.states.size(), kMostStates);
    return sets;
  }
  const SearchedBand searched = searched_band(band, model.samples.size());
  if (!(searched.low < searched.high)) {
    sets.objection = "the assumed frequencies are no band of some width from 0 to pi rad/sample";
    return sets;
  }
  Eigen::VectorXd sizes;
  if (!assume.start_within.empty()) {
    sizes.resize(static_cast<Eigen::Index>(deviations.size()));
    for (std::size_t i = 0; i < deviations.size(); ++i) {
      sizes[static_cast<Eigen::Index>(i)] = deviations[i].upper();
    }
  }
  const double noise = assume.gaussian ? 0.0 : assume.noise.value.upper();
  const double slew = slew_of(assume).upper();
  const bool is_everything = extent == Extent::everything;
  std::optional<AmplitudeParts> parts;
  if (is_constant_in_range(assume)) {
    parts.emplace(model, tracker, tone.filter, searched, deadline);
  }
  // Parts are narrow: shapes are those of one amplitude (and see AmplitudeParts::prove).
  const bool is_disturbed = tracker.amplitude_varies && !parts;
  std::vector<model::SetTask> tasks(1);
  // An amplitude that varies is a disturbance, without noise, too.
  tasks.front() = {.name = "starts",
                   .objective = is_disturbed ? ShapeObjective::largest_noise : ShapeObjective::largest_starts,
                   .with_curve = true,
                   .deviations = sizes};
  if (noise > 0.0 || slew > 0.0) {
    tasks.push_back({.name = "assumed",
                     .objective = noise > 0.0 ? ShapeObjective::largest_noise : ShapeObjective::largest_slew,
                     .noise = noise,
                     .slew = slew,
                     .deviations = sizes});
  }
  if (is_everything || require.largest_noise_at_least) {
    tasks.push_back({.name = "noise",
                     .objective = ShapeObjective::largest_noise,
                     .largest_noise = true,
                     .deviations = {}});
  }
  if (slew > 0.0 || require.largest_slew_at_least) {
    // A shape for the slew alone leaves no room for amplitudes; that of a filter is for both.
    const bool is_alone = !is_disturbed || tone.filter != nullptr;
    tasks.push_back({.name = "slew",
                     .objective = is_alone ? ShapeObjective::largest_slew : ShapeObjective::largest_noise,
                     .largest_slew = true,
                     .deviations = {}});
  }
  if (const auto& required = require.frequency_error_below) {
    tasks[noise > 0.0 || slew > 0.0 ? 1 : 0].largest_error = required->value.lower();
  }
  if (deadline.is_set() && tasks.size() > 1 && tasks[1].name == "assumed") {
    std::swap(tasks[0], tasks[1]);  // what is required rests on it
  }
  const double locks = !assume.gaussian ? 0.0 : is_everything ? 2.0 : 1.0;
  const bool follows_start =
      !assume.start_exactly.empty() && (is_everything || tables.require.captured_within);
  const double captures = follows_start ? 1.0 : 0.0;
  const double all = static_cast<double>(tasks.size()) + locks + captures;
  double done = 0.0;
  const auto tell = [&](double share) {
    if (progress) {
      progress({(done + share) / all, 0.0, 0});
    }
  };
  if (assume.gaussian && searched.out_of_reach.empty()) {
    const LockSearch search{&tables, &model, &tone, &tracker, searched.low, searched.high, deadline};
    sets.gaussian = certify_model_lock(search, false, tell);
    if (is_everything) {
      done += 1.0;
      sets.lowest_snr = certify_model_lock(search, true, tell);
    }
    done = locks;
  }
  const auto prove = [&](const model::SetTask& task) {
    TubeSet tubes = parts ? parts->prove(task, tell) : prove_task(tone, tracker, searched, task, tell);
    tubes.is_complete = tubes.is_complete && searched.out_of_reach.empty();
    tubes.reasons.insert(tubes.reasons.begin(), searched.out_of_reach.begin(), searched.out_of_reach.end());
    return tubes;
  };
  for (model::SetTask& task : tasks) {
    task.deadline = deadline;
    task.of_each_cell = is_everything;
    if (sets.assumed && sets.assumed->is_proved()) {
      task.known_noise = task.largest_noise ? sets.assumed->tubes.noise : 0.0;
      task.known_slew = task.largest_slew ? sets.assumed->tubes.slew : 0.0;
    }
    const bool is_first = task.name == "starts";
    ModelSet set = conclude(tracker, prove(task), deviations, is_first ? &sets.cells : nullptr);
    if (const auto& required = require.frequency_error_below; required && task.name == "assumed") {
      // A set for more does it for less: for noise and slew that do not depend on the assumed ones.
      constexpr int kSteps = 2;
      const auto meets = [&](const ModelSet& one) {
        return one.is_proved() && one.start_share <= 1.0 &&
               rigor::certainly_less(Interval(meeting(tracker, one, deviations, *required).frequency_error),
                                     required->value);
      };
      for (int steps = 0; steps < kSteps && !meets(set) && !deadline.is_over(); ++steps) {
        model::SetTask louder = task;
        louder.noise = sets::raised(Interval(noise), steps).upper();
        louder.slew = sets::raised(Interval(slew), steps).upper();
        if (ModelSet other = conclude(tracker, prove(louder), deviations, nullptr); meets(other)) {
          set = std::move(other);
        }
      }
    }
    if (is_first) {
      sets.starts = std::move(set);
    } else {
      (task.name == "assumed" ? sets.assumed
       : task.name == "noise" ? sets.noise
                              : sets.slew) = std::move(set);
    }
    done += 1.0;
  }
  if (sets.bounds_covariance && sets.assumed && !(slew > 0.0)) {
    auto tubes = parts ? parts->prove_long_run(sets.assumed->tubes)
                       : model::prove_long_run_set(tone, tracker, sets.assumed->tubes, deadline);
    if (tubes) {
      ModelSet inner = conclude(tracker, *std::move(tubes), deviations, nullptr);
      if (inner.settled_error < sets.assumed->settled_error) {
        sets.long_run = std::move(inner);
      }
    }
  }
  if (const auto& required = require.frequency_error_below) {
    ModelSet& deciding = sets.assumed ? *sets.assumed : sets.starts;
    deciding = meeting(tracker, std::move(deciding), deviations, *required);
  }
  if (follows_start) {
    const ModelSet& deciding = sets.assumed ? *sets.assumed : sets.starts;
    sets.capture = capture_of(model, tracker, exact_start(model, tables.model, assume.start_exactly),
                              deciding.tubes, noise, deciding.frequency_error, deadline, tell);
  }
  if (is_everything && sets.assumed && !sets.assumed->tubes.tubes.empty()) {
    sets.linear = parts ? parts->linear_over(sets.assumed->tubes) : linear_over(tone, sets.assumed->tubes);
  }
  return sets;
}

}  // namespace veritrack::certificates
