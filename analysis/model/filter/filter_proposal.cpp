#include "analysis/model/filter/filter_proposal.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/model/filter/filter_fit.hpp"
#include "analysis/model/filter/filter_long_run.hpp"
#include "analysis/model/filter/filter_search.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::model {

namespace {

using detail::FilterOnOrbit;
using detail::FilterOrbit;
using detail::FilterParameters;
using detail::FilterSearch;
using detail::FilterWorth;
using detail::LongRunSearch;
using detail::matrix_of_triangle;
using detail::memory_of;
using detail::PhaseFit;
using detail::Surroundings;
using detail::triangle_of;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Bounds and shape on a grid of phases at one frequency: a column for each phase, of lower triangles.
struct FilterOnGrid {
  MatrixXd low, high, shape;
};

std::optional<FilterOnGrid> on_grid(const TrackedTone& tone, const NodeCurve& curve,
                                    const FilterParameters& parameters, int memory, int phases,
                                    const Surroundings& around, const MatrixXcd& slope) {
  const Index n = tone.filter->states;
  FilterOnGrid grid{MatrixXd(n * (n + 1) / 2, phases), MatrixXd(n * (n + 1) / 2, phases),
                    MatrixXd(n * (n + 1) / 2, phases)};
  std::vector<char> is_known(static_cast<std::size_t>(phases), 1);
  tbb::parallel_for(0, phases, [&](int j) {
    FilterOrbit orbit(tone, curve, parameters, around, &slope);
    const double phase = 2.0 * std::numbers::pi * j / phases;
    orbit.begin(phase - memory * curve.frequency);
    for (int k = 0; k < memory; ++k) {
      if (!orbit.step()) {
        is_known[static_cast<std::size_t>(j)] = 0;
        return;
      }
    }
    const FilterOnOrbit& here = orbit.here();
    grid.low.col(j) = triangle_of(here.low);
    grid.high.col(j) = triangle_of(here.high);
    const auto root = rigor::cholesky(here.shape);
    if (!root) {
      is_known[static_cast<std::size_t>(j)] = 0;
      return;
    }
    grid.shape.col(j) = triangle_of(*root);
  });
  const bool all = std::all_of(is_known.begin(), is_known.end(), [](char known) { return known != 0; });
  return all && grid.low.allFinite() && grid.high.allFinite() && grid.shape.allFinite() ? std::optional(grid)
                                                                                        : std::nullopt;
}

/// |L^-1 (a - b) L^-T| for L L' = b: the distance of a from b in units of b.
double mismatch(const MatrixXd& a, const MatrixXd& b) {
  const auto root = rigor::cholesky(b);
  if (!root) {
    return std::numeric_limits<double>::infinity();
  }
  const double size =
      rigor::largest_absolute_eigenvalue(rigor::in_units_of(*root, rigor::combination(1.0, a, -1.0, b)));
  return std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
}

/// The matrices of a tube as series.
struct FilterFits {
  PhaseFit low, high, shape;
};

/// The grids of a cell: at the nodes, and between them to judge.
class FilterGrids {
 public:
  FilterGrids(const TrackedTone& tone, const CurveFit& curve, const FilterParameters& parameters, int memory,
              const Surroundings& around)
      : tone_(&tone), curve_(&curve), parameters_(&parameters), memory_(memory), around_(around) {}
  /// False when there is no tube on one of them.
  [[nodiscard]] bool compute(int most_harmonics) {
    for (std::size_t j = 0; j < low_.size(); ++j) {
      const auto grid = at(node_places().at(j), 2 * most_harmonics + 1);
      if (!grid) {
        return false;
      }
      low_.at(j) = grid->low;
      high_.at(j) = grid->high;
      shape_.at(j) = grid->shape;
    }
    for (const double z : {-1.0, 0.0, 0.6, 1.0}) {
      auto grid = at(z, 31);
      if (!grid) {
        return false;
      }
      judges_.emplace_back(z, *std::move(grid));
    }
    return true;
  }
  [[nodiscard]] FilterFits fits(int harmonics, double scale) const {
    return {detail::fit_of(low_, harmonics, 1.0), detail::fit_of(high_, harmonics, 1.0),
            detail::fit_of(shape_, harmonics, scale)};
  }
  /// Their loss between the nodes, in units of the admissible loss.
  [[nodiscard]] double loss_of(const FilterFits& fits, double scale) const {
    double worst = 0.0;
    for (const auto& judge : judges_) {  // clang 14 captures no structured binding
      const double z = judge.first;
      const FilterOnGrid& exact = judge.second;
      for (Index j = 0; j < exact.low.cols(); ++j) {
        const double phase =
            2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(exact.low.cols());
        const auto matrix_in = [n = tone_->filter->states, z, phase](const PhaseFit& fit, bool is_symmetric) {
          return matrix_of_triangle(detail::value_of(fit, z, phase), n, is_symmetric);
        };
        const auto exact_of = [n = tone_->filter->states, j](const MatrixXd& grid, bool is_symmetric) {
          return matrix_of_triangle(grid.col(j), n, is_symmetric);
        };
        const MatrixXd u = matrix_in(fits.shape, false);
        const MatrixXd exact_u = exact_of(exact.shape, false) * scale;
        constexpr double kOfBounds = 0.2 * detail::kSlack;
        constexpr double kOfShape = 0.01;
        worst = std::max(
            {worst, mismatch(matrix_in(fits.low, true), exact_of(exact.low, true)) / kOfBounds,
             mismatch(matrix_in(fits.high, true), exact_of(exact.high, true)) / kOfBounds,
             mismatch(rigor::product_with_transpose(u, u), rigor::product_with_transpose(exact_u, exact_u)) /
                 kOfShape});
      }
    }
    return worst;
  }

