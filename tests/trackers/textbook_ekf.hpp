// The oracle: the extended Kalman filter (2.3)-(2.7) of the thesis in full 3x3 matrices, with F and H of
// (3.8) and (3.9), written down as in a textbook and sharing no code with trackers/.
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace veritrack::test {

template <typename Real>
struct TextbookEkf {
  using Vector3 = Eigen::Matrix<Real, 3, 1>;
  using Matrix3 = Eigen::Matrix<Real, 3, 3>;
  using Vector2 = Eigen::Matrix<Real, 2, 1>;
  using Matrix2 = Eigen::Matrix<Real, 2, 2>;
  using Matrix23 = Eigen::Matrix<Real, 2, 3>;
  using Matrix32 = Eigen::Matrix<Real, 3, 2>;

  Real q1, q2, r, epsilon;
  Vector3 x;
  Matrix3 P;
  Matrix2 S = Matrix2::Zero();

  void time_update() {
    using std::cos;
    using std::sin;
    const Real c = cos(x(2));
    const Real s = sin(x(2));
    Matrix3 F;
    F << c, -s, -x(0) * s - x(1) * c,  //
        s, c, x(0) * c - x(1) * s,     //
        Real(0), Real(0), Real(1) - epsilon;
    Matrix3 f;
    f << c, -s, Real(0), s, c, Real(0), Real(0), Real(0), Real(1) - epsilon;
    Matrix3 Q = Matrix3::Zero();
    Q.diagonal() << q1, q1, q2;
    x = (f * x).eval();
    P = (F * P * F.transpose() + Q).eval();
  }

  void measurement_update(const Vector2& y) {
    Matrix23 H;
    H << Real(1), Real(0), Real(0), Real(0), Real(1), Real(0);
    S = H * P * H.transpose() + r * Matrix2::Identity();
    const Matrix32 K = P * H.transpose() * S.inverse();
    x = (x + K * (y - H * x)).eval();
    P = ((Matrix3::Identity() - K * H) * P).eval();
  }

  void step(const Vector2& y) {
    time_update();
    measurement_update(y);
  }
};

}  // namespace veritrack::test
