#include "analysis/quadrature/contraction/error_contraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analysis/quadrature/contraction/cell_batch.hpp"
#include "analysis/rigor/decimal.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using trackers::InstructionSet;

StepSetting<double> middle_of(const StepSetting<Interval>& s) {
  const auto block = [](const BlockCovariance<Interval>& p) {
    return BlockCovariance<double>{midpoint(p.p11), midpoint(p.p22), midpoint(p.p23), midpoint(p.p33)};
  };
  return {{midpoint(s.design.q1), midpoint(s.design.q2), midpoint(s.design.r), 0.0},
          {midpoint(s.metric.amplitude), midpoint(s.metric.phase), midpoint(s.metric.coupling),
           midpoint(s.metric.frequency)},
          block(s.covariance_lower),
          block(s.covariance_upper),
          midpoint(s.largest_amplitude),
          midpoint(s.largest_chi),
          midpoint(s.noise)};
}

/// A box of (s, beta) and of the fractions of RayCell.
struct Cell {
  std::array<double, kCellVariables> low, high;
  std::array<double, 2> reach;  ///< of RayCell: the same for all parts of a cell, so that they cover it
  [[nodiscard]] double middle(std::size_t i) const { return 0.5 * (low[i] + high[i]); }
  [[nodiscard]] Interval side(std::size_t i) const { return Interval::from_bounds(low[i], high[i]); }
};
enum Side : std::size_t { kScale = 0, kBeta = 1, kAlong = 2, kAcross = 3 };

RayCell<double, double> middle_ray(const Cell& cell) {
  const double beta = cell.middle(kBeta);
  return {cell.middle(kScale),  beta,      std::cos(beta), std::sin(beta), cell.middle(kAlong),
          cell.middle(kAcross), cell.reach};
}

/// A cell that is still to be judged, with what a look at it finds.
struct OpenCell {
  Cell cell;
  bool has_reach = false;  ///< parts of a cell have its reach
  bool holds = false;
  double rate_squared = 0.0;  ///< that a proposal finds in the middle
  std::size_t widest = 0;     ///< the side to bisect
};

/// Walks the cells in generations: all of one, then the halves of those that were left. So as many are looked
/// at together as a register holds, and it is soon seen when there will be too many.
class Cover {
 public:
  Cover(const StepSetting<Interval>& setting, const StepConstants<Interval>& constants, InstructionSet set)
      : setting_(setting),
        constants_(constants),
        middle_(middle_of(setting)),
        middle_constants_{midpoint(constants.rate_squared), midpoint(constants.noise_gain_squared),
                          midpoint(constants.slew_gain_squared), constants.noisy, constants.slewing},
        instructions_(set) {}

  ContractionOverSet judge(std::vector<OpenCell> cells, int depth) {
    ContractionOverSet over;
    for (; !cells.empty(); --depth) {
      std::vector<OpenCell> halves;
      for (std::size_t first = 0; first < cells.size(); first += CellBatch::kMost) {
        const std::size_t count = std::min<std::size_t>(CellBatch::kMost, cells.size() - first);
        look_at(&cells[first], static_cast<int>(count));
        for (std::size_t i = first; i < first + count; ++i) {
          over.reason = judge(cells[i], depth, halves);
          if (!over.reason.empty()) {
            return over;
          }
        }
        if (over.cells + static_cast<std::int64_t>(cells.size() + halves.size()) > kMostCells) {
          over.reason = "more than " + std::to_string(kMostCells) + " cells were needed.";
          return over;
        }
      }
      over.cells += static_cast<std::int64_t>(cells.size());
      cells = std::move(halves);
    }
    over.proved = true;
    return over;
  }

 private:
  static constexpr std::int64_t kMostCells = 12000;

  static bool has_finite_reach(const Cell& cell) {
    return std::isfinite(cell.reach[0]) && std::isfinite(cell.reach[1]);
  }

  /// Adds the halves of a cell that is left. A reason when there is no hope for it.
  [[nodiscard]] std::string judge(const OpenCell& here, int depth, std::vector<OpenCell>& halves) const {
    if (!has_finite_reach(here.cell)) {
      return "the set is so large that the estimate may lose its phase.";
    }
    if (here.holds) {
      return {};
    }
    const bool hopeful = depth > 0 && here.rate_squared <= middle_constants_.rate_squared;
    if (!hopeful) {
      return not_contracting(here.cell);
    }
    OpenCell first{here.cell, true};
    OpenCell second = first;
    first.cell.high[here.widest] = second.cell.low[here.widest] = here.cell.middle(here.widest);
    halves.insert(halves.end(), {first, second});
    return {};
  }

  [[nodiscard]] std::string not_contracting(const Cell& cell) const {
    const double beta = cell.middle(kBeta);
    const double a = middle_.largest_amplitude * cell.middle(kScale) * std::cos(beta);
    const double chi = middle_.largest_chi * cell.middle(kScale) * std::sin(beta);
    return "near amplitude error " + rigor::to_decimal(a, 3, rigor::Direction::up) +
           " and predicted phase error " + rigor::to_decimal(chi, 3, rigor::Direction::up) +
           " rad a step could not be proved to contract, or to tolerate the noise and slew.";
  }

