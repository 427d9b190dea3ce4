// The self-tuning regulator that removes a sinusoid of unknown frequency from the output of an unknown plant.
//
// B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis, Australian National
// University, 1994, chapter 5. Equation numbers are the thesis's. N is the order of plant and disturbance
// together,
//     phi_k = (y_k ... y_{k-N+1}, u_k ... u_{k-N+1}),   theta of length 2N:
// an estimator fits y_k by phi_{k-1}' theta, and the controller (5.8) chooses u_k so that phi_k' theta_k = 0.
//
// Two estimators: least squares with condition number monitoring, (5.9)-(5.14), and with exponential
// forgetting and resetting, EFRA, of section 5.4.
//
// What the thesis prints differently:
//   (5.5)   the data obey y_{k+1} = phi_k' (-a, b), not phi_k' (c - a, b): the terms c_i y are those of e,
//   which is 0.
//           Only in the loop that the ideal controller has closed are the two the same, since there y = e =
//           0.
//   5.2.5   what (5.12)-(5.14) bound is r lambda_max(P). A factor leaves the condition number of P as it is,
//   so that it
//           may grow without end. "r_k <= Lambda trace" needs r_{-1} lambda_max(P_{-1}) <= Lambda, which is
//           not said.
//   5.4     the lower bound of EFRA has gamma^2 under the root where (alpha - gamma)^2 belongs: 0.80 for the
//   printed
//           design instead of the printed 0.011, which is right. The upper bound is 10.62, printed as 10.1.
//   5.4.2   the poles "-3.2232, 2.2085" of Table 5.2 are in z^-1; the controller's are -0.3103 and 0.4528.
//   5.4     "matches the ideal controller at omega" is true of the pole alone: at omega the numerators of
//   Table 5.1
//           differ.
// The thesis assumes nothing of theta_{N+1}, by which (5.8) divides: here zero is an error.
//
// A template over a floating-point scalar and N; a step does not allocate.
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <concepts>
#include <stdexcept>

namespace veritrack::trackers {

/// theta or phi.
template <typename Scalar, int N>
using RegulatorVector = Eigen::Matrix<Scalar, 2 * N, 1>;

/// Thrown by the controller when the estimate of b_0 is exactly zero.
class ZeroLeadingCoefficient : public std::domain_error {
 public:
  ZeroLeadingCoefficient()
      : std::domain_error(
            "the estimate of b_0, by which the minimum-variance law divides, is exactly zero: start the "
            "estimator with another one") {}
};

/// The minimum-variance law (5.8): u_k with phi_k' theta = 0, for phi_k with the y up to k and the u up to
/// k-1; its entry N, the place of u_k, is not read. Throws ZeroLeadingCoefficient.
template <typename Scalar, int Size>
[[nodiscard]] inline Scalar minimum_variance_control(const Eigen::Matrix<Scalar, Size, 1>& theta,
                                                     const Eigen::Matrix<Scalar, Size, 1>& phi) {
  constexpr int kOrder = Size / 2;
  if (theta(kOrder) == Scalar(0.0)) {
    throw ZeroLeadingCoefficient();
  }
  Scalar sum(0.0);
  for (int i = 0; i < Size; ++i) {
    if (i != kOrder) {
      sum = sum + theta(i) * phi(i);
    }
  }
  return -sum / theta(kOrder);
}

/// Recursive least squares with condition number monitoring, (5.9)-(5.14).
template <std::floating_point Scalar, int N>
class MonitoredLeastSquares {
 public:
  using Vector = RegulatorVector<Scalar, N>;
  using Matrix = Eigen::Matrix<Scalar, 2 * N, 2 * N>;

  /// theta_0, P_{-1} (symmetric, positive definite), r_{-1} > 0 and Lambda > 0.
  MonitoredLeastSquares(const Vector& theta, const Matrix& p, Scalar r, Scalar limit)
      : theta_(theta), p_(p), r_(r), limit_(limit) {}

  /// y_k, and phi_{k-1} that predicts it.
  void update(const Vector& phi, const Scalar& output) {
    const Vector direction = p_ * phi;
    const Scalar growth = Scalar(1) + phi.dot(direction);
    theta_ += direction * ((output - phi.dot(theta_)) / growth);
    // Entry by entry of the triangle below, so that P stays symmetric to the last bit.
    for (int j = 0; j < 2 * N; ++j) {
      for (int i = j; i < 2 * N; ++i) {
        p_(i, j) -= direction(i) * direction(j) / growth;
        p_(j, i) = p_(i, j);
      }
    }
    r_ *= growth;
    const Scalar largest =
        Eigen::SelfAdjointEigenSolver<Matrix>(p_, Eigen::EigenvaluesOnly).eigenvalues()(2 * N - 1);
    if (r_ * largest > limit_) {
      p_ *= limit_ / (r_ * largest);
    }
  }

  [[nodiscard]] const Vector& theta() const { return theta_; }
  [[nodiscard]] const Matrix& covariance() const { return p_; }
  /// r of (5.11).
  [[nodiscard]] Scalar normalisation() const { return r_; }

