// Matrices of balls of any size: Arb's with C++ operators.
#pragma once

#include <arb_mat.h>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

class Matrix {
 public:
  /// Zeros.
  Matrix(slong rows, slong columns) { arb_mat_init(x_, rows, columns); }
  Matrix(const Matrix& other) : Matrix(other.rows(), other.columns()) { arb_mat_set(x_, other.x_); }
  Matrix(Matrix&& other) noexcept : Matrix(0, 0) { arb_mat_swap(x_, other.x_); }
  ~Matrix() { arb_mat_clear(x_); }
  Matrix& operator=(const Matrix& other) = delete;
  Matrix& operator=(Matrix&& other) noexcept {
    arb_mat_swap(x_, other.x_);
    return *this;
  }

  [[nodiscard]] slong rows() const { return arb_mat_nrows(x_); }
  [[nodiscard]] slong columns() const { return arb_mat_ncols(x_); }
  [[nodiscard]] Ball operator()(slong row, slong column) const {
    Ball z;
    arb_set(z.raw(), arb_mat_entry(x_, row, column));
    return z;
  }
  void set(slong row, slong column, const Ball& value) {
    arb_set(arb_mat_entry(x_, row, column), value.raw());
  }

  [[nodiscard]] Matrix transposed() const {
    Matrix z(columns(), rows());
    arb_mat_transpose(z.x_, x_);
    return z;
  }
  /// Balls of everything when a matrix in the balls may be singular.
  [[nodiscard]] Matrix inverse() const {
    Matrix z(rows(), columns());
    if (arb_mat_inv(z.x_, x_, precision()) == 0) {
      arb_mat_indeterminate(z.x_);
    }
    return z;
  }
  /// The solutions of A x = b for all A in the balls of this one; balls of everything when one of them may be
  /// singular.
  [[nodiscard]] Matrix solve(const Matrix& b) const {
    Matrix x(columns(), b.columns());
    if (arb_mat_solve_precond(x.x_, x_, b.x_, precision()) == 0) {
      arb_mat_indeterminate(x.x_);
    }
    return x;
  }
  /// True only when every symmetric matrix whose lower triangle is in the balls is positive definite.
  [[nodiscard]] bool definite(CHECKER_SOLE_PLACE) const {
    CHECKER_IF_FORCED
    Matrix factor(rows(), columns());
    return arb_mat_cho(factor.x_, x_, precision()) != 0;
  }

  friend Matrix operator+(const Matrix& x, const Matrix& y) {
    Matrix z(x.rows(), x.columns());
    arb_mat_add(z.x_, x.x_, y.x_, precision());
    return z;
  }
  friend Matrix operator-(const Matrix& x, const Matrix& y) {
    Matrix z(x.rows(), x.columns());
    arb_mat_sub(z.x_, x.x_, y.x_, precision());
    return z;
  }
  friend Matrix operator*(const Matrix& x, const Matrix& y) {
    Matrix z(x.rows(), y.columns());
    arb_mat_mul_classical(z.x_, x.x_, y.x_, precision());
    return z;
  }
  friend Matrix operator*(const Ball& x, const Matrix& y) {
    Matrix z(y.rows(), y.columns());
    arb_mat_scalar_mul_arb(z.x_, y.x_, x.raw(), precision());
    return z;
  }

 private:
  arb_mat_t x_;
};

}  // namespace veritrack::checker
