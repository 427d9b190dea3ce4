#include "analysis/quadrature/true_phase/cell_forms.hpp"

#include <algorithm>

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

constexpr std::size_t kMostVariables = 9;
using Linear = std::array<Interval, kMostVariables>;

Interval scalar(double x) {
  return Interval(x);
}

Linear nothing() {
  Linear result;
  result.fill(Interval(0.0));
  return result;
}

Linear variable(std::size_t i) {
  Linear result = nothing();
  result.at(i) = Interval(1.0);
  return result;
}

Linear operator+(Linear a, const Linear& b) {
  for (std::size_t i = 0; i < kMostVariables; ++i) {
    a[i] += b[i];
  }
  return a;
}

Linear operator-(Linear a, const Linear& b) {
  for (std::size_t i = 0; i < kMostVariables; ++i) {
    a[i] -= b[i];
  }
  return a;
}

Linear operator*(const Interval& factor, Linear a) {
  for (Interval& entry : a) {
    entry *= factor;
  }
  return a;
}

using ThreeLinear = std::array<Linear, 3>;

/// A sum of terms weight * linear * linear; at (i, j), i <= j, the coefficient of x_i x_j.
class QuadraticForm {
 public:
  explicit QuadraticForm(std::size_t variables) : variables_(variables) {
    for (auto& row : coefficients_) {
      row.fill(Interval(0.0));
    }
  }

  void add(const Interval& weight, const Linear& l, const Linear& m) {
    for (std::size_t i = 0; i < variables_; ++i) {
      for (std::size_t j = i; j < variables_; ++j) {
        coefficients_[i][j] += weight * (i == j ? l[i] * m[i] : l[i] * m[j] + l[j] * m[i]);
      }
    }
  }

  void add(double weight, const Eigen::Matrix3d& matrix, const ThreeLinear& l) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) {
        const double entry = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        add(scalar(i == j ? weight : 2.0 * weight) * scalar(entry), l[i], l[j]);
      }
    }
  }

  /// By elimination of one variable after the other, as `positive` of positive.v does.
  [[nodiscard]] bool is_positive() const {
    QuadraticForm rest = *this;
    for (std::size_t k = 0; k < variables_; ++k) {
      const Interval pivot = rest.coefficients_[k][k];
      if (!(pivot.lower() > 0.0)) {
        return false;
      }
      Linear row = nothing();
      std::copy(rest.coefficients_[k].begin() + static_cast<std::ptrdiff_t>(k) + 1,
                rest.coefficients_[k].begin() + static_cast<std::ptrdiff_t>(variables_),
                row.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      rest.add(Interval(-1.0) / (Interval(4.0) * pivot), row, row);
    }
    return true;
  }

 private:
  std::size_t variables_;
  std::array<Linear, kMostVariables> coefficients_;
};

/// Q and r of the design, and F' (I - K H)' of the prediction: predicted_terms of leaf.v.
void add_prediction(QuadraticForm& form, double weight, const trackers::ToneModel<double>& design,
                    const Eigen::Matrix3d& covariance, const ErrorBox& box, const ThreeLinear& at,
                    const Linear& k1, const Linear& k2) {
  const Linear y1 = at[0] - k1;
  const Linear y2 = at[1] - k2;
  form.add(weight, covariance, {y1, y2, at[2] + (Interval(1.0) + box.sides[0]) * y2 - box.sides[1] * y1});
  form.add(scalar(weight * design.q1), y1, y1);
  form.add(scalar(weight * design.q1), y2, y2);
  form.add(scalar(weight * design.q2), at[2], at[2]);
  form.add(scalar(weight * design.r), k1, k1);
  form.add(scalar(weight * design.r), k2, k2);
}

Linear gain_column(const CellNumbers& cell, Eigen::Index column, const ThreeLinear& at) {
  return scalar(cell.gain(0, column)) * at[0] + scalar(cell.gain(1, column)) * at[1] +
         scalar(cell.gain(2, column)) * at[2];
}

/// cos nu = 1 - nu (nu g) and sin nu = nu s, as sine_and_cosine_over of cover.v.
struct Turn {
  Interval g, s, cosine, sine;
};

