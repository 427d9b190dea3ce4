#include "checker/quadrature/set_inequality.hpp"

#include <algorithm>
#include <cmath>

#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

namespace {

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

/// (s, beta, d1, d2): a = s A cos(beta), chi = s C sin(beta), and the corrected estimate d away from the one
/// that the mean gain corrects without noise.
struct Cell {
  std::array<double, kVariables> low, high;
  [[nodiscard]] double middle(std::size_t i) const { return 0.5 * (low[i] + high[i]); }
  [[nodiscard]] Ball side(std::size_t i) const { return Ball::hull(Ball(low[i]), Ball(high[i])); }
};

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

/// `x` is (s, beta, d1, d2), `axis` = (cos, sin) of the axis that x and y of the document refer to.
template <typename S>
Form<S> form_of(const Setting& setting, const std::array<S, kVariables>& x, const std::array<Ball, 2>& axis) {
  const Metric& t = setting.metric;
  const Ball zero(0.0);
  Form<S> form;
  Matrix<S>& m = form.fixed;

  // |T e|^2 and the errors (a, chi) that belong to a unit along and across the axis.
  const std::array<std::array<Ball, 2>, 2> errors{
      {{-(setting.largest_amplitude * axis[1]), setting.largest_chi * axis[0]},
       {setting.largest_amplitude * axis[0], setting.largest_chi * axis[1]}}};
  const Matrix3 before{{{zero, t.coupling - t.phase, t.frequency},
                        image(t, errors[0][0], errors[0][1], zero),
                        image(t, errors[1][0], errors[1][1], zero)}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      m[kNu + i][kNu + j] = square(setting.rate) * dot(before[i], before[j]);
    }
  }

  const S a = x[0] * setting.largest_amplitude * cos(x[1]);
  const S chi = x[0] * setting.largest_chi * sin(x[1]);
  const Correction<S> c = correction(setting, a, chi);
  const Secant<S> left = secant(c.signal, c.mean);
  const Secant<S> moved = secant(c.mean, {c.mean[0] + x[2], c.mean[1] + x[3]});
  form.meaningful = certainly_positive(value_of(left.dot)) && certainly_positive(value_of(moved.dot)) &&
                    certainly_positive(value_of(c.mean[0]) - c.reach[0]) &&
                    certainly_positive(Ball(1.0) + value_of(a));

  // The step under the mean gain.
  const std::array<Ball, 3> carried{zero, t.coupling, t.frequency};
  const S rest1 = Ball(1.0) - c.k1;
  const S rest2 = Ball(1.0) - c.k2;
  std::array<std::array<S, 2>, 2> innovation;
  for (std::size_t k = 0; k < 3; ++k) {
    m[kNu][kNext + k] = carried[k];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    innovation[i] = c.innovation(errors[i][0], errors[i][1]);
    const S d1 = -(rest1 * innovation[i][0]);
    const S d2 = -(rest2 * innovation[i][1]);
    const std::array<S, 3> after = image<S>(t, left.length[0] * d1 + left.length[1] * d2,
                                            left.angle[0] * d1 + left.angle[1] * d2, c.k3 * innovation[i][1]);
    for (std::size_t k = 0; k < 3; ++k) {
      m[kAcross + i][kNext + k] = after[k];
    }
  }

  // What noise and the spread of the gain add: T J for a correction along, across, and of the frequency.
  const std::array<std::array<S, 3>, 3> b{{image<S>(t, moved.length[0], moved.angle[0], zero),
                                           image<S>(t, moved.length[1], moved.angle[1], zero),
                                           {S(zero), S(t.coupling), S(t.frequency)}}};
  const Ball over_r2 = Ball(1.0) / square(setting.r);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t l = 0; l <= k; ++l) {
      form.by_inverse[kNext + k][kNext + l] =
          -(over_r2 *
            (c.spread.p11 * b[0][k] * b[0][l] + c.spread.p22 * b[1][k] * b[1][l] +
             c.spread.p23 * (b[1][k] * b[2][l] + b[2][k] * b[1][l]) + c.spread.p33 * b[2][k] * b[2][l]));
      m[kNext + k][kNext + l] = Ball(k == l ? 1.0 : 0.0);
      if (setting.slewing) {
        m[kNext + k][kNext + l] =
            m[kNext + k][kNext + l] - carried[k] * carried[l] / square(setting.slew_gain);
      }
    }
  }
  const std::array<S, 2> spread{c.spread.p11, c.spread.p22};
  for (std::size_t j = 0; j < 2; ++j) {
    m[j][j] = setting.noisy ? square(setting.noise_gain) : Ball(1.0);
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
      m[kNext + k][0] = b[0][k] * c.k1;
      m[kNext + k][1] = b[1][k] * c.k2 + b[2][k] * c.k3;
    }
  }
  return form;
}

