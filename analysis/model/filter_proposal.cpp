#include "analysis/model/filter_proposal.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::model {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the bounds, in units of themselves: what they have to spare.
constexpr double kSlack = 0.006;

/// The parts of a filter in doubles.
class FilterNumbers {
 public:
  explicit FilterNumbers(const TrackedTone& tone)
      : parts_(tone.filter), inputs_(tone.step.constants()), constants_(inputs_.size()) {
    inputs_.resize(constants_ + static_cast<std::size_t>(parts_->states + parts_->samples), 1.0);
    const auto values = trackers::filter_values(*parts_, inputs_);
    const Index n = parts_->states;
    const Index c = parts_->samples;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    measured_ = Eigen::Map<const RowMajor>(values.measured.data(), c, n);
    process_ = Eigen::Map<const RowMajor>(values.process.data(), n, n);
    noise_ = Eigen::Map<const RowMajor>(values.noise.data(), c, c);
    weighted_ = noise_.inverse() * measured_;
  }
  [[nodiscard]] Index states() const { return parts_->states; }
  [[nodiscard]] const MatrixXd& measured() const { return measured_; }
  [[nodiscard]] const MatrixXd& weighted() const { return weighted_; }  ///< R^-1 H
  [[nodiscard]] const MatrixXd& process() const { return process_; }
  [[nodiscard]] MatrixXd jacobian(const VectorXd& estimate) {
    std::copy(estimate.begin(), estimate.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(constants_));
    results_.resize(parts_->program.results().size());
    parts_->program.run(std::span<const double>(inputs_), registers_, std::span<double>(results_));
    const Index n = states();
    MatrixXd f(n, n);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        f(i, j) = results_[static_cast<std::size_t>(n + i * n + j)];
      }
    }
    return f;
  }
  /// The change of F along a direction.
  [[nodiscard]] MatrixXd change(const VectorXd& estimate, const VectorXd& direction) {
    constexpr double kPart = 1e-4;
    return (jacobian(estimate + kPart * direction) - jacobian(estimate - kPart * direction)) / (2.0 * kPart);
  }
  [[nodiscard]] MatrixXd updated(const MatrixXd& predicted) const {
    const MatrixXd cross = measured_ * predicted;
    const MatrixXd result =
        predicted - cross.transpose() * (cross * measured_.transpose() + noise_).ldlt().solve(cross);
    return 0.5 * (result + result.transpose());
  }

 private:
  const trackers::FilterParts* parts_;
  std::vector<double> inputs_, registers_, results_;
  std::size_t constants_;
  MatrixXd measured_, process_, noise_, weighted_;
};

struct FilterParameters {
  double eta = 0.3;
  double theta = 0.3;
  double lambda = 0.9;
  double noise = 0.0;   ///< V
  double source = 0.0;  ///< b
  double spread = 0.0;  ///< d
  VectorXd process;     ///< the diagonal of W
};

/// What is carried along.
struct FilterOnOrbit {
  MatrixXd low, high;  ///< predicted for this sample
  MatrixXd shape;      ///< Pi after it
};

/// What a step is worth.
struct FilterGrowth {
  double whole = 0.0;   ///< |F|, about, for |xi| <= 1
  double linear = 0.0;  ///< of it, without noise
};

class FilterOrbit {
 public:
  FilterOrbit(const TrackedTone& tone, const NodeCurve& curve, const FilterParameters& parameters)
      : tone_(&tone), numbers_(tone), curve_(&curve), parameters_(parameters) {}

