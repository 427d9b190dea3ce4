#include "analysis/model/steady_state/step_derivatives.hpp"

#include <cmath>
#include <complex>
#include <span>
#include <stdexcept>

#include "analysis/model/steady_state/jet.hpp"

namespace veritrack::model {

namespace {

using trackers::StraightLineProgram;

/// The results of a program at constants, then x + t direction.
template <int K>
std::vector<Jet<K>> run_along(const StraightLineProgram& program, const std::vector<double>& constants,
                              const Eigen::VectorXd& x, const Eigen::VectorXd& direction) {
  std::vector<Jet<K>> inputs;
  inputs.reserve(constants.size() + static_cast<std::size_t>(x.size()));
  for (const double constant : constants) {
    inputs.emplace_back(constant);
  }
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    inputs.emplace_back(x[i], direction[i]);
  }
  std::vector<Jet<K>> registers;
  std::vector<Jet<K>> results(program.results().size());
  program.run(std::span<const Jet<K>>(inputs), registers, std::span<Jet<K>>(results));
  return results;
}

std::vector<double> run_at(const StraightLineProgram& program, const std::vector<double>& constants,
                           const Eigen::VectorXd& x) {
  std::vector<double> inputs = constants;
  inputs.insert(inputs.end(), x.begin(), x.end());
  std::vector<double> registers;
  std::vector<double> results(program.results().size());
  program.run(std::span<const double>(inputs), registers, std::span<double>(results));
  return results;
}

Eigen::VectorXd joined(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd both(a.size() + b.size());
  both << a, b;
  return both;
}

/// The coefficient of t^order of every result.
template <int K>
Eigen::VectorXd coefficients_of(const std::vector<Jet<K>>& jets, int order) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(jets.size()));
  for (std::size_t i = 0; i < jets.size(); ++i) {
    result[static_cast<Eigen::Index>(i)] = jets[i].at(order);
  }
  return result;
}

}  // namespace

StepMap::StepMap(const trackers::Recursion& recursion, const std::vector<double>& constants)
    : recursion_(recursion), constants_(constants) {
  if (static_cast<int>(constants.size()) != recursion.constants) {
    throw std::invalid_argument("wrong number of constants of a tracker");
  }
}

Eigen::VectorXd StepMap::next(const Eigen::VectorXd& state, const Eigen::VectorXd& samples) const {
  const std::vector<double> next = run_at(recursion_.step, constants_, joined(state, samples));
  return Eigen::Map<const Eigen::VectorXd>(next.data(), states());
}

double StepMap::frequency(const Eigen::VectorXd& state) const {
  return run_at(recursion_.frequency, constants_, state).front();
}

Eigen::RowVectorXd StepMap::frequency_gradient(const Eigen::VectorXd& state) const {
  Eigen::RowVectorXd gradient(states());
  for (int i = 0; i < states(); ++i) {
    const Eigen::VectorXd direction = Eigen::VectorXd::Unit(states(), i);
    gradient[i] = run_along<1>(recursion_.frequency, constants_, state, direction).front().at(1);
  }
  return gradient;
}

Eigen::MatrixXd StepMap::frequency_hessian(const Eigen::VectorXd& state) const {
  const int n = states();
  const auto square_along = [&](const Eigen::VectorXd& direction) {
    return run_along<2>(recursion_.frequency, constants_, state, direction).front().at(2);
  };
  Eigen::VectorXd squares(n);
  Eigen::MatrixXd hessian(n, n);
  for (int i = 0; i < n; ++i) {
    squares[i] = square_along(Eigen::VectorXd::Unit(n, i));
    hessian(i, i) = 2.0 * squares[i];
    for (int j = 0; j < i; ++j) {
      const double both = square_along(Eigen::VectorXd::Unit(n, i) + Eigen::VectorXd::Unit(n, j));
      hessian(i, j) = hessian(j, i) = both - squares[i] - squares[j];
    }
  }
  return hessian;
}