// ---- proposals in double: any multipliers and any congruence will do

Matrix<double> near(const Matrix<Ball>& m) {
  Matrix<double> result{};
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      result[i][j] = m[i][j].near();
    }
  }
  return result;
}

Matrix<double> with_lambda(const Form<double>& f, double lambda) {
  Matrix<double> m{};
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      m[i][j] = f.fixed[i][j] + lambda * f.by_lambda[i][j] + f.by_inverse[i][j] / lambda;
    }
  }
  return m;
}

/// Eliminates the first rows; false when the matrix is not definite.
bool eliminate(Matrix<double>& m, std::size_t rows) {
  for (std::size_t k = 0; k < rows; ++k) {
    if (!(m[k][k] > 0.0)) {
      return false;
    }
    for (std::size_t i = k + 1; i < kSize; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j <= i; ++j) {
        m[i][j] -= factor * m[j][k];
      }
    }
  }
  return true;
}

/// The largest k for which k |T e|^2 could be taken away, rate^2 = 1, with nothing across the axis: the
/// smaller root of det(left - k size) = 0 over (nu, along).
double room(const Form<double>& form, double lambda) {
  Matrix<double> left = with_lambda(form, lambda);
  if (!eliminate(left, kNu)) {
    return -HUGE_VAL;
  }
  const Matrix<double>& size = form.fixed;
  const auto det = [](const Matrix<double>& x, const Matrix<double>& y) {
    return x[kNu][kNu] * y[kAlong][kAlong] - x[kAlong][kNu] * y[kAlong][kNu];
  };
  const double half = 0.5 * (det(left, size) + det(size, left));
  const double square = std::fmax(0.0, half * half - det(size, size) * det(left, left));
  return (half - std::sqrt(square)) / det(size, size);
}

/// The multiplier with the most room, among powers of 2^(1/16).
double propose_lambda(const Form<double>& form) {
  const double trace = -(form.by_inverse[kNext][kNext] + form.by_inverse[kNext + 1][kNext + 1] +
                         form.by_inverse[kNext + 2][kNext + 2]);
  double best = trace;
  for (const double step : {1.0, 0.25, 0.0625}) {
    const double centre = step == 1.0 ? 8.0 * trace : best;
    for (int i = -9; i <= 9; ++i) {
      const double lambda = centre * std::exp2(0.5 * step * i);
      best = room(form, lambda) > room(form, best) ? lambda : best;
    }
  }
  return best;
}

/// The multiplier for |y| <= tangent |x| that leaves most room.
double propose_tau(const Form<double>& form, double lambda, double tangent) {
  Matrix<double> m = with_lambda(form, lambda);
  return eliminate(m, kAcross)
             ? std::max(0.0, 0.5 * (m[kAlong][kAlong] / (tangent * tangent) - m[kAcross][kAcross]))
             : 0.0;
}

/// L^-1 for m = L L'; not numbers when m is not definite.
Matrix<double> inverse_factor(const Matrix<double>& m) {
  Matrix<double> l{};
  Matrix<double> inverse{};
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= l[i][k] * l[j][k];
      }
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (std::size_t k = j; k < i; ++k) {
        sum -= l[i][k] * inverse[k][j];
      }
      inverse[i][j] = sum / l[i][i];
    }
  }
  return inverse;
}

// ---- proofs

/// C m C' for a lower triangular C.
Matrix<Ball> congruent(const Matrix<Ball>& c, const Matrix<Ball>& m) {
  Matrix<Ball> half;
  Matrix<Ball> result;
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j < kSize; ++j) {
      for (std::size_t k = 0; k <= i; ++k) {
        arb_addmul(half[i][j].raw(), c[i][k].raw(), (k < j ? m[j][k] : m[k][j]).raw(), precision());
      }
    }
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k <= j; ++k) {
        arb_addmul(result[i][j].raw(), half[i][k].raw(), c[j][k].raw(), precision());
      }
    }
  }
  return result;
}

class Cover {
 public:
  Cover(const Setting& setting, std::int64_t& cells) : setting_(setting), cells_(cells) {}

  bool holds(Cell cell, int depth) {
    if (++cells_ > kMostCells || !clip(cell)) {
      return false;
    }
    std::size_t side = 0;
    if (proves(cell, side)) {
      return true;
    }
    if (depth == 0) {
      return false;
    }
    Cell first = cell;
    Cell second = cell;
    first.high[side] = second.low[side] = cell.middle(side);
    return holds(first, depth - 1) && holds(second, depth - 1);
  }

 private:
  static constexpr std::int64_t kMostCells = 40000;

