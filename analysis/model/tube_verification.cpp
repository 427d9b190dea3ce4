#include "analysis/model/tube_verification.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "analysis/model/angle_check.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// `sum` becomes the hull of both; the first is taken as it is.
void include(std::optional<Interval>& sum, const Interval& more) {
  sum = sum ? hull(*sum, more) : more;
}

/// Whether all bounds are at most what is asked of them. A comparison with NaN is false.
bool holds(const StepBounds& bounds, const LevelQuestion& question, const std::vector<double>& scales) {
  if (bounds.steps.size() != scales.size() || scales.empty() || rigor::is_empty(bounds.frequency_error)) {
    return false;
  }
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const Interval allowed = Interval(question.shrinking) * Interval(scales[i]);
    // |F| is in units of the shape, in which the ball has the radius R.
    const Interval relative = Interval(bounds.steps[i]) / Interval(question.radius);
    if (!rigor::certainly_less_equal(relative, allowed)) {
      return false;
    }
  }
  return true;
}

/// What one part of the first grid came to.
struct PartResult {
  bool is_proved = false;
  std::size_t cells = 0;
  std::optional<Interval> frequency_error;
  TubeCell failed;
};

class Verification {
 public:
  Verification(const TrackerModel& model, const Tube& tube, const LevelQuestion& question,
               const VerificationBudget& budget)
      : model_(&model), tube_(&tube), question_(&question), budget_(budget) {
    scales_.push_back(1.0);
    if (question.least_scale < 1.0) {
      scales_.push_back(question.least_scale);
    }
  }

  [[nodiscard]] LevelResult run() {
    const auto parts =
        static_cast<std::size_t>(budget_.phases) * static_cast<std::size_t>(budget_.frequencies);
    std::vector<PartResult> results(parts);
    // The first part that fails, in their order, is the one that is reported.
    std::atomic<std::size_t> first_failure{parts};
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t number) {
      if (number > first_failure.load()) {
        return;
      }
      results[number] = verify_part(number, first_failure);
      if (!results[number].is_proved) {
        std::size_t known = first_failure.load();
        while (number < known && !first_failure.compare_exchange_weak(known, number)) {
        }
      }
    });
    LevelResult result;
    const std::size_t failure = first_failure.load();
    if (failure < parts) {
      result.worst_cell = results[failure].failed;
      result.reason = fmt::format(
          "at phases about {:.4g} of a turn and frequencies about {:.4g} rad/sample a step may grow beyond "
          "the tube",
          result.worst_cell.turn, tube_->frequency + tube_->half_width * result.worst_cell.z);
      return result;
    }
    const rigor::UpwardRounding upward;
    std::optional<Interval> frequency_error;
    for (const PartResult& part : results) {
      if (!part.frequency_error) {
        result.reason = "a part without cells";
        return result;
      }
      result.cells += part.cells;
      include(frequency_error, *part.frequency_error);
    }
    result.frequency_error = frequency_error.value();
    result.verdict = Verdict::proved;
    return result;
  }

 private:
  /// Part number k of a dyadic grid over a turn and [-1, 1].
  [[nodiscard]] TubeCell part(std::size_t number) const {
    const double phases = budget_.phases;
    const double frequencies = budget_.frequencies;
    const auto i = static_cast<double>(number % static_cast<std::size_t>(budget_.phases));
    const auto j = static_cast<double>(number / static_cast<std::size_t>(budget_.phases));
    return {(i + 0.5) / phases, 0.5 / phases, (2.0 * j + 1.0) / frequencies - 1.0, 1.0 / frequencies};
  }

  [[nodiscard]] PartResult verify_part(std::size_t number,
                                       const std::atomic<std::size_t>& first_failure) const {
    const rigor::UpwardRounding upward;
    PartResult result;
    std::vector<TubeCell> open{part(number)};
    const std::size_t most = budget_.most_cells / (static_cast<std::size_t>(budget_.phases) *
                                                   static_cast<std::size_t>(budget_.frequencies)) +
                             64;
    while (!open.empty()) {
      const TubeCell cell = open.back();
      open.pop_back();
      const StepBounds bounds =
          bound_step(*model_, *tube_, cell, question_->radius, question_->noise, scales_);
      if (holds(bounds, *question_, scales_)) {
        ++result.cells;
        include(result.frequency_error, bounds.frequency_error);
        continue;
      }
      if (result.cells + open.size() >= most || first_failure.load() < number || !may_hold(cell)) {
        result.failed = cell;
        return result;
      }
      halve(cell, bounds, open);
    }
    result.is_proved = true;
    return result;
  }

  /// Whether a cell that fails may be worth halving: whether its middle passes.
  [[nodiscard]] bool may_hold(const TubeCell& cell) const {
    const TubeCell middle{cell.turn, 0.0, cell.z, 0.0};
    return holds(bound_step(*model_, *tube_, middle, question_->radius, question_->noise, scales_),
                 *question_, scales_);
  }

  static void halve(const TubeCell& cell, const StepBounds& bounds, std::vector<TubeCell>& open) {
    TubeCell first = cell;
    TubeCell second = cell;
    const bool by_frequency = bounds.by_frequency > bounds.by_phase;  // a guess; false with NaN
    if (by_frequency) {
      first.half_z = second.half_z = cell.half_z / 2.0;
      first.z -= first.half_z;
      second.z += second.half_z;
    } else {
      first.half_turn = second.half_turn = cell.half_turn / 2.0;
      first.turn -= first.half_turn;
      second.turn += second.half_turn;
    }
    open.push_back(second);
    open.push_back(first);
  }

  const TrackerModel* model_;
  const Tube* tube_;
  const LevelQuestion* question_;
  VerificationBudget budget_;
  std::vector<double> scales_;
};