Eigen::MatrixXd StepMap::jacobian(const Eigen::VectorXd& state, const Eigen::VectorXd& samples) const {
  const Eigen::VectorXd x = joined(state, samples);
  Eigen::MatrixXd result(states(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    result.col(i) =
        coefficients_of(run_along<1>(recursion_.step, constants_, x, Eigen::VectorXd::Unit(x.size(), i)), 1);
  }
  return result;
}

StepDerivatives StepMap::derivatives(const Eigen::VectorXd& state, const Eigen::VectorXd& samples,
                                     const Eigen::VectorXd& scale) const {
  const Eigen::VectorXd x = joined(state, samples);
  const Eigen::VectorXd size = joined(scale, Eigen::VectorXd::Ones(samples.size()));
  const int n = states();
  const int m = static_cast<int>(x.size());
  // Forms of degree 2 and 3 at sums of directions e_i give their polar forms; indices i <= j <= k < m.
  const auto along = [&](const Eigen::VectorXd& direction) {
    return run_along<3>(recursion_.step, constants_, x, direction.cwiseProduct(size));
  };
  const auto unit = [m](int i) { return Eigen::VectorXd::Unit(m, i); };
  Eigen::MatrixXd first(n, m);
  Eigen::MatrixXd square(n, m);
  Eigen::MatrixXd cube(n, m);
  for (int i = 0; i < m; ++i) {
    const auto jets = along(unit(i));
    first.col(i) = coefficients_of(jets, 1);
    square.col(i) = coefficients_of(jets, 2);
    cube.col(i) = coefficients_of(jets, 3);
  }
  StepDerivatives result;
  result.second.assign(static_cast<std::size_t>(n), Eigen::MatrixXd::Zero(m, m));
  result.third = Eigen::MatrixXd::Zero(n, n * n * n);
  Eigen::MatrixXd pair_cubes(n, m * m);
  for (int i = 0; i < m; ++i) {
    for (int j = i; j < m; ++j) {
      const auto jets = along(unit(i) + unit(j));
      const Eigen::VectorXd polar = coefficients_of(jets, 2) - square.col(i) - square.col(j);
      for (int row = 0; row < n; ++row) {
        auto& hessian = result.second[static_cast<std::size_t>(row)];
        hessian(i, j) = hessian(j, i) = polar[row] / (size[i] * size[j]);
      }
      pair_cubes.col(i * m + j) = pair_cubes.col(j * m + i) = coefficients_of(jets, 3);
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) {
      for (int k = j; k < n; ++k) {
        const Eigen::VectorXd all = coefficients_of(along(unit(i) + unit(j) + unit(k)), 3);
        const Eigen::VectorXd polar = (all - pair_cubes.col(i * m + j) - pair_cubes.col(i * m + k) -
                                       pair_cubes.col(j * m + k) + cube.col(i) + cube.col(j) + cube.col(k)) /
                                      (size[i] * size[j] * size[k]);
        for (const int place : {(i * n + j) * n + k, (i * n + k) * n + j, (j * n + i) * n + k,
                                (j * n + k) * n + i, (k * n + i) * n + j, (k * n + j) * n + i}) {
          result.third.col(place) = polar;
        }
      }
    }
  }
  const Eigen::MatrixXd unscaled = first * size.cwiseInverse().asDiagonal();
  result.state = unscaled.leftCols(n);
  result.sample = unscaled.rightCols(m - n);
  return result;
}

Eigen::VectorXd samples_of(const Signal& signal, double amplitude, double phase) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(signal.coefficients.size()));
  for (std::size_t c = 0; c < signal.coefficients.size(); ++c) {
    for (std::size_t h = 0; h < signal.coefficients[c].size(); ++h) {
      const std::complex<double> turn = std::polar(1.0, static_cast<double>(h) * phase);
      result[static_cast<Eigen::Index>(c)] += amplitude * (signal.coefficients[c][h] * turn).real();
    }
  }
  return result;
}

}  // namespace veritrack::model
