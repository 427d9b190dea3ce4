#include "analysis/quadrature/leak/steady_contraction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quadrature/leak/steady_rate.hpp"
#include "analysis/quadrature/leak/steady_setting.hpp"
#include "analysis/rigor/decimal.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// Walks the cells of one level depth first.
class Cover {
 public:
  Cover(const SteadySettings& settings, double level, double next, const SteadyDisturbance& disturbance,
        std::int64_t most_cells)
      : settings_(settings),
        middle_(convert<double>(settings.over_cell)),
        level_(level),
        rate_(Interval(next) / Interval(level)),
        disturbance_(disturbance),
        most_cells_(most_cells) {}

  /// False when a cell cannot be proved to map into the next level; `reason` then says where.
  bool proves(const SteadyCell& cell, int depth) {
    if (cell.is_outside()) {
      return true;
    }
    if (++cells_ > most_cells_) {
      reason_ = "more than " + std::to_string(most_cells_) + " cells were needed.";
      return false;
    }
    const CellOutcome outcome = try_cell(cell);
    if (outcome.contracts) {
      return true;
    }
    const SteadyOrder& order = outcome.order;
    const bool fails_inside =
        order.hopeless || (order.kept && !may_contract(cell, square(outcome.left).lower()));
    const bool hopeless = depth == 0 || (fails_inside && std::hypot(cell.middle(kX), cell.middle(kY)) <= 1.0);
    if (hopeless) {
      reason_ = "at level " + rigor::to_decimal(level_, 3, rigor::Direction::up) +
                (order.kept ? " of the set a step could not be proved to contract, or to tolerate the noise."
                            : " of the set the covariance could not be proved to stay between its bounds.");
      return false;
    }
    const auto [first, second] = halves(cell, order);
    return proves(first, depth - 1) && proves(second, depth - 1);
  }

  [[nodiscard]] SteadyContraction result(bool proved) const {
    SteadyContraction over;
    over.proved = proved;
    over.reason = reason_;
    over.noise_gain = noise_gain_;
    over.cells = cells_;
    return over;
  }

 private:
  /// How one cell fared.
  struct CellOutcome {
    bool contracts = false;
    SteadyOrder order;
    Interval left;  ///< what noise and slew leave of the rate
  };

  /// Does every step from the cell lead to the next level?
  [[nodiscard]] CellOutcome try_cell(const SteadyCell& cell) {
    const SteadyStep<SteadySecant> secants =
        steady_step(settings_.secants, {SteadySecant(Interval(level_)),
                                        SteadySecant::variable(cell.side(kX), cell.middle(kX), kX),
                                        SteadySecant::variable(cell.side(kY), cell.middle(kY), kY)});
    const SteadyStep<Interval> step = enclosure(secants, offset_box(cell, settings_.frequencies));
    const std::vector<SteadyOffset> corners = corner_offsets(cell, settings_.frequencies);
    const Interval level(level_);
    const SteadyBounds<Interval> bounds = steady_bounds(step, settings_.over_cell, level, disturbance_.noise);
    CellOutcome outcome;
    outcome.left =
        Interval((rate_ - (bounds.noise_gain * disturbance_.noise + disturbance_.motion) / level).lower());
    const Interval share((rate_ - disturbance_.covariance_motion / level).lower());
    outcome.order = keeps_covariance(settings_, corners, secants, level_, bounds.tangent_reach, share);
    // cannot bind (along, swing): in the middle of a level `along` is the component that least_along bounds,
    // and the step divides by it, so that it is zero nowhere in a level whose cells all hold; and where both
    // are positive the phase before a step, its turn and the phase after it differ by a multiple of a turn
    // that is continuous, and zero in the middle. These two keep a cell from being believed by itself.
    outcome.contracts = outcome.order.kept && certainly_positive(outcome.left) &&
                        certainly_positive(bounds.least_along) && certainly_positive(step.along) &&
                        certainly_less(abs(step.swing), Interval(1.5)) &&
                        contracts_by(outcome.left, secants, step, bounds, corners);
    if (outcome.contracts) {
      noise_gain_ = std::max(noise_gain_, bounds.noise_gain.upper());
    }
    return outcome;
  }