  /// At this phase, from the steady state of the filter.
  void begin(double phase) {
    phase_ = phase;
    estimate_ = at(phase);
    const VectorXd state = state_at(*curve_, phase);
    const Index n = numbers_.states();
    MatrixXd covariance(n, n);
    Index place = n;
    for (Index i = 0; i < n; ++i) {
      for (Index j = i; j < n; ++j) {
        covariance(i, j) = covariance(j, i) = state[place++];
      }
    }
    updated_low_ = updated_high_ = covariance;
    here_.shape = parameters_.process.asDiagonal();
    here_.low = here_.high = covariance;
  }
  /// To the next sample; false where bounds or shape are none.
  [[nodiscard]] bool step() {
    const Index n = numbers_.states();
    const MatrixXd f = numbers_.jacobian(estimate_);
    const Eigen::LLT<MatrixXd> root(here_.shape);
    if (root.info() != Eigen::Success || !(here_.shape.maxCoeff() < 1e12)) {
      return false;
    }
    const MatrixXd u = root.matrixL();
    changes_.clear();
    MatrixXd of_high = MatrixXd::Zero(n, n);
    MatrixXd of_low = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
      changes_.push_back(numbers_.change(estimate_, u.col(i)));
      of_high += changes_.back() * updated_high_ * changes_.back().transpose();
      of_low += changes_.back() * updated_low_ * changes_.back().transpose();
    }
    constexpr double kHigherOrders = 1.1;
    of_high *= kHigherOrders;
    of_low *= kHigherOrders;
    const double eta = parameters_.eta;
    const double theta = parameters_.theta;
    FilterOnOrbit next;
    next.high = (1.0 + kSlack) * (numbers_.process() + (1.0 + eta) * f * updated_high_ * f.transpose() +
                                  (1.0 + 1.0 / eta) * of_high);
    next.low = (1.0 - kSlack) * (numbers_.process() + (1.0 - theta) * f * updated_low_ * f.transpose() -
                                 (1.0 / theta - 1.0) * of_low);
    if (Eigen::LLT<MatrixXd>(next.low).info() != Eigen::Success || !(next.high.maxCoeff() < 1e12)) {
      return false;
    }
    updated_high_ = numbers_.updated(next.high);
    updated_low_ = numbers_.updated(next.low);
    const MatrixXd middle = 0.5 * (updated_high_ + updated_low_);
    delta_ = 0.5 * (updated_high_ - updated_low_);
    gain_ = middle * numbers_.weighted().transpose();
    contraction_ = (MatrixXd::Identity(n, n) - gain_ * numbers_.measured());
    const MatrixXd a = contraction_ * f;
    next.shape = a * here_.shape * a.transpose() / parameters_.lambda +
                 parameters_.source * gain_ * gain_.transpose() + parameters_.spread * delta_;
    next.shape.diagonal() += parameters_.process;
    jacobian_ = f;
    before_ = u;
    here_ = std::move(next);
    phase_ += curve_->frequency;
    estimate_ = at(phase_);
    return true;
  }
  [[nodiscard]] const FilterOnOrbit& here() const { return here_; }
  /// How far frequency errors reach in the shape.
  [[nodiscard]] double reach() {
    const Index n = numbers_.states();
    VectorXd state = state_at(*curve_, phase_);
    const Eigen::RowVectorXd gradient = tone_->step.frequency_gradient(state).leftCols(n);
    return std::sqrt((gradient * here_.shape * gradient.transpose()).value());
  }
  /// Of the step that was the last one.
  [[nodiscard]] FilterGrowth growth() const {
    const Index n = numbers_.states();
    const Eigen::LLT<MatrixXd> root(here_.shape);
    FilterGrowth worst{std::numeric_limits<double>::infinity(), 1.0};
    if (root.info() != Eigen::Success) {
      return worst;
    }
    const auto in_units = [&](const MatrixXd& x) -> MatrixXd { return root.matrixL().solve(x); };
    const MatrixXd spread = in_units(in_units(delta_).transpose());
    const MatrixXd weighted = numbers_.weighted() * delta_ * numbers_.weighted().transpose();
    const MatrixXd factor = Eigen::LLT<MatrixXd>(weighted).matrixL();
    const MatrixXd of_x = in_units(contraction_ * jacobian_ * before_);
    const MatrixXd reach_of_x = -factor.transpose() * numbers_.measured() * jacobian_ * before_;
    const MatrixXd of_v = in_units(gain_) * parameters_.noise;
    const MatrixXd reach_of_v = factor.transpose() * parameters_.noise;
    MatrixXd second(n, n * n);
    for (Index i = 0; i < n; ++i) {
      second.middleCols(i * n, n) = 0.5 * changes_[static_cast<std::size_t>(i)] * before_;
    }
    const MatrixXd of_squares = in_units(contraction_ * second);
    const MatrixXd reach_of_squares = -factor.transpose() * numbers_.measured() * second;
    const auto largest = [](const MatrixXd& symmetric) {
      return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    };
    const double top = largest(spread);
    for (const double share : {1.08, 1.2, 1.4, 1.8, 3.0, 8.0, 40.0}) {
      const double mu = share * top + 1e-300;
      const Eigen::LLT<MatrixXd> inner(MatrixXd::Identity(n, n) - spread / mu);
      const auto stacked = [&](const MatrixXd& first, const MatrixXd& below) {
        MatrixXd both(first.rows() + below.rows(), first.cols());
        both << inner.matrixL().solve(first), std::sqrt(mu) * below;
        return both;
      };
      const MatrixXd x = stacked(of_x, reach_of_x);
      const MatrixXd gram = x * x.transpose();
      const double alone = std::sqrt(largest(gram));
      double linear = alone;
      if (parameters_.noise > 0.0) {
        const MatrixXd v = stacked(of_v, reach_of_v);
        const MatrixXd other = v * v.transpose();
        linear = std::numeric_limits<double>::infinity();
        for (const double t : {0.5, 0.7, 0.82, 0.9, 0.95}) {
          linear = std::min(linear, std::sqrt(largest(gram / t + other / (1.0 - t))));
        }
      }
      const MatrixXd squares = stacked(of_squares, reach_of_squares);
      const double whole = linear + std::sqrt(largest(squares * squares.transpose()));
      if (whole < worst.whole) {
        worst = {whole, alone};
      }
    }
    return worst;
  }

 private:
  [[nodiscard]] VectorXd at(double phase) const { return state_at(*curve_, phase).head(numbers_.states()); }

  const TrackedTone* tone_;
  FilterNumbers numbers_;
  const NodeCurve* curve_;
  FilterParameters parameters_;
  double phase_ = 0.0;
  VectorXd estimate_;
  MatrixXd updated_low_, updated_high_, delta_, gain_, contraction_, jacobian_, before_;
  std::vector<MatrixXd> changes_;
  FilterOnOrbit here_;
};