  /// Fills in what is to be known of cells that stand side by side.
  void look_at(OpenCell* cells, int count) const {
    if (instructions_ != InstructionSet::sse2) {
      look_at_together(cells, count);
      return;
    }
    for (int i = 0; i < count; ++i) {
      look_at(cells[i]);
    }
  }

  // ---- one cell

  void look_at(OpenCell& here) const {
    Cell& cell = here.cell;
    if (!here.has_reach) {
      set_reach(cell);
    }
    if (!has_finite_reach(cell)) {
      return;
    }
    const CellForms forms = forms_of(cell);
    const RayRate proposal = propose_rate(forms.proposal, middle_.metric, middle_constants_);
    const CellVerdict verdict = check_cell(forms, setting_.metric, constants_, middle_.metric,
                                           middle_constants_, proposal.multiplier);
    // cannot bind (least_along, mean_real): the form divides by `mean.real`, and by z1 all the way to where
    // corrections reach along it. So neither is zero in a cell whose inequality holds, and at s = 0 both are
    // 1; where all cells hold they are positive in all. These two keep a cell from being believed by itself.
    here.holds = verdict.holds && certainly_positive(forms.over.least_along) &&
                 certainly_positive(forms.over.mean_real);
    here.rate_squared = proposal.rate_squared;
    here.widest = widest(forms.half_widths, verdict.influence);
  }

  /// How far corrections reach in the cell, or infinity.
  void set_reach(Cell& cell) const {
    const Interval none(0.0);
    const PolarStepForm<Interval, Interval> form = polar_step_form<Interval, Interval>(
        setting_, {cell.side(kScale), cell.side(kBeta), Interval(1.0), none, none, none, {none, none}});
    for (std::size_t i = 0; i < 2; ++i) {
      cell.reach[i] =
          rigor::is_finite(form.reach[i]) ? form.reach[i].upper() : std::numeric_limits<double>::infinity();
    }
  }

  [[nodiscard]] CellForms forms_of(const Cell& cell) const {
    const RayCell<double, double> middle = middle_ray(cell);
    const Interval axis_cosine(middle.axis_cosine);
    const Interval axis_sine(middle.axis_sine);
    const std::array<Interval, 2> reach{Interval(cell.reach[0]), Interval(cell.reach[1])};
    const auto variable = [&](std::size_t i) { return Derivatives(cell.side(i), unit(i)); };
    CellForms forms;
    forms.proposal = polar_step_form(middle_, middle);
    forms.middle = polar_step_form<Interval, Interval>(
        setting_, {Interval(middle.scale), Interval(middle.beta), axis_cosine, axis_sine,
                   Interval(middle.along), Interval(middle.across), reach});
    forms.over = polar_step_form<Interval, Derivatives>(
        setting_, {variable(kScale), variable(kBeta), axis_cosine, axis_sine, variable(kAlong),
                   variable(kAcross), reach});
    forms.half_widths = half_widths(cell);
    forms.tangent_squared = tangent_squared_from(axis_cosine, axis_sine, cell.low[kBeta], cell.high[kBeta]);
    return forms;
  }

  static std::array<Interval, kCellVariables> unit(std::size_t i) {
    std::array<Interval, kCellVariables> result;
    result.fill(Interval(0.0));
    result[i] = Interval(1.0);
    return result;
  }

  static std::array<double, kCellVariables> half_widths(const Cell& cell) {
    std::array<double, kCellVariables> result{};
    for (std::size_t i = 0; i < kCellVariables; ++i) {
      const Interval middle_of_side(cell.middle(i));
      result[i] = std::max((Interval(cell.high[i]) - middle_of_side).upper(),
                           (middle_of_side - Interval(cell.low[i])).upper());
    }
    return result;
  }

