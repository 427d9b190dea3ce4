// The words of proposals that failed.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/model/tube/frequency_cells.hpp"
#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

/// A number with `count` significant digits.
std::string digits(double value, int count) {
  const rigor::NearestRounding nearest;
  std::ostringstream text;
  text.precision(count);
  text << value;
  return text.str();
}

std::string at_frequency(const SteadyState& steady) {
  return ", at " + digits(steady.frequency, 6) + " rad/sample";
}

std::string name_of(const SteadyState& steady, Eigen::Index state) {
  const auto number = static_cast<std::size_t>(state);
  return number < steady.names.size() ? steady.names[number] : "state " + std::to_string(state);
}

/// The states in which a mode mainly is.
std::string states_in(const SteadyState& steady) {
  constexpr double kShare = 0.1;
  std::string text;
  for (Eigen::Index i = 0; i < steady.mode.size(); ++i) {
    if (std::fabs(steady.mode[i]) >= kShare) {
      text += (text.empty() ? "" : ", ") + digits(steady.mode[i], 2) + " of " + name_of(steady, i);
    }
  }
  return text;
}

/// A further remark on a state that does not stop: that it turns, or how long it would take.
std::string hint_to_drift(const SteadyState& steady) {
  const double turned = steady.frequency * steady.period;  // of the phase, rad
  const double ratio = steady.drift[steady.slowest_state] / turned;
  const double whole = std::round(ratio);
  constexpr double kClose = 1e-3;
  constexpr double kMost = 16.0;
  if (whole != 0.0 && std::fabs(whole) <= kMost && std::fabs(ratio - whole) < kClose) {
    return ": it turns " + (whole == 1.0 ? std::string("once") : digits(whole, 3) + " times") +
           " while the phase turns once; if it is an angle, name it in angles";
  }
  if (steady.rate > 0.0 && steady.rate < 1.0) {
    constexpr double kDecades = 9.0;
    return ". Near there each sample multiplies errors by " + digits(steady.rate, 7) +
           ", so that settling may take " +
           digits(std::ceil(kDecades * std::numbers::ln10 / (1.0 - steady.rate)), 2) +
           " samples: give a start that is nearer, or write a slow loop at a lower sample rate";
  }
  return "";
}

/// The frequency to which a tracker that settles elsewhere has locked.
std::string lock_of(const SteadyState& steady) {
  constexpr double kClose = 2e-3;
  constexpr int kMost = 16;
  const double ratio = steady.mean_frequency / steady.frequency;
  for (int k = 2; k <= kMost; ++k) {
    if (std::fabs(ratio / k - 1.0) < kClose) {
      return "it has locked to harmonic number " + std::to_string(k);
    }
    if (std::fabs(ratio * k - 1.0) < kClose) {
      return "it has locked to the tone's frequency divided by " + std::to_string(k);
    }
  }
  return std::fabs(ratio + 1.0) < kClose ? "it has locked to the tone with the sign of the frequency reversed"
                                         : "it has locked to something else";
}

/// For errors that do not grow, but do not decay by a factor a sample either.
std::string decay_of(const SteadyState& steady) {
  return steady.rate < 1.0 ? ", which is 1 as far as " + std::to_string(steady.samples) +
                                 " samples can tell: if errors decay, it is not exponentially"
                           : std::string();
}

}  // namespace

std::string reason_of(const SteadyState& steady) {
  switch (steady.outcome) {
    case SteadyStateOutcome::settled:
      return "";
    case SteadyStateOutcome::diverges:
      return "no steady state: the simulation diverges or is undefined within " +
             std::to_string(steady.samples) + " samples" + at_frequency(steady) +
             (steady.undefined.empty() ? "" : ": " + steady.undefined);
    case SteadyStateOutcome::still_drifts:
      return "no steady state: after " + std::to_string(steady.samples) + " samples " +
             name_of(steady, steady.slowest_state) + " at phase 0 still moves by " +
             digits(std::fabs(steady.drift[steady.slowest_state]), 3) + " in " +
             std::to_string(steady.period) + " samples" + at_frequency(steady) + hint_to_drift(steady);
    case SteadyStateOutcome::repeats_later:
      return "no steady state: the tracker settles on a curve of period " +
             std::to_string(steady.repetition) + " in the phase" + at_frequency(steady);
    case SteadyStateOutcome::locked_elsewhere:
      return "the tracker settles on " + digits(steady.mean_frequency, 6) + " rad/sample when the tone has " +
             digits(steady.frequency, 6) + ": " + lock_of(steady);
    case SteadyStateOutcome::not_exponentially_stable:
      return "not exponentially stable: each sample multiplies errors by " + digits(steady.rate, 7) +
             at_frequency(steady) +
             (steady.neutral ? ": " + words_of(*steady.neutral, steady.names)
                             : ", in the mode " + states_in(steady) + decay_of(steady));
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
             "over "
             "it";
    case TubeOutcome::no_shape:
      return "no tube found around the steady state, where each sample multiplies errors by " +
             digits(proposal.steady_state.rate, 7);
    case TubeOutcome::no_common_shape:
      return "no tube found that contracts in the whole cell; at its middle each sample multiplies errors "
             "by " +
             digits(proposal.steady_state.rate, 7);
    case TubeOutcome::time_limit:
      return kTimeLimit;
    case TubeOutcome::cell_too_wide:
      if (proposal.loss < 0.01 * proposal.variation) {
        return "the size of the tube changes too much over the cell: by " +
               digits(100.0 * proposal.variation, 2) + " %";
      }
      return "the steady state changes too much over the cell: a polynomial in the frequency is off by " +
             digits(proposal.curve_error, 2) + " rad/sample and costs " + digits(100.0 * proposal.loss, 2) +
             " % of the tube, whose size varies by " + digits(100.0 * proposal.variation, 2) + " %";
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
      std::string reason = reason_of(cell);
      reason += ", between " + digits(cell.frequency - cell.half_width, 6) + " and " +
                digits(last.frequency + last.half_width, 6) + " rad/sample";
      reasons.push_back(reason);  // NOLINT(performance-inefficient-vector-operation): few, of unknown number
    }
    first = end;
  }
  return reasons;
}

}  // namespace veritrack::model
