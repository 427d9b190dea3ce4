#include "analysis/kkl_observer/kkl_identities.hpp"

namespace veritrack::kkl_observer {

namespace {

using Integer = std::int64_t;
using Four = std::array<Integer, 4>;

/// M as printed below (9), applied to xi.
Four printed_matrix_times(const Four& l, const Four& x) {
  return {(l[2] - l[3]) * x[1] + (l[3] - l[1]) * x[2] + (l[1] - l[2]) * x[3],
          (l[3] - l[2]) * x[0] + (l[0] - l[3]) * x[2] + (l[2] - l[0]) * x[3],
          (l[1] - l[3]) * x[0] + (l[3] - l[0]) * x[1] + (l[0] - l[1]) * x[3],
          (l[2] - l[1]) * x[0] + (l[0] - l[2]) * x[1] + (l[1] - l[0]) * x[2]};
}

Integer dot(const Four& a, const Four& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// The residual of (3) times lambda^2 + x3, for x1' = sign x2, x2' = -sign x3 x1.
rigor::Verdict residual_is_zero(Integer sign) {
  return is_zero_polynomial<4>(
      [sign](const std::array<Integer, 4>& p) {
        const auto [lambda, x1, x2, x3] = p;
        const Integer slope_times = lambda * (sign * x2) - sign * x3 * x1;  // of lambda x1 + x2
        return slope_times + lambda * (lambda * x1 + x2) - (lambda * lambda + x3) * x1;
      },
      2);
}

}  // namespace

rigor::Verdict transform_is_invariant() {
  return residual_is_zero(-1);
}

rigor::Verdict transform_is_invariant_with_other_sign() {
  return residual_is_zero(1);
}

rigor::Verdict determinant_is_excitation() {
  return is_zero_polynomial<8>(
      [](const std::array<Integer, 8>& p) {
        const Four lambda{p[0], p[1], p[2], p[3]};
        const Four xi{p[4], p[5], p[6], p[7]};
        const Four one{1, 1, 1, 1};
        const Integer ll = dot(lambda, lambda);
        const Integer l1 = dot(lambda, one);
        const Integer lx = -dot(lambda, xi);
        const Integer ox = -dot(one, xi);
        const Integer xx = dot(xi, xi);
        const Integer determinant =
            ll * (4 * xx - ox * ox) - l1 * (l1 * xx - ox * lx) + lx * (l1 * ox - 4 * lx);
        const Four image = printed_matrix_times(lambda, xi);
        return determinant - dot(image, image);
      },
      2);
}

rigor::Verdict null_space_holds_lambda_and_one() {
  return is_zero_polynomial<4>(
      [](const Four& lambda) {
        const Four by_lambda = printed_matrix_times(lambda, lambda);
        const Four by_one = printed_matrix_times(lambda, {1, 1, 1, 1});
        Integer sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          sum += by_lambda[i] * by_lambda[i] + by_one[i] * by_one[i];
        }
        return sum;  // of degree at most 4 in each rate
      },
      4);
}

}  // namespace veritrack::kkl_observer