 private:
  Vector theta_;
  Matrix p_;
  Scalar r_;
  Scalar limit_;
};

/// The engineer's choices for EFRA.
template <typename Scalar>
struct EfraDesign {
  Scalar alpha;   ///< gain; in (gamma, 1), gamma = (1 - lambda) / lambda
  Scalar beta;    ///< added to P with every sample; > 0
  Scalar lambda;  ///< forgetting factor; in (0, 1)
  Scalar delta;   ///< subtracted from P, times P^2; > 0
};

/// alpha = 0.5, beta = 0.005, lambda = 0.95, delta = 0.005, of section 5.4.
template <typename Scalar>
[[nodiscard]] inline EfraDesign<Scalar> thesis_efra_design() {
  return {Scalar(0.5), Scalar(0.005), Scalar(0.95), Scalar(0.005)};
}

/// The interval [lower, upper] of the eigenvalues of P that EFRA does not leave.
template <typename Scalar>
struct EfraBounds {
  Scalar lower;
  Scalar upper;
};

/// The fixed points without excitation, P -> P / lambda + beta I - delta P^2, and with as much as there can
/// be, Pphiphi'P / (1 + g) <= P, P -> (1/lambda - alpha) P + beta I - delta P^2:
///     2 delta upper = gamma + sqrt(gamma^2 + 4 beta delta),
///     2 delta lower = -(alpha - gamma) + sqrt((alpha - gamma)^2 + 4 beta delta).
template <typename Scalar>
[[nodiscard]] inline EfraBounds<Scalar> efra_bounds(const EfraDesign<Scalar>& design) {
  using std::sqrt;
  const Scalar gamma = (Scalar(1.0) - design.lambda) / design.lambda;
  const Scalar margin = design.alpha - gamma;
  const Scalar product = Scalar(4.0) * design.beta * design.delta;
  const Scalar twice = design.delta + design.delta;
  return {(sqrt(margin * margin + product) - margin) / twice,
          (sqrt(gamma * gamma + product) + gamma) / twice};
}

/// Whether [lower, upper] is certain to be kept. Both fixed-point maps are functions of P, concave in each
/// eigenvalue: the upper one rises on all of the interval when gamma^2 + 4 beta delta <= 1, and the lower one
/// stays above `lower` when it does so at the upper end, (1 - alpha) upper >= lower. Derived here: the thesis
/// has other conditions.
template <typename Scalar>
[[nodiscard]] inline bool efra_keeps_bounds(const EfraDesign<Scalar>& design) {
  const Scalar gamma = (Scalar(1.0) - design.lambda) / design.lambda;
  const EfraBounds<Scalar> bounds = efra_bounds(design);
  return gamma > Scalar(0.0) && gamma < design.alpha && design.alpha < Scalar(1.0) &&
         design.beta > Scalar(0.0) && design.delta > Scalar(0.0) &&
         gamma * gamma + Scalar(4.0) * design.beta * design.delta <= Scalar(1.0) &&
         (Scalar(1.0) - design.alpha) * bounds.upper >= bounds.lower;
}

/// Recursive least squares with exponential forgetting and resetting, section 5.4 (Salgado, Goodwin and
/// Middleton, "Modified least squares algorithm incorporating exponential resetting and forgetting", 1988).
template <std::floating_point Scalar, int N>
class EfraLeastSquares {
 public:
  using Vector = RegulatorVector<Scalar, N>;
  using Matrix = Eigen::Matrix<Scalar, 2 * N, 2 * N>;

  /// theta_0 and P_{-1}, symmetric with eigenvalues within efra_bounds.
  EfraLeastSquares(const EfraDesign<Scalar>& design, const Vector& theta, const Matrix& p)
      : design_(design), theta_(theta), p_(p) {}

  /// y_k, and phi_{k-1} that predicts it.
  void update(const Vector& phi, const Scalar& output) {
    const Vector direction = p_ * phi;
    const Scalar weight = design_.alpha / (Scalar(1) + phi.dot(direction));
    theta_ += direction * (weight * (output - phi.dot(theta_)));
    Matrix next;
    for (int j = 0; j < 2 * N; ++j) {
      for (int i = j; i < 2 * N; ++i) {
        next(i, j) = p_(i, j) / design_.lambda - weight * direction(i) * direction(j) -
                     design_.delta * p_.col(i).dot(p_.col(j)) + (i == j ? design_.beta : Scalar(0));
        next(j, i) = next(i, j);
      }
    }
    p_ = next;
  }

  [[nodiscard]] const Vector& theta() const { return theta_; }
  [[nodiscard]] const Matrix& covariance() const { return p_; }

 private:
  EfraDesign<Scalar> design_;
  Vector theta_;
  Matrix p_;
};

/// The regulator with its memory, from rest: all y and u before the first step are zero. `Estimator` is one
/// of the two.
template <typename Scalar, int N, typename Estimator>
class SelfTuningRegulator {
 public:
  using Vector = RegulatorVector<Scalar, N>;

  explicit SelfTuningRegulator(const Estimator& estimator) : estimator_(estimator) { phi_.setZero(); }

  /// u_k from y_k. Throws ZeroLeadingCoefficient.
  Scalar step(const Scalar& output) {
    estimator_.update(phi_, output);
    for (int i = N - 1; i > 0; --i) {
      phi_(i) = phi_(i - 1);
      phi_(N + i) = phi_(N + i - 1);
    }
    phi_(0) = output;
    phi_(N) = minimum_variance_control<Scalar, 2 * N>(estimator_.theta(), phi_);
    return phi_(N);
  }

  [[nodiscard]] const Estimator& estimator() const { return estimator_; }
  /// phi_k of the last step.
  [[nodiscard]] const Vector& regressor() const { return phi_; }

 private:
  Estimator estimator_;
  Vector phi_;
};

}  // namespace veritrack::trackers
