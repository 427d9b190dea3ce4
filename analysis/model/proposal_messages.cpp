// The words of proposals that failed.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/model/frequency_cells.hpp"
#include "analysis/model/tube_proposal.hpp"

namespace veritrack::model {

namespace {

/// The states in which a mode mainly is, by their numbers.
std::string states_in(const Eigen::VectorXd& mode) {
  constexpr double kShare = 0.1;
  std::string text;
  for (Eigen::Index i = 0; i < mode.size(); ++i) {
    if (std::fabs(mode[i]) >= kShare) {
      text += fmt::format("{}{:.2g} of state {}", text.empty() ? "" : ", ", mode[i], i);
    }
  }
  return text;
}

}  // namespace

std::string reason_of(const SteadyState& steady) {
  switch (steady.outcome) {
    case SteadyStateOutcome::settled:
      return "";
    case SteadyStateOutcome::diverges:
      return fmt::format(
          "no steady state: the simulation diverges or is undefined within {} samples, at {:.6g} "
          "rad/sample",
          steady.samples, steady.frequency);
    case SteadyStateOutcome::still_drifts:
      return fmt::format(
          "no steady state: after {} samples state {} at phase 0 still moves by {:.3g} in {} samples, at "
          "{:.6g} "
          "rad/sample",
          steady.samples, steady.slowest_state, std::fabs(steady.drift[steady.slowest_state]), steady.period,
          steady.frequency);
    case SteadyStateOutcome::repeats_later:
      return fmt::format(
          "no steady state: the tracker settles on a curve of period {} in the phase, at {:.6g} rad/sample",
          steady.repetition, steady.frequency);
    case SteadyStateOutcome::locked_elsewhere:
      return fmt::format(
          "the tracker settles on {:.6g} rad/sample when the tone has {:.6g}: it has locked to something "
          "else",
          steady.mean_frequency, steady.frequency);
    case SteadyStateOutcome::not_exponentially_stable:
      return fmt::format(
          "not exponentially stable: errors change by a factor {:.6f} per sample, at {:.6g} "
          "rad/sample, in the mode {}",
          steady.rate, steady.frequency, states_in(steady.mode));
  }
  return "";
}

std::string reason_of(const TubeProposal& proposal) {
  switch (proposal.outcome) {
    case TubeOutcome::proposed:
      return "";
    case TubeOutcome::no_steady_state:
      return reason_of(proposal.steady_state);
    case TubeOutcome::no_curve:
      return "no steady state: the simulation settles in the middle of the cell, but not on a smooth curve "
             "over it";
    case TubeOutcome::no_shape:
      return fmt::format(
          "no tube found around the steady state, where errors change by a factor {:.6f} per sample",
          proposal.steady_state.rate);
    case TubeOutcome::cell_too_wide:
      return fmt::format(
          "the steady state changes too much over the cell: a polynomial in the frequency is off by {:.2g} "
          "rad/sample, and costs {:.0f} % of the tube, whose size varies by {:.0f} %",
          proposal.curve_error, 100.0 * proposal.loss, 100.0 * proposal.variation);
  }
  return "";
}

std::vector<std::string> reasons_of(const BandProposal& band) {
  std::vector<std::string> reasons;
  for (std::size_t first = 0; first < band.cells.size();) {
    const TubeProposal& cell = band.cells[first];
    std::size_t end = first + 1;
    while (end < band.cells.size() && band.cells[end].outcome == cell.outcome &&
           band.cells[end].steady_state.outcome == cell.steady_state.outcome) {
      ++end;
    }
    if (cell.outcome != TubeOutcome::proposed) {
      const TubeProposal& last = band.cells[end - 1];
      reasons.push_back(fmt::format("{}, between {:.6g} and {:.6g} rad/sample", reason_of(cell),
                                    cell.frequency - cell.half_width, last.frequency + last.half_width));
    }
    first = end;
  }
  return reasons;
}

}  // namespace veritrack::model
