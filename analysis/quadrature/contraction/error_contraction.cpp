#include "analysis/quadrature/contraction/error_contraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

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

/// Walks the cells depth first.
class Cover {
 public:
  Cover(const StepSetting<Interval>& setting, const StepConstants<Interval>& constants)
      : setting_(setting),
        constants_(constants),
        middle_(middle_of(setting)),
        middle_constants_{midpoint(constants.rate_squared), midpoint(constants.noise_gain_squared),
                          midpoint(constants.slew_gain_squared), constants.noisy, constants.slewing} {}

  /// Fills in how far corrections reach in the cell. False when that is not finite.
  bool set_reach(Cell& cell) const {
    const Interval none(0.0);
    const PolarStepForm<Interval, Interval> form = polar_step_form<Interval, Interval>(
        setting_, {cell.side(kScale), cell.side(kBeta), Interval(1.0), none, none, none, {none, none}});
    cell.reach = {form.reach[0].upper(), form.reach[1].upper()};
    return rigor::is_finite(form.reach[0]) && rigor::is_finite(form.reach[1]);
  }

  /// False when a cell cannot be shown to contract; `reason` then says where.
  bool proves(const Cell& cell, int depth) {
    if (++cells_ > kMostCells) {
      reason_ = "more than " + std::to_string(kMostCells) + " cells were needed.";
      return false;
    }
    const CellForms forms = forms_of(cell);
    const RayRate proposal = propose_rate(forms.proposal, middle_.metric, middle_constants_);
    const CellVerdict verdict = check_cell(forms, setting_.metric, constants_, middle_.metric,
                                           middle_constants_, proposal.multiplier);
    // cannot bind (least_along, mean_real): the form divides by `mean.real`, and by z1 all the way to where
    // corrections reach along it. So neither is zero in a cell whose inequality holds, and at s = 0 both are
    // 1; where all cells hold they are positive in all. These two keep a cell from being believed by itself.
    if (verdict.holds && certainly_positive(forms.over.least_along) &&
        certainly_positive(forms.over.mean_real)) {
      return true;
    }
    const bool hopeless = depth == 0 || !(proposal.rate_squared <= middle_constants_.rate_squared);
    if (hopeless) {
      const double beta = cell.middle(kBeta);
      const double a = middle_.largest_amplitude * cell.middle(kScale) * std::cos(beta);
      const double chi = middle_.largest_chi * cell.middle(kScale) * std::sin(beta);
      reason_ = "near amplitude error " + rigor::to_decimal(a, 3, rigor::Direction::up) +
                " and predicted phase error " + rigor::to_decimal(chi, 3, rigor::Direction::up) +
                " rad a step could not be proved to contract, or to tolerate the noise and slew.";
      return false;
    }
    const std::size_t side = widest(forms, verdict);
    Cell first = cell;
    Cell second = cell;
    first.high[side] = second.low[side] = cell.middle(side);
    return proves(first, depth - 1) && proves(second, depth - 1);
  }

  void fail(std::string reason) { reason_ = std::move(reason); }

  [[nodiscard]] ContractionOverSet result(bool proved) const {
    ContractionOverSet over;
    over.proved = proved;
    over.reason = reason_;
    over.cells = cells_;
    return over;
  }

 private:
  static constexpr std::int64_t kMostCells = 12000;

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
    for (std::size_t i = 0; i < kCellVariables; ++i) {
      const Interval middle_of_side(cell.middle(i));
      forms.half_widths[i] = std::max((Interval(cell.high[i]) - middle_of_side).upper(),
                                      (middle_of_side - Interval(cell.low[i])).upper());
    }
    forms.tangent_squared = tangent_squared_from(axis_cosine, axis_sine, cell.low[kBeta], cell.high[kBeta]);
    return forms;
  }

  static std::array<Interval, kCellVariables> unit(std::size_t i) {
    std::array<Interval, kCellVariables> result;
    result.fill(Interval(0.0));
    result[i] = Interval(1.0);
    return result;
  }

  /// The side to bisect: where the matrix moves most, or, when nothing is known of that, where the cell is
  /// largest. A matter of speed only.
  [[nodiscard]] static std::size_t widest(const CellForms& forms, const CellVerdict& verdict) {
    std::array<double, kCellVariables> weights = verdict.influence;
    const bool known =
        std::all_of(weights.begin(), weights.end(),
                    [](double weight) { return std::isfinite(weight) && weight >= 0.0; }) &&
        std::any_of(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; });
    if (!known) {
      weights = {forms.half_widths[kScale], forms.half_widths[kBeta], 0.1 * forms.half_widths[kAlong],
                 0.1 * forms.half_widths[kAcross]};
    }
    return static_cast<std::size_t>(
        std::distance(weights.begin(), std::max_element(weights.begin(), weights.end())));
  }

  StepSetting<Interval> setting_;
  StepConstants<Interval> constants_;
  StepSetting<double> middle_;
  StepConstants<double> middle_constants_;
  std::int64_t cells_ = 0;
  std::string reason_;
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

ContractionOverSet prove_contraction(const StepSetting<Interval>& setting,
                                     const StepConstants<Interval>& constants) {
  constexpr int kScales = 8;
  constexpr int kAngles = 16;
  constexpr int kDepth = 20;
  rigor::require_upward_rounding();
  Cover cover(setting, constants);
  // The last node lies beyond pi by less than an ulp, which does no harm.
  const double end = rigor::pi().upper();
  for (int i = 0; i < kScales; ++i) {
    for (int j = 0; j < kAngles; ++j) {
      Cell cell{
          {static_cast<double>(i) / kScales, end * (static_cast<double>(j) / kAngles), -1.0, -1.0},
          {static_cast<double>(i + 1) / kScales, end * (static_cast<double>(j + 1) / kAngles), 1.0, 1.0},
          {}};
      if (!cover.set_reach(cell)) {
        cover.fail("the set is so large that the estimate may lose its phase.");
        return cover.result(false);
      }
      if (!cover.proves(cell, kDepth)) {
        return cover.result(false);
      }
    }
  }
  return cover.result(true);
}

}  // namespace veritrack::quadrature
