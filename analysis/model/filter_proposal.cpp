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

/// Matrices of a filter of at most ten states without allocations.
constexpr int kMostStates = 10;
constexpr int kMostRows = kMostStates + 2;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1>;
using Wide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostStates * kMostStates>;

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
  [[nodiscard]] const Small& measured() const { return measured_; }
  [[nodiscard]] const Small& weighted() const { return weighted_; }  ///< R^-1 H
  [[nodiscard]] const Small& process() const { return process_; }
  [[nodiscard]] Small jacobian(const SmallVector& estimate) {
    std::copy(estimate.begin(), estimate.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(constants_));
    results_.resize(parts_->program.results().size());
    parts_->program.run(std::span<const double>(inputs_), registers_, std::span<double>(results_));
    const Index n = states();
    Small f(n, n);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        f(i, j) = results_[static_cast<std::size_t>(n + i * n + j)];
      }
    }
    return f;
  }
  /// The change of F along a direction.
  [[nodiscard]] Small change(const SmallVector& estimate, const SmallVector& direction) {
    constexpr double kPart = 1e-4;
    return (jacobian(estimate + kPart * direction) - jacobian(estimate - kPart * direction)) / (2.0 * kPart);
  }
  [[nodiscard]] Small updated(const Small& predicted) const {
    const Small cross = measured_ * predicted;
    const Small result =
        predicted - cross.transpose() * (cross * measured_.transpose() + noise_).ldlt().solve(cross);
    return 0.5 * (result + result.transpose());
  }

 private:
  const trackers::FilterParts* parts_;
  std::vector<double> inputs_, registers_, results_;
  std::size_t constants_;
  Small measured_, process_, noise_, weighted_;
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
  Small low, high;  ///< predicted for this sample
  Small shape;      ///< Pi after it
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
    Small covariance(n, n);
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
    const Small f = numbers_.jacobian(estimate_);
    const Eigen::LLT<Small> root(here_.shape);
    if (root.info() != Eigen::Success || !(here_.shape.maxCoeff() < 1e12)) {
      return false;
    }
    const Small u = root.matrixL();
    changes_.clear();
    Small of_high = Small::Zero(n, n);
    Small of_low = Small::Zero(n, n);
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
    if (Eigen::LLT<Small>(next.low).info() != Eigen::Success || !(next.high.maxCoeff() < 1e12)) {
      return false;
    }
    updated_high_ = numbers_.updated(next.high);
    updated_low_ = numbers_.updated(next.low);
    const Small middle = 0.5 * (updated_high_ + updated_low_);
    delta_ = 0.5 * (updated_high_ - updated_low_);
    gain_ = middle * numbers_.weighted().transpose();
    contraction_ = (Small::Identity(n, n) - gain_ * numbers_.measured());
    const Small a = contraction_ * f;
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
    const Eigen::LLT<Small> root(here_.shape);
    FilterGrowth worst{std::numeric_limits<double>::infinity(), 1.0};
    if (root.info() != Eigen::Success) {
      return worst;
    }
    const auto in_units = [&](auto x) {
      root.matrixL().solveInPlace(x);
      return x;
    };
    const Small spread = in_units(Small(in_units(delta_).transpose()));
    const Small weighted = numbers_.weighted() * delta_ * numbers_.weighted().transpose();
    const Small factor = Eigen::LLT<Small>(weighted).matrixL();
    const Small of_x = in_units(Small(contraction_ * jacobian_ * before_));
    const Small reach_of_x = -factor.transpose() * numbers_.measured() * jacobian_ * before_;
    const Small of_v = Small(in_units(gain_) * parameters_.noise);
    const Small reach_of_v = factor.transpose() * parameters_.noise;
    Wide second(n, n * n);
    for (Index i = 0; i < n; ++i) {
      second.middleCols(i * n, n) = 0.5 * changes_[static_cast<std::size_t>(i)] * before_;
    }
    const Wide of_squares = in_units(Wide(contraction_ * second));
    const Wide reach_of_squares = -factor.transpose() * numbers_.measured() * second;
    const auto largest = [](const Small& symmetric) {
      return Eigen::SelfAdjointEigenSolver<Small>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    };
    const double top = largest(spread);
    for (const double share : {1.08, 1.2, 1.4, 1.8, 3.0, 8.0, 40.0}) {
      const double mu = share * top + 1e-300;
      const Eigen::LLT<Small> inner(Small::Identity(n, n) - spread / mu);
      const auto stacked = [&](auto first, const auto& below) {
        inner.matrixL().solveInPlace(first);
        auto both = first;
        both.resize(first.rows() + below.rows(), first.cols());
        both << first, std::sqrt(mu) * below;
        return both;
      };
      const Small x = stacked(of_x, reach_of_x);
      const Small gram = x * x.transpose();
      const double alone = std::sqrt(largest(gram));
      double linear = alone;
      if (parameters_.noise > 0.0) {
        const Small v = stacked(of_v, reach_of_v);
        const Small other = v * v.transpose();
        linear = std::numeric_limits<double>::infinity();
        for (const double t : {0.5, 0.7, 0.82, 0.9, 0.95}) {
          linear = std::min(linear, std::sqrt(largest(Small(gram / t + other / (1.0 - t)))));
        }
      }
      const Wide squares = stacked(of_squares, reach_of_squares);
      const double whole = linear + std::sqrt(largest(Small(squares * squares.transpose())));
      if (whole < worst.whole) {
        worst = {whole, alone};
      }
    }
    return worst;
  }

 private:
  [[nodiscard]] SmallVector at(double phase) const {
    return state_at(*curve_, phase).head(numbers_.states());
  }

  const TrackedTone* tone_;
  FilterNumbers numbers_;
  const NodeCurve* curve_;
  FilterParameters parameters_;
  double phase_ = 0.0;
  SmallVector estimate_;
  Small updated_low_, updated_high_, delta_, gain_, contraction_, jacobian_, before_;
  std::vector<Small> changes_;
  FilterOnOrbit here_;
};

