#include "checker/dft_block/block_matrices.hpp"

namespace veritrack::checker {

namespace {

Ball sum_of_squares(const Matrix3& a) {
  Ball sum = zero;
  for (const auto& row : a) {
    for (const Ball& entry : row) {
      sum += square(entry);
    }
  }
  return sum;
}

Matrix3 middle_of(const Matrix3& a) {
  Matrix3 c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      c[i][j] = a[i][j].middle();
    }
  }
  return c;
}

}  // namespace

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
  }
  return c;
}

Matrix3 transposed(const Matrix3& a) {
  Matrix3 c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      c[i][j] = a[j][i];
    }
  }
  return c;
}

Matrix3 about(const Matrix3& a, const Matrix3& b) {
  return product(product(a, b), transposed(a));
}

Matrix3 identity(const Ball& scale) {
  return diagonal(scale, scale, scale);
}

// With M the middle, X = M^-1 and D = A - M, A^-1 = X - X D X + X D A^-1 D X, and |A^-1| <=
// |X|/(1 - |X D|). (M need not be symmetric to the last bit.)
Matrix3 inverse_near(const Matrix3& a) {
  const Matrix3 m = middle_of(a);
  const Matrix3 x = inverse(m);
  const Matrix3 d = a - m;
  const Matrix3 xd = product(x, d);
  const Ball size = root_of_non_negative(sum_of_squares(xd)).upper();
  const Ball other = root_of_non_negative(sum_of_squares(product(d, x))).upper();
  const Ball rest = size * other * root_of_non_negative(sum_of_squares(x)).upper() / (one - size);
  const bool is_small = certainly_less(size, one);
  const Ball around = is_small ? Ball::within(rest) : Ball::everything();
  Matrix3 c = x - product(xd, x);
  for (auto& row : c) {
    for (Ball& entry : row) {
      entry += around;
    }
  }
  return c;
}

bool definite_together(const Matrix3& a, const Matrix3& b, const Matrix3& c) {
  SquareMatrix<6> all;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      all[i][j] = a[i][j];
      all[i + 3][j] = b[i][j];
      all[i][j + 3] = b[j][i];
      all[i + 3][j + 3] = c[i][j];
    }
  }
  return definite(all);
}

bool definite_together(const Matrix3& a, const Matrix3& b, const Matrix3& c, const Matrix3& d,
                       const Matrix3& e, const Matrix3& f) {
  const std::array<std::array<const Matrix3*, 3>, 3> lower{{{&a, &b, &d}, {&b, &c, &e}, {&d, &e, &f}}};
  SquareMatrix<9> all;
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      all[i][j] = (*lower[i / 3][j / 3])[i % 3][j % 3];
      all[j][i] = all[i][j];
    }
  }
  return definite(all);
}

}  // namespace veritrack::checker
