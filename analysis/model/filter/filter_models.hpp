// Matrices of ball models, and the covariances of a filter over a cell.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/ball_model.hpp"

namespace veritrack::model {

/// A matrix of ball models, row by row.
class BallMatrix {
 public:
  BallMatrix(std::size_t rows, std::size_t columns) : columns_(columns), entries_(rows * columns) {}
  BallMatrix(std::vector<rigor::BallModel> entries, std::size_t columns)
      : columns_(columns), entries_(std::move(entries)) {}

  [[nodiscard]] std::size_t rows() const { return entries_.size() / columns_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] rigor::BallModel& operator()(std::size_t i, std::size_t j) {
    return entries_[i * columns_ + j];
  }
  [[nodiscard]] const rigor::BallModel& operator()(std::size_t i, std::size_t j) const {
    return entries_[i * columns_ + j];
  }
  [[nodiscard]] const std::vector<rigor::BallModel>& entries() const { return entries_; }

 private:
  std::size_t columns_;
  std::vector<rigor::BallModel> entries_;
};

[[nodiscard]] BallMatrix operator*(const BallMatrix& a, const BallMatrix& b);
[[nodiscard]] BallMatrix operator+(const BallMatrix& a, const BallMatrix& b);
[[nodiscard]] BallMatrix operator-(const BallMatrix& a, const BallMatrix& b);
[[nodiscard]] BallMatrix scaled(const BallMatrix& a, const rigor::BallModel& factor);
[[nodiscard]] BallMatrix transposed(const BallMatrix& a);
/// The symmetric matrix of a lower triangle, row by row.
[[nodiscard]] BallMatrix symmetric(const std::vector<rigor::BallModel>& triangle);
/// A P A'.
[[nodiscard]] BallMatrix congruent(const BallMatrix& a, const BallMatrix& p);
/// The lower triangular factor; entries are not known where a pivot can vanish.
[[nodiscard]] BallMatrix cholesky(const BallMatrix& a);
/// L^-1 b for a lower triangular L.
[[nodiscard]] std::vector<rigor::BallModel> solved(const BallMatrix& l,
                                                   const std::vector<rigor::BallModel>& b);

/// Whether a matrix of models in s and z alone is positive definite, in the whole cell. Symmetric: the lower
/// triangle is read.
[[nodiscard]] bool is_positive_definite(const BallMatrix& a);

/// Quantities of a filter at a place that depend on the constants of the design only.
struct FilterNoise {
  BallMatrix measured;  ///< H
  BallMatrix process;   ///< Q
  BallMatrix noise;     ///< R
  BallMatrix inverse;   ///< R^-1
};
[[nodiscard]] FilterNoise noise_of(const TrackerModel& model);

/// The inverse of a symmetric matrix of one or two rows; not known unless it is positive definite.
[[nodiscard]] BallMatrix inverse_of_positive(const BallMatrix& a);

/// P - P H' (H P H' + R)^-1 H P; not known unless H P H' + R is positive definite.
[[nodiscard]] BallMatrix updated(const BallMatrix& predicted, const FilterNoise& noise);

/// The values of the filter's parts at this estimate with these samples.
[[nodiscard]] trackers::FilterValues<rigor::BallModel> parts_at(const TrackerModel& model,
                                                                const std::vector<rigor::BallModel>& estimate,
                                                                const std::vector<rigor::BallModel>& samples);

}  // namespace veritrack::model
