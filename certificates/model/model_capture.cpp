#include "certificates/model/model_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace veritrack::certificates {

namespace {

/// The length of simulations.
constexpr std::size_t kMostSimulatedSamples = 20'000;
/// Parts of a turn to begin with.
constexpr int kFirstPhases = 16;
constexpr std::size_t kFewFollowedCells = 2'000;
constexpr std::size_t kMostFollowedCells = 20'000;  // of a tube

/// An angle that turns with the signal, by its name; empty where there is none. Started at one value at every
/// phase, its distance from the curve changes by a whole turn while the phase does, and is in a set at all
/// phases only if it jumps, which it does not.
std::string turning_angle(const Model& model, const model::TubeSet& tubes) {
  for (const model::ProvedTube& proved : tubes.tubes) {
    for (std::size_t i = 0; i < proved.tube.turns.size(); ++i) {
      if (proved.tube.turns[i] != 0) {
        return model.states[i];
      }
    }
  }
  return {};
}

/// Parts of the frequencies of a tube in which the phase differs little after this many samples.
int parts_of_frequencies(const model::TubeSet& tubes, std::size_t samples) {
  constexpr double kMostRadians = 0.4;
  constexpr double kMostParts = 1024.0;
  double widest = 0.0;
  for (const model::ProvedTube& proved : tubes.tubes) {
    widest = std::max(widest, proved.tube.half_width);
  }
  const double parts = static_cast<double>(samples) * widest / kMostRadians;
  int power = 1;
  while (power < std::min(parts, kMostParts)) {
    power *= 2;
  }
  return power;
}

}  // namespace

ModelCapture capture_of(const Model& model, const model::TrackerModel& tracker,
                        const std::vector<rigor::Interval>& start, const model::TubeSet& tubes, double noise,
                        double set_error, const search::Deadline& deadline,
                        const std::function<void(double)>& progress) {
  ModelCapture capture;
  if (tubes.tubes.empty()) {
    capture.reason = "there is no set that it could come into";
    return capture;
  }
  if (const std::string angle = turning_angle(model, tubes); !angle.empty()) {
    capture.reason = fmt::format(
        "the angle {} turns with the signal: from one value at all phases it settles by another number of "
        "whole turns at some than at others, and at those between them it is not in the set after any number "
        "of samples",
        angle);
    return capture;
  }
  std::vector<model::TubeOfLevel> targets;
  for (const model::ProvedTube& proved : tubes.tubes) {
    targets.push_back({&proved.tube, proved.levels.front()});
  }
  const std::size_t simulated = model::simulated_capture(tracker, targets, start, kMostSimulatedSamples);
  if (simulated >= kMostSimulatedSamples) {
    capture.reason =
        fmt::format("simulated at some phases and frequencies, it is not in the set after {} samples",
                    kMostSimulatedSamples);
    return capture;
  }
  capture.phases = kFirstPhases;
  capture.frequencies = parts_of_frequencies(tubes, simulated);
  // Wide cells arrive late: first, cells are halved that do not arrive soon after simulations do.
  model::StartCapture found;
  for (const bool is_soon : {true, false}) {
    const model::StartQuestion question{start, noise,
                                        is_soon ? simulated + simulated / 4 + 8 : 2 * simulated + 64};
    const model::VerificationBudget budget{capture.phases, capture.frequencies,
                                           is_soon ? kFewFollowedCells : kMostFollowedCells, deadline};
    found = model::prove_start_captured(tracker, targets, question, budget, progress);
    if (found.verdict == rigor::Verdict::proved) {
      break;
    }
  }
  if (found.verdict != rigor::Verdict::proved) {
    capture.reason = found.reason;
    return capture;
  }
  // A few more, for a checker whose bounds are cruder.
  capture.is_proved = true;
  capture.samples = static_cast<int>(found.samples + std::max<std::size_t>(4, found.samples / 16));
  const rigor::Interval& error = found.frequency_error;
  const double largest = rigor::is_finite(error) && std::isfinite(set_error)
                             ? std::max({-error.lower(), error.upper(), set_error})
                             : INFINITY;
  const double with_room = (rigor::Interval(largest) * rigor::Interval(1.001)).upper();
  capture.frequency_error = std::isfinite(largest) ? with_room : INFINITY;
  return capture;
}

}  // namespace veritrack::certificates