Turn turn_by(const Interval& angle) {
  const Interval largest(std::max(angle.lower() * angle.lower(), angle.upper() * angle.upper()));
  const Interval g = rigor::hull(Interval(0.5) - largest / Interval(24.0), Interval(0.5));
  const Interval s = rigor::hull(Interval(1.0) - largest / Interval(6.0), Interval(1.0));
  return {g, s, Interval(1.0) - angle * (angle * g), angle * s};
}

ThreeLinear turned_back(const Turn& turn, const ThreeLinear& at) {
  return {turn.cosine * at[0] + turn.sine * at[1], turn.cosine * at[1] - turn.sine * at[0], at[2]};
}

}  // namespace

bool upper_form_is_positive(const trackers::ToneModel<double>& design, const ErrorEllipsoid& set,
                            const CellNumbers& cell, const ErrorBox& box) {
  QuadraticForm form(3);
  const ThreeLinear at{variable(0), variable(1), variable(2)};
  form.add(1.0, cell.highest, at);
  add_prediction(form, -1.0, design, set.highest, box, at, gain_column(cell, 0, at),
                 gain_column(cell, 1, at));
  return form.is_positive();
}

bool lower_form_is_positive(const trackers::ToneModel<double>& design, const ErrorEllipsoid& set,
                            const CellNumbers& cell, const ErrorBox& box) {
  QuadraticForm form(5);
  const ThreeLinear at{variable(2), variable(3), variable(4)};
  form.add(-1.0, cell.lowest, at);
  add_prediction(form, 1.0, design, set.lowest, box, at, variable(0) + gain_column(cell, 0, at),
                 variable(1) + gain_column(cell, 1, at));
  return form.is_positive();
}

bool error_form_is_positive(const trackers::ToneModel<double>& design, const ErrorEllipsoid& set,
                            const CellNumbers& cell, const ErrorBox& box) {
  QuadraticForm form(9);
  const ThreeLinear b{variable(0), variable(1), variable(2)};
  const ThreeLinear e{variable(6), variable(7), variable(8)};
  const Interval& nu = box.sides[2];
  const Turn turn = turn_by(nu);
  const Linear h1 = e[0] + (nu * turn.g) * e[2];
  const Linear h2 = e[1] + turn.s * e[2];
  const Linear i1 = variable(3) - h1;
  const Linear i2 = variable(4) - h2;
  const Eigen::Matrix3d middle = (cell.lowest + cell.highest) / (2.0 * design.r);
  const Eigen::Matrix3d half = (cell.highest - cell.lowest) / 2.0;
  const Linear a1 = h1 + scalar(middle(0, 0)) * i1 + scalar(middle(0, 1)) * i2;
  const Linear a2 = h2 + scalar(middle(0, 1)) * i1 + scalar(middle(1, 1)) * i2;
  const Linear a3 = e[2] + scalar(middle(0, 2)) * i1 + scalar(middle(1, 2)) * i2;
  form.add(set.kappa2, set.shape, e);
  form.add(1.0, set.inverse, b);
  form.add(-cell.lambda, half, turned_back(turn, b));
  form.add(-cell.mu, half, {i1, i2, nothing()});
  form.add(scalar(set.noise_gain), variable(3), variable(3));
  form.add(scalar(set.noise_gain), variable(4), variable(4));
  form.add(scalar(set.slew_gain), variable(5), variable(5));
  form.add(scalar(-2.0), b[0], turn.cosine * a1 - turn.sine * a2);
  form.add(scalar(-2.0), b[1], turn.sine * a1 + turn.cosine * a2);
  form.add(scalar(-2.0), b[2], a3 - variable(5));
  return form.is_positive();
}

bool is_inside_when_turned(const Eigen::Matrix3d& inner, const Eigen::Matrix3d& outer, const Interval& angle,
                           bool outer_is_below) {
  QuadraticForm form(3);
  const ThreeLinear at{variable(0), variable(1), variable(2)};
  const double sign = outer_is_below ? -1.0 : 1.0;
  form.add(sign, outer, at);
  form.add(-sign, inner, turned_back(turn_by(angle), at));
  return form.is_positive();
}

bool is_outside(const ErrorEllipsoid& set, const ErrorBox& box) {
  Interval level(0.0);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = i; j < 3; ++j) {
      level += scalar(i == j ? set.shape(i, j) : 2.0 * set.shape(i, j)) *
               box.sides.at(static_cast<std::size_t>(i)) * box.sides.at(static_cast<std::size_t>(j));
    }
  }
  return level.lower() > 1.0;
}

}  // namespace veritrack::quadrature