  /// The side to bisect: where the matrix moves most, or, when nothing is known of that, where the cell is
  /// largest. A matter of speed only.
  [[nodiscard]] static std::size_t widest(const std::array<double, kCellVariables>& half_widths,
                                          const std::array<double, kCellVariables>& influence) {
    std::array<double, kCellVariables> weights = influence;
    const bool known =
        std::all_of(weights.begin(), weights.end(),
                    [](double weight) { return std::isfinite(weight) && weight >= 0.0; }) &&
        std::any_of(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; });
    if (!known) {
      weights = {half_widths[kScale], half_widths[kBeta], 0.1 * half_widths[kAlong],
                 0.1 * half_widths[kAcross]};
    }
    return static_cast<std::size_t>(
        std::distance(weights.begin(), std::max_element(weights.begin(), weights.end())));
  }

  // ---- several cells

  void look_at_together(OpenCell* open, int count) const {
    CellBatch batch{};
    batch.count = count;
    set_reach(open, batch);
    for (int column = 0; column < CellBatch::kMost; ++column) {
      propose(open[std::min(column, count - 1)], batch, column);  // columns left over have copies
    }
    CellAnswers answers{};
    const bool wide = instructions_ == InstructionSet::avx512;
    (wide ? detail::check_cells_avx512 : detail::check_cells_avx2)(setting_, constants_, batch, answers);
    for (int column = 0; column < count; ++column) {
      std::array<double, kCellVariables> influence{};
      std::array<double, kCellVariables> widths{};
      for (std::size_t i = 0; i < kCellVariables; ++i) {
        influence[i] = answers.influence[i][column];
        widths[i] = batch.half_width[i][column];
      }
      open[column].holds = answers.holds[column];
      open[column].widest = widest(widths, influence);
    }
  }

  static void write_sides(const Cell& cell, CellBatch& batch, int column) {
    for (std::size_t i = 0; i < kCellVariables; ++i) {
      batch.low[i][column] = cell.low[i];
      batch.high[i][column] = cell.high[i];
    }
  }

  /// Cells of one generation have their reach all, or none has.
  void set_reach(OpenCell* open, CellBatch& batch) const {
    if (open[0].has_reach) {
      return;
    }
    for (int column = 0; column < CellBatch::kMost; ++column) {
      write_sides(open[std::min(column, batch.count - 1)].cell, batch, column);
    }
    CellReach found{};
    const bool wide = instructions_ == InstructionSet::avx512;
    (wide ? detail::reach_of_cells_avx512 : detail::reach_of_cells_avx2)(setting_, batch, found);
    for (int column = 0; column < batch.count; ++column) {
      open[column].cell.reach = {found.reach[0][column], found.reach[1][column]};
    }
  }

  /// A column of the batch.
  void propose(OpenCell& open, CellBatch& batch, int column) const {
    const Cell& cell = open.cell;
    const RayCell<double, double> middle = middle_ray(cell);
    const PolarStepForm<double, double> form = polar_step_form(middle_, middle);
    const RayRate proposal = propose_rate(form, middle_.metric, middle_constants_);
    const double tangent_squared = tangent_squared_from(
        Interval(middle.axis_cosine), Interval(middle.axis_sine), cell.low[kBeta], cell.high[kBeta]);
    const double tau = propose_angle_multiplier(form, middle_.metric, middle_constants_, proposal.multiplier,
                                                tangent_squared);
    const std::array<double, kCellVariables> widths = half_widths(cell);
    write_sides(cell, batch, column);
    for (std::size_t i = 0; i < kCellVariables; ++i) {
      batch.middle[i][column] = cell.middle(i);
      batch.half_width[i][column] = widths[i];
    }
    batch.axis_cosine[column] = middle.axis_cosine;
    batch.axis_sine[column] = middle.axis_sine;
    batch.reach[0][column] = cell.reach[0];
    batch.reach[1][column] = cell.reach[1];
    batch.multiplier[column] = proposal.multiplier;
    batch.angle_multiplier[column] = tau > 0.0 ? tau : 0.0;
    batch.tangent_squared[column] = tau > 0.0 ? tangent_squared : 0.0;
    open.rate_squared = proposal.rate_squared;
  }

  StepSetting<Interval> setting_;
  StepConstants<Interval> constants_;
  StepSetting<double> middle_;
  StepConstants<double> middle_constants_;
  InstructionSet instructions_;
};

}  // namespace

double tangent_squared_from(const Interval& axis_cosine, const Interval& axis_sine, double low, double high) {
  double largest = 0.0;
  for (const double beta : {low, high}) {
    const auto [sine, cosine] = rigor::sin_cos(Interval(beta));
    const Interval along = cosine * axis_cosine + sine * axis_sine;
    if (!certainly_positive(along)) {
      return std::numeric_limits<double>::infinity();
    }
    const Interval across = sine * axis_cosine - cosine * axis_sine;
    largest = std::max(largest, rigor::square(across / along).upper());
  }
  return largest;
}

InstructionSet instructions_for_cells() {
#ifdef VERITRACK_MUTATION
  return InstructionSet::sse2;  // the guards of a proof are those of single cells
#else
  return trackers::widest_instruction_set();
#endif
}

ContractionOverSet prove_contraction(const StepSetting<Interval>& setting,
                                     const StepConstants<Interval>& constants, InstructionSet set) {
  constexpr int kScales = 8;
  constexpr int kAngles = 16;
  constexpr int kDepth = 20;
  rigor::require_upward_rounding();
  if (!trackers::has(set)) {
    throw std::invalid_argument("this processor lacks the instructions");
  }
  // The last node lies beyond pi by less than an ulp, which does no harm.
  const double end = rigor::pi().upper();
  std::vector<OpenCell> cells;
  for (int i = 0; i < kScales; ++i) {
    for (int j = 0; j < kAngles; ++j) {
      cells.push_back(
          {{{static_cast<double>(i) / kScales, end * (static_cast<double>(j) / kAngles), -1.0, -1.0},
            {static_cast<double>(i + 1) / kScales, end * (static_cast<double>(j + 1) / kAngles), 1.0, 1.0},
            {}}});
    }
  }
  return Cover(setting, constants, set).judge(std::move(cells), kDepth);
}

}  // namespace veritrack::quadrature
