#include "analysis/quadrature/leak/steady_contraction.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "analysis/quadrature/leak/steady_multipliers.hpp"
#include "analysis/quadrature/leak/steady_setting.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// Walks the cells of one level depth first.
class Cover {
 public:
  Cover(const SteadySettings& settings, double level, double next, const SteadyDisturbance& disturbance,
        std::int64_t most_cells, SteadyDivision& division)
      : settings_(settings),
        middle_(convert<double>(settings.over_cell)),
        level_(level),
        rate_(Interval(next) / Interval(level)),
        disturbance_(disturbance),
        most_cells_(most_cells),
        division_(division) {}

  /// Every cell maps into the next level. Otherwise the reason says where one cannot be proved to.
  [[nodiscard]] SteadyContraction all() {
    constexpr int kDepth = 18;
    constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();  // skipped cells are free
    const Part whole{{{-1.0, -1.0}, {1.0, 1.0}}, SteadyDivision::kWhole, kDepth};
    const auto look = [this](const Part& part) { return look_at(part); };
    SteadyContraction over;
    over.proved = search::cover_by_bisection(whole, kUnlimited, look).is_proved;
    over.reason = reason_;
    over.cells = cells_;
    return over;
  }

 private:
  /// A cell, and where the division knows it.
  struct Part {
    SteadyCell cell;
    std::size_t node;
    int halvings_left;
  };

  [[nodiscard]] search::CellDecision<Part> look_at(const Part& part) {
    const SteadyCell& cell = part.cell;
    if (cell.is_outside()) {
      return {true};
    }
    if (division_.skips(part.node, level_)) {
      return {false, halves_of(part)};
    }
    if (++cells_ > most_cells_) {
      reason_ = "more than " + std::to_string(most_cells_) + " cells were needed.";
      return {};
    }
    const CellOutcome outcome = try_cell(cell);
    if (outcome.contracts) {
      division_.close(part.node);
      return {true};
    }
    const SteadyOrder& order = outcome.order;
    const bool fails_inside = order.hopeless || (order.kept && !may_contract(cell));
    const bool hopeless =
        part.halvings_left == 0 || (fails_inside && std::hypot(cell.middle(kX), cell.middle(kY)) <= 1.0);
    if (hopeless) {
      reason_ = "at level " + rigor::to_decimal(level_, 3, rigor::Direction::up) +
                (order.kept ? " of the set a step could not be proved to contract, or to tolerate the noise."
                            : " of the set the covariance could not be proved to stay between its bounds.");
      return {};
    }
    division_.open(part.node, level_, side_to_cut(cell, order.kept ? outcome.blur : order.blur));
    return {false, halves_of(part)};
  }

  /// How one cell fared.
  struct CellOutcome {
    bool contracts = false;
    SteadyOrder order;
    Interval left;  ///< what slew, rounding and the remainder of noise and gain leave of the rate
    std::array<double, 2> blur{};  ///< of the image: the widths of its slopes
  };

  /// Does every step from the cell lead to the next level?
  [[nodiscard]] CellOutcome try_cell(const SteadyCell& cell) {
    const SteadySecant level_of_all{Interval(level_)};
    const SteadySecant x = SteadySecant::variable(cell.side(kX), cell.middle(kX), kX);
    const SteadySecant y = SteadySecant::variable(cell.side(kY), cell.middle(kY), kY);
    const SteadyStep<SteadySecant> secants =
        steady_step(settings_.secants, {level_of_all, x, y}, image_over(cell, x));
    const SteadyOffset box = offset_box(cell, settings_.frequencies);
    const SteadyStep<Interval> step = enclosure(secants, box);
    const std::vector<SteadyOffset> corners = corner_offsets(cell, settings_.frequencies);
    const Interval level(level_);
    const SteadyBounds<Interval> bounds = steady_bounds(step, settings_.over_cell, level, disturbance_.noise);
    CellOutcome outcome;
    outcome.left = Interval((rate_ - bounds.remainder - disturbance_.motion / level).lower());
    const Interval share((rate_ - disturbance_.covariance_motion / level).lower());
    outcome.order = keeps_covariance(settings_, corners, box, secants, level_, bounds.tangent_reach, share);
    for (const std::size_t variable : {kX, kY}) {
      for (const SteadySecant& entry : secants.image) {
        outcome.blur[variable] += width(entry.slope(variable));
      }
    }
    // cannot bind (along, swing): in the middle of a level `along` is the component that least_along bounds,
    // and the step divides by it, so that it is zero nowhere in a level whose cells all hold; and where both
    // are positive the phase before a step, its turn and the phase after it differ by a multiple of a turn
    // that is continuous, and zero in the middle. These two keep a cell from being believed by itself.
    outcome.contracts = outcome.order.kept && certainly_positive(outcome.left) &&
                        certainly_positive(bounds.least_along) && certainly_positive(step.along) &&
                        certainly_less(abs(step.swing), Interval(1.5)) &&
                        contracts_by(square(outcome.left), secants, step, bounds, cell, corners);
    return outcome;
  }

