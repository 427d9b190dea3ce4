// Jets: the Taylor coefficients of a function of one variable, in double, up to an order K. A program that
// runs over jets gives its derivatives in one direction. For proposals: nothing here is rounded outward.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace veritrack::model {

/// sum_k at(k) t^k, k = 0, ..., K.
template <int K>
class Jet {
 public:
  Jet() = default;
  explicit Jet(double constant) { c_[0] = constant; }
  explicit Jet(int constant) : Jet(static_cast<double>(constant)) {}
  /// value + slope t.
  Jet(double value, double slope) : Jet(value) { c_[1] = slope; }

  [[nodiscard]] double at(int k) const { return c_[static_cast<std::size_t>(k)]; }
  double& at(int k) { return c_[static_cast<std::size_t>(k)]; }

  Jet operator-() const {
    Jet result;
    for (int k = 0; k <= K; ++k) {
      result.at(k) = -at(k);
    }
    return result;
  }
  friend Jet operator+(const Jet& a, const Jet& b) {
    Jet result;
    for (int k = 0; k <= K; ++k) {
      result.at(k) = a.at(k) + b.at(k);
    }
    return result;
  }
  friend Jet operator-(const Jet& a, const Jet& b) {
    Jet result;
    for (int k = 0; k <= K; ++k) {
      result.at(k) = a.at(k) - b.at(k);
    }
    return result;
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet result;
    for (int k = 0; k <= K; ++k) {
      for (int j = 0; j <= k; ++j) {
        result.at(k) += a.at(j) * b.at(k - j);
      }
    }
    return result;
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    Jet result;
    for (int k = 0; k <= K; ++k) {
      double rest = a.at(k);
      for (int j = 1; j <= k; ++j) {
        rest -= b.at(j) * result.at(k - j);
      }
      result.at(k) = rest / b.at(0);
    }
    return result;
  }

 private:
  std::array<double, static_cast<std::size_t>(K) + 1> c_{};
};

namespace detail {

/// The jet y with y(0) = value and y' = slope x'.
template <int K>
[[nodiscard]] Jet<K> jet_from_slope(double value, const Jet<K>& slope, const Jet<K>& x) {
  Jet<K> result(value);
  for (int k = 1; k <= K; ++k) {
    for (int j = 1; j <= k; ++j) {
      result.at(k) += static_cast<double>(j) / k * x.at(j) * slope.at(k - j);
    }
  }
  return result;
}

}  // namespace detail

template <int K>
[[nodiscard]] Jet<K> square(const Jet<K>& x) {
  return x * x;
}

template <int K>
[[nodiscard]] Jet<K> sqrt(const Jet<K>& x) {
  Jet<K> root(std::sqrt(x.at(0)));
  for (int k = 1; k <= K; ++k) {
    double rest = x.at(k);
    for (int j = 1; j < k; ++j) {
      rest -= root.at(j) * root.at(k - j);
    }
    root.at(k) = rest / (2.0 * root.at(0));
  }
  return root;
}

template <int K>
[[nodiscard]] std::pair<Jet<K>, Jet<K>> sin_cos(const Jet<K>& x) {
  Jet<K> sine(std::sin(x.at(0)));
  Jet<K> cosine(std::cos(x.at(0)));
  for (int k = 1; k <= K; ++k) {
    for (int j = 1; j <= k; ++j) {
      const double weight = static_cast<double>(j) / k * x.at(j);
      sine.at(k) += weight * cosine.at(k - j);
      cosine.at(k) -= weight * sine.at(k - j);
    }
  }
  return {sine, cosine};
}
template <int K>
[[nodiscard]] Jet<K> sin(const Jet<K>& x) {
  return sin_cos(x).first;
}
template <int K>
[[nodiscard]] Jet<K> cos(const Jet<K>& x) {
  return sin_cos(x).second;
}
template <int K>
[[nodiscard]] Jet<K> tan(const Jet<K>& x) {
  const auto circle = sin_cos(x);
  return circle.first / circle.second;
}

template <int K>
[[nodiscard]] Jet<K> exp(const Jet<K>& x) {
  Jet<K> result(std::exp(x.at(0)));
  for (int k = 1; k <= K; ++k) {
    for (int j = 1; j <= k; ++j) {
      result.at(k) += static_cast<double>(j) / k * x.at(j) * result.at(k - j);
    }
  }
  return result;
}
template <int K>
[[nodiscard]] Jet<K> log(const Jet<K>& x) {
  return detail::jet_from_slope(std::log(x.at(0)), Jet<K>(1.0) / x, x);
}
template <int K>
[[nodiscard]] Jet<K> atan(const Jet<K>& x) {
  return detail::jet_from_slope(std::atan(x.at(0)), Jet<K>(1.0) / (Jet<K>(1.0) + x * x), x);
}
template <int K>
[[nodiscard]] Jet<K> asin(const Jet<K>& x) {
  return detail::jet_from_slope(std::asin(x.at(0)), Jet<K>(1.0) / sqrt(Jet<K>(1.0) - x * x), x);
}
template <int K>
[[nodiscard]] Jet<K> acos(const Jet<K>& x) {
  return detail::jet_from_slope(std::acos(x.at(0)), Jet<K>(-1.0) / sqrt(Jet<K>(1.0) - x * x), x);
}
/// The angle of (x, y).
template <int K>
[[nodiscard]] Jet<K> atan2(const Jet<K>& y, const Jet<K>& x) {
  const Jet<K> squared_length = x * x + y * y;
  const Jet<K> in_y = detail::jet_from_slope(std::atan2(y.at(0), x.at(0)), x / squared_length, y);
  return in_y - detail::jet_from_slope(0.0, y / squared_length, x);
}
/// x: for a proposal, nothing has to be shown.
template <int K>
[[nodiscard]] Jet<K> stays_within(const Jet<K>& x, const Jet<K>& /*low*/, const Jet<K>& /*high*/) {
  return x;
}
// Functions with kinks: the branch that is taken.
template <int K>
[[nodiscard]] Jet<K> chosen(const Jet<K>& positive, const Jet<K>& a, const Jet<K>& b) {
  return positive.at(0) > 0.0 ? a : b;
}
template <int K>
[[nodiscard]] Jet<K> maximum(const Jet<K>& a, const Jet<K>& b) {
  return a.at(0) < b.at(0) ? b : a;
}
template <int K>
[[nodiscard]] Jet<K> minimum(const Jet<K>& a, const Jet<K>& b) {
  return b.at(0) < a.at(0) ? b : a;
}
template <int K>
[[nodiscard]] Jet<K> absolute(const Jet<K>& x) {
  return x.at(0) < 0.0 ? -x : x;
}
template <int K>
[[nodiscard]] Jet<K> clamped(const Jet<K>& x, const Jet<K>& low, const Jet<K>& high) {
  return x.at(0) < low.at(0) ? low : high.at(0) < x.at(0) ? high : x;
}
template <int K>
[[nodiscard]] Jet<K> sign_of(const Jet<K>& x) {
  const double value = x.at(0);
  return Jet<K>(value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : value);
}

}  // namespace veritrack::model
