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

/// Powers of the matrix of a cell in its middle.
class CellPowers {
 public:
  explicit CellPowers(const FloquetCell& cell) : n_(cell.states()) {
    for (const std::vector<double>& entry : cell.matrix) {
      matrix_.push_back(entry[0]);
    }
    power_.assign(n_ * n_, 0.0);
    for (std::size_t i = 0; i < n_; ++i) {
      power_[i * n_ + i] = 1.0;
    }
    next_ = largest_ = sum_ = power_;
  }

  [[nodiscard]] const std::vector<double>& power() const { return power_; }
  /// The sums of absolute values, until now.
  [[nodiscard]] const std::vector<double>& sums() const { return sum_; }
  /// Whether some entry is more than this share of the largest one that it was.
  [[nodiscard]] bool is_above(double share) const {
    constexpr double kNothing = 1e-12;
    for (std::size_t i = 0; i < power_.size(); ++i) {
      if (std::fabs(power_[i]) > share * largest_[i] && std::fabs(power_[i]) > kNothing) {
        return true;
      }
    }
    return false;
  }
  void advance() {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        double sum = 0.0;
        for (std::size_t m = 0; m < n_; ++m) {
          sum += power_[i * n_ + m] * matrix_[m * n_ + j];
        }
        next_[i * n_ + j] = sum;
      }
    }
    std::swap(power_, next_);
    for (std::size_t i = 0; i < power_.size(); ++i) {
      largest_[i] = std::max(largest_[i], std::fabs(power_[i]));
      sum_[i] += std::fabs(power_[i]);
    }
  }
  /// How far those half way are from the mean of these and others, against sums of all.
  [[nodiscard]] double bend(const std::vector<double>& half_way, const std::vector<double>& others,
                            const std::vector<double>& sums) const {
    double most = 0.0;
    for (std::size_t i = 0; i < power_.size(); ++i) {
      const double off = std::fabs(half_way[i] - 0.5 * (power_[i] + others[i]));
      most = sums[i] > 0.0 ? std::max(most, off / sums[i]) : most;
    }
    return most;
  }

 private:
  std::size_t n_;
  std::vector<double> matrix_, power_, next_, largest_, sum_;
};

constexpr std::size_t kLongestHorizon = 1U << 16U;  // that the checker takes one by one
constexpr std::size_t kMostLags = 1U << 22U;

/// After how many samples the powers of the matrix are negligible, and their sums; 0: after too many.
std::size_t lags_of(const FloquetCell& cell, std::vector<double>& sums) {
  constexpr double kNegligible = 1e-4;
  CellPowers powers(cell);
  std::size_t last = 0;
  for (std::size_t k = 0; k < kMostLags; ++k) {
    last = powers.is_above(kNegligible) ? k : last;
    if (k > 2 * last + 1024) {
      break;
    }
    powers.advance();
  }
  sums = powers.sums();
  return last + 1 < kMostLags ? last + 1 : 0;
}

