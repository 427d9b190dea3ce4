// Bounds of a filter's covariance and a shape, carried along an orbit of the tone: see filter_proposal.hpp.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "analysis/model/curve_fit.hpp"
#include "analysis/model/phase_grid.hpp"
#include "analysis/model/tube.hpp"
#include "trackers/model/filter_parts.hpp"

namespace veritrack::model::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Matrices of a filter of at most ten states without allocations.
inline constexpr int kMostStates = 10;
inline constexpr int kMostRows = kMostStates + 2;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1>;
using Wide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostStates * kMostStates>;

/// Of the bounds, in units of themselves: what they have to spare.
inline constexpr double kSlack = 0.006;
/// Of those in the long run, where it is also how fast the covariance comes between them, and of those of a
/// frequency that moves, which have to fit together at borders of cells.
inline constexpr double kWideSlack = 0.012;

/// A matrix of series at a place, from its lower triangle.
inline MatrixXd matrix_at(const std::vector<PhaseSeries>& triangle, double phase, double z,
                          bool is_symmetric) {
  std::size_t most = 1;
  for (const PhaseSeries& series : triangle) {
    most = std::max(most, series.coefficients.size());
  }
  std::vector<std::pair<double, double>> harmonics;
  for (std::size_t h = 0; h < most; ++h) {
    const double angle = static_cast<double>(h) * phase;
    harmonics.emplace_back(std::cos(angle), std::sin(angle));
  }
  const std::vector<double> powers{1.0, z, z * z, z * z * z, z * z * z * z};
  Index rows = 0;
  while (rows * (rows + 1) / 2 < static_cast<Index>(triangle.size())) {
    ++rows;
  }
  MatrixXd matrix = MatrixXd::Zero(rows, rows);
  std::size_t place = 0;
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j <= i; ++j) {
      matrix(i, j) = triangle[place++].at(harmonics, powers);
      if (is_symmetric) {
        matrix(j, i) = matrix(i, j);
      }
    }
  }
  return matrix;
}