/// Parameters as a point: the logarithm of eta, the logits of theta and of lambda between the square of the
/// rate and 1, the logarithms of b and d, those of W in units of the states, and, when it is searched for, that
/// of V.
struct Coordinates {
  double rate_squared;
  VectorXd sizes;
  double given_noise;
  bool finds_noise;

  [[nodiscard]] Index size() const { return 5 + sizes.size() + (finds_noise ? 1 : 0); }
  [[nodiscard]] FilterParameters at(const VectorXd& x) const {
    const auto logistic = [](double t) { return 1.0 / (1.0 + std::exp(-t)); };
    FilterParameters parameters;
    parameters.eta = std::exp(x[0]);
    parameters.theta = logistic(x[1]);
    parameters.lambda = rate_squared + (1.0 - rate_squared) * logistic(x[2]);
    parameters.source = std::exp(x[3]);
    parameters.spread = std::exp(x[4]);
    parameters.process = x.segment(5, sizes.size()).array().exp() * sizes.array().square();
    parameters.noise = finds_noise ? std::exp(x[size() - 1]) : given_noise;
    return parameters;
  }
};

struct FilterWorth {
  double growth = std::numeric_limits<double>::infinity();
  double linear = 1.0;
  double least_reach = std::numeric_limits<double>::infinity();
  double most_reach = 0.0;
};

/// Over so many samples of an orbit, after `before`.
FilterWorth worth_on_orbit(const TrackedTone& tone, const NodeCurve& curve, const FilterParameters& parameters,
                           int before, int samples) {
  FilterOrbit orbit(tone, curve, parameters);
  orbit.begin(0.3);
  FilterWorth worth;
  double growth = 0.0;
  double linear = 0.0;
  for (int k = 0; k < before + samples; ++k) {
    if (!orbit.step()) {
      return worth;
    }
    if (k >= before) {
      const FilterGrowth here = orbit.growth();
      growth = std::max(growth, here.whole);
      linear = std::max(linear, here.linear);
      const double reach = orbit.reach();
      if (!std::isfinite(here.whole) || !std::isfinite(reach)) {
        return worth;
      }
      worth.least_reach = std::min(worth.least_reach, reach);
      worth.most_reach = std::max(worth.most_reach, reach);
    }
  }
  worth.growth = growth;
  worth.linear = linear;
  return worth;
}

/// How many samples the shape remembers.
int memory_of(double rate_squared, const FilterParameters& parameters, double share) {
  const double factor = std::min(0.999, std::max(rate_squared / parameters.lambda, rate_squared));
  return std::clamp(static_cast<int>(std::ceil(std::log(share) / std::log(factor))), 16, 4000);
}

