#include "analysis/model/gain/phase_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "analysis/model/gain/factor_order.hpp"
#include "analysis/model/gain/floquet_proposal.hpp"
#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/upward_parts.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

/// The states of the curve in the middle of the cell, at a phase.
std::vector<double> curve_state(const FloquetCell& cell, double phase) {
  std::vector<std::pair<double, double>> harmonics;
  std::size_t powers = 1;
  for (const PhaseSeries& series : cell.curve.curve) {
    for (const auto& of_harmonic : series.coefficients) {
      powers = std::max(powers, of_harmonic.size());
    }
    for (std::size_t h = harmonics.size(); h < series.coefficients.size(); ++h) {
      const double angle = static_cast<double>(h) * phase;
      harmonics.emplace_back(std::cos(angle), std::sin(angle));
    }
  }
  std::vector<double> in_middle(powers, 0.0);
  in_middle[0] = 1.0;
  std::vector<double> state;
  for (std::size_t i = 0; i < cell.states(); ++i) {
    state.push_back(cell.curve.turns[i] * phase + cell.curve.curve[i].at<double>(harmonics, in_middle));
  }
  return state;
}

/// The registers of the step in the middles of cells of phases: the checker looks at the same places.
std::vector<std::vector<double>> registers_on(const TrackerModel& tracker, const TrackedTone& tone,
                                              const FloquetCell& cell, std::size_t phases) {
  const rigor::NearestRounding nearest;
  std::vector<std::vector<double>> all;
  for (std::size_t g = 0; g < phases; ++g) {
    const double phase = std::numbers::pi * static_cast<double>(2 * g + 1) / static_cast<double>(phases);
    std::vector<double> inputs;
    for (const Interval& constant : tracker.constants) {
      inputs.push_back(rigor::midpoint(constant));
    }
    const std::vector<double> state = curve_state(cell, phase);
    inputs.insert(inputs.end(), state.begin(), state.end());
    const auto samples = samples_of(tone.signal, tone.amplitude, phase + cell.curve.frequency);
    inputs.insert(inputs.end(), samples.begin(), samples.end());
    std::vector<double> registers;
    std::vector<double> results(tracker.recursion->step.results().size());
    tracker.recursion->step.run<double>(std::span<const double>(inputs), registers,
                                        std::span<double>(results));
    all.push_back(std::move(registers));
  }
  return all;
}

/// Cells of equal width.
std::optional<std::vector<FloquetCell>> cells_of(const TrackedTone& tone, const Interval& band,
                                                 std::size_t count, FloquetGauge gauge) {
  std::vector<FloquetCell> cells;
  const double width = (band.upper() - band.lower()) / static_cast<double>(count);
  // Cells overlap a little: their middles are rounded.
  const double room = 1e-9 * width + 1e-12;
  for (std::size_t i = 0; i < count; ++i) {
    const double low = band.lower() + static_cast<double>(i) * width;
    auto cell = propose_floquet_cell(tone, gauge, low - room, low + width + room);
    if (!cell) {
      return std::nullopt;
    }
    cells.push_back(*std::move(cell));
  }
  return cells;
}

constexpr std::size_t kLongestHorizon = 1U << 16U;  // that the checker takes

/// After how many samples the powers of the matrix are negligible; 0: after too many.
std::size_t horizon_of(const FloquetCell& cell) {
  constexpr double kNegligible = 1e-4;
  const std::size_t n = cell.states();
  std::vector<double> power(n * n, 0.0);
  std::vector<double> largest(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    power[i * n + i] = 1.0;
  }
  std::size_t last = 0;
  for (std::size_t k = 0; k < kLongestHorizon; ++k) {
    std::vector<double> next(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double size = std::fabs(power[i * n + j]);
        largest[i * n + j] = std::max(largest[i * n + j], size);
        last = size > kNegligible * largest[i * n + j] && size > 1e-12 ? k : last;
        for (std::size_t m = 0; m < n; ++m) {
          next[i * n + j] += power[i * n + m] * cell.matrix[m * n + j][0];
        }
      }
    }
    power = std::move(next);
  }
  const std::size_t blocks = last / PhaseKernels::kBlocks + 1;
  return last + PhaseKernels::kBlocks < kLongestHorizon ? blocks * PhaseKernels::kBlocks : 0;
}

}  // namespace

std::optional<PhaseGains> PhaseLoop::gains_of(std::size_t part, bool moves) const {
  const std::size_t cell = part / gridding_.parts;
  auto made = phase_part(tracker_, cells_[cell], gridding_, part % gridding_.parts);
  if (!made) {
    return std::nullopt;
  }
  std::vector<PhasePart> alone;
  alone.push_back(*std::move(made));
  constexpr double kSlowest = 1e-300;
  return PhaseGains::make(std::move(alone), gridding_, moves ? kSlowest : 0.0);
}