 private:
  [[nodiscard]] std::optional<FilterOnGrid> at(double z, int phases) const {
    return on_grid(*tone_, curve_->at(z), *parameters_, memory_, phases, {around_.tube, around_.radius, z},
                   curve_->slope_at(z));
  }

  const TrackedTone* tone_;
  const CurveFit* curve_;
  const FilterParameters* parameters_;
  int memory_;
  Surroundings around_;
  std::array<MatrixXd, kNodes> low_, high_, shape_;
  std::vector<std::pair<double, FilterOnGrid>> judges_;
};

Tube tube_of(const TrackedTone& tone, const CurveFit& curve, const FilterFits& fits) {
  const Index n = tone.filter->states;
  Tube tube;
  tube.frequency = curve.frequency;
  tube.half_width = curve.half_width;
  tube.amplitude = tone.amplitude;
  tube.turns.assign(static_cast<std::size_t>(n), 0);
  PhaseFit of_estimate;
  for (std::size_t d = 0; d < of_estimate.size(); ++d) {
    of_estimate.at(d) = curve.coefficients.at(d).topRows(n);
  }
  tube.curve = detail::series_of_fit(of_estimate);
  tube.covariance_low = detail::series_of_fit(fits.low);
  tube.covariance_high = detail::series_of_fit(fits.high);
  tube.shape = detail::series_of_fit(fits.shape);
  return tube;
}

/// Fills in the tube of these parameters and their worth, or says that the cell is too wide. `around`: as for
/// an orbit; its z is not read. `unit`: of the levels, rad/sample.
void fit_tube(const TrackedTone& tone, const CurveFit& curve, const FilterParameters& parameters, double rate,
              const FilterWorth& worth, double unit, const Surroundings& around, TubeProposal& proposal) {
  proposal.outcome = TubeOutcome::no_common_shape;
  proposal.loss = INFINITY;
  if (!(worth.growth < 1.3)) {
    return;
  }
  constexpr double kForgotten = 1e-6;
  FilterGrids grids(tone, curve, parameters, memory_of(rate * rate, parameters, kForgotten), around);
  const int most_harmonics = std::max<int>(24, 2 * static_cast<int>(curve.coefficients[0].cols()));
  if (!grids.compute(most_harmonics)) {
    return;
  }
  proposal.outcome = TubeOutcome::cell_too_wide;
  // The fewest harmonics that lose hardly anything.
  std::optional<FilterFits> found;
  for (int harmonics = 2; harmonics <= most_harmonics && !found; harmonics += 2) {
    FilterFits fits = grids.fits(harmonics, 1.0 / unit);
    const double loss = grids.loss_of(fits, 1.0 / unit);
    proposal.loss = std::min(proposal.loss, loss);
    if (loss <= 1.0) {
      found = std::move(fits);
      proposal.shape.harmonics = harmonics;
    }
  }
  if (!found) {
    return;
  }
  proposal.worth.level = unit;
  proposal.worth.reach = worth.most_reach;
  proposal.worth.least_reach = worth.least_reach;
  proposal.worth.noise = parameters.noise;
  proposal.worth.slew = parameters.slew;
  proposal.worth.rate = std::min(worth.linear, 0.999);
  proposal.shape.worth = proposal.worth;
  proposal.tube = tube_of(tone, curve, *found);
  proposal.outcome = TubeOutcome::proposed;
}

}  // namespace

