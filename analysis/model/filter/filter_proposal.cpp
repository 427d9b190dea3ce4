#include "analysis/model/filter/filter_proposal.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "analysis/model/filter/filter_long_run.hpp"
#include "analysis/model/filter/filter_search.hpp"
#include "analysis/rigor/decompositions.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using detail::FilterOnOrbit;
using detail::FilterOrbit;
using detail::FilterParameters;
using detail::FilterSearch;
using detail::FilterWorth;
using detail::kSlack;
using detail::LongRunSearch;
using detail::memory_of;
using detail::Surroundings;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Bounds and shape on a grid of phases at one frequency: a column for each phase, of lower triangles.
struct FilterOnGrid {
  MatrixXd low, high, shape;
};

VectorXd triangle_of(const MatrixXd& matrix) {
  const Index n = matrix.rows();
  VectorXd entries(n * (n + 1) / 2);
  Index place = 0;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j <= i; ++j) {
      entries[place++] = matrix(i, j);
    }
  }
  return entries;
}

MatrixXd matrix_of_triangle(const VectorXd& entries, Index n, bool is_symmetric) {
  MatrixXd matrix = MatrixXd::Zero(n, n);
  Index place = 0;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j <= i; ++j) {
      matrix(i, j) = entries[place++];
      if (is_symmetric) {
        matrix(j, i) = matrix(i, j);
      }
    }
  }
  return matrix;
}

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
    const MatrixXd root = Eigen::LLT<detail::Small>(here.shape).matrixL();
    grid.shape.col(j) = triangle_of(root);
  });
  const bool all = std::all_of(is_known.begin(), is_known.end(), [](char known) { return known != 0; });
  return all && grid.low.allFinite() && grid.high.allFinite() && grid.shape.allFinite() ? std::optional(grid)
                                                                                        : std::nullopt;
}

/// Coefficients of z^d, rows x harmonics.
using Fit = std::array<MatrixXcd, kNodes>;

Fit fit_of(const std::array<MatrixXd, kNodes>& values, int harmonics, double scale) {
  std::array<MatrixXcd, kNodes> at_nodes;
  for (std::size_t j = 0; j < at_nodes.size(); ++j) {
    at_nodes.at(j) = harmonics_of(values.at(j), harmonics) * scale;
  }
  Fit fit;
  for (int d = 0; d < kNodes; ++d) {
    MatrixXcd sum = MatrixXcd::Zero(at_nodes[0].rows(), at_nodes[0].cols());
    for (int j = 0; j < kNodes; ++j) {
      sum += node_weights()(d, j) * at_nodes.at(static_cast<std::size_t>(j));
    }
    const double size = at_nodes[0].cwiseAbs().maxCoeff();
    constexpr double kNegligible = 1e-7;
    for (Index i = 0; i < sum.size(); ++i) {
      std::complex<double>& c = sum(i);
      c = std::abs(c) < kNegligible * size
              ? 0.0
              : std::complex<double>(static_cast<float>(c.real()), static_cast<float>(c.imag()));
    }
    fit.at(static_cast<std::size_t>(d)) = sum;
  }
  return fit;
}

VectorXd value_of(const Fit& fit, double z, double phase) {
  MatrixXcd harmonics = fit.back();
  for (int d = kNodes - 2; d >= 0; --d) {
    harmonics = (harmonics * z + fit.at(static_cast<std::size_t>(d))).eval();
  }
  return value_at(harmonics, phase);
}

std::vector<PhaseSeries> series_of_fit(const Fit& fit) {
  std::vector<PhaseSeries> all;
  for (Index row = 0; row < fit[0].rows(); ++row) {
    PhaseSeries series;
    series.coefficients.resize(static_cast<std::size_t>(fit[0].cols()));
    for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
      auto& powers = series.coefficients[h];
      for (const MatrixXcd& matrix : fit) {
        powers.push_back(matrix(row, static_cast<Index>(h)));
      }
      while (!powers.empty() && powers.back() == 0.0) {
        powers.pop_back();
      }
    }
    while (!series.coefficients.empty() && series.coefficients.back().empty()) {
      series.coefficients.pop_back();
    }
    all.push_back(std::move(series));
  }
  return all;
}

