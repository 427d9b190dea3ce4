// Eigen's requirements on a type stored in matrices.
#pragma once

#include <Eigen/Core>

namespace veritrack::rigor {

/// Base of Eigen::NumTraits<Scalar> for the real number types of this folder. The costs only tell Eigen when
/// to store an intermediate result instead of computing it again.
template <typename Scalar, int kReadCost, int kAddCost, int kMultiplyCost>
struct EigenScalar : Eigen::GenericNumTraits<Scalar> {
  using Real = Scalar;
  using NonInteger = Scalar;
  using Nested = Scalar;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = kReadCost,
    AddCost = kAddCost,
    MulCost = kMultiplyCost
  };
};

/// For scalars that consist of many numbers: nothing is computed twice.
template <typename Scalar>
using CostlyEigenScalar = EigenScalar<Scalar, Eigen::HugeCost, Eigen::HugeCost, Eigen::HugeCost>;

}  // namespace veritrack::rigor
