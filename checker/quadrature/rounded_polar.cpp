// The effect of rounding on the state in the coordinates of the proofs: polar_rounding and rounding_share of
// rounded_step.hpp.
#include "checker/quadrature/rounded_step.hpp"

#include <cmath>

namespace veritrack::checker {

PolarRounding polar_rounding(const Rounding& rounding, const Ball& least_z, const Ball& most_zz,
                             const Ball& most_33) {
  // A turn by the angle a moves a 2x2 block by at most 2 a times its norm, a vector by a times its length.
  const Ball turn = arcsine(rounding.z / least_z).upper();
  const Ball most_z3 = sqrt(most_zz * most_33);
  return {rounding.z,
          turn,
          rounding.frequency,
          (rounding.p_zz + two * turn * (most_zz + rounding.p_zz)).upper(),
          (rounding.p_z3 + turn * (most_z3 + rounding.p_z3)).upper(),
          rounding.p_33};
}

Ball rounding_share(const Matrix3& p, const PolarRounding& rounding) {
  // 2 |x_z| |x_3| <= s |x_z|^2 + |x_3|^2 / s for every s.
  const Ball s(std::sqrt(std::fmax(p[0][0].near(), p[1][1].near()) / p[2][2].near()));
  const Ball of_z = rounding.p_zz + s * rounding.p_z3;
  const Ball of_d = rounding.p_33 + rounding.p_z3 / s;
  constexpr int kLeast = -52;
  constexpr int kMost = -8;
  for (int k = kLeast; k <= kMost; ++k) {
    Ball share(std::ldexp(1.0, k));
    Matrix3 rest = p;
    for (auto& row : rest) {
      for (Ball& entry : row) {
        entry = share * entry;
      }
    }
    if (definite(rest - diagonal(of_z, of_z, of_d))) {
      return share;
    }
  }
  return Ball::everything();
}

}  // namespace veritrack::checker