  /// Leaves out the (d1, d2) that no point of the cell reaches. False when the reach is not finite.
  bool clip(Cell& cell) const {
    const Ball a = cell.side(0) * setting_.largest_amplitude * cos(cell.side(1));
    const Ball chi = cell.side(0) * setting_.largest_chi * sin(cell.side(1));
    const Correction<Ball> c = correction(setting_, a, chi);
    for (std::size_t i = 0; i < 2; ++i) {
      const double reach = c.reach[i].upper_double();
      if (!std::isfinite(reach)) {
        return false;
      }
      // Where nothing is left any one point will do: there is nothing to be proved.
      cell.low[2 + i] = std::clamp(cell.low[2 + i], -reach, reach);
      cell.high[2 + i] = std::clamp(cell.high[2 + i], -reach, reach);
    }
    return true;
  }

  /// The mean value theorem: the matrix in the middle plus its derivatives over the cell times the way.
  /// `side` is the variable that moves it most.
  bool proves(const Cell& cell, std::size_t& side) const {
    std::array<Ball, kVariables> middle;
    std::array<Slope, kVariables> range;
    for (std::size_t i = 0; i < kVariables; ++i) {
      middle[i] = Ball(cell.middle(i));
      range[i] = Slope::variable(cell.side(i), i);
      side = cell.high[i] - cell.low[i] > cell.high[side] - cell.low[side] ? i : side;
    }
    const std::array<Ball, 2> axis{cos(middle[1]), sin(middle[1])};
    const Form<Ball> at = form_of(setting_, middle, axis);
    const Form<Slope> over = form_of(setting_, range, axis);
    if (!over.meaningful) {
      return false;
    }
    const Ball angle = range[1].value - middle[1];
    const Ball tangent_squared = square(sin(angle) / cos(angle)).upper();
    const Form<double> rough{near(at.fixed), near(at.by_lambda), near(at.by_inverse), true};
    const double lambda = propose_lambda(rough);
    const double tau = propose_tau(rough, lambda, std::sqrt(tangent_squared.near()));
    if (!(lambda > 0.0) || !(tau >= 0.0) || !certainly_positive(cos(angle))) {
      return false;
    }
    Matrix<double> proposed = with_lambda(rough, lambda);
    proposed[kAlong][kAlong] -= tau * tangent_squared.near();
    proposed[kAcross][kAcross] += tau;
    const Matrix<double> factor = inverse_factor(proposed);
    Matrix<Ball> c;
    for (std::size_t i = 0; i < kSize; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        if (!std::isfinite(factor[i][j])) {
          return false;
        }
        c[i][j] = Ball(factor[i][j]);
      }
    }
    const Ball over_lambda = Ball(1.0) / Ball(lambda);
    Matrix<Ball> m;
    for (std::size_t i = 0; i < kSize; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        m[i][j] = at.fixed[i][j] + Ball(lambda) * at.by_lambda[i][j] + over_lambda * at.by_inverse[i][j];
      }
    }
    m[kAlong][kAlong] -= Ball(tau) * tangent_squared;
    m[kAcross][kAcross] += Ball(tau);
    Matrix<Ball> sum = congruent(c, m);
    double most = 0.0;
    for (std::size_t variable = 0; variable < kVariables; ++variable) {
      for (std::size_t i = 0; i < kSize; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          m[i][j] = over.fixed[i][j].by[variable] + Ball(lambda) * over.by_lambda[i][j].by[variable] +
                    over_lambda * over.by_inverse[i][j].by[variable];
        }
      }
      const Ball way = range[variable].value - middle[variable];
      const Matrix<Ball> slope = congruent(c, m);
      double influence = 0.0;
      for (std::size_t i = 0; i < kSize; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          const Ball moved = slope[i][j] * way;
          influence += moved.upper_double();
          sum[i][j] += moved;
        }
      }
      if (influence > most && std::isfinite(influence)) {
        most = influence;
        side = variable;
      }
    }
    // C m C' > 0 implies m > 0: C has an inverse, or else C m C' would be singular.
    return definite(sum);
  }

  const Setting& setting_;
  std::int64_t& cells_;
};

}  // namespace

bool contracts(const Setting& setting, std::int64_t& cells) {
  constexpr int kScales = 4;
  constexpr int kAngles = 8;
  constexpr int kDepth = 24;
  const double half_turn = pi().upper_double();
  Cover cover(setting, cells);
  for (int i = 0; i < kScales; ++i) {
    for (int j = 0; j < kAngles; ++j) {
      // The mirror image (psi, nu, P12, P13, v2, w) -> -(...) commutes with the step: 0 <= beta <= pi
      // suffices.
      const Cell cell{
          {i / static_cast<double>(kScales), half_turn * j / kAngles, -HUGE_VAL, -HUGE_VAL},
          {(i + 1) / static_cast<double>(kScales), half_turn * (j + 1) / kAngles, HUGE_VAL, HUGE_VAL}};
      if (!cover.holds(cell, kDepth)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace veritrack::checker
