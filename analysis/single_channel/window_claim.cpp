#include "analysis/single_channel/window_claim.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "analysis/rigor/elementary.hpp"
#include "analysis/single_channel/window_cell_lanes.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using trackers::InstructionSet;
using trackers::ToneModel;

/// Cells that cover a period of the phase and the band, the ends of the band first: there the bounds are the
/// least good, so that a claim that says too much is refused at once.
std::vector<WindowCells> cells_of(const Interval& band) {
  constexpr std::size_t kPhases = 48;
  constexpr double kFrequencyWidth = 0.02;  // rad/sample
  static_assert(kPhases % WindowCells::kMost == 0);
  const auto count = static_cast<std::size_t>(std::ceil(std::max(1.0, width(band) / kFrequencyWidth)));
  const auto part = [](const Interval& whole, std::size_t k, std::size_t parts) {
    const auto end = [&](std::size_t i) {
      const double share = static_cast<double>(i) / static_cast<double>(parts);
      return i == parts ? whole.upper() : std::min(whole.upper(), whole.lower() + share * width(whole));
    };
    return Interval::from_bounds(end(k), end(k + 1));
  };
  const Interval period = Interval::from_bounds(0.0, rigor::pi().upper());
  std::vector<WindowCells> batches;
  batches.reserve(count * kPhases / WindowCells::kMost);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t j = k % 2 == 0 ? k / 2 : count - 1 - k / 2;
    const Interval frequency = part(band, j, count);
    for (std::size_t first = 0; first < kPhases; first += WindowCells::kMost) {
      WindowCells& cells = batches.emplace_back();
      cells.count = WindowCells::kMost;
      for (std::size_t i = 0; i < WindowCells::kMost; ++i) {
        const Interval phase = part(period, first + i, kPhases);
        cells.phase[0][i] = phase.lower();
        cells.phase[1][i] = phase.upper();
        cells.frequency[0][i] = frequency.lower();
        cells.frequency[1][i] = frequency.upper();
      }
    }
  }
  return batches;
}

/// Looks at all cells, in parallel, until `goes_on(answers)` is false for some; then false.
template <typename GoesOn>
bool look_at_all(const WindowTask& task, const std::vector<WindowCells>& batches,
                 std::vector<WindowAnswers>& answers, const GoesOn& goes_on) {
  detail::CheckWindow* const check = detail::check_window_of(detail::instructions_for_window());
  answers.resize(batches.size());
  std::atomic<bool> all = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, batches.size()), [&](const auto& range) {
    const rigor::UpwardRounding upward;
    for (std::size_t i = range.begin(); i < range.end() && all; ++i) {
      check(task, batches[i], answers[i]);
      if (!goes_on(answers[i])) {
        all = false;
      }
    }
  });
  return all;
}

bool is_sensible(const ToneModel<Interval>& design, const Interval& band, const WindowClaim& claim) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  const WindowAssumption& assumption = claim.assumption;
  // cannot bind (design.q1, design.q2, design.r): questions are well posed, and without q1 no set is looked
  // for (certify_phases).
  return rigor::certainly_positive(design.q1) && rigor::certainly_positive(design.q2) &&
         rigor::certainly_positive(design.r) && design.without_leak() && is_finite(band) &&
         positive(assumption.radius) && positive(assumption.frequency_variance) &&
         positive(assumption.signal_variance) && positive(assumption.loosening) &&
         assumption.loosening < 1.0 && assumption.rounding.is_bounded() && claim.settling > 0 &&
         !claim.shares.empty() && claim.slew >= 0.0 && positive(claim.curvature) &&
         positive(claim.curvature_weight) && positive(claim.signal_uncertainty) &&
         std::all_of(claim.shares.begin(), claim.shares.end(), [](double share) { return share >= 0.0; });
}

WindowTask task_of(const ToneModel<Interval>& design, const WindowClaim& claim,
                   const std::vector<StartVariances>& starts) {
  WindowTask task{design,
                  claim.assumption,
                  {claim.settling, static_cast<int>(claim.shares.size()), claim.slew},
                  claim.shares.data(),
                  claim.curvature,
                  claim.curvature_weight,
                  claim.signal_uncertainty,
                  static_cast<int>(starts.size()),
                  {},
                  {}};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    task.start_signal[i] = starts[i].signal;
    task.start_frequency[i] = starts[i].frequency;
  }
  return task;
}

}  // namespace

namespace detail {

InstructionSet instructions_for_window() {
  return trackers::widest_instruction_set();
}

CheckWindow* check_window_of([[maybe_unused]] InstructionSet set) {
#ifdef VERITRACK_MUTATION
  return check_window<1>;  // the guards of a proof are those of single cells
#else
  return set == InstructionSet::avx512 ? check_window_avx512
         : set == InstructionSet::avx2 ? check_window_avx2
                                       : check_window<2>;
#endif
}

CheckWindow* check_window_one_by_one() {
  return check_window<1>;
}

}  // namespace detail

std::optional<VerifiedWindow> verify_window(const ToneModel<Interval>& design, const Interval& band,
                                            const WindowClaim& claim,
                                            const std::vector<StartVariances>& starts) {
  const rigor::UpwardRounding outer;
  if (!is_sensible(design, band, claim) || starts.size() > WindowTask::kMostStarts) {
    return std::nullopt;
  }
  const std::vector<WindowCells> batches = cells_of(band);
  std::vector<WindowAnswers> answers;
  const auto holds = [](const WindowAnswers& found) {
    return std::all_of(std::begin(found.holds), std::end(found.holds), [](bool one) { return one; });
  };
  if (batches.empty() || !look_at_all(task_of(design, claim, starts), batches, answers, holds)) {
    return std::nullopt;
  }
  constexpr double kNoFloor = std::numeric_limits<double>::infinity();
  VerifiedWindow window{{kNoFloor, kNoFloor, kNoFloor}, std::vector<bool>(starts.size(), true)};
  for (const WindowAnswers& found : answers) {
    window.floor = {
        std::min(window.floor.p11, *std::min_element(std::begin(found.p11), std::end(found.p11))),
        std::min(window.floor.p22, *std::min_element(std::begin(found.p22), std::end(found.p22))),
        std::min(window.floor.p33, *std::min_element(std::begin(found.p33), std::end(found.p33)))};
    for (std::size_t start = 0; start < starts.size(); ++start) {
      const auto& below = found.is_below[start];
      window.is_below[start] = window.is_below[start] &&
                               std::all_of(std::begin(below), std::end(below), [](bool one) { return one; });
    }
  }
  return window;
}

std::optional<WindowFloor> verify_window(const ToneModel<Interval>& design, const Interval& band,
                                         const WindowClaim& claim) {
  const auto window = verify_window(design, band, claim, {});
  return window ? std::optional(window->floor) : std::nullopt;
}

bool certainly_below_covariances(const ToneModel<Interval>& design, const Interval& band,
                                 const WindowClaim& claim,
                                 const StartVariances& start VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  const rigor::UpwardRounding outer;
  const auto window = verify_window(design, band, claim, {start});
  return window && window->is_below.front();
}

}  // namespace veritrack::single_channel
