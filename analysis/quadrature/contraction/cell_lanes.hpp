// A batch of cells in registers of some width: part of cell_batch.hpp. Each unit that includes this one is
// compiled for one set of instructions, and calls it with its own number of lanes; all types that depend on
// the set have that number as a parameter, so that the linker cannot replace a function of one unit by that
// of another.
#pragma once

#include <array>

#include "analysis/quadrature/contraction/cell_batch.hpp"
#include "analysis/rigor/mean_value_lanes.hpp"

namespace veritrack::quadrature::detail {

/// The numbers of a whole set, in every lane, and the cells of `Lanes` columns from `first` on.
template <int Lanes>
class CellLanes {
 public:
  using R = rigor::Registers<Lanes>;
  using Numbers = typename R::Numbers;
  using Mask = typename R::Mask;
  using Set = rigor::IntervalLanes<Lanes>;
  using Slopes = rigor::Dual<Set, kCellVariables>;

  CellLanes(const StepSetting<rigor::Interval>& s, const CellBatch& cells, int first)
      : cells_(cells), first_(first) {
    setting_ = {
        {Set(s.design.q1), Set(s.design.q2), Set(s.design.r), Set(s.design.epsilon)},
        {Set(s.metric.amplitude), Set(s.metric.phase), Set(s.metric.coupling), Set(s.metric.frequency)},
        block(s.covariance_lower),
        block(s.covariance_upper),
        Set(s.largest_amplitude),
        Set(s.largest_chi),
        Set(s.noise)};
  }

  void reach(CellReach& found) const {
    const Set none(0.0);
    const PolarStepForm<Set, Set> form =
        polar_step_form<Set, Set>(setting_, {side(0), side(1), Set(1.0), none, none, none, {none, none}});
    for (int i = 0; i < 2; ++i) {
      R::store(found.reach[i] + first_, rigor_finite_upper(form.reach[static_cast<std::size_t>(i)]));
    }
  }

  void check(const StepConstants<rigor::Interval>& given, CellAnswers& answers) const {
    const StepConstants<Set> constants{Set(given.rate_squared), Set(given.noise_gain_squared),
                                       Set(given.slew_gain_squared), given.noisy, given.slewing};
    const Set lambda = point(cells_.multiplier);
    const Set axis_cosine = point(cells_.axis_cosine);
    const Set axis_sine = point(cells_.axis_sine);
    const std::array<Set, 2> reach{point(cells_.reach[0]), point(cells_.reach[1])};
    const PolarStepForm<Set, Set> middle = polar_step_form<Set, Set>(
        setting_, {point(cells_.middle[0]), point(cells_.middle[1]), axis_cosine, axis_sine,
                   point(cells_.middle[2]), point(cells_.middle[3]), reach});
    const PolarStepForm<Set, Slopes> over = polar_step_form<Set, Slopes>(
        setting_, {variable(0), variable(1), axis_cosine, axis_sine, variable(2), variable(3), reach});
    const ReducedForm<Set, Set> reduced_middle = reduced_form(middle, setting_.metric, constants, lambda);
    const ReducedForm<Set, Slopes> reduced_over = reduced_form(over, setting_.metric, constants, lambda);
    const Mask asked =
        R::both(certainly_positive(lambda), R::both(certainly_positive(reduced_over.noise_pivots[0]),
                                                    certainly_positive(reduced_over.noise_pivots[1])));
    rigor::LaneTriangle<6, Lanes> at_middle =
        remaining_matrix(middle, setting_.metric, constants, reduced_middle);
    // Where tau is zero so is the tangent here, and nothing is added.
    add_angle(at_middle, point(cells_.angle_multiplier), point(cells_.tangent_squared));
    std::array<rigor::LaneNumbers<Lanes>, kCellVariables> half_widths;
    for (std::size_t i = 0; i < kCellVariables; ++i) {
      half_widths[i].at = R::load(cells_.half_width[i] + first_);
    }
    std::array<rigor::LaneNumbers<Lanes>, kCellVariables> influence;
    Mask holds = rigor::certainly_definite_over_lanes<6, Lanes, kCellVariables>(
        asked, at_middle, remaining_matrix(over, setting_.metric, constants, reduced_over), half_widths,
        influence);
    holds = R::both(holds, R::both(certainly_positive(over.least_along), certainly_positive(over.mean_real)));
    const unsigned bits = R::bits(holds);
    for (int lane = 0; lane < Lanes; ++lane) {
      answers.holds[first_ + lane] = ((bits >> static_cast<unsigned>(lane)) & 1U) != 0U;
    }
    for (std::size_t i = 0; i < kCellVariables; ++i) {
      R::store(answers.influence[i] + first_, influence[i].at);
    }
  }

 private:
  static BlockCovariance<Set> block(const BlockCovariance<rigor::Interval>& p) {
    return {Set(p.p11), Set(p.p22), Set(p.p23), Set(p.p33)};
  }
  [[nodiscard]] Set point(const double* column) const { return Set::at(R::load(column + first_)); }
  [[nodiscard]] Set side(std::size_t i) const {
    return Set::load(cells_.low[i] + first_, cells_.high[i] + first_);
  }
  [[nodiscard]] Slopes variable(std::size_t i) const {
    std::array<Set, kCellVariables> unit;
    unit.fill(Set(0.0));
    unit[i] = Set(1.0);
    return Slopes(side(i), unit);
  }
  /// NaN where x is not finite.
  [[nodiscard]] static Numbers rigor_finite_upper(const Set& x) { return only(is_finite(x), x).upper(); }

  const CellBatch& cells_;
  int first_;
  StepSetting<Set> setting_;
};

/// All columns of the batch, which are filled up.
template <int Lanes>
void check_cells(const StepSetting<rigor::Interval>& setting, const StepConstants<rigor::Interval>& constants,
                 const CellBatch& cells, CellAnswers& answers) {
  for (int first = 0; first < cells.count; first += Lanes) {
    CellLanes<Lanes>(setting, cells, first).check(constants, answers);
  }
}

template <int Lanes>
void reach_of_cells(const StepSetting<rigor::Interval>& setting, const CellBatch& cells, CellReach& found) {
  for (int first = 0; first < cells.count; first += Lanes) {
    CellLanes<Lanes>(setting, cells, first).reach(found);
  }
}

}  // namespace veritrack::quadrature::detail