/// |L^-1 (a - b) L^-T| for L L' = b: how far a is from b in units of b.
double mismatch(const MatrixXd& a, const MatrixXd& b) {
  const Eigen::LLT<MatrixXd> root(b);
  if (root.info() != Eigen::Success) {
    return std::numeric_limits<double>::infinity();
  }
  MatrixXd difference = root.matrixL().solve(a - b);
  difference = root.matrixL().solve(difference.transpose()).eval();
  return rigor::largest_absolute_eigenvalue(difference);
}

/// Fills in the tube of these parameters and their worth, or says that the cell is too wide. `around`: as for
/// an orbit; its z is not read. `unit`: of the levels, rad/sample.
void fit_tube(const TrackedTone& tone, const CurveFit& curve, const FilterParameters& parameters, double rate,
              const FilterWorth& worth, double unit, const Surroundings& around, TubeProposal& proposal) {
  const Index n = tone.filter->states;
  proposal.outcome = TubeOutcome::no_common_shape;
  proposal.loss = INFINITY;
  if (!(worth.growth < 1.3)) {
    return;
  }
  constexpr double kForgotten = 1e-6;
  const int memory = memory_of(rate * rate, parameters, kForgotten);
  const double scale = 1.0 / unit;
  const int most_harmonics = std::max<int>(24, 2 * static_cast<int>(curve.coefficients[0].cols()));
  const int phases = 2 * most_harmonics + 1;
  const auto on_grid_at = [&](double z, int so_many) {
    return on_grid(tone, curve.at(z), parameters, memory, so_many, {around.tube, around.radius, z},
                   curve.slope_at(z));
  };
  std::array<MatrixXd, kNodes> low;
  std::array<MatrixXd, kNodes> high;
  std::array<MatrixXd, kNodes> shape;
  for (std::size_t j = 0; j < low.size(); ++j) {
    const auto grid = on_grid_at(node_places().at(j), phases);
    if (!grid) {
      return;
    }
    low.at(j) = grid->low;
    high.at(j) = grid->high;
    shape.at(j) = grid->shape;
  }
  // As few harmonics as lose hardly anything, judged between the nodes.
  std::vector<std::pair<double, FilterOnGrid>> judges;
  for (const double z : {-1.0, 0.0, 0.6, 1.0}) {
    auto grid = on_grid_at(z, 31);
    if (!grid) {
      return;
    }
    judges.emplace_back(z, *std::move(grid));
  }
  proposal.outcome = TubeOutcome::cell_too_wide;
  std::optional<std::array<Fit, 3>> found;
  for (int harmonics = 2; harmonics <= most_harmonics && !found; harmonics += 2) {
    std::array<Fit, 3> fit{fit_of(low, harmonics, 1.0), fit_of(high, harmonics, 1.0),
                           fit_of(shape, harmonics, scale)};
    double worst = 0.0;
    for (const auto& judge : judges) {
      const double z = judge.first;
      const FilterOnGrid& exact = judge.second;
      for (Index j = 0; j < exact.low.cols(); ++j) {
        const double phase =
            2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(exact.low.cols());
        const auto of = [&](const Fit& one, bool is_symmetric) {
          return matrix_of_triangle(value_of(one, z, phase), n, is_symmetric);
        };
        const MatrixXd u = of(fit[2], false) / scale;
        const MatrixXd exact_u = matrix_of_triangle(exact.shape.col(j), n, false);
        constexpr double kOfBounds = 0.2 * kSlack;
        constexpr double kOfShape = 0.01;
        worst = std::max(
            {worst, mismatch(of(fit[0], true), matrix_of_triangle(exact.low.col(j), n, true)) / kOfBounds,
             mismatch(of(fit[1], true), matrix_of_triangle(exact.high.col(j), n, true)) / kOfBounds,
             mismatch(u * u.transpose(), exact_u * exact_u.transpose()) / kOfShape});
      }
    }
    proposal.loss = std::min(proposal.loss, worst);
    if (worst <= 1.0) {
      found = std::move(fit);
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
  Tube tube;
  tube.frequency = curve.frequency;
  tube.half_width = curve.half_width;
  tube.amplitude = tone.amplitude;
  tube.turns.assign(static_cast<std::size_t>(n), 0);
  Fit of_estimate;
  for (std::size_t d = 0; d < of_estimate.size(); ++d) {
    of_estimate.at(d) = curve.coefficients.at(d).topRows(n);
  }
  tube.curve = series_of_fit(of_estimate);
  tube.covariance_low = series_of_fit((*found)[0]);
  tube.covariance_high = series_of_fit((*found)[1]);
  tube.shape = series_of_fit((*found)[2]);
  proposal.tube = std::move(tube);
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
