// The matrix whose definiteness is the step inequality (docs/contraction.md, section 4), with all eight rows.
#pragma once

#include <array>

#include "checker/numbers/matrix3.hpp"
#include "checker/quadrature/step.hpp"

namespace veritrack::checker::step_form {

constexpr std::size_t kSize = 8;
/// Rows: the noise (2), T e+ (3), and the error by nu, across the axis and along it.
enum Row : std::size_t { kNoise = 0, kNext = 2, kNu = 5, kAcross = 6, kAlong = 7 };

/// The lower triangle of a symmetric matrix.
template <typename S>
using Matrix = std::array<std::array<S, kSize>, kSize>;

template <typename S>
S dot(const std::array<S, 3>& x, const std::array<S, 3>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// The matrix of docs/contraction.md section 4, as fixed + lambda by_lambda + by_inverse / lambda.
template <typename S>
struct Form {
  Matrix<S> fixed, by_lambda, by_inverse;
  bool meaningful = false;
};

/// T (amplitude, phase, frequency) for a vector of errors.
template <typename S>
std::array<S, 3> image(const Metric& t, const S& amplitude, const S& phase, const S& frequency) {
  return {t.amplitude * amplitude, t.phase * phase + t.coupling * frequency, t.frequency * frequency};
}

/// The errors (a, chi) of a unit along and across the axis.
using AxisErrors = std::array<std::array<Ball, 2>, 2>;

/// Rows of the errors: rate^2 |T e|^2.
template <typename S>
void add_size(const Setting& setting, const AxisErrors& errors, Matrix<S>& m) {
  const Metric& t = setting.metric;
  const Matrix3 before{{{zero, t.coupling - t.phase, t.frequency},
                        image(t, errors[0][0], errors[0][1], zero),
                        image(t, errors[1][0], errors[1][1], zero)}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      m[kNu + i][kNu + j] = square(setting.rate) * dot(before[i], before[j]);
    }
  }
}

/// T e+ by the errors: the step under the mean gain.
template <typename S>
void add_mean_step(const Metric& t, const Correction<S>& c, const Secant<S>& left,
                   const std::array<std::array<S, 2>, 2>& innovation, Matrix<S>& m) {
  const std::array<Ball, 3> carried{zero, t.coupling, t.frequency};
  for (std::size_t k = 0; k < 3; ++k) {
    m[kNu][kNext + k] = carried[k];
  }
  const S rest1 = one - c.k1;
  const S rest2 = one - c.k2;
  for (std::size_t i = 0; i < 2; ++i) {
    const S d1 = -(rest1 * innovation[i][0]);
    const S d2 = -(rest2 * innovation[i][1]);
    const std::array<S, 3> after = image<S>(t, left.length[0] * d1 + left.length[1] * d2,
                                            left.angle[0] * d1 + left.angle[1] * d2, c.k3 * innovation[i][1]);
    for (std::size_t k = 0; k < 3; ++k) {
      m[kAcross + i][kNext + k] = after[k];
    }
  }
}

/// The contributions of the spread of the gain and of the slew to T e+. `b` is T J for a correction along,
/// across, and of the frequency.
template <typename S>
void add_spread(const Setting& setting, const Covariance<S>& spread, const std::array<std::array<S, 3>, 3>& b,
                Form<S>& form) {
  const std::array<Ball, 3> carried{zero, setting.metric.coupling, setting.metric.frequency};
  const Ball over_r2 = one / square(setting.r);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t l = 0; l <= k; ++l) {
      form.by_inverse[kNext + k][kNext + l] = -(
          over_r2 * (spread.p11 * b[0][k] * b[0][l] + spread.p22 * b[1][k] * b[1][l] +
                     spread.p23 * (b[1][k] * b[2][l] + b[2][k] * b[1][l]) + spread.p33 * b[2][k] * b[2][l]));
      S& entry = form.fixed[kNext + k][kNext + l];
      entry = Ball(k == l ? 1.0 : 0.0);
      if (setting.slewing) {
        entry = entry - carried[k] * carried[l] / square(setting.slew_gain);
      }
    }
  }
}

/// The innovation, by the errors and by the noise; and T e+ by the noise.
template <typename S>
void add_innovation(const Setting& setting, const Correction<S>& c, const std::array<std::array<S, 3>, 3>& b,
                    const std::array<std::array<S, 2>, 2>& innovation, Form<S>& form) {
  const std::array<S, 2> spread{c.spread.p11, c.spread.p22};
  for (std::size_t j = 0; j < 2; ++j) {
    form.fixed[j][j] = setting.noisy ? square(setting.noise_gain) : one;
    for (std::size_t i = 0; i < 2; ++i) {
      const S pull = spread[j] * innovation[i][j];
      for (std::size_t l = 0; l <= i; ++l) {
        form.by_lambda[kAcross + i][kAcross + l] =
            form.by_lambda[kAcross + i][kAcross + l] - pull * innovation[l][j];
      }
      if (setting.noisy) {
        form.by_lambda[kAcross + i][j] = -pull;
      }
    }
    if (setting.noisy) {
      form.by_lambda[j][j] = -spread[j];
    }
  }
  if (setting.noisy) {
    for (std::size_t k = 0; k < 3; ++k) {
      form.fixed[kNext + k][0] = b[0][k] * c.k1;
      form.fixed[kNext + k][1] = b[1][k] * c.k2 + b[2][k] * c.k3;
    }
  }
}

/// `x` is (s, beta, d1, d2), `axis` = (cos, sin) of the axis that x and y of the document refer to.
template <typename S>
Form<S> form_of(const Setting& setting, const std::array<S, kVariables>& x, const std::array<Ball, 2>& axis) {
  const Metric& t = setting.metric;
  const AxisErrors errors{{{-(setting.largest_amplitude * axis[1]), setting.largest_chi * axis[0]},
                           {setting.largest_amplitude * axis[0], setting.largest_chi * axis[1]}}};
  const S a = x[0] * setting.largest_amplitude * cos(x[1]);
  const S chi = x[0] * setting.largest_chi * sin(x[1]);
  const Correction<S> c = correction(setting, a, chi);
  const Secant<S> left = secant(c.signal, c.mean);
  const Secant<S> moved = secant(c.mean, {c.mean[0] + x[2], c.mean[1] + x[3]});
  Form<S> form;
  // cannot bind (value_of(left.dot), value_of(moved.dot), value_of(c.mean[0]) - c.reach[0]): secants divide
  // by these dots, so that they are zero in no cell that is proved; at s = 0 they are positive, hence in all;
  // and (b) asks for the last one, too.
  form.meaningful = certainly_positive(value_of(left.dot)) && certainly_positive(value_of(moved.dot)) &&
                    certainly_positive(value_of(c.mean[0]) - c.reach[0]) &&
                    certainly_positive(one + value_of(a));
  std::array<std::array<S, 2>, 2> innovation;
  for (std::size_t i = 0; i < 2; ++i) {
    innovation[i] = c.innovation(errors[i][0], errors[i][1]);
  }
  const std::array<std::array<S, 3>, 3> b{{image<S>(t, moved.length[0], moved.angle[0], zero),
                                           image<S>(t, moved.length[1], moved.angle[1], zero),
                                           {S(zero), S(t.coupling), S(t.frequency)}}};
  add_size(setting, errors, form.fixed);
  add_mean_step(t, c, left, innovation, form.fixed);
  add_spread(setting, c.spread, b, form);
  add_innovation(setting, c, b, innovation, form);
  return form;
}

}  // namespace veritrack::checker::step_form