bool PhaseLoop::find_parts(bool with_slew, Fineness& best) {
  // With more phases as many parts are needed as with fewer.
  const std::size_t fewest_parts =
      std::isfinite(best.missed) ? std::max<std::size_t>(best.gridding.parts / 2, 2) : 2;
  const std::size_t most_parts = (with_slew ? 128 : 64) / cells_.size();
  // What may be missed of the gain: with a slew finer parts take minutes, because all look at each other.
  const double fine = with_slew ? 0.1 : 0.06;
  constexpr double kBetter = 0.9;
  constexpr double kNear = 1.03;
  constexpr double kSteady = 0x1p-19;  // rad/sample: the steady state is known to this, or phases are too few
  double last_gain = INFINITY;
  for (std::size_t parts = fewest_parts; parts <= most_parts; parts *= 2) {
    const PhaseGridding before = std::exchange(gridding_, {gridding_.phases, gridding_.horizon, parts});
    auto gains = gains_of(0, with_slew);
    const auto still = gains ? gains->errors({}) : std::nullopt;
    if (still && !(still->for_ever - still->bias <= kSteady)) {
      gains.reset();
    }
    const double missed = gains ? gains->missed_share() : INFINITY;
    const double gain = gains ? gains->largest_gain() : INFINITY;
    if (!(missed < kBetter * best.missed) && last_gain < kNear * gain && std::isfinite(best.missed)) {
      gridding_ = before;
      break;
    }
    if (gains && missed < best.missed) {
      best = {missed, gridding_};
      probe_ = std::make_shared<PhaseGains>(*std::move(gains));
    }
    if (missed < fine && last_gain < kNear * gain) {
      return true;
    }
    last_gain = gain;
  }
  return false;
}

/// The checker does the same with as many phases.
void PhaseLoop::order_factors() {
  tracker_ = *given_;
  recursion_ = std::make_shared<trackers::Recursion>(*given_->recursion);
  recursion_->step = with_vanishing_factors_last(
      given_->recursion->step, registers_on(*given_, *tone_, cells_.front(), gridding_.phases));
  tracker_.recursion = recursion_.get();
}

std::string PhaseLoop::find_gridding(bool with_slew) {
  gridding_.horizon = 0;
  for (const FloquetCell& each : cells_) {
    const std::size_t horizon = horizon_of(each);
    if (horizon == 0) {
      return fmt::format("its errors take more than {} samples to decay to a ten-thousandth",
                         kLongestHorizon);
    }
    gridding_.horizon = std::max(gridding_.horizon, horizon);
  }
  constexpr std::array<std::size_t, 2> kPhases{128, 256};
  Fineness best;
  for (const std::size_t phases : kPhases) {
    gridding_.phases = phases;
    order_factors();
    // With a slew all parts are kept, and all look at each other.
    if (find_parts(with_slew, best) || with_slew) {
      break;
    }
  }
  if (gridding_.phases != best.gridding.phases) {
    gridding_.phases = best.gridding.phases;
    order_factors();
  }
  gridding_ = best.gridding;
  return probe_ != nullptr ? "" : "256 phases and 64 parts of the band are too coarse for its gains";
}

PhaseLoop PhaseLoop::make(const TrackerModel& tracker, const TrackedTone& tone, const Interval& band,
                          bool with_slew, const search::Deadline& deadline) {
  constexpr std::size_t kMostCells = 8;
  std::string reason = "no basis was found in which its errors have constant coefficients and decay";
  for (std::size_t count = 1; count <= (with_slew ? 1 : kMostCells) && !deadline.is_over(); count *= 2) {
    std::optional<PhaseLoop> best;
    for (const FloquetGauge gauge : {FloquetGauge::by_mode, FloquetGauge::by_state}) {
      auto cells = cells_of(tone, band, count, gauge);
      if (!cells) {
        continue;
      }
      PhaseLoop loop;
      loop.cells_ = *std::move(cells);
      loop.given_ = &tracker;
      loop.tone_ = &tone;
      const std::string objection = loop.find_gridding(with_slew);
      if (!objection.empty()) {
        reason = objection;
      } else if (!best || loop.probe().largest_gain() * (1.0 + loop.probe().missed_share()) <
                              best->probe().largest_gain() * (1.0 + best->probe().missed_share())) {
        best = std::move(loop);
      }
    }
    if (best) {
      return *std::move(best);
    }
  }
  throw NoFrame(reason);
}

bool PhaseLoop::for_each_part(const PartTask& task) const {
  std::atomic<bool> is_done{true};
  model::for_each_part(parts(), [&](std::size_t part) {
    if (!is_done) {
      return;
    }
    const auto gains = gains_of(part);
    if (!gains || !task(part, *gains)) {
      is_done = false;
    }
  });
  return is_done;
}

std::optional<PhaseGains> PhaseLoop::with_slew(double slew) const {
  if (cells_.size() != 1) {
    return std::nullopt;
  }
  std::vector<std::optional<PhasePart>> made(parts());
  model::for_each_part(made.size(), [&](std::size_t part) {
    made[part] = phase_part(tracker_, cells_.front(), gridding_, part);
  });
  std::vector<PhasePart> all;
  for (std::optional<PhasePart>& each : made) {
    if (!each) {
      return std::nullopt;
    }
    all.push_back(*std::move(each));
  }
  return PhaseGains::make(std::move(all), gridding_, slew);
}

}  // namespace veritrack::model