/// A tube in which the estimate stays, at a frequency of its cell.
struct Surroundings {
  const Tube* tube = nullptr;
  double radius = 0.0;
  double z = 0.0;
};

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
  /// The prediction from the estimate of which the Jacobian was asked last.
  [[nodiscard]] SmallVector predicted() const {
    return Eigen::Map<const VectorXd>(results_.data(), states());
  }
  /// The derivative of f, by which errors change: F itself, unless that is given.
  [[nodiscard]] Small slope(const SmallVector& estimate) {
    if (!parts_->has_given_jacobian) {
      return jacobian(estimate);
    }
    constexpr double kPart = 1e-5;
    const Index n = states();
    Small f(n, n);
    for (Index j = 0; j < n; ++j) {
      const double change = kPart * std::max(1e-3, std::fabs(estimate[j]));
      SmallVector higher = estimate;
      SmallVector lower = estimate;
      higher[j] += change;
      lower[j] -= change;
      (void)jacobian(higher);
      const SmallVector above = predicted();
      (void)jacobian(lower);
      f.col(j) = (above - predicted()) / (2.0 * change);
    }
    return f;
  }
  /// The change of F along a direction.
  [[nodiscard]] Small change(const SmallVector& estimate, const SmallVector& direction) {
    constexpr double kPart = 1e-4;
    return (jacobian(estimate + kPart * direction) - jacobian(estimate - kPart * direction)) / (2.0 * kPart);
  }
  /// The change of the derivative of f along a direction.
  [[nodiscard]] Small change_of_slope(const SmallVector& estimate, const SmallVector& direction) {
    constexpr double kPart = 1e-3;
    return parts_->has_given_jacobian
               ? Small((slope(estimate + kPart * direction) - slope(estimate - kPart * direction)) /
                       (2.0 * kPart))
               : change(estimate, direction);
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
  double noise = 0.0;     ///< V, or the deviation of Gaussian noise
  double slew = 0.0;      ///< W
  double moving = 0.0;    ///< c
  double source = 0.0;    ///< b
  double spread = 0.0;    ///< d
  double exponent = 0.0;  ///< L, for Gaussian noise: see gaussian_drift.hpp; 0: the noise is bounded
  VectorXd process;       ///< the diagonal of W
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

/// c0, for proposals.
inline constexpr double kProposedConstant = 5.0;

/// The root of the largest (log E W+ - log(1 + c0 exp(-L l^2)))/(L l^2), about, over the levels l, where the
/// step is N xi + B v and what is quadratic: from N N', B deviation, and the square of a bound of the latter.
inline double gaussian_growth(const Small& gram, const Small& of_noise, double squared, double exponent) {
  const Small noise = 2.0 * exponent * of_noise * of_noise.transpose();
  const Index n = gram.rows();
  constexpr std::array<double, 5> kLevels{1.0, 0.7, 0.5, 0.34, 0.25};
  std::array<double, kLevels.size()> least{};
  least.fill(std::numeric_limits<double>::infinity());
  for (const double a : {0.01, 0.02, 0.04, 0.07, 0.12, 0.2, 0.35}) {
    const Eigen::LLT<Small> root(Small::Identity(n, n) - (1.0 + a) * noise);
    if (root.info() != Eigen::Success) {
      break;
    }
    const Small half = root.matrixL().solve(gram);
    const Small inner = root.matrixL().solve(Small(half.transpose()));
    const double linear =
        Eigen::SelfAdjointEigenSolver<Small>(inner, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    const double spread = -std::log(root.matrixLLT().diagonal().prod());
    for (std::size_t i = 0; i < kLevels.size(); ++i) {
      const double square = kLevels[i] * kLevels[i];
      const double all = exponent * square;
      least[i] = std::min(least[i], (1.0 + a) * linear + (1.0 + 1.0 / a) * squared * square +
                                        (spread - std::log1p(kProposedConstant * std::exp(-all))) / all);
    }
  }
  return std::sqrt(std::max(0.0, *std::max_element(least.begin(), least.end())));
}

class FilterOrbit {
 public:
  /// `around`: the bounds are for all estimates in there, not only for those in the shape.
  /// `slope`: of the curve by the frequency, for a slew.
  FilterOrbit(const TrackedTone& tone, const NodeCurve& curve, const FilterParameters& parameters,
              const Surroundings& around = {}, const Eigen::MatrixXcd* slope = nullptr)
      : tone_(&tone),
        numbers_(tone),
        curve_(&curve),
        parameters_(parameters),
        around_(around),
        slope_(parameters.slew > 0.0 ? slope : nullptr) {}

  /// At this phase, from the steady state of the filter.
  void begin(double phase) {
    phase_ = phase;
    estimate_ = at(phase);
    const Small covariance = steady_covariance(phase);
    updated_low_ = updated_high_ = covariance;
    here_.shape = parameters_.process.asDiagonal();
    here_.low = here_.high = covariance;
  }
  /// To the next sample; false where bounds or shape are none.
  [[nodiscard]] bool step() {
    const Index n = numbers_.states();
    const Small f = numbers_.jacobian(estimate_);
    const SmallVector predicted = numbers_.predicted();
    const Small slope = numbers_.slope(estimate_);
    const Eigen::LLT<Small> root(here_.shape);
    if (root.info() != Eigen::Success || !(here_.shape.maxCoeff() < 1e12)) {
      return false;
    }
    const Small u = root.matrixL();
    changes_.clear();
    Small of_high = Small::Zero(n, n);
    Small of_low = Small::Zero(n, n);
    const bool is_inside = around_.tube != nullptr;
    const Small wide =
        is_inside ? Small(around_.radius * matrix_at(around_.tube->shape, phase_, around_.z, false)) : u;
    for (Index i = 0; i < n; ++i) {
      changes_.push_back(numbers_.change_of_slope(estimate_, u.col(i)));
      const Small change = numbers_.change(estimate_, is_inside ? wide.col(i) : u.col(i));
      of_high += change * updated_high_ * change.transpose();
      of_low += change * updated_low_ * change.transpose();
    }
    const double slack = is_inside || slope_ != nullptr ? kWideSlack : kSlack;
    constexpr double kHigherOrders = 1.1;
    of_high *= kHigherOrders;
    of_low *= kHigherOrders;
    const double eta = parameters_.eta;
    const double theta = parameters_.theta;
    FilterOnOrbit next;
    next.high = (1.0 + slack) * (numbers_.process() + (1.0 + eta) * f * updated_high_ * f.transpose() +
                                 (1.0 + 1.0 / eta) * of_high);
    next.low = (1.0 - slack) * (numbers_.process() + (1.0 - theta) * f * updated_low_ * f.transpose() -
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
    const Small a = contraction_ * slope;
    next.shape = a * here_.shape * a.transpose() / parameters_.lambda +
                 parameters_.source * gain_ * gain_.transpose() + parameters_.spread * delta_;
    next.shape.diagonal() += parameters_.process;
    if (slope_ != nullptr) {
      move_ = value_at(*slope_, phase_ + curve_->frequency).head(n);
      next.shape += parameters_.moving * move_ * move_.transpose();
    }
    jacobian_ = slope;
    before_ = u;
    here_ = std::move(next);
    phase_ += curve_->frequency;
    estimate_ = at(phase_);
    // The innovation on the curve itself, which a leak makes other than 0: from the correction, and the gain
    // there.
    const SmallVector correction = estimate_ - predicted;
    const Small gain = steady_covariance(phase_) * numbers_.weighted().transpose();
    innovation_ = (gain.transpose() * gain).ldlt().solve(gain.transpose() * correction);
    offset_ = gain_ * innovation_ - correction;
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
    // What the range of gains does to the curve.
    const Small offset = in_units(Small(offset_));
    const Small reach_of_offset = factor.transpose() * innovation_;
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
      if (parameters_.exponent > 0.0) {
        const Small v = stacked(of_v, reach_of_v);
        const Wide squares = stacked(of_squares, reach_of_squares);
        const double drift =
            gaussian_growth(gram, v, largest(Small(squares * squares.transpose())), parameters_.exponent);
        if (drift < worst.whole) {
          worst = {drift, alone};
        }
        continue;
      }
      double linear = alone;
      if (parameters_.noise > 0.0 || slope_ != nullptr) {
        Small other = Small::Zero(gram.rows(), gram.rows());
        // Of both, each gets a half.
        const double half = parameters_.noise > 0.0 && slope_ != nullptr ? 2.0 : 1.0;
        if (parameters_.noise > 0.0) {
          const Small v = stacked(of_v, reach_of_v);
          other += half * v * v.transpose();
        }
        if (slope_ != nullptr) {
          const Small w = stacked(Small(in_units(Small(move_)) * parameters_.slew),
                                  Small(Small::Zero(reach_of_v.rows(), 1)));
          other += half * w * w.transpose();
        }
        linear = std::numeric_limits<double>::infinity();
        for (const double t : {0.5, 0.7, 0.82, 0.9, 0.95}) {
          linear = std::min(linear, std::sqrt(largest(Small(gram / t + other / (1.0 - t)))));
        }
      }
      const Wide squares = stacked(of_squares, reach_of_squares);
      const double whole = linear + std::sqrt(largest(Small(squares * squares.transpose()))) +
                           stacked(offset, reach_of_offset).norm();
      if (whole < worst.whole) {
        worst = {whole, alone};
      }
    }
    return worst;
  }

 private:
  [[nodiscard]] Small steady_covariance(double phase) const {
    const VectorXd state = state_at(*curve_, phase);
    const Index n = numbers_.states();
    Small covariance(n, n);
    Index place = n;
    for (Index i = 0; i < n; ++i) {
      for (Index j = i; j < n; ++j) {
        covariance(i, j) = covariance(j, i) = state[place++];
      }
    }
    return covariance;
  }
  [[nodiscard]] SmallVector at(double phase) const {
    return state_at(*curve_, phase).head(numbers_.states());
  }

  const TrackedTone* tone_;
  FilterNumbers numbers_;
  const NodeCurve* curve_;
  FilterParameters parameters_;
  Surroundings around_;
  const Eigen::MatrixXcd* slope_;
  SmallVector move_;                 ///< how the curve moves with the frequency
  SmallVector innovation_, offset_;  ///< on the curve: y - h(x^), and what the middle gain makes of it
  double phase_ = 0.0;
  SmallVector estimate_;
  Small updated_low_, updated_high_, delta_, gain_, contraction_, jacobian_, before_;
  std::vector<Small> changes_;
  FilterOnOrbit here_;
};

}  // namespace veritrack::model::detail
