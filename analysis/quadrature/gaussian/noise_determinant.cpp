#include "analysis/quadrature/gaussian/noise_determinant.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

using rigor::Interval;

NoiseDeterminant::NoiseDeterminant(const LockSetting<Interval>& setting)
    : r_(setting.design.r), noise_variance_(setting.noise_variance) {
  const BlockMetric<Interval>& t = setting.metric;
  // With k = 1/(1 - eta), k M in place of M:
  // M_t = k T'(I + k w^2 t3 t3'/(1 - k w^2 |t3|^2)) T, t3 = (0, coupling, frequency).
  const Interval k = Interval(1.0) / Interval(1.0 - kRoundingRoom);
  const Interval length = rigor::square(t.coupling) + rigor::square(t.frequency);
  walk_determinant_ = Interval(1.0) - k * setting.walk_variance * length;
  const Interval more = k * setting.walk_variance / walk_determinant_;
  const std::array<Interval, 3> t3{Interval(0.0), t.phase * t.coupling, length};
  const Interval none(0.0);
  weight_ = {{{rigor::square(t.amplitude), none, none},
              {none, rigor::square(t.phase), none},
              {none, t.phase * t.coupling, length}}};
  for (std::size_t i = 1; i < 3; ++i) {
    for (std::size_t j = 1; j <= i; ++j) {
      weight_[i][j] += more * t3[i] * t3[j];
    }
  }
  for (auto& row : weight_) {
    for (Interval& entry : row) {
      entry *= k;
    }
  }
}

namespace {

using Derivatives = rigor::Dual<Interval, 3>;

/// The root of what is a square, or an enclosure of one.
Interval root_of_square(const Interval& x) {
  return rigor::sqrt(max(x, Interval(0.0)));
}
Derivatives root_of_square(const Derivatives& x) {
  const Interval root = root_of_square(x.value());
  return x.chain(root, Interval(0.5) / root);
}

/// Of [[a, b], [b, c]].
Interval larger_eigenvalue(const Interval& a, const Interval& b, const Interval& c) {
  const Interval half(0.5);
  return half * (a + c) + rigor::sqrt(rigor::square(half * (a - c)) + rigor::square(b));
}

}  // namespace

template <typename Scalar>
Scalar NoiseDeterminant::trace_bound(const LevelImages<Scalar>& images) const {
  const Interval over_r = Interval(1.0) / r_;
  const Interval half_over_r = Interval(0.5) * over_r;
  const SymmetricMatrix<Scalar>& delta = images.half_spread;
  const auto at = [](const auto& x, std::size_t i, std::size_t j) {
    return x[std::max(i, j)][std::min(i, j)];
  };
  // X = H'K'M_t/r, and tr K'M_t K, at the mean image.
  std::array<std::array<Scalar, 3>, 3> x;
  Scalar trace(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      x[k][i] = Scalar(0.0);
      for (std::size_t j = 0; k < 2 && j < 3; ++j) {
        x[k][i] += at(images.mean, j, k) * (at(weight_, i, j) * over_r);
      }
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      trace += x[k][j] * at(images.mean, j, k) * over_r;
    }
  }
  // |tr(sym(D'X D) Y)| <= sqrt(3) |sym(D'X D)|_F, D D' = Delta, |Y| <= 1, and |.|_F^2 = tr(X_s Delta X_s
  // Delta).
  std::array<std::array<Scalar, 3>, 3> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product[i][j] = Scalar(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        product[i][j] += (x[i][k] + x[k][i]) * at(delta, k, j) * half_over_r;
      }
    }
  }
  Scalar squared(0.0);
  Scalar last(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      squared += product[i][j] * product[j][i];
      last += at(delta, i, j) * at(weight_, i, j);
    }
  }
  const Scalar linear = root_of_square(squared) * (Interval(2.0) * rigor::sqrt(Interval(3.0)));
  const Scalar quadratic = last * (delta[0][0] + delta[1][1]) * rigor::square(over_r);
  return Interval(1.0) - (trace + linear + quadratic) * noise_variance_;
}

Interval NoiseDeterminant::eigenvalue_bound(const LevelImages<Derivatives>& images) const {
  const auto at = [](const SymmetricMatrix<Derivatives>& x, std::size_t i, std::size_t j) -> const Interval& {
    return x[std::max(i, j)][std::min(i, j)].value();
  };
  const auto weight = [&](std::size_t i, std::size_t j) -> const Interval& {
    return weight_[std::max(i, j)][std::min(i, j)];
  };
  // K'M_t K r^2 at the mean image, and tr (M_t Delta)^2, above the largest eigenvalue of T_t Delta T_t'
  // squared.
  const auto form = [&](std::size_t k, std::size_t l) {
    Interval sum(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        sum += at(images.mean, i, k) * weight(i, j) * at(images.mean, j, l);
      }
    }
    return sum;
  };
  std::array<std::array<Interval, 3>, 3> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product[i][j] = Interval(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        product[i][j] += weight(i, k) * at(images.half_spread, k, j);
      }
    }
  }
  Interval squared(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      squared += product[i][j] * product[j][i];
    }
  }
  const Interval mean = larger_eigenvalue(form(0, 0), form(1, 0), form(1, 1));
  const Interval spread = larger_eigenvalue(at(images.half_spread, 0, 0), at(images.half_spread, 1, 0),
                                            at(images.half_spread, 1, 1));
  const Interval norm = root_of_square(mean) + root_of_square(root_of_square(squared) * spread);
  return Interval((noise_variance_ * rigor::square(norm / r_)).upper());
}

double NoiseDeterminant::roughly(const LevelImages<Interval>& images) const {
  constexpr double kLeast = 1e-3;
  const double trace = midpoint(trace_bound(images));
  const double walk = midpoint(walk_determinant_);
  const auto logarithm = [](double x) {
    return x > kLeast ? std::log(x) : std::log(kLeast) + x / kLeast - 1.0;
  };
  return -(logarithm(trace) + logarithm(walk));
}

Interval NoiseDeterminant::bound(const LevelImages<Interval>& images) const {
  return -(rigor::log(trace_bound(images)) + rigor::log(walk_determinant_));
}

Interval NoiseDeterminant::bound_over(const LevelImages<Interval>& middle,
                                      const LevelImages<Derivatives>& over,
                                      const std::array<double, 3>& half_widths) const {
  const Derivatives slopes = trace_bound(over);
  Interval left = trace_bound(middle);
  for (int i = 0; i < 3; ++i) {
    left += slopes.derivative(i) * rigor::symmetric(half_widths[static_cast<std::size_t>(i)]);
  }
  // Where there are no derivatives (without a spread) the values will do.
  const double by_trace =
      is_finite(left) ? std::max(left.lower(), slopes.value().lower()) : slopes.value().lower();
  // With eigenvalues of at most g, of which the sum is at most 1 - by_trace, the determinant is the least
  // when one of them is g.
  const Interval largest = eigenvalue_bound(over);
  const Interval other = min(largest, Interval(1.0) - Interval(by_trace) - largest);
  const Interval product = (Interval(1.0) - largest) * (Interval(1.0) - other);
  const bool sharper = certainly_less(largest, Interval(1.0)) && certainly_less(other, Interval(1.0)) &&
                       product.lower() > by_trace;
  const Interval least(sharper ? product.lower() : by_trace);
  return -(rigor::log(least) + rigor::log(walk_determinant_));
}

}  // namespace veritrack::quadrature
