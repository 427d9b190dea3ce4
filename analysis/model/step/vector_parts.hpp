// The parts of a vector of ball models: its linear parts and bounds of the others.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "analysis/model/step/enclosed_matrix.hpp"
#include "analysis/rigor/ball_model.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// P(s, z) P(s, z)' for a matrix P of polynomials in s and z, by exponents of s and z.
using Gram = std::map<std::pair<int, int>, EnclosedMatrix>;

/// A Gram matrix, and its factor.
struct WeightedGram {
  const Gram* gram = nullptr;
  rigor::Interval factor;
};

/// An upper bound of the largest eigenvalue of the weighted sum of the Gram matrices, all s and z in [-1, 1]:
/// a verified bound for the constant part, and the norms of the others. NaN when nothing is known, or a
/// factor is not positive. Needs the upward rounding mode.
[[nodiscard]] double joint_bound(const std::vector<WeightedGram>& parts);

/// P P' at s = z = 0, in floating point; no rows when there is nothing.
[[nodiscard]] Eigen::MatrixXd at_middle(const Gram& gram);

/// The parts of a vector of models in x of the unit ball and a disturbance v of another.
struct VectorParts {
  static constexpr std::size_t kDegrees = rigor::BallMonomials::kMostOfVectors + 1;
  Gram of_x;  ///< of the part of degree 1 in x
  Gram of_v;  ///< of the part of degree 1 in v
  Gram of_w;  ///< of the last disturbance, when it is bounded by itself
  /// [a][b]: bounds of the lengths of the parts of degree a in x and b in v, a + b != 1.
  std::array<std::array<rigor::Interval, kDegrees>, kDegrees> norms;
  rigor::Interval error;  ///< the length of the vector of errors; empty when nothing is known

  /// `last_alone`: the last component of v is kept apart. Needs the upward rounding mode.
  VectorParts(const std::vector<rigor::BallModel>& vector, bool last_alone);
};

}  // namespace veritrack::model