/// From which multiple of 64 on powers are nearly linear over so many lags; 0: from none.
std::size_t nearly_linear_from(const FloquetCell& cell, std::size_t lags, const std::vector<double>& sums) {
  constexpr double kBend = 1e-3;
  for (std::size_t first = PhaseKernels::kBlocks; first < kLongestHorizon; first *= 2) {
    CellPowers powers(cell);
    for (std::size_t k = 0; k < first; ++k) {
      powers.advance();
    }
    const std::vector<double> from = powers.power();
    for (std::size_t k = 0; k < lags / 2; ++k) {
      powers.advance();
    }
    const std::vector<double> half_way = powers.power();
    for (std::size_t k = lags / 2; k < lags; ++k) {
      powers.advance();
    }
    if (powers.bend(half_way, from, sums) * static_cast<double>(lags) < kBend) {
      return first;
    }
  }
  return 0;
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
  const std::size_t most_parts = (with_slew ? 128 : gridding_.late_blocks > 0 ? 16 : 64) / cells_.size();
  // The share of the gain that may be missed: with a slew finer parts take minutes, because all look at each
  // other.
  const bool is_late = gridding_.late_blocks > 0;  // then every part takes seconds in both programs
  const double fine = with_slew || is_late ? 0.1 : 0.06;
  constexpr double kBetter = 0.9;
  const double near_gain = is_late ? 1.1 : 1.03;
  constexpr double kSteady = 0x1p-19;  // rad/sample: the steady state is known to this, or phases are too few
  double last_gain = INFINITY;
  for (std::size_t parts = fewest_parts; parts <= most_parts; parts *= 2) {
    const PhaseGridding before = gridding_;
    gridding_.parts = parts;
    auto gains = gains_of(0, with_slew);
    const auto still = gains ? gains->errors({}) : std::nullopt;
    if (still && !(still->for_ever - still->bias <= kSteady)) {
      gains.reset();
    }
    const double missed = gains ? gains->missed_share() : INFINITY;
    const double gain = gains ? gains->largest_gain() : INFINITY;
    if (!(missed < kBetter * best.missed) && last_gain < near_gain * gain && std::isfinite(best.missed)) {
      gridding_ = before;
      break;
    }
    if (gains && missed < best.missed) {
      best = {missed, gridding_};
      probe_ = std::make_shared<PhaseGains>(*std::move(gains));
    }
    if (missed < fine && last_gain < near_gain * gain) {
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

std::string PhaseLoop::find_horizon(bool with_slew) {
  std::size_t lags = 0;
  std::vector<std::vector<double>> sums(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::size_t here = lags_of(cells_[i], sums[i]);
    if (here == 0) {
      return fmt::format("its errors take more than {} samples to decay to a ten-thousandth", kMostLags);
    }
    lags = std::max(lags, here);
  }
  gridding_.late_blocks = gridding_.late_turns = 0;
  gridding_.lags = gridding_.horizon = (lags / PhaseKernels::kBlocks + 1) * PhaseKernels::kBlocks;
  if (gridding_.horizon <= kLongestHorizon) {
    return {};
  }
  if (with_slew) {
    return fmt::format("its errors take {} samples to decay to a ten-thousandth: too many with a slew", lags);
  }
  constexpr double kShare = 0.01;  // of all lags, of a block
  const double low = cells_.front().curve.frequency - cells_.front().curve.half_width;
  const double turn = 2.0 * std::numbers::pi / low;
  gridding_.late_turns = static_cast<std::size_t>(kShare * static_cast<double>(lags) / turn) + 1;
  const auto block = static_cast<std::size_t>(std::ceil(static_cast<double>(gridding_.late_turns) * turn));
  gridding_.horizon = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::size_t first = nearly_linear_from(cells_[i], block, sums[i]);
    if (first == 0 || block > kLongestHorizon) {
      return fmt::format("its errors take {} samples to decay to a ten-thousandth: too many for its gains",
                         lags);
    }
    gridding_.horizon = std::max(gridding_.horizon, first);
  }
  gridding_.late_blocks = lags / block + 1;
  gridding_.lags = gridding_.horizon + gridding_.late_blocks * block;
  return {};
}

std::string PhaseLoop::find_gridding(bool with_slew) {
  std::string objection = find_horizon(with_slew);
  if (!objection.empty()) {
    return objection;
  }
  constexpr std::array<std::size_t, 2> kPhases{128, 256};
  Fineness best;
  for (const std::size_t phases : kPhases) {
    gridding_.phases = phases;
    order_factors();
    // With a slew all parts are kept, and all look at each other.
    if (find_parts(with_slew, best) || with_slew || gridding_.late_blocks > 0) {
      break;
    }
  }
  if (gridding_.phases != best.gridding.phases) {
    gridding_.phases = best.gridding.phases;
    order_factors();
  }
  gridding_ = best.gridding;
  return probe_ != nullptr
             ? ""
             : "its gains were not bounded with the phases and parts of the band that are tried";
}

PhaseLoop PhaseLoop::make(const TrackerModel& tracker, const TrackedTone& tone, const Interval& band,
                          bool with_slew, const search::Deadline& deadline) {
  constexpr std::size_t kMostCells = 8;
  std::string reason = "no basis was found in which its errors have constant coefficients and decay";
  for (std::size_t count = 1; count <= (with_slew ? 1 : kMostCells); count *= 2) {
    std::optional<PhaseLoop> best;
    for (const FloquetGauge gauge : {FloquetGauge::by_mode, FloquetGauge::by_state}) {
      if (!best && deadline.is_over()) {
        throw NoTime("a basis was found in which its errors have constant coefficients and decay");
      }
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

bool PhaseLoop::round(ProgramRounding rounding) {
  rounding_ = std::make_shared<ProgramRounding>(std::move(rounding));
  tracker_.rounding = rounding_.get();
  auto gains = gains_of(0, false);
  if (!gains) {
    return false;
  }
  probe_ = std::make_shared<PhaseGains>(*std::move(gains));
  return true;
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
