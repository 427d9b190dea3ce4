#include "checker/quadrature/lock_form.hpp"

namespace veritrack::checker::lock_form {

namespace {

/// (upper +- lower)/2.
Lower3<Chord> half_sum(const Lower3<Chord>& x, const Lower3<Chord>& y) {
  Lower3<Chord> z;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      z[i][j] = half * (x[i][j] + y[i][j]);
    }
  }
  return z;
}
Lower3<Chord> half_difference(const Lower3<Chord>& x, const Lower3<Chord>& y) {
  Lower3<Chord> z;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      z[i][j] = half * (x[i][j] - y[i][j]);
    }
  }
  return z;
}

std::array<Chord, 3> image(const Metric& t, const std::array<Chord, 3>& v) {
  return {t.amplitude * v[0], t.phase * v[1] + t.coupling * v[2], t.frequency * v[2]};
}

/// From a mean and half spread of the images and of m.
ChordMatrix<kSize> entries(const Lower3<Chord>& mean, const Lower3<Chord>& spread,
                           const std::array<Chord, 3>& error, const std::array<Chord, 2>& p, const Metric& t,
                           const Ball& gain) {
  ChordMatrix<kSize> n;
  const Lower3<Chord> moved = transformed(t, spread);
  const std::array<Chord, 3> last = image(t, error);
  const std::array<std::array<Chord, 3>, 2> columns{
      {{mean[0][0], mean[1][0], mean[2][0]}, {mean[1][0], mean[1][1], mean[2][1]}}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      n[kError + i][kError + j] = moved[i][j];
    }
    n[kRest][kError + i] = last[i];
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const std::array<Chord, 3> column = image(t, columns[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      n[kNoise + k][kError + i] = gain * column[i];
    }
    for (std::size_t l = 0; l <= k; ++l) {
      n[kNoise + k][kNoise + l] = spread[k][l];
    }
  }
  n[kRest][kNoise] = spread[0][0] * p[0] + spread[1][0] * p[1];
  n[kRest][kNoise + 1] = spread[1][0] * p[0] + spread[1][1] * p[1];
  n[kRest][kRest] = p[0] * n[kRest][kNoise] + p[1] * n[kRest][kNoise + 1];
  return n;
}

}  // namespace

Parts parts_of(const LockStep& step, const Metric& next, const Ball& deviation, const Ball& r) {
  const Ball gain = deviation / r;
  const Lower3<Chord> turned = half_sum(step.upper_slope, step.lower_slope);
  const auto& p = step.prediction;
  // m = p - Psi Z p_z/r.
  const Ball over_r = Ball(-1.0) / r;
  const std::array<Chord, 3> moved{over_r * (turned[0][0] * p[0] + turned[1][0] * p[1]),
                                   over_r * (turned[1][0] * p[0] + turned[1][1] * p[1]),
                                   over_r * (turned[2][0] * p[0] + turned[2][1] * p[1])};
  return {entries(half_sum(step.upper, step.lower), half_difference(step.upper, step.lower), step.mean, p,
                  next, gain),
          entries(turned, half_difference(step.upper_slope, step.lower_slope), moved, p, next, gain)};
}

Ball left_over(SquareMatrix<kSize> n) {
  for (std::size_t k = 0; k < kRest; ++k) {
    if (!certainly_positive(n[k][k])) {
      return Ball::everything();
    }
    for (std::size_t i = k + 1; i < kSize; ++i) {
      const Ball factor = n[i][k] / n[k][k];
      for (std::size_t j = k + 1; j <= i; ++j) {
        n[i][j] -= factor * n[j][k];
      }
    }
  }
  return n[kRest][kRest] + log(n[kNoise][kNoise] * n[kNoise + 1][kNoise + 1]);
}

}  // namespace veritrack::checker::lock_form
