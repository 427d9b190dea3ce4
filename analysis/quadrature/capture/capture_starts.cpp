#include "analysis/quadrature/capture/capture_starts.hpp"

#include <algorithm>
#include <utility>

#include "analysis/quadrature/capture/capture_basin.hpp"
#include "analysis/quadrature/capture/capture_derivation.hpp"
#include "analysis/quadrature/capture/capture_target.hpp"
#include "analysis/quadrature/start_covariance.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

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

StartBox assumed_starts(const sets::ContractionQuestion& question) {
  return {rigor::symmetric(question.initial_amplitude_error.upper()),
          rigor::symmetric(question.initial_phase_error.upper()),
          rigor::symmetric(question.initial_frequency_error.upper())};
}

std::optional<CaptureProblem> capture_problem(const sets::ContractionQuestion& asked) {
  const sets::ContractionQuestion question = with_start_covariance(asked, 0.0);
  CaptureProblem problem;
  problem.design = question.design;
  problem.noise = question.noise.upper();
  problem.slew = question.slew.upper();
  problem.signal = {question.amplitude, question.largest_frequency};
  if (!question.start_covariance) {
    return std::nullopt;
  }
  problem.initial_covariance = question.start_covariance->enclosure();
  return problem;
}

StartCapture capture_starts(const sets::ContractionQuestion& question, const CertifiedSet& set,
                            const std::string& id, std::size_t most_cells,
                            const std::function<bool(const RegionProgress&)>& progress) {
  const rigor::UpwardRounding upward;
  StartCapture capture;
  theorems::Derivation& derivation = capture.derivation;
  derivation.id = id;
  derivation.title = "Capture of every assumed start by the certified set";
  derivation.conditions = {set_tolerates_assumptions(question, set)};
  const bool can_begin = derivation.conditions[0].verdict == Verdict::proved &&
                         question.design.without_leak() && sets::is_well_posed(question);
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
    if (derivation.conditions.back().verdict == Verdict::undecided && question.start_covariance &&
        !question.start_covariance->range.empty()) {
      derivation.conditions.back().reason +=
          " The starts have " + question.start_covariance->range + "; a narrower range may help.";
    }
  } else {
    derivation.conditions.push_back(
        {"starts-captured", "X(k_c) \\in \\Omega \\text{ from every assumed start}", Verdict::undecided,
         Interval::empty(), Interval::empty(),
         can_begin ? "the question names no covariance at the start." : "no start was followed."});
  }
  derivation.verdict =
      rigor::conjunction({derivation.conditions[0].verdict, derivation.conditions[1].verdict});
  if (derivation.conditions[0].verdict == Verdict::proved) {
    derivation.evidence = capture_evidence(question, capture.region);
  }
  CaptureBounds tube;
  if (derivation.verdict == Verdict::proved) {
    tube = capture_tube(question, set, capture.region);
  }
  capture.result = capture_result(derivation.verdict, set, capture.region, tube);
  capture.result.conditions = derivation.conditions;
  derivation.quantities = capture_quantities(capture.result, capture.region);
  capture.frequency_errors = std::move(tube.frequency_errors);
  return capture;
}

}  // namespace veritrack::quadrature
