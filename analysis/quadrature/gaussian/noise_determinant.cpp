#include "analysis/quadrature/gaussian/noise_determinant.hpp"

#include <algorithm>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

using rigor::Interval;

NoiseDeterminant::NoiseDeterminant(const LockSetting<Interval>& setting)
    : r_(setting.design.r), noise_variance_(setting.noise_variance) {
  const BlockMetric<Interval>& t = setting.metric;
  // M_t = T'(I + w^2 t3 t3'/(1 - w^2 |t3|^2)) T, t3 = (0, coupling, frequency).
  const Interval length = rigor::square(t.coupling) + rigor::square(t.frequency);
  walk_determinant_ = Interval(1.0) - setting.walk_variance * length;
  const Interval more = setting.walk_variance / walk_determinant_;
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
}

Interval NoiseDeterminant::bound(const LevelImages<Interval>& images) const {
  const Interval over_r = Interval(1.0) / r_;
  const Symmetric<Interval>& delta = images.half_spread;
  const auto at = [](const Symmetric<Interval>& x, std::size_t i, std::size_t j) -> const Interval& {
    return x[std::max(i, j)][std::min(i, j)];
  };
  // X = H'K'M_t/r, and tr K'M_t K, at the mean image.
  std::array<std::array<Interval, 3>, 3> x;
  Interval trace(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      x[k][i] = Interval(0.0);
      for (std::size_t j = 0; k < 2 && j < 3; ++j) {
        x[k][i] += at(weight_, i, j) * at(images.mean, j, k) * over_r;
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
  std::array<std::array<Interval, 3>, 3> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product[i][j] = Interval(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        product[i][j] += Interval(0.5) * over_r * (x[i][k] + x[k][i]) * at(delta, k, j);
      }
    }
  }
  Interval square(0.0);
  Interval last(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      square += product[i][j] * product[j][i];
      last += at(weight_, i, j) * at(delta, i, j);
    }
  }
  const Interval linear = Interval(2.0) * rigor::sqrt(Interval(3.0) * max(square, Interval(0.0)));
  const Interval quadratic = last * (delta[0][0] + delta[1][1]) * rigor::square(over_r);
  const Interval most = noise_variance_ * (trace + linear + quadratic);
  return -(rigor::log(Interval(1.0) - most) + rigor::log(walk_determinant_));
}

}  // namespace veritrack::quadrature
