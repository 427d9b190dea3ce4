#include "analysis/model/map/capture_phase.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::model {

namespace {

using rigor::Interval;

/// Cells of the grid, [first, last) in each direction.
struct CellRange {
  std::size_t first_column = 0, last_column = 0;
  std::size_t first_row = 0, last_row = 0;

  [[nodiscard]] std::size_t columns() const { return last_column - first_column; }
  [[nodiscard]] std::size_t rows() const { return last_row - first_row; }
};

/// Starts that are followed together: cells of the grid, or a part of one.
struct Company {
  CellRange cells;
  StartBox box;
  int x_halvings = 0;  ///< of a single cell
  int y_halvings = 0;
  FollowedSet set;
  std::vector<char> is_open;  ///< of its cells, row by row: not captured yet
};

class PhaseRun {
 public:
  PhaseRun(const CaptureProblem& problem, const CaptureGrid& grid, const CaptureOptions& options,
           const PhaseCell& phases)
      : problem_(&problem), grid_(&grid), options_(&options), track_(problem, phases), follower_(problem) {}

  [[nodiscard]] PhaseAnswer run(const std::vector<char>& wanted) {
    answer_.outcomes.assign(grid_->cells(), CaptureOutcome::not_wanted);
    answer_.samples.assign(grid_->cells(), 0);
    for (std::size_t cell = 0; cell < grid_->cells(); ++cell) {
      if (wanted[cell] != 0) {
        answer_.outcomes[cell] = CaptureOutcome::captured;  // until a part of it is not
      }
    }
    begin();
    while (!waiting_.empty()) {
      Company company = take_next();
      if (is_any_open(company)) {
        follow(company);
      }
    }
    return std::move(answer_);
  }

 private:
  void begin() {
    CellRange cells{grid_->columns(), 0, grid_->rows(), 0};
    for (std::size_t row = 0; row < grid_->rows(); ++row) {
      for (std::size_t column = 0; column < grid_->columns(); ++column) {
        if (answer_.outcomes[grid_->cell(column, row)] != CaptureOutcome::not_wanted) {
          cells.first_column = std::min(cells.first_column, column);
          cells.last_column = std::max(cells.last_column, column + 1);
          cells.first_row = std::min(cells.first_row, row);
          cells.last_row = std::max(cells.last_row, row + 1);
        }
      }
    }
    if (cells.last_row > 0) {
      Company all{cells, box_of(cells), 0, 0, {}, {}};
      all.set = follower_.start(track_, all.box);
      all.is_open.assign(cells.columns() * cells.rows(), 1);
      waiting_.push_back(std::move(all));
    }
  }

  /// Those that were halved least come first: hard cells must not use up what easy ones need.
  [[nodiscard]] Company take_next() {
    const auto halvings = [](const Company& company) { return company.x_halvings + company.y_halvings; };
    // The last among equal ones, so that few wait.
    auto best = waiting_.begin();
    for (auto each = waiting_.begin(); each != waiting_.end(); ++each) {
      best = halvings(*each) <= halvings(*best) ? each : best;
    }
    Company company = std::move(*best);
    waiting_.erase(best);
    return company;
  }

  [[nodiscard]] StartBox box_of(const CellRange& cells) const {
    return {grid_->x_state, grid_->y_state,
            Interval::from_bounds(grid_->x[cells.first_column], grid_->x[cells.last_column]),
            Interval::from_bounds(grid_->y[cells.first_row], grid_->y[cells.last_row])};
  }

  template <typename Work>
  void for_each_cell_of(const CellRange& cells, const Work& work) const {
    for (std::size_t row = cells.first_row; row < cells.last_row; ++row) {
      for (std::size_t column = cells.first_column; column < cells.last_column; ++column) {
        const std::size_t place = (row - cells.first_row) * cells.columns() + (column - cells.first_column);
        work(column, row, place);
      }
    }
  }

  /// Closes the cells with another part that has failed. Returns whether there are others.
  bool is_any_open(Company& company) const {
    bool is_any = false;
    for_each_cell_of(company.cells, [&](std::size_t column, std::size_t row, std::size_t place) {
      const bool is_open = company.is_open[place] != 0 &&
                           answer_.outcomes[grid_->cell(column, row)] == CaptureOutcome::captured;
      company.is_open[place] = is_open ? 1 : 0;
      is_any = is_any || is_open;
    });
    return is_any;
  }

