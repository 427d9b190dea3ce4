#include "analysis/linear/resolvent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::linear {

using rigor::Interval;

namespace {

struct Complex {
  Interval real{0.0}, imaginary{0.0};
};

Complex operator-(const Complex& a, const Complex& b) {
  return {a.real - b.real, a.imaginary - b.imaginary};
}
Complex operator+(const Complex& a, const Complex& b) {
  return {a.real + b.real, a.imaginary + b.imaginary};
}
Complex operator*(const Complex& a, const Complex& b) {
  return {a.real * b.real - a.imaginary * b.imaginary, a.real * b.imaginary + a.imaginary * b.real};
}
Interval squared_size(const Complex& a) {
  return square(a.real) + square(a.imaginary);
}
/// Empty where b may be 0.
Complex operator/(const Complex& a, const Complex& b) {
  const Interval size = squared_size(b);
  return {(a.real * b.real + a.imaginary * b.imaginary) / size,
          (a.imaginary * b.real - a.real * b.imaginary) / size};
}
double size_up(const Complex& a) {
  const Interval size = squared_size(a);
  return rigor::is_finite(size) ? sqrt(size).upper() : INFINITY;
}

/// The solution of M x = b by elimination. Rows stay in their order where the pivot is not small: with states
/// of different units others would cancel.
std::vector<Complex> solution(std::vector<std::vector<Complex>> m, std::vector<Complex> b) {
  constexpr double kSmall = 1e-3;  // squared, of the largest in the column
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double first = squared_size(m[k][k]).lower();
    std::size_t best = k;
    double largest = first;
    for (std::size_t i = k + 1; i < n; ++i) {
      const double size = squared_size(m[i][k]).lower();
      best = size > largest ? i : best;
      largest = std::max(largest, size);
    }
    best = first > kSmall * largest ? k : best;
    std::swap(m[k], m[best]);
    std::swap(b[k], b[best]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Complex factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < n; ++j) {
        m[i][j] = m[i][j] - factor * m[k][j];
      }
      b[i] = b[i] - factor * b[k];
    }
  }
  std::vector<Complex> x(n);
  for (std::size_t k = n; k-- > 0;) {
    Complex sum = b[k];
    for (std::size_t j = k + 1; j < n; ++j) {
      sum = sum - m[k][j] * x[j];
    }
    x[k] = sum / m[k][k];
  }
  return x;
}

}  // namespace

std::optional<TurningResponse> turning_response(const std::vector<Row>& a, const Row& real,
                                                const Row& imaginary, int turns,
                                                const std::vector<Row>& forms, const Interval& band,
                                                int parts) {
  const std::size_t n = a.size();
  TurningResponse response{std::vector<double>(n, 0.0), std::vector<double>(forms.size(), 0.0), 0.0,
                           std::vector<double>(n, 0.0)};
  const Complex one{Interval(1.0), Interval(0.0)};
  for (int part = 0; part < parts; ++part) {
    const Interval share = Interval::from_bounds(part, part + 1) / Interval(static_cast<double>(parts));
    const Interval omega = Interval(band.lower()) + share * (Interval(band.upper()) - Interval(band.lower()));
    const Interval angle = Interval(static_cast<double>(turns)) * omega;
    const Complex turn{rigor::cos(angle), rigor::sin(angle)};
    std::vector<std::vector<Complex>> m(n, std::vector<Complex>(n));
    std::vector<Complex> g(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        m[i][j].real = -a[i][j];
      }
      m[i][i] = m[i][i] + turn;
      g[i] = Complex{real[i], imaginary[i]} * turn;
    }
    const std::vector<Complex> pi = solution(std::move(m), std::move(g));
    response.direct = std::max(response.direct, size_up(turn / (turn - one)));
    for (std::size_t j = 0; j < n; ++j) {
      Complex rest = Complex{} - pi[j];  // (A - 1) Pi
      for (std::size_t i = 0; i < n; ++i) {
        rest = rest + Complex{a[j][i], Interval(0.0)} * pi[i];
      }
      response.rest[j] = std::max(response.rest[j], size_up(rest / (turn - one)));
      response.states[j] = std::max(response.states[j], size_up(pi[j]));
      if (!std::isfinite(response.states[j]) || !std::isfinite(response.rest[j])) {
        return std::nullopt;
      }
    }
    if (!std::isfinite(response.direct)) {
      return std::nullopt;
    }
    for (std::size_t f = 0; f < forms.size(); ++f) {
      Complex sum;
      for (std::size_t j = 0; j < n; ++j) {
        sum = sum + Complex{forms[f][j], Interval(0.0)} * pi[j];
      }
      response.forms[f] = std::max(response.forms[f], size_up(sum));
    }
  }
  return response;
}

}  // namespace veritrack::linear
