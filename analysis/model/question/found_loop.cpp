#include "analysis/model/question/found_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "analysis/linear/worst_case_gains.hpp"
#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/steady_proposal.hpp"
#include "analysis/model/tube/false_lock.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

/// States near which a steady state may be: that of the design, the same with every angle half a turn further
/// (a detector that multiplies is at rest there, too), and one to which a simulation comes.
std::vector<StartState> places_to_look(const SetQuestion& question) {
  constexpr int kSamples = 20'000;
  const std::vector<bool>& is_angle = question.tracker.recursion->is_angle;
  const TrackedTone& tone = question.tone;
  const auto turned = [start = tone.start, is_angle](double omega) {
    std::vector<double> state = start(omega);
    for (std::size_t i = 0; i < state.size(); ++i) {
      state[i] += is_angle[i] ? std::numbers::pi : 0.0;
    }
    return state;
  };
  const auto simulated = [&tone, is_angle](double omega) {
    const rigor::NearestRounding nearest;
    const std::vector<double> start = tone.start(omega);
    Eigen::VectorXd state =
        Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
    for (int k = 1; k <= kSamples; ++k) {
      const double phase = std::remainder(k * omega, 2.0 * std::numbers::pi);
      state = tone.step.next(state, samples_of(tone.signal, tone.amplitude, phase));
    }
    std::vector<double> found(state.begin(), state.end());
    for (std::size_t i = 0; i < found.size(); ++i) {
      found[i] = is_angle[i] ? std::remainder(found[i] - kSamples * omega, 2.0 * std::numbers::pi) : found[i];
    }
    return found;
  };
  return {tone.start, turned, simulated};
}

/// The first steady state about which errors decay, or else the first of all; none is as far from the true
/// frequency as a false lock may be. Throws NoFrame.
std::optional<FoundLoop> find_loop(const SetQuestion& question, const std::optional<ProposedVector>& vector) {
  const Interval& band = question.whole_band;
  // At one frequency, a little more shows how the steady state depends on it.
  const double width = std::max(band.upper() - band.lower(), 1e-3);
  const double half_distance = half_distance_to_false_lock(question.tracker, band);
  std::optional<FoundLoop> first;
  std::string objection;
  for (const StartState& start : places_to_look(question)) {
    try {
      const auto steady =
          proposed_steady_state(question.tracker, start, band.lower(), band.lower() + width, vector);
      if (!steady) {
        continue;
      }
      FoundLoop found{*steady, loop_network(question.tracker, *steady, band)};
      if (!(rigor::magnitude(found.network.bias) < half_distance)) {
        throw NoFrame(
            fmt::format("the steady state that is found is off by {:.3g} rad/sample at some frequency "
                        "of the band: no lock to the signal",
                        rigor::magnitude(found.network.bias)));
      }
      if (linear::proposed_horizon(found.network.a, 1, 0.5, SIZE_MAX)) {
        return found;
      }
      if (!first) {
        first = std::move(found);
      }
    } catch (const NoFrame& reason) {
      objection = objection.empty() ? reason.what() : objection;
    }
  }
  if (!first && !objection.empty()) {
    throw NoFrame(objection);
  }
  return first;
}

/// With two states that are the parts of a vector; empty where no pair is one.
std::optional<FoundLoop> find_loop_with_vector(const SetQuestion& question, bool has_length) {
  const auto is_off = [&](std::size_t state) {
    return question.assumes_start && question.deviations.at(state).upper() > 0.0;
  };
  for (const ProposedVector& vector : possible_vectors(question.tracker)) {
    if (vector.has_length != has_length || is_off(vector.real) || is_off(vector.imaginary)) {
      continue;
    }
    try {
      if (std::optional<FoundLoop> found = find_loop(question, vector)) {
        return found;
      }
    } catch (const NoFrame&) {
      continue;
    }
  }
  return std::nullopt;
}

}  // namespace

// Where a direction alone matters, as one angle it is as good as linear; as two numbers it is not.
std::optional<FoundLoop> find_loop(const SetQuestion& question) {
  if (std::optional<FoundLoop> found = find_loop_with_vector(question, false)) {
    return found;
  }
  try {
    return find_loop(question, std::nullopt);
  } catch (const NoFrame&) {
    if (std::optional<FoundLoop> found = find_loop_with_vector(question, true)) {
      return found;
    }
    throw;  // what is said of the first attempt is of more use
  }
}

}  // namespace veritrack::model
