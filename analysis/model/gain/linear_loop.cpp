#include "analysis/model/gain/linear_loop.hpp"

#include <cmath>
#include <vector>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

constexpr double kLittle = 1e-6;  // noise that is small for any detector

Eigen::VectorXd middle_of(const linear::Row& row) {
  Eigen::VectorXd middle(static_cast<Eigen::Index>(row.size()));
  for (std::size_t i = 0; i < row.size(); ++i) {
    middle(static_cast<Eigen::Index>(i)) = rigor::midpoint(row[i]);
  }
  return middle;
}

/// The effect of noise of size 1 on the states, for each component of an input.
std::vector<Eigen::VectorXd> noise_columns(const LoopNetwork& network, std::size_t input) {
  const rigor::UpwardRounding upward;  // sizes are bounds
  std::vector<Eigen::VectorXd> columns;
  const double size =
      network.inputs[input].size(kLittle, 0.0, std::vector<double>(network.forms.size(), 0.0));
  for (const linear::Row& column : network.columns[input].columns) {
    const Eigen::VectorXd middle = middle_of(column);
    if (network.inputs[input].cause == NetworkInput::Cause::noise && middle.norm() > 0.0) {
      columns.emplace_back(size / kLittle * middle);
    }
  }
  return columns;
}

Eigen::MatrixXd matrix_of(const LoopNetwork& network) {
  const auto n = static_cast<Eigen::Index>(network.a.size());
  Eigen::MatrixXd a(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    a.row(i) = middle_of(network.a[static_cast<std::size_t>(i)]).transpose();
  }
  return a;
}

}  // namespace

linear::LinearLoop linear_loop(const LoopNetwork& network) {
  linear::LinearLoop loop;
  loop.a = matrix_of(network);
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t l = 0; l < network.inputs.size(); ++l) {
    for (Eigen::VectorXd& column : noise_columns(network, l)) {
      columns.push_back(std::move(column));
    }
    if (network.inputs[l].cause == NetworkInput::Cause::slew) {
      loop.step = middle_of(network.columns[l].columns.front());
    }
  }
  loop.noise.resize(loop.a.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    loop.noise.col(static_cast<Eigen::Index>(i)) = columns[i];
  }
  loop.estimate = middle_of(network.forms.back()).transpose();
  if (network.has_ripples) {
    // One channel: the noise of a sample is one number, times a sine and a cosine.
    loop.noise *= std::sqrt(0.5);
    loop.tone_share = std::sqrt(0.5);
  }
  return loop;
}

}  // namespace veritrack::model
