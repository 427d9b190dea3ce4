#include "analysis/contraction/ball_metric.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/search/maximize.hpp"

namespace veritrack::contraction {

namespace {

using rigor::DynamicMatrix;

constexpr double kLargestRate = 0.999;

double norm(const DynamicMatrix& wide) {
  const DynamicMatrix gram = wide * wide.transpose();
  const Eigen::SelfAdjointEigenSolver<DynamicMatrix> solver(gram, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

/// N x N^2, both inputs through `inverse`; in place.
void turn_pairs(Eigen::Ref<DynamicMatrix> wide, const DynamicMatrix& inverse) {
  const Eigen::Index n = inverse.rows();
  for (Eigen::Index output = 0; output < n; ++output) {
    const DynamicMatrix slice =
        Eigen::Map<const DynamicMatrix>(Eigen::RowVectorXd(wide.row(output)).data(), n, n);
    const DynamicMatrix turned = inverse.transpose() * slice * inverse;
    wide.row(output) = Eigen::Map<const Eigen::RowVectorXd>(turned.data(), n * n);
  }
}

double quadratic_norm(const DynamicMatrix& quadratic, const DynamicMatrix& metric,
                      const DynamicMatrix& inverse) {
  DynamicMatrix wide = metric * quadratic;
  turn_pairs(wide, inverse);
  return norm(wide);
}

double cubic_norm(const DynamicMatrix& cubic, const DynamicMatrix& metric, const DynamicMatrix& inverse) {
  const Eigen::Index n = inverse.rows();
  DynamicMatrix wide = metric * cubic;
  for (Eigen::Index k = 0; k < n; ++k) {
    turn_pairs(wide.middleCols(k * n * n, n * n), inverse);
  }
  DynamicMatrix result = DynamicMatrix::Zero(n, n * n * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index l = 0; l < n; ++l) {
      result.middleCols(k * n * n, n * n) += inverse(l, k) * wide.middleCols(l * n * n, n * n);
    }
  }
  return norm(result);
}

/// X = B' X B + W by doubling.
DynamicMatrix solve_lyapunov(DynamicMatrix b, DynamicMatrix x) {
  constexpr int kDoublings = 40;
  for (int i = 0; i < kDoublings && b.allFinite() && b.norm() > 1e-18; ++i) {
    x += (b.transpose() * x * b).eval();
    b = (b * b).eval();
  }
  return x;
}

/// kappa(R) = linear + R quadratic / 2 + R^2 cubic / 6.
struct Rate {
  double linear = 0.0, quadratic = 0.0, cubic = 0.0;

  [[nodiscard]] double at(double radius) const {
    return linear + radius * quadratic / 2.0 + radius * radius * cubic / 6.0;
  }
  /// The radius at which it is kLargestRate; zero when there is none.
  [[nodiscard]] double largest_radius() const {
    const double room = kLargestRate - linear;
    if (!(room > 0.0)) {
      return 0.0;
    }
    const double half = quadratic / 2.0;
    return 2.0 * room / (half + std::sqrt(half * half + 4.0 * room * cubic / 6.0));
  }
};

class Proposer {
 public:
  Proposer(const std::vector<LocalModel>& models, const MetricSearch& search)
      : models_(models), search_(search), middle_(models[models.size() / 2]) {
    spectral_radius_ = middle_.linear.eigenvalues().cwiseAbs().maxCoeff();
  }

  [[nodiscard]] bool stable() const { return spectral_radius_ < 1.0; }

  /// Variables: the logarithms of the square roots of W's diagonal, and where k lies between the spectral
  /// radius and 1.
  [[nodiscard]] MetricProposal evaluate(const Eigen::VectorXd& variables) const {
    const Eigen::Index n = middle_.linear.rows();
    const double k = spectral_radius_ + (1.0 - spectral_radius_) / (1.0 + std::exp(-variables[n]));
    const DynamicMatrix weight = (2.0 * variables.head(n)).array().exp().matrix().asDiagonal();
    const DynamicMatrix x = solve_lyapunov(middle_.linear / k, weight);
    MetricProposal proposal;
    const Eigen::LLT<DynamicMatrix> factor(x);
    if (factor.info() != Eigen::Success) {
      return proposal;
    }
    proposal.metric = factor.matrixU();
    const DynamicMatrix inverse = proposal.metric.inverse();
    if (!proposal.metric.allFinite() || !inverse.allFinite()) {
      return proposal;
    }
    Rate worst;
    double noise_gain = 0.0;
    for (const LocalModel& model : models_) {
      worst.linear = std::max(worst.linear, norm(proposal.metric * model.linear * inverse));
      worst.quadratic = std::max(worst.quadratic, quadratic_norm(model.quadratic, proposal.metric, inverse));
      worst.cubic = std::max(worst.cubic, cubic_norm(model.cubic, proposal.metric, inverse));
      noise_gain = std::max(noise_gain, norm(proposal.metric * model.noise));
    }
    proposal.cubic = worst.cubic;
    worst.cubic *= search_.cubic_factor;
    const double largest = worst.largest_radius();
    if (search_.aim == BallAim::state) {
      proposal.radius = largest;
      proposal.value = largest * inverse.row(search_.state).norm();
      return proposal;
    }
    constexpr int kGrid = 40;
    for (int i = 1; i < kGrid; ++i) {
      const double radius = largest * i / kGrid;
      const double noise = radius * (1.0 - worst.at(radius)) / noise_gain;
      if (noise > proposal.value) {
        proposal.value = noise;
        proposal.radius = radius;
      }
    }
    return proposal;
  }

 private:
  const std::vector<LocalModel>& models_;
  const MetricSearch& search_;
  const LocalModel& middle_;
  double spectral_radius_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

std::optional<MetricProposal> propose_metric(const std::vector<LocalModel>& models,
                                             const MetricSearch& search) {
  if (models.empty()) {
    throw std::invalid_argument("propose_metric: at least one local model is needed");
  }
  const rigor::NearestRounding nearest;
  for (const LocalModel& model : models) {
    if (!model.linear.allFinite() || !model.quadratic.allFinite() || !model.cubic.allFinite() ||
        !model.noise.allFinite()) {
      return std::nullopt;
    }
  }
  const Proposer proposer(models, search);
  if (!proposer.stable()) {
    return std::nullopt;
  }
  const Eigen::Index n = models.front().linear.rows();
  search::SearchSpace space;
  space.start = Eigen::VectorXd::Zero(n + 1);
  // Start with each coordinate in units of what noise makes of it: the stationary covariance of the linear
  // loop.
  const LocalModel& middle = models[models.size() / 2];
  const DynamicMatrix driven = middle.noise * middle.noise.transpose();
  const DynamicMatrix stationary = solve_lyapunov(middle.linear.transpose(), driven);
  const double largest_spread = std::sqrt(stationary.diagonal().maxCoeff());
  for (Eigen::Index i = 0; i < n; ++i) {
    const double spread = std::sqrt(std::max(0.0, stationary(i, i)));
    space.start[i] = -std::log(std::max(spread, 1e-3 * largest_spread));
  }
  if (!space.start.allFinite()) {
    space.start.setZero();
  }
  space.step = Eigen::VectorXd::Ones(n + 1);
  space.lower = space.start.array() - 12.0;
  space.upper = space.start.array() + 12.0;
  space.evaluations = search.evaluations;
  const search::BestPoint best = search::maximize(
      [&proposer](const Eigen::VectorXd& variables) { return proposer.evaluate(variables).value; }, space);
  MetricProposal proposal = proposer.evaluate(best.point);
  if (!(proposal.value > 0.0) || !std::isfinite(proposal.radius)) {
    return std::nullopt;
  }
  return proposal;
}

}  // namespace veritrack::contraction