  void fail(const Company& company, CaptureOutcome outcome) {
    for_each_cell_of(company.cells, [&](std::size_t column, std::size_t row, std::size_t place) {
      if (company.is_open[place] != 0) {
        answer_.outcomes[grid_->cell(column, row)] = outcome;
      }
    });
  }

  void follow(Company& company) {
    for (;;) {
      if (company.set.sample % options_->stride == 0 && look(company)) {
        return;
      }
      if (company.set.sample >= options_->most_samples) {
        fail(company, CaptureOutcome::too_coarse);
        return;
      }
      constexpr std::size_t kEvery = 64;  // to ask for the time costs little, but not nothing
      if (++steps_ > options_->most_steps || (steps_ % kEvery == 0 && options_->deadline.is_over())) {
        fail(company, CaptureOutcome::given_up);
        return;
      }
      FollowedStep next = follower_.step(track_, company.set);
      // Comparisons with what is not known are false.
      const double radius = company.set.radius;
      const bool is_accurate = next.added <= options_->tolerance * problem_->level;
      const bool is_small = next.set.radius <= problem_->level;
      if (is_accurate && is_small && !(company.is_open.size() > 1 && is_spreading(next, radius))) {
        company.set = std::move(next.set);
        continue;
      }
      // An unknown bound, or one that grows suddenly, is also the result of a box that is too large.
      constexpr double kSmallShare = 0.25;
      if (is_accurate && !(radius <= kSmallShare * problem_->level)) {
        fail(company, CaptureOutcome::too_coarse);
      } else {
        divide(company);
      }
      return;
    }
  }

  /// Whether the ball grows much in a step, and this matters: among starts that differ less it would not.
  [[nodiscard]] bool is_spreading(const FollowedStep& next, double radius) const {
    constexpr double kGrowth = 1.04;
    constexpr double kShare = 0.01;
    return radius > kShare * problem_->level && next.set.radius > kGrowth * radius + next.added;
  }

  /// Divides the starts where they differ most; fails when that is not allowed or does not help.
  void divide(const Company& company) {
    const std::array<double, 3> spread = spread_of(company.set, track_.target(company.set.sample));
    const CellRange& cells = company.cells;
    const bool may_halve = company.x_halvings + company.y_halvings < options_->cell_halvings;
    const bool can_divide_x = cells.columns() > 1 || (cells.rows() == 1 && may_halve);
    const bool can_divide_y = cells.rows() > 1 || (cells.columns() == 1 && may_halve);
    const bool by_x = can_divide_x && (spread[of_x] >= spread[of_y] || !can_divide_y);
    // When the phase is too wide, narrower starts do not help.
    const double widest = by_x ? spread[of_x] : spread[of_y];
    constexpr double kShareOfPhase = 0.25;
    if (!(widest >= kShareOfPhase * spread[of_phase])) {
      fail(company, CaptureOutcome::too_coarse);
      return;
    }
    if (!can_divide_x && !can_divide_y) {
      fail(company, CaptureOutcome::given_up);
      return;
    }
    for (const bool is_second : {true, false}) {
      waiting_.push_back(half_of(company, by_x, is_second));
      if (!open_half(company, waiting_.back())) {
        waiting_.pop_back();
      }
    }
  }

  [[nodiscard]] Company half_of(const Company& company, bool by_x, bool is_second) const {
    Company half{company.cells, company.box, company.x_halvings, company.y_halvings, {}, {}};
    const auto divide_range = [&](std::size_t& first, std::size_t& last, Interval& range, int& halvings,
                                  const std::vector<double>& ends) {
      double middle = rigor::midpoint(range);
      if (last - first > 1) {
        const std::size_t between = first + (last - first) / 2;
        middle = ends[between];
        (is_second ? first : last) = between;
      } else {
        ++halvings;
      }
      range = is_second ? Interval::from_bounds(middle, range.upper())
                        : Interval::from_bounds(range.lower(), middle);
    };
    if (by_x) {
      divide_range(half.cells.first_column, half.cells.last_column, half.box.x, half.x_halvings, grid_->x);
    } else {
      divide_range(half.cells.first_row, half.cells.last_row, half.box.y, half.y_halvings, grid_->y);
    }
    return half;
  }