void propose_filter_tube(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings,
                         const std::optional<ShapeParameters>& nearby, bool keep, TubeProposal& proposal) {
  const rigor::NearestRounding nearest;
  const double rate = proposal.steady_state.rate;
  if (!(rate < 1.0) || tone.filter->states > detail::kMostStates) {
    proposal.outcome = TubeOutcome::no_shape;
    return;
  }
  FilterSearch search(tone, curve, settings, rate);
  const bool keeps = keep && nearby && nearby->of_filter.size() == search.coordinates().size();
  const std::optional<VectorXd> point =
      keeps ? std::optional(nearby->of_filter) : search.run(nearby ? nearby->of_filter : VectorXd());
  if (!point) {
    proposal.outcome = TubeOutcome::no_common_shape;
    return;
  }
  proposal.shape.parameters.of_filter = *point;
  const FilterParameters parameters = search.coordinates().at(*point);
  constexpr int kSamples = 64;
  const FilterWorth worth = search.worth_at(parameters, kSamples);
  // Neighbouring tubes of equal parameters fit together if their units are equal.
  const double unit = keeps ? nearby->unit_of_filter : worth.most_reach;
  proposal.shape.parameters.unit_of_filter = unit;
  fit_tube(tone, curve, parameters, rate, worth, unit, {}, proposal);
}

TubeProposal propose_long_run_tube(const TrackedTone& tone, const Tube& around, double radius, double noise,
                                   const ShapeParameters& of_around,
                                   const std::optional<ShapeParameters>& nearby) {
  const rigor::NearestRounding nearest;
  TubeProposal proposal;
  proposal.frequency = around.frequency;
  proposal.half_width = around.half_width;
  proposal.steady_state = find_steady_state(tone, around.frequency, {});
  const double rate = proposal.steady_state.rate;
  if (proposal.steady_state.outcome != SteadyStateOutcome::settled || !(rate < 1.0)) {
    return proposal;
  }
  constexpr double kNegligible = 1e-13;
  const auto curve = fit_curve(tone, around.frequency, around.half_width, proposal.steady_state, kNegligible);
  if (!curve) {
    proposal.outcome = TubeOutcome::no_curve;
    return proposal;
  }
  TubeSettings settings;
  settings.shape.objective = ShapeObjective::largest_noise;
  settings.shape.noise = noise;
  const FilterSearch coordinates(tone, *curve, settings, rate);
  constexpr int kEvaluations = 80;
  const LongRunSearch search(tone, *curve, coordinates.coordinates(), around, radius, kEvaluations);
  const std::optional<VectorXd> point =
      search.run(of_around.of_filter, nearby ? nearby->of_filter : VectorXd());
  proposal.outcome = TubeOutcome::cell_too_wide;
  if (point) {
    proposal.shape.parameters.of_filter = *point;
    const FilterParameters parameters = coordinates.coordinates().at(*point);
    constexpr int kSamples = 64;
    const FilterWorth worth = search.worth_at(parameters, kSamples);
    fit_tube(tone, *curve, parameters, rate, worth, worth.most_reach, {&around, radius, 0.0}, proposal);
  }
  if (proposal.tube) {
    proposal.tube->curve = around.curve;
  }
  return proposal;
}

}  // namespace veritrack::model