  /// Cut where the covariance, if it is what fails, or else the image is blurred the most.
  static std::size_t side_to_cut(const SteadyCell& cell, const std::array<double, 2>& blur) {
    const double blur_x = blur[kX] * cell.width(kX);
    const double blur_y = blur[kY] * cell.width(kY);
    const bool known = std::isfinite(blur_x + blur_y) && blur_x + blur_y > 0.0;
    return (known ? blur_x >= blur_y : cell.width(kX) >= cell.width(kY)) ? kX : kY;
  }

  /// Where the division cuts it.
  [[nodiscard]] std::array<Part, 2> halves_of(const Part& whole) const {
    const std::size_t side = division_.side(whole.node);
    const std::size_t first = division_.first_part(whole.node);
    Part low{whole.cell, first, whole.halvings_left - 1};
    Part high{whole.cell, first + 1, whole.halvings_left - 1};
    low.cell.high[side] = high.cell.low[side] = whole.cell.middle(side);
    return {low, high};
  }

  /// The covariance_image of the cell, which it shares with all that have the same range of x.
  const CovarianceImage<SteadySecant>& image_over(const SteadyCell& cell, const SteadySecant& x) {
    const auto [found, is_new] = images_.try_emplace({cell.low[kX], cell.high[kX]});
    if (is_new) {
      found->second = covariance_image(settings_.secants, SteadySecant(Interval(level_)), x);
    }
    return found->second;
  }

  /// By multipliers that have served another cell, or by new ones.
  [[nodiscard]] bool contracts_by(const Interval& rate_squared, const SteadyStep<SteadySecant>& secants,
                                  const SteadyStep<Interval>& step, const SteadyBounds<Interval>& bounds,
                                  const SteadyCell& cell, const std::vector<SteadyOffset>& corners) {
    const auto contracts = [&] {
      return certainly_contracts(secants, bounds, hidden_image(settings_.over_cell), cell,
                                 square(disturbance_.noise / Interval(level_)), corners, rate_squared,
                                 multipliers_);
    };
    if (contracts()) {
      return true;
    }
    SteadyCellReach reach;
    reach.reach = sample_of(cell).reach;
    reach.reach.eta_squared = (bounds.eta_factor * step.eta_squared + bounds.eta_rest).upper();
    const auto slopes = middle_slopes(secants);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      reach.slopes.row(i) << slopes[kX][k], slopes[kY][k];
    }
    reach.middle << cell.middle(kX), cell.middle(kY);
    reach.size_squared = 0.25 * (cell.width(kX) * cell.width(kX) + cell.width(kY) * cell.width(kY));
    multipliers_ = propose_cell_rate(reach, rate_squared.lower()).multipliers;
    return contracts();
  }

  /// A step from the middle of a cell, in double.
  struct Sample {
    SteadyBounds<double> bounds;
    SteadyReach reach;
  };
  [[nodiscard]] Sample sample_of(const SteadyCell& cell) const {
    const SteadyStep<double> step = steady_step(middle_, {level_, cell.middle(kX), cell.middle(kY)});
    const double noise = midpoint(disturbance_.noise);
    const SteadyBounds<double> bounds = steady_bounds(step, middle_, level_, noise);
    return {bounds, reach_of(step, bounds, middle_, level_, noise)};
  }

  /// Does a sample see a step from the middle contract?
  [[nodiscard]] bool may_contract(const SteadyCell& cell) const {
    const Sample sample = sample_of(cell);
    const double left = midpoint(rate_) - sample.bounds.remainder - midpoint(disturbance_.motion) / level_;
    return left > 0.0 && propose_rate(sample.reach, 0.0).rate_squared <= left * left;
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
  SteadyDivision& division_;
  SteadyMultipliers multipliers_{};
  std::map<std::pair<double, double>, CovarianceImage<SteadySecant>> images_;  ///< by ranges of x
  std::int64_t cells_ = 0;
  std::string reason_;
};

}  // namespace

bool SteadyDivision::skips(std::size_t node, double level) const {
  constexpr double kLittle = 0.85;
  const Node& cell = nodes_[node];
  if (cell.first == 0) {
    return false;
  }
  const bool parts_hold = nodes_[cell.first].first == 0 && nodes_[cell.first + 1].first == 0;
  return !parts_hold || level > kLittle * cell.failed_at;
}

void SteadyDivision::open(std::size_t node, double level, std::size_t side) {
  nodes_[node].failed_at = level;
  if (nodes_[node].first == 0) {
    nodes_[node].first = nodes_.size();
    nodes_[node].side = side;
    nodes_.resize(nodes_.size() + 2);
  }
}

SteadyContraction prove_contraction(const SteadySettings& settings, double level, double next,
                                    const SteadyDisturbance& disturbance, std::int64_t most_cells,
                                    SteadyDivision& division) {
  rigor::require_upward_rounding();
  return Cover(settings, level, next, disturbance, most_cells, division).all();
}

}  // namespace veritrack::quadrature