/// Parameters as a point: the logarithm of eta, the logits of theta and of lambda between the square of the
/// rate and 1, the logarithms of b and d, those of W in units of the states, and, when it is searched for,
/// that of V.
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
FilterWorth worth_on_orbit(const TrackedTone& tone, const NodeCurve& curve,
                           const FilterParameters& parameters, int before, int samples) {
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
      constexpr double kFar = 3.0;
      if (!(here.whole < kFar) || !std::isfinite(reach)) {
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
  return std::clamp(static_cast<int>(std::ceil(std::log(share) / std::log(factor))), 12, 4000);
}

/// The search for parameters: at the middle of the cell, and then scaled so that they do at its ends.
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
    constexpr int kUsual = 100;
    evaluations_ = settings.shape.evaluations > 0 ? settings.shape.evaluations / 3 : kUsual;
  }

  [[nodiscard]] const Coordinates& coordinates() const { return coordinates_; }
  /// At the middle and both ends.
  [[nodiscard]] FilterWorth worth_at(const FilterParameters& parameters, int samples) const {
    std::array<FilterWorth, 3> each;
    tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t i) {
      each.at(i) = worth_on_orbit(*tone_, nodes_.at(i), parameters,
                                  memory_of(coordinates_.rate_squared, parameters, 1e-4), samples);
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
  /// The point with a larger or smaller scale: of the tube, or of the noise.
  [[nodiscard]] VectorXd scaled(VectorXd x, double logarithm) const {
    if (coordinates_.finds_noise) {
      x[coordinates_.size() - 1] += logarithm;
    } else {
      x[3] += logarithm;
      x.segment(5, coordinates_.sizes.size()).array() += logarithm;
    }
    return x;
  }
  /// The largest scale at which the growth is what it may be; -infinity when there is none nearby.
  template <typename Worth>
  [[nodiscard]] double largest_scale(const VectorXd& x, const Worth& worth_of) const {
    const auto may_be = [&](double logarithm) {
      const FilterWorth worth = worth_of(coordinates_.at(scaled(x, logarithm)));
      return worth.growth <= kLargestGrowth &&
             !(largest_reach_ > 0.0 && worth.most_reach > 0.97 * largest_reach_);
    };
    constexpr double kStep = 1.2;
    constexpr int kMostSteps = 9;
    double low = 0.0;
    int steps = 0;
    const bool grows = may_be(0.0);
    for (double tried = grows ? kStep : -kStep; steps < kMostSteps;
         ++steps, tried += grows ? kStep : -kStep) {
      const bool is_possible = may_be(tried);
      low = is_possible || !grows ? tried : low;
      if (is_possible != grows) {
        break;
      }
    }
    if (steps == kMostSteps) {
      return grows ? low : -std::numeric_limits<double>::infinity();
    }
    double high = low + kStep;
    constexpr int kHalvings = 6;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (may_be(middle) ? low : high) = middle;
    }
    return low;
  }
  struct Scored {
    double value = -std::numeric_limits<double>::infinity();
    VectorXd point;
  };
  [[nodiscard]] Scored score(const VectorXd& x) const {
    constexpr int kSamples = 20;
    const auto at_middle = [&](const FilterParameters& parameters) {
      return worth_on_orbit(*tone_, nodes_[1], parameters,
                            memory_of(coordinates_.rate_squared, parameters, 1e-2), kSamples);
    };
    const double logarithm = largest_scale(x, at_middle);
    if (!std::isfinite(logarithm)) {
      return {};
    }
    Scored scored{0.0, scaled(x, logarithm)};
    const FilterParameters parameters = coordinates_.at(scored.point);
    scored.value = std::log(coordinates_.finds_noise ? parameters.noise : at_middle(parameters).least_reach);
    return scored;
  }
  /// The best point found, scaled for the whole cell.
  [[nodiscard]] std::optional<VectorXd> run(const VectorXd& nearby) const {
    std::vector<Scored> starts;
    if (nearby.size() == coordinates_.size()) {
      starts.push_back(score(nearby));
    } else {
      if (!coordinates_.finds_noise) {
        starts = first_starts();
      } else {
        // From tubes without noise, made smaller.
        std::vector<VectorXd> points;
        FilterSearch without_noise(*this);
        without_noise.coordinates_.finds_noise = false;
        for (const Scored& start : without_noise.best_of(without_noise.first_starts())) {
          for (const double scale : {-0.5, -1.4, -2.8}) {
            if (std::isfinite(start.value)) {
              const VectorXd smaller = without_noise.scaled(start.point, scale);
              points.emplace_back(coordinates_.size());
              points.back() << smaller, -6.0;
            }
          }
        }
        starts.assign(points.size(), {});
        tbb::parallel_for(std::size_t{0}, points.size(),
                          [&](std::size_t i) { starts[i] = score(points[i]); });
      }
      starts = best_of(std::move(starts));
    }
    if (starts.empty() || !std::isfinite(starts.front().value)) {
      return std::nullopt;
    }
    tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) { improve(starts[i], 1.0); });
    Scored best = *std::max_element(starts.begin(), starts.end(),
                                    [](const Scored& a, const Scored& b) { return a.value < b.value; });
    if (starts.size() > 1) {
      improve(best, 0.5);
      improve(best, 0.8);
    }
    constexpr int kSamples = 40;
    const double logarithm = largest_scale(
        best.point, [&](const FilterParameters& parameters) { return worth_at(parameters, kSamples); });
    return std::isfinite(logarithm) ? std::optional(scaled(best.point, logarithm)) : std::nullopt;
  }

  static constexpr double kLargestGrowth = 0.985;

 private:
  /// Of the reach.
  [[nodiscard]] std::vector<Scored> first_starts() const {
    std::vector<VectorXd> points;
    for (const double source : {-8.0, -4.0, -1.0}) {
      for (const double eta : {-2.3, -1.0}) {
        for (const double logit : {0.0, 1.4, 2.6}) {
          for (const double spread : {-5.0, -2.0}) {
            // The scale of W is found by itself.
            constexpr double kProcess = -4.5;
            VectorXd x = VectorXd::Constant(coordinates_.size(), kProcess);
            x.head(5) << eta, eta, logit, source, spread;
            points.push_back(x);
          }
        }
      }
    }
    std::vector<Scored> starts(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { starts[i] = score(points[i]); });
    return starts;
  }
  /// The three best ones, the best first.
  [[nodiscard]] static std::vector<Scored> best_of(std::vector<Scored> starts) {
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Scored& a, const Scored& b) { return a.value > b.value; });
    constexpr std::size_t kMost = 3;
    starts.resize(std::min(kMost, starts.size()));
    return starts;
  }
  void improve(Scored& best, double step) const {
    if (!std::isfinite(best.value)) {
      return;
    }
    const rigor::NearestRounding nearest;
    search::SearchSpace space;
    space.start = best.point;
    space.step = VectorXd::Constant(best.point.size(), step);
    space.lower = VectorXd::Constant(best.point.size(), -30.0);
    space.upper = VectorXd::Constant(best.point.size(), 12.0);
    space.evaluations = evaluations_;
    space.tolerance = 1e-3;
    (void)search::maximize(
        [&](const VectorXd& x) {
          const Scored here = score(x);
          if (here.value > best.value) {
            best = here;
          }
          return here.value;
        },
        space);
  }

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
    const MatrixXd root = Eigen::LLT<Small>(here.shape).matrixL();
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
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(difference, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

}  // namespace

void propose_filter_tube(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings,
                         const std::optional<ShapeParameters>& nearby, TubeProposal& proposal) {
  const rigor::NearestRounding nearest;
  const Index n = tone.filter->states;
  const double rate = proposal.steady_state.rate;
  if (!(rate < 1.0) || n > kMostStates) {
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
