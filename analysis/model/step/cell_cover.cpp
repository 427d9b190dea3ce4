#include "analysis/model/step/cell_cover.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

/// `sum` becomes the hull of both; the first is taken as it is.
void include(std::optional<Interval>& sum, const Interval& more) {
  sum = sum ? hull(*sum, more) : more;
}

bool is_power_of_two(int n) {
  return n > 0 && (n & (n - 1)) == 0;
}

/// The result of one part of the first grid.
struct PartResult {
  bool is_proved = false;
  std::size_t cells = 0;
  std::optional<Interval> range;
  TubeCell failed;
};

class Cover {
 public:
  Cover(const std::function<CellAnswer(const TubeCell&)>& ask, const VerificationBudget& budget)
      : ask_(&ask), budget_(budget) {}

  [[nodiscard]] CoverResult run() const {
    const auto parts =
        static_cast<std::size_t>(budget_.phases) * static_cast<std::size_t>(budget_.frequencies);
    std::vector<PartResult> results(parts);
    // The first part that fails, in their order, is the one that is reported.
    std::atomic<std::size_t> first_failure{parts};
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t number) {
      if (number > first_failure.load()) {
        return;
      }
      results[number] = cover_part(number, first_failure);
      if (!results[number].is_proved) {
        std::size_t known = first_failure.load();
        while (number < known && !first_failure.compare_exchange_weak(known, number)) {
        }
      }
    });
    CoverResult result;
    const std::size_t failure = first_failure.load();
    if (failure < parts) {
      result.failed = results[failure].failed;
      return result;
    }
    const rigor::UpwardRounding upward;
    std::optional<Interval> range;
    for (const PartResult& part : results) {
      if (!part.is_proved || !part.range) {
        result.failed = part.failed;
        return result;
      }
      result.cells += part.cells;
      include(range, *part.range);
    }
    if (range) {
      result.range = *range;
      result.is_proved = true;
    }
    return result;
  }

 private:
  /// Part number k of a dyadic grid over a turn and [-1, 1].
  [[nodiscard]] TubeCell part(std::size_t number) const {
    const double phases = budget_.phases;
    const double frequencies = budget_.frequencies;
    const std::size_t row = number / static_cast<std::size_t>(budget_.phases);
    const auto i = static_cast<double>(number % static_cast<std::size_t>(budget_.phases));
    const auto j = static_cast<double>(row);
    return {(i + 0.5) / phases, 0.5 / phases, (2.0 * j + 1.0) / frequencies - 1.0, 1.0 / frequencies};
  }

  [[nodiscard]] PartResult cover_part(std::size_t number,
                                      const std::atomic<std::size_t>& first_failure) const {
    const rigor::UpwardRounding upward;
    PartResult result;
    const std::size_t most = budget_.most_cells / (static_cast<std::size_t>(budget_.phases) *
                                                   static_cast<std::size_t>(budget_.frequencies)) +
                             64;
    const auto look = [&](const TubeCell& cell) -> search::CellDecision<TubeCell> {
      if (budget_.deadline.is_over()) {
        return {};
      }
      const CellAnswer answer = (*ask_)(cell);
      if (answer.is_proved) {
        ++result.cells;
        include(result.range, answer.range);
        return {true};
      }
      if (first_failure.load() < number || is_tiny(cell) || !may_be_proved(cell)) {
        return {};
      }
      return {false, halves_of(cell, answer)};
    };
    const auto cover = search::cover_by_bisection(part(number), 2 * static_cast<std::int64_t>(most), look);
    result.is_proved = cover.is_proved;
    result.failed = cover.failed.value_or(TubeCell{});
    return result;
  }

  /// Whether a cell that fails may be worth halving: whether its middle passes.
  [[nodiscard]] bool may_be_proved(const TubeCell& cell) const {
    return (*ask_)({cell.turn, 0.0, cell.z, 0.0}).is_proved;
  }

  /// Approximately the parts of a turn that are as wide as all frequencies.
  static constexpr double kPhasesAsWide = 48.0;

  /// The limit of halving: a part is one in a million in each direction.
  [[nodiscard]] static bool is_tiny(const TubeCell& cell) {
    return cell.half_turn < 0x1p-26 || cell.half_z < 0x1p-20;
  }

  [[nodiscard]] static std::array<TubeCell, 2> halves_of(const TubeCell& cell, const CellAnswer& answer) {
    TubeCell first = cell;
    TubeCell second = cell;
    // A guess. Where the better direction is unknown, both take turns.
    const double sum = answer.by_frequency + answer.by_phase;
    const bool is_known = std::isfinite(sum) && sum > 0.0;
    const bool by_frequency =
        is_known ? answer.by_frequency > answer.by_phase : cell.half_z > kPhasesAsWide * cell.half_turn;
    if (by_frequency) {
      first.half_z = second.half_z = cell.half_z / 2.0;
      first.z -= first.half_z;
      second.z += second.half_z;
    } else {
      first.half_turn = second.half_turn = cell.half_turn / 2.0;
      first.turn -= first.half_turn;
      second.turn += second.half_turn;
    }
    return {first, second};
  }

  const std::function<CellAnswer(const TubeCell&)>* ask_;
  VerificationBudget budget_;
};

}  // namespace

bool is_grid(const VerificationBudget& budget) {
  return is_power_of_two(budget.phases) && is_power_of_two(budget.frequencies);
}

CoverResult cover_cells(const std::function<CellAnswer(const TubeCell&)>& ask,
                        const VerificationBudget& budget) {
  if (!is_grid(budget)) {
    throw std::invalid_argument("a grid of cells is of powers of two");
  }
  return Cover(ask, budget).run();
}

}  // namespace veritrack::model
