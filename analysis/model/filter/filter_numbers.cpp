#include "analysis/model/filter/filter_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace veritrack::model::detail {

namespace {

/// The matrix of these entries, row by row.
SmallMatrix matrix_of_rows(const double* entries, Index rows, Index columns) {
  SmallMatrix matrix(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      matrix(i, j) = entries[i * columns + j];
    }
  }
  return matrix;
}

SmallVector moved(SmallVector estimate, double part, const SmallVector& direction) {
  estimate += part * direction;
  return estimate;
}

}  // namespace

FilterNumbers::FilterNumbers(const TrackedTone& tone)
    : parts_(tone.filter), inputs_(tone.step.constants()), constants_(inputs_.size()) {
  inputs_.resize(constants_ + static_cast<std::size_t>(parts_->states + parts_->samples), 1.0);
  const auto values = trackers::filter_values(*parts_, inputs_);
  const Index n = parts_->states;
  const Index c = parts_->samples;
  measured_ = matrix_of_rows(values.measured.data(), c, n);
  process_ = matrix_of_rows(values.process.data(), n, n);
  noise_ = matrix_of_rows(values.noise.data(), c, c);
  weighted_ = rigor::product(rigor::approximate_inverse(noise_), measured_);
}

SmallMatrix FilterNumbers::jacobian(const SmallVector& estimate) {
  std::copy(estimate.begin(), estimate.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(constants_));
  results_.resize(parts_->program.results().size());
  parts_->program.run(std::span<const double>(inputs_), registers_, std::span<double>(results_));
  return matrix_of_rows(results_.data() + states(), states(), states());
}

SmallVector FilterNumbers::predicted() const {
  SmallVector prediction(states());
  std::copy_n(results_.begin(), states(), prediction.begin());
  return prediction;
}

SmallMatrix FilterNumbers::slope(const SmallVector& estimate) {
  if (!parts_->has_given_jacobian) {
    return jacobian(estimate);
  }
  constexpr double kPart = 1e-5;
  const Index n = states();
  SmallMatrix f(n, n);
  for (Index j = 0; j < n; ++j) {
    const double change = kPart * std::max(1e-3, std::fabs(estimate[j]));
    SmallVector higher = estimate;
    SmallVector lower = estimate;
    higher[j] += change;
    lower[j] -= change;
    (void)jacobian(higher);
    const SmallVector above = predicted();
    (void)jacobian(lower);
    f.col(j) = rigor::combination(0.5 / change, above, -0.5 / change, predicted());
  }
  return f;
}

SmallMatrix FilterNumbers::change(const SmallVector& estimate, const SmallVector& direction) {
  constexpr double kPart = 1e-4;
  return rigor::combination(0.5 / kPart, jacobian(moved(estimate, kPart, direction)), -0.5 / kPart,
                            jacobian(moved(estimate, -kPart, direction)));
}

SmallMatrix FilterNumbers::change_of_slope(const SmallVector& estimate, const SmallVector& direction) {
  if (!parts_->has_given_jacobian) {
    return change(estimate, direction);
  }
  constexpr double kPart = 1e-3;
  return rigor::combination(0.5 / kPart, slope(moved(estimate, kPart, direction)), -0.5 / kPart,
                            slope(moved(estimate, -kPart, direction)));
}

SmallMatrix FilterNumbers::updated(const SmallMatrix& predicted) const {
  const SmallMatrix cross = rigor::product(measured_, predicted);
  const SmallMatrix innovation =
      rigor::combination(1.0, rigor::product_with_transpose(cross, measured_), 1.0, noise_);
  const SmallMatrix known =
      rigor::product(rigor::transposed(cross), rigor::symmetric_solution(innovation, cross));
  const SmallMatrix result = rigor::combination(1.0, predicted, -1.0, known);
  return rigor::combination(0.5, result, 0.5, rigor::transposed(result));
}

}  // namespace veritrack::model::detail