  /// Cut where the covariance is blurred the most, or else where the cell is widest.
  static std::pair<SteadyCell, SteadyCell> halves(const SteadyCell& cell, const SteadyOrder& order) {
    const double blur_x = order.blur[kX] * cell.width(kX);
    const double blur_y = order.blur[kY] * cell.width(kY);
    const bool known = std::isfinite(blur_x + blur_y);
    const std::size_t side = (known ? blur_x >= blur_y : cell.width(kX) >= cell.width(kY)) ? kX : kY;
    std::pair<SteadyCell, SteadyCell> both{cell, cell};
    both.first.high[side] = both.second.low[side] = cell.middle(side);
    return both;
  }

  /// By multipliers that have served another cell, or by new ones.
  [[nodiscard]] bool contracts_by(const Interval& left, const SteadyStep<SteadySecant>& secants,
                                  const SteadyStep<Interval>& step, const SteadyBounds<Interval>& bounds,
                                  const std::vector<SteadyOffset>& corners) {
    const Interval rate_squared = square(left);
    const auto contracts = [&] {
      return certainly_contracts(secants, bounds, step.eta_squared, corners, rate_squared, multipliers_);
    };
    if (contracts()) {
      return true;
    }
    multipliers_ = propose_rate(worst_of(secants, step), worst_of(bounds), rate_squared.lower());
    return contracts();
  }

  /// For proposals: what decides at the middle, and the largest eta.
  static SteadyStep<double> worst_of(const SteadyStep<SteadySecant>& secants,
                                     const SteadyStep<Interval>& step) {
    SteadyStep<double> worst;
    for (std::size_t i = 0; i < worst.slope.size(); ++i) {
      worst.slope[i] = midpoint(secants.slope[i].center());
    }
    for (std::size_t i = 0; i < worst.constant.size(); ++i) {
      worst.constant[i] = midpoint(secants.constant[i].center());
    }
    worst.eta_squared = step.eta_squared.upper();
    return worst;
  }
  static SteadyBounds<double> worst_of(const SteadyBounds<Interval>& bounds) {
    const Symmetric<Interval>& g = bounds.gram;
    SteadyBounds<double> worst;
    worst.gram = {g.p11.upper(), midpoint(g.p12), midpoint(g.p13),
                  g.p22.upper(), midpoint(g.p23), g.p33.upper()};
    return worst;
  }

  /// Do samples see a step from the middle contract?
  [[nodiscard]] bool may_contract(const SteadyCell& cell, double rate_squared) const {
    const SteadyStep<double> step = steady_step(middle_, {level_, cell.middle(kX), cell.middle(kY)});
    const SteadyBounds<double> bounds = steady_bounds(step, middle_, level_, midpoint(disturbance_.noise));
    return propose_rate(step, bounds, rate_squared).rate_squared <= rate_squared;
  }

  /// All values over the cell: from the middle, and by interval arithmetic.
  static SteadyStep<Interval> enclosure(SteadyStep<SteadySecant> secants, const SteadyOffset& offset) {
    SteadyStep<Interval> values;
    const auto to = values.entries();
    const auto from = secants.entries();
    for (std::size_t i = 0; i < to.size(); ++i) {
      *to[i] = intersection(from[i]->moved_by(offset), from[i]->range());
    }
    return values;
  }

  const SteadySettings& settings_;
  SteadySetting<double> middle_;
  double level_;
  Interval rate_;
  SteadyDisturbance disturbance_;
  std::int64_t most_cells_;
  SteadyRate multipliers_{};
  double noise_gain_ = 0.0;
  std::int64_t cells_ = 0;
  std::string reason_;
};

}  // namespace

SteadyContraction prove_contraction(const SteadySettings& settings, double level, double next,
                                    const SteadyDisturbance& disturbance, std::int64_t most_cells) {
  constexpr int kDepth = 12;
  rigor::require_upward_rounding();
  Cover cover(settings, level, next, disturbance, most_cells);
  const bool proved = cover.proves({{-1.0, -1.0}, {1.0, 1.0}}, kDepth);
  return cover.result(proved);
}

}  // namespace veritrack::quadrature