bool is_power_of_two(int n) {
  return n > 0 && (n & (n - 1)) == 0;
}

}  // namespace

LevelResult verify_level(const TrackerModel& model, const Tube& tube, const LevelQuestion& question,
                         const VerificationBudget& budget) {
  LevelResult result;
  const rigor::UpwardRounding upward;
  result.reason = angle_objection(*model.recursion, model.constants);
  if (!result.reason.empty()) {
    return result;
  }
  if (!is_periodic(*model.signal, model.constants)) {
    result.reason = "the signal is not known to have the period 2 pi in its phase";
    return result;
  }
  for (std::size_t i = 0; i < tube.turns.size(); ++i) {
    if (tube.turns[i] != 0 && !model.recursion->is_angle[i]) {
      result.reason = "the curve turns in a state that is no angle";
      return result;
    }
  }
  const bool is_question = std::isfinite(question.radius) && question.radius > 0.0 && question.noise >= 0.0 &&
                           std::isfinite(question.noise) && question.least_scale > 0.0 &&
                           question.least_scale <= 1.0 && question.shrinking > 0.0 &&
                           question.shrinking <= 1.0 && is_power_of_two(budget.phases) &&
                           is_power_of_two(budget.frequencies);
  if (!is_question) {
    result.reason = "no radius, noise or budget that could be verified";
    return result;
  }
  return Verification(model, tube, question, budget).run();
}

double sampled_growth(const TrackerModel& model, const Tube& tube, double radius, double noise, int phases) {
  constexpr std::array<double, 3> kPlaces{-1.0, 0.0, 1.0};
  std::vector<double> growths(static_cast<std::size_t>(phases) * kPlaces.size());
  tbb::parallel_for(std::size_t{0}, growths.size(), [&](std::size_t number) {
    const double turn = static_cast<double>(number / kPlaces.size()) / phases;
    const TubeCell point{turn, 0.0, kPlaces.at(number % kPlaces.size()), 0.0};
    const double step = bound_step(model, tube, point, radius, noise, {1.0}).steps.front();
    growths[number] = std::isfinite(step) ? step / radius : std::numeric_limits<double>::infinity();
  });
  return *std::max_element(growths.begin(), growths.end());
}

}  // namespace veritrack::model
