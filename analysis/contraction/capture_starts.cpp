#include "analysis/contraction/capture_starts.hpp"

#include <algorithm>
#include <utility>

#include "analysis/contraction/capture_basin.hpp"
#include "analysis/contraction/capture_target.hpp"
#include "analysis/contraction/certified_level.hpp"
#include "analysis/contraction/fixed_point_bias.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Direction;
using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;
using theorems::Quantity;

constexpr const char* kSource = "docs/contraction.md";
constexpr std::size_t kCellsNamed = 3;

std::string range(const Interval& x) {
  return "[" + rigor::to_decimal(x.lower(), 4, Direction::down) + ", " +
         rigor::to_decimal(x.upper(), 4, Direction::up) + "]";
}

/// Outward rounded, as a box that failed may be named larger than it is.
std::string named(const StartBox& starts) {
  return "frequency error in " + range(starts.frequency_error) + " rad/sample, phase error in " +
         range(starts.phase_error) + " rad, amplitude error in " + range(starts.amplitude_error);
}

std::size_t count(const Region& region, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(region.cells.begin(), region.cells.end(),
                    [verdict](const RegionCell& cell) { return cell.verdict == verdict; }));
}

/// The number of samples after which every start of the PROVED cells has been captured.
int capture_samples(const Region& region) {
  int samples = 0;
  for (const RegionCell& cell : region.cells) {
    samples = std::max(samples, cell.result.samples);
  }
  return samples;
}

/// The bounds of all cells while they are followed, and those of the set from each cell's capture on.
struct Tube {
  std::vector<double> frequency_errors;
  double ultimate_frequency_error = 0.0;  ///< of the set that captures
  std::optional<int> settling_samples;
};

Tube tube_of(const ContractionQuestion& question, const CertifiedSet& set, const Region& region) {
  constexpr int kLongest = 100000;
  const int last_capture = capture_samples(region);
  std::vector<std::optional<double>> captures(static_cast<std::size_t>(last_capture) + 1);  // their levels
  for (const RegionCell& cell : region.cells) {
    std::optional<double>& level = captures[static_cast<std::size_t>(cell.result.samples)];
    level = std::max(level.value_or(0.0), cell.result.level);
  }
  Tube tube;
  std::optional<CertifiedLevel> captured;
  for (int k = 0; k <= last_capture; ++k) {
    const auto index = static_cast<std::size_t>(k);
    if (captured) {
      captured->step();
    }
    if (const std::optional<double>& level = captures[index]) {
      const CertifiedLevel fresh(set, Interval(*level), question.noise, question.slew);
      captured = captured && captured->above(fresh) ? captured : fresh;
    }
    tube.frequency_errors.push_back(
        std::max(region.frequency_errors.at(index), captured ? captured->frequency_error() : 0.0));
  }
  for (int k = last_capture; captured && captured->can_settle() && k <= kLongest; ++k) {
    if (captured->settled()) {
      tube.settling_samples = k;
      break;
    }
    captured->step();
    tube.frequency_errors.push_back(captured->frequency_error());
  }
  if (captured) {
    tube.frequency_errors.back() =
        std::max(tube.frequency_errors.back(), captured->largest_frequency_error());
    tube.ultimate_frequency_error = captured->ultimate_frequency_error();
  }
  return tube;
}

Quantity quantity(std::string name, std::string symbol, std::string formula, const Interval& value) {
  return {std::move(name), std::move(symbol), std::move(formula), kSource, value, std::nullopt};
}

/// |2 pi k| less what the frequency error may differ from it in the shifted set: what starts of the refuted
/// cells come to exceed, and exceed for ever.
std::optional<Interval> wrong_lock(const CertifiedSet& set, const Region& region) {
  for (const RegionCell& cell : region.cells) {
    if (cell.verdict == Verdict::refuted) {
      const Interval shift = abs(Interval(2.0 * cell.result.turns) * rigor::pi());
      return Interval((shift - error_bounds(set, Interval(set.radius))[2]).lower());
    }
  }
  return std::nullopt;
}

