#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

namespace {

const Ball three(3.0);

template <typename Function>
Matrix3 each(const Function& entry) {
  Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] = entry(i, j);
    }
  }
  return result;
}

/// acos; of a ball that reaches beyond +-1, of what lies between.
Ball angle_of(const Ball& cosine) {
  const Ball sine = root_of_non_negative(one - square(cosine));
  // cannot bind (-cosine): both ways are right for every angle; each is sharp for half of them.
  const bool obtuse = certainly_positive(-cosine);
  Ball z;
  arb_atan2(z.raw(), sine.raw(), (obtuse ? -cosine : cosine).raw(), precision());
  return obtuse ? pi() - z : z;
}

}  // namespace

Matrix3 operator+(const Matrix3& x, const Matrix3& y) {
  return each([&](std::size_t i, std::size_t j) { return x[i][j] + y[i][j]; });
}
Matrix3 operator-(const Matrix3& x, const Matrix3& y) {
  return each([&](std::size_t i, std::size_t j) { return x[i][j] - y[i][j]; });
}

Matrix3 scaled(const Ball& factor, Matrix3 p) {
  for (auto& row : p) {
    for (Ball& entry : row) {
      entry = factor * entry;
    }
  }
  return p;
}

bool symmetric(const Matrix3& p) {
  return certainly_equal(p[1][0], p[0][1]) && certainly_equal(p[2][0], p[0][2]) &&
         certainly_equal(p[2][1], p[1][2]);
}

Matrix3 diagonal(const Ball& x, const Ball& y, const Ball& z) {
  Matrix3 result;
  result[0][0] = x;
  result[1][1] = y;
  result[2][2] = z;
  return result;
}

Matrix3 congruent(const Matrix3& a, const Matrix3& p) {
  const Matrix3 left = each([&](std::size_t i, std::size_t j) {
    return a[i][0] * p[0][j] + a[i][1] * p[1][j] + a[i][2] * p[2][j];
  });
  return each([&](std::size_t i, std::size_t j) {
    return left[i][0] * a[j][0] + left[i][1] * a[j][1] + left[i][2] * a[j][2];
  });
}

Matrix3 inverse(const Matrix3& p) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t r = (i + 1) % 3;
    const std::size_t s = (i + 2) % 3;
    const std::size_t u = (j + 1) % 3;
    const std::size_t v = (j + 2) % 3;
    return p[r][u] * p[s][v] - p[r][v] * p[s][u];
  };
  const Ball determinant = p[0][0] * cofactor(0, 0) + p[0][1] * cofactor(0, 1) + p[0][2] * cofactor(0, 2);
  return each([&](std::size_t i, std::size_t j) { return cofactor(j, i) / determinant; });
}

// With mean m and p^2 the mean square of P - m I over two: m + 2 p cos((acos(det((P - m I)/p)/2) + 2 pi
// k)/3).
Range extreme_eigenvalues(const Matrix3& a) {
  const Ball mean = (a[0][0] + a[1][1] + a[2][2]) / three;
  const Ball d0 = a[0][0] - mean;
  const Ball d1 = a[1][1] - mean;
  const Ball d2 = a[2][2] - mean;
  const Ball off = square(a[0][1]) + square(a[0][2]) + square(a[1][2]);
  const Ball p = sqrt((square(d0) + square(d1) + square(d2) + two * off) / Ball(6.0));
  const Ball determinant = d0 * (d1 * d2 - square(a[1][2])) - a[0][1] * (a[0][1] * d2 - a[1][2] * a[0][2]) +
                           a[0][2] * (a[0][1] * a[1][2] - d1 * a[0][2]);
  const Ball angle = angle_of(half * determinant / (p * square(p))) / three;
  return {mean + two * p * cos(angle + two * pi() / three), mean + two * p * cos(angle)};
}

Ball larger_eigenvalue(const Ball& a, const Ball& b, const Ball& c) {
  return half * (a + c) + sqrt(square(half * (a - c)) + square(b));
}

}  // namespace veritrack::checker
