// The oracle: the extended Kalman filter (2) of Bittanti and Savaresi in full 3x3 matrices, for any Q,
// written down as in the paper and sharing no code with trackers/.
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace veritrack::test {

template <typename Real>
struct TextbookSingleChannelEkf {
  using Vector3 = Eigen::Matrix<Real, 3, 1>;
  using Matrix3 = Eigen::Matrix<Real, 3, 3>;

  Matrix3 Q;
  Real r, epsilon;
  Vector3 x;
  Matrix3 P;
  Vector3 K = Vector3::Zero();
  Real S = Real(0);

  void time_update() {
    using std::cos;
    using std::sin;
    const Real c = cos(x(2));
    const Real s = sin(x(2));
    Matrix3 F;
    F << c, -s, -x(0) * s - x(1) * c,  //
        s, c, x(0) * c - x(1) * s,     //
        Real(0), Real(0), Real(1) - epsilon;
    x = Vector3(c * x(0) - s * x(1), s * x(0) + c * x(1), (Real(1) - epsilon) * x(2));
    P = (F * P * F.transpose() + Q).eval();
  }

  void measurement_update(const Real& y) {
    const Vector3 H(Real(1), Real(0), Real(0));
    S = H.dot(P * H) + r;
    K = P * H / S;
    x = (x + K * (y - H.dot(x))).eval();
    P = ((Matrix3::Identity() - K * H.transpose()) * P).eval();
  }

  void step(const Real& y) {
    time_update();
    measurement_update(y);
  }
};

}  // namespace veritrack::test