void add_quantities(theorems::Derivation& derivation, const CertifiedSet& set, const Region& region,
                    const Tube& tube) {
  const bool proved = derivation.verdict == Verdict::proved;
  const auto add = [&](const char* name, const char* symbol, const char* formula,
                       const std::optional<Interval>& value, const char* missing) {
    derivation.quantities.push_back(quantity(name, symbol, formula, value.value_or(Interval::empty())));
    if (!value) {
      derivation.quantities.back().not_applicable = missing;
    }
  };
  constexpr const char* kNotAll = "Not every assumed start is proved to be captured.";
  std::optional<Interval> samples;
  std::optional<Interval> bound;
  std::optional<Interval> ultimate;
  std::optional<Interval> settling;
  if (proved) {
    ultimate = Interval(tube.ultimate_frequency_error);
    samples = Interval(static_cast<double>(capture_samples(region)));
    bound = Interval(*std::max_element(tube.frequency_errors.begin(), tube.frequency_errors.end()));
    if (tube.settling_samples) {
      settling = Interval(static_cast<double>(*tube.settling_samples));
    }
  }
  add("capture_samples", "k_c", "\\min \\{k : X(k) \\in \\Omega \\text{ from every assumed start}\\}",
      samples, kNotAll);
  add("frequency_error_bound", "\\sup_k |\\nu(k)|",
      "\\max(\\max_{k \\le k_c} |\\nu(k)|,\\ |T e(k_c)|\\,|e_3' T^{-1}|,\\ \\nu_\\infty)", bound, kNotAll);
  add("ultimate_frequency_error", "\\nu_\\infty", "u\\,|e_3' T^{-1}|", ultimate, kNotAll);
  add("settling_samples", "k_s",
      "k_c + \\min \\{k : \\kappa^{2k} |T e(k_c)|^2 + (1 - \\kappa^{2k}) u^2 \\le 4 u^2\\}", settling,
      proved ? "Without noise and slew the ultimate bound is zero, which is approached but not reached."
             : kNotAll);
  if (const std::optional<Interval> wrong = wrong_lock(set, region)) {
    add("wrong_lock_frequency_error", "\\liminf_k |\\nu(k)|", "2 \\pi |n| - R\\,|e_3' T^{-1}|", wrong, "");
  }
  add("cells", "", "", Interval(static_cast<double>(region.cells.size())), "");
  add("cells_captured", "", "", Interval(static_cast<double>(count(region, Verdict::proved))), "");
}

Condition certified_set(const ContractionQuestion& question, const CertifiedSet& set) {
  const bool bears = certainly_less_equal(question.noise, Interval(set.noise)) &&
                     certainly_less_equal(question.slew, Interval(set.slew));
  return {"certified-set",
          "V \\le V_\\Omega,\\ W \\le W_\\Omega",
          bears ? Verdict::proved : Verdict::undecided,
          Interval::empty(),
          Interval::empty(),
          bears ? "the set in which the starts are to be captured is never left under this noise and slew."
                : "the set was certified for less noise or slew than is assumed."};
}

/// The reason for the verdict on the starts, and the first cells that failed as notes.
Condition starts_captured(const Region& region, std::vector<std::string>& notes) {
  Condition condition{"starts-captured", "X(k_c) \\in \\Omega \\text{ from every assumed start}",
                      verdict(region),   Interval::empty(),
                      Interval::empty(), {}};
  const std::size_t total = region.cells.size();
  if (condition.verdict == Verdict::proved) {
    condition.reason = "every assumed start, in " + std::to_string(total) +
                       " cells, is in the certified set after at most " +
                       std::to_string(capture_samples(region)) + " samples.";
    return condition;
  }
  const auto refuted = std::find_if(region.cells.begin(), region.cells.end(),
                                    [](const RegionCell& cell) { return cell.verdict == Verdict::refuted; });
  if (refuted != region.cells.end()) {
    condition.reason = "witness: a start with " + named(refuted->starts) + " locks " +
                       std::to_string(refuted->result.turns) +
                       " turns per sample off the true frequency, whatever the noise and slew within the "
                       "assumed bounds. Smaller start errors would do.";
    return condition;
  }
  condition.reason = std::to_string(total - count(region, Verdict::proved)) + " of " + std::to_string(total) +
                     " cells of assumed starts could not be followed into the certified set; smaller start "
                     "errors or less noise would do.";
  for (const RegionCell& cell : region.cells) {
    if (cell.verdict != Verdict::proved && notes.size() < kCellsNamed) {
      notes.push_back("Not captured (" + std::string(to_string(cell.result.outcome)) +
                      "): " + named(cell.starts) + ".");
    }
  }
  return condition;
}