  /// Gives the half its part of the set; false when nothing is open in it.
  bool open_half(const Company& company, Company& half) {
    half.is_open.assign(half.cells.columns() * half.cells.rows(), 0);
    bool is_any = false;
    for_each_cell_of(half.cells, [&](std::size_t column, std::size_t row, std::size_t place) {
      const std::size_t before =
          (row - company.cells.first_row) * company.cells.columns() + (column - company.cells.first_column);
      half.is_open[place] = company.is_open[before];
      is_any = is_any || company.is_open[before] != 0;
    });
    if (is_any) {
      half.set = part_of(company.set, track_.target(company.set.sample), sub_box(company.box, half.box));
    }
    return is_any;
  }

  /// Notes which cells are captured; true when none is left.
  bool look(Company& company) {
    if (!may_be_captured(company)) {
      return false;
    }
    const CaptureModel squared = follower_.squared_level(track_, company.set);
    bool is_any_left = false;
    const bool is_single = company.is_open.size() == 1;
    for_each_cell_of(company.cells, [&](std::size_t column, std::size_t row, std::size_t place) {
      if (company.is_open[place] == 0) {
        return;
      }
      Interval range = squared.range();
      if (!is_single && !(level_bound(range, company.set.radius) <= problem_->level)) {
        const StartBox box = box_of({column, column + 1, row, row + 1});
        range = value_near(squared, company.box, box) <= problem_->level * problem_->level
                    ? substituted(squared, sub_box(company.box, box)).range()
                    : Interval::empty();
      }
      const double level = level_bound(range, company.set.radius);
      if (level <= problem_->level) {
        company.is_open[place] = 0;
        std::size_t& samples = answer_.samples[grid_->cell(column, row)];
        samples = std::max(samples, company.set.sample);
      } else {
        is_any_left = true;
      }
    });
    return !is_any_left;
  }

  /// A guess by the middle of the starts, to look only where there may be something to see.
  [[nodiscard]] bool may_be_captured(const Company& company) {
    const CaptureTarget& target = track_.target(company.set.sample);
    Eigen::VectorXd middle(target.middle.curve.size());
    for (Eigen::Index i = 0; i < middle.size(); ++i) {
      middle[i] = company.set.middle[static_cast<std::size_t>(i)].constant();
      if (problem_->tracker->recursion->is_angle[static_cast<std::size_t>(i)]) {
        constexpr double kFullTurn = 6.283185307179586;
        middle[i] -= kFullTurn * std::round((middle[i] - target.middle.curve[i]) / kFullTurn);
      }
    }
    const std::array<double, 3> spread = spread_of(company.set, target);
    return target.middle.coordinates(middle).norm() <=
           problem_->level + company.set.radius + spread[of_x] + spread[of_y];
  }

  /// Approximately the polynomial at the middle of a box and of the phases.
  [[nodiscard]] static double value_near(const CaptureModel& polynomial, const StartBox& outer,
                                         const StartBox& inner) {
    const auto place = [](const Interval& range, const Interval& part) {
      const double half = 0.5 * (range.upper() - range.lower());
      return half > 0.0 ? (rigor::midpoint(part) - rigor::midpoint(range)) / half : 0.0;
    };
    const double x = place(outer.x, inner.x);
    const double y = place(outer.y, inner.y);
    double sum = 0.0;
    for (std::size_t i = 0; i < CaptureModel::kTerms; ++i) {
      const auto& exponents = CaptureModel::Monomials::kExponents[i];
      if (exponents[of_phase] == 0) {
        sum += polynomial.coefficients()[i] * std::pow(x, exponents[of_x]) * std::pow(y, exponents[of_y]);
      }
    }
    return sum;
  }

  const CaptureProblem* problem_;
  const CaptureGrid* grid_;
  const CaptureOptions* options_;
  CaptureTrack track_;
  Follower follower_;
  PhaseAnswer answer_;
  std::vector<Company> waiting_;
  std::size_t steps_ = 0;
};

}  // namespace

PhaseAnswer follow_at(const CaptureProblem& problem, const CaptureGrid& grid, const std::vector<char>& wanted,
                      const CaptureOptions& options, const PhaseCell& phases) {
  return PhaseRun(problem, grid, options, phases).run(wanted);
}

}  // namespace veritrack::model