/// The search for parameters that do at all frequencies of the cell.
class FilterSearch {
 public:
  FilterSearch(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings, double rate)
      : tone_(&tone), nodes_{curve.at(-1.0), curve.at(0.0), curve.at(1.0)} {
    const Index n = tone.filter->states;
    const VectorXd state = state_at(nodes_[1], 0.3);
    VectorXd sizes(n);
    // Of deviations: those that the filter itself expects.
    Index place = n;
    for (Index i = 0; i < n; ++i) {
      sizes[i] = std::sqrt(std::max(1e-300, state[place]));
      place += n - i;
    }
    const bool is_for_noise = settings.shape.objective == ShapeObjective::largest_noise;
    // The largest reach at a given noise, or the largest noise.
    coordinates_ = {rate * rate, sizes, settings.shape.noise, is_for_noise && !(settings.shape.noise > 0.0)};
    largest_reach_ = settings.shape.largest_reach;
    constexpr int kUsual = 180;
    evaluations_ = settings.shape.evaluations > 0 ? settings.shape.evaluations / 3 : kUsual;
  }

  [[nodiscard]] const Coordinates& coordinates() const { return coordinates_; }
  [[nodiscard]] FilterWorth worth_at(const FilterParameters& parameters, int samples) const {
    std::array<FilterWorth, 3> each;
    tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t i) {
      each.at(i) = worth_on_orbit(*tone_, nodes_.at(i), parameters,
                                  memory_of(coordinates_.rate_squared, parameters, 1e-3), samples);
    });
    FilterWorth worth{0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0};
    for (const FilterWorth& one : each) {
      worth.growth = std::max(worth.growth, one.growth);
      worth.linear = std::max(worth.linear, one.linear);
      worth.least_reach = std::min(worth.least_reach, one.least_reach);
      worth.most_reach = std::max(worth.most_reach, one.most_reach);
    }
    return worth;
  }
  [[nodiscard]] double score(const VectorXd& x) const {
    constexpr int kSamples = 24;
    constexpr double kPenalty = 20.0;
    const FilterParameters parameters = coordinates_.at(x);
    const FilterWorth worth = worth_at(parameters, kSamples);
    if (!std::isfinite(worth.growth)) {
      return -std::numeric_limits<double>::infinity();
    }
    const double goal = coordinates_.finds_noise ? std::log(parameters.noise) : std::log(worth.least_reach);
    // Where errors have to stay below a bound, a larger tube is of no use.
    const double excess = largest_reach_ > 0.0 ? std::max(0.0, worth.most_reach / largest_reach_ - 0.97) : 0.0;
    return goal - kPenalty * (std::max(0.0, worth.growth - kLargestGrowth) + excess) -
           (worth.growth > 2.0 ? 10.0 : 0.0);
  }
  /// The best point found.
  [[nodiscard]] std::optional<VectorXd> run(const VectorXd& nearby) const {
    VectorXd best;
    double value = -std::numeric_limits<double>::infinity();
    const auto consider = [&](const VectorXd& x) {
      const double here = score(x);
      if (here > value) {
        value = here;
        best = x;
      }
    };
    const bool has_nearby = nearby.size() == coordinates_.size();
    if (has_nearby) {
      consider(nearby);
    } else {
      for (const double process : {-7.0, -5.0, -3.5, -2.0}) {
        for (const double source : {-9.0, -6.0, -3.0}) {
          for (const double eta : {-2.5, -1.5, -0.5}) {
            for (const double noise : coordinates_.finds_noise ? std::vector{-9.0, -6.5, -4.5} : std::vector{0.0}) {
              VectorXd x = VectorXd::Constant(coordinates_.size(), process);
              x[0] = eta;
              x[1] = eta;
              x[2] = 0.0;
              x[3] = source;
              x[4] = -3.0;
              if (coordinates_.finds_noise) {
                x[coordinates_.size() - 1] = noise;
              }
              consider(x);
            }
          }
        }
      }
    }
    if (!std::isfinite(value)) {
      return std::nullopt;
    }
    const int rounds = has_nearby ? 1 : 3;
    for (int round = 0; round < rounds; ++round) {
      search::SearchSpace space;
      space.start = best;
      space.step = VectorXd::Constant(best.size(), round == 0 ? 1.0 : 0.6);
      space.lower = VectorXd::Constant(best.size(), -30.0);
      space.upper = VectorXd::Constant(best.size(), 12.0);
      space.evaluations = evaluations_;
      space.tolerance = 1e-3;
      const search::BestPoint found =
          search::maximize([this](const VectorXd& x) { return score(x); }, space);
      if (found.value > value) {
        value = found.value;
        best = found.point;
      }
    }
    return best;
  }

  static constexpr double kLargestGrowth = 0.982;

 private:
  const TrackedTone* tone_;
  std::array<NodeCurve, 3> nodes_;
  Coordinates coordinates_;
  double largest_reach_ = 0.0;
  int evaluations_ = 0;  ///< of each round
};

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
                                    const FilterParameters& parameters, int memory, int phases) {
  const Index n = tone.filter->states;
  FilterOnGrid grid{MatrixXd(n * (n + 1) / 2, phases), MatrixXd(n * (n + 1) / 2, phases),
                    MatrixXd(n * (n + 1) / 2, phases)};
  std::vector<char> is_known(static_cast<std::size_t>(phases), 1);
  tbb::parallel_for(0, phases, [&](int j) {
    FilterOrbit orbit(tone, curve, parameters);
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
    const MatrixXd root = Eigen::LLT<MatrixXd>(here.shape).matrixL();
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
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(difference, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

void propose_filter_tube(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings,
                         const std::optional<ShapeParameters>& nearby, TubeProposal& proposal) {
  const rigor::NearestRounding nearest;
  const Index n = tone.filter->states;
  const double rate = proposal.steady_state.rate;
  if (!(rate < 1.0)) {
    proposal.outcome = TubeOutcome::no_shape;
    return;
  }
  const FilterSearch search(tone, curve, settings, rate);
  const std::optional<VectorXd> point = search.run(nearby ? nearby->of_filter : VectorXd());
  if (!point) {
    proposal.outcome = TubeOutcome::cell_too_wide;
    proposal.loss = 1.0;
    return;
  }
  const FilterParameters parameters = search.coordinates().at(*point);
  constexpr int kSamples = 64;
  const FilterWorth worth = search.worth_at(parameters, kSamples);
  if (!(worth.growth < 1.3)) {
    proposal.outcome = TubeOutcome::cell_too_wide;
    proposal.loss = 1.0;
    return;
  }
  proposal.shape.parameters.of_filter = *point;
  constexpr double kForgotten = 1e-6;
  const int memory = memory_of(rate * rate, parameters, kForgotten);
  // Levels are in rad/sample.
  const double scale = 1.0 / worth.most_reach;
  const int most_harmonics = std::max<int>(24, 2 * static_cast<int>(curve.coefficients[0].cols()));
  const int phases = 2 * most_harmonics + 1;
  std::array<MatrixXd, kNodes> low;
  std::array<MatrixXd, kNodes> high;
  std::array<MatrixXd, kNodes> shape;
  for (std::size_t j = 0; j < low.size(); ++j) {
    const auto grid = on_grid(tone, curve.at(node_places().at(j)), parameters, memory, phases);
    if (!grid) {
      proposal.outcome = TubeOutcome::cell_too_wide;
      proposal.loss = 1.0;
      return;
    }
    low.at(j) = grid->low;
    high.at(j) = grid->high;
    shape.at(j) = grid->shape;
  }
  // As few harmonics as lose hardly anything, judged between the nodes.
  std::vector<std::pair<double, FilterOnGrid>> judges;
  for (const double z : {-1.0, 0.0, 0.6, 1.0}) {
    auto grid = on_grid(tone, curve.at(z), parameters, memory, 31);
    if (!grid) {
      proposal.outcome = TubeOutcome::cell_too_wide;
      proposal.loss = 1.0;
      return;
    }
    judges.emplace_back(z, *std::move(grid));
  }
  std::optional<std::array<Fit, 3>> found;
  proposal.loss = 1.0;
  for (int harmonics = 2; harmonics <= most_harmonics && !found; harmonics += 2) {
    std::array<Fit, 3> fit{fit_of(low, harmonics, 1.0), fit_of(high, harmonics, 1.0),
                           fit_of(shape, harmonics, scale)};
    double worst = 0.0;
    for (const auto& [z, exact] : judges) {
      for (Index j = 0; j < exact.low.cols(); ++j) {
        const double phase = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(exact.low.cols());
        const auto of = [&](const Fit& one, bool is_symmetric) {
          return matrix_of_triangle(value_of(one, z, phase), n, is_symmetric);
        };
        const MatrixXd u = of(fit[2], false) / scale;
        const MatrixXd exact_u = matrix_of_triangle(exact.shape.col(j), n, false);
        constexpr double kOfBounds = 0.2 * kSlack;
        constexpr double kOfShape = 0.01;
        worst = std::max({worst, mismatch(of(fit[0], true), matrix_of_triangle(exact.low.col(j), n, true)) / kOfBounds,
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
    proposal.outcome = TubeOutcome::cell_too_wide;
    return;
  }
  proposal.worth.level = worth.most_reach;
  proposal.worth.reach = worth.most_reach;
  proposal.worth.least_reach = worth.least_reach;
  proposal.worth.noise = parameters.noise;
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

}  // namespace veritrack::model