/// A single start that locks at a wrong frequency, proposed by simulation, proved by following it; nothing
/// when none was found.
std::optional<RegionCell> wrong_lock_witness(const CaptureProblem& problem, const CaptureTarget& target,
                                             const StartBox& starts) {
  constexpr int kGrid = 24;
  constexpr int kSamples = 400;
  constexpr std::size_t kMostCandidates = 12;
  const SimulatedBasin basin = simulate_basin(problem, starts, kGrid, kGrid, kSamples);
  std::vector<StartBox> candidates;
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      if (!basin.locks_at(i, j)) {
        candidates.push_back({Interval(midpoint(starts.amplitude_error)), Interval(basin.phase(i)),
                              Interval(basin.frequency(j))});
      }
    }
  }
  const std::size_t stride = std::max<std::size_t>(1, candidates.size() / kMostCandidates);
  for (std::size_t i = 0; i < candidates.size(); i += stride) {
    RegionCell cell;
    cell.starts = candidates[i];
    cell.result = follow_starts(problem, target, cell.starts);
    if (cell.result.outcome == CaptureOutcome::locked_elsewhere) {
      cell.verdict = Verdict::refuted;
      return cell;
    }
  }
  return std::nullopt;
}

}  // namespace

StartBox assumed_starts(const ContractionQuestion& question) {
  return {rigor::symmetric(question.initial_amplitude_error.upper()),
          rigor::symmetric(question.initial_phase_error.upper()),
          rigor::symmetric(question.initial_frequency_error.upper())};
}

std::optional<CaptureProblem> capture_problem(const ContractionQuestion& question) {
  CaptureProblem problem;
  problem.design = question.design;
  problem.noise = question.noise.upper();
  problem.slew = question.slew.upper();
  if (question.initial_covariance) {
    problem.initial_covariance = *question.initial_covariance;
    return problem;
  }
  const LockBranch branch = verify_lock_branch(question.design, Interval(0.0));
  if (branch.verdict != Verdict::proved || branch.cells.empty()) {
    return std::nullopt;
  }
  const auto state = branch.cells.front().box();
  problem.initial_covariance << state[3], state[4], state[5],  //
      state[4], state[6], state[7],                            //
      state[5], state[7], state[8];
  return problem;
}

StartCapture capture_starts(const ContractionQuestion& question, const CertifiedSet& set,
                            const std::string& id, std::size_t most_cells,
                            const std::function<bool(const RegionProgress&)>& progress) {
  const rigor::UpwardRounding upward;
  StartCapture capture;
  theorems::Derivation& derivation = capture.derivation;
  derivation.id = id;
  derivation.title = "Capture of every assumed start by the certified set";
  derivation.conditions = {certified_set(question, set)};
  const bool can_begin = derivation.conditions[0].verdict == Verdict::proved &&
                         question.design.epsilon == Interval(0.0) && is_well_posed(question);
  const std::optional<CaptureProblem> problem = can_begin ? capture_problem(question) : std::nullopt;
  if (problem) {
    RegionOptions options;
    options.first_cells = {1, 2, 2};
    options.most_halvings = 10;
    options.most_cells = most_cells;
    options.generation_size = 64;
    const CertifiedSetTarget target(set, true);
    const StartBox starts = assumed_starts(question);
    if (const std::optional<RegionCell> witness = wrong_lock_witness(*problem, target, starts)) {
      capture.region.cells = {*witness};  // one is enough, and spares the long work
    } else {
      capture.region = prove_region(*problem, target, starts, options, progress);
    }
    derivation.conditions.push_back(starts_captured(capture.region, derivation.notes));
  } else {
    derivation.conditions.push_back({"starts-captured",
                                     "X(k_c) \\in \\Omega \\text{ from every assumed start}",
                                     Verdict::undecided, Interval::empty(), Interval::empty(),
                                     can_begin ? "the covariance at the start, the filter's steady state, "
                                                 "could not be enclosed, so that no start could be followed."
                                               : "no start was followed."});
  }
  derivation.verdict =
      rigor::conjunction({derivation.conditions[0].verdict, derivation.conditions[1].verdict});
  Tube tube;
  if (derivation.verdict == Verdict::proved) {
    tube = tube_of(question, set, capture.region);
  }
  add_quantities(derivation, set, capture.region, tube);
  capture.frequency_tube = std::move(tube.frequency_errors);
  return capture;
}

}  // namespace veritrack::contraction
