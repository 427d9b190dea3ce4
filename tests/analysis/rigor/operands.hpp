// Operands that arithmetic is likely to get wrong, and a counter of those it did get wrong.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

#include "analysis/rigor/interval.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kLargest = std::numeric_limits<double>::max();
inline constexpr double kSmallestNormal = std::numeric_limits<double>::min();
inline constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

inline rigor::Interval bounds(double lower, double upper) {
  return rigor::Interval::from_bounds(lower, upper);
}

/// Runs `computation` with the upward mode held, and nothing else: oracles stay outside.
template <typename Computation>
auto upward(Computation computation) {
  const rigor::UpwardRounding mode;
  return computation();
}

/// `steps` doubles above (or, negative, below) x.
inline double neighbour(double x, int steps) {
  for (; steps > 0; --steps) {
    x = std::nextafter(x, kInfinity);
  }
  for (; steps < 0; ++steps) {
    x = std::nextafter(x, -kInfinity);
  }
  return x;
}

/// For an enclosure [lower, upper] of a number between two neighbouring doubles: at most `ulps` doubles from
/// each.
inline bool is_within(const rigor::Interval& x, double tightest_lower, double tightest_upper, int ulps) {
  return x.lower() >= neighbour(tightest_lower, -ulps) && x.upper() <= neighbour(tightest_upper, ulps);
}

class Operands {
 public:
  explicit Operands(std::uint64_t stream) : random_(stream) {
    mpfr_init2(turn_, 400);
    mpfr_init2(half_pi_, 400);
    mpfr_const_pi(half_pi_, MPFR_RNDN);
    mpfr_div_2ui(half_pi_, half_pi_, 1, MPFR_RNDN);
  }
  ~Operands() {
    mpfr_clear(turn_);
    mpfr_clear(half_pi_);
  }
  Operands(const Operands&) = delete;
  Operands& operator=(const Operands&) = delete;
  Operands(Operands&&) = delete;
  Operands& operator=(Operands&&) = delete;

  Random& random() { return random_; }

  /// A finite double: any size, often special.
  double number() {
    switch (random_.below(10)) {
      case 0:
        return random_.uniform(-10.0, 10.0);
      case 1:
        return any_bits();
      case 2:
        return sign() * static_cast<double>(random_.word() >> (12 + random_.below(52))) * kSmallest;
      case 3:
        return sign() * neighbour(kLargest, -static_cast<int>(random_.below(4))) *
               (coin() ? 1.0 : random_.uniform());
      case 4:
        return sign() * neighbour(kSmallestNormal, static_cast<int>(random_.below(7)) - 3);
      case 5:
        return static_cast<double>(random_.below(41)) - 20.0;
      case 6:
        return sign() * neighbour(std::ldexp(1.0, static_cast<int>(random_.below(200)) - 100),
                                  static_cast<int>(random_.below(5)) - 2);
      case 7:
        return near_quarter_turn();
      case 8:
        return special();
      default:
        return std::ldexp(random_.uniform(-1.0, 1.0), static_cast<int>(random_.below(80)) - 40);
    }
  }

  /// An angle in rad: mostly of the sizes that a tracker meets, often close to a multiple of pi/2.
  double angle() {
    switch (random_.below(8)) {
      case 0:
        return random_.uniform(-10.0, 10.0);
      case 1:
        return random_.uniform(-1000.0, 1000.0);
      case 2:
        return random_.uniform(-0x1.1p+20, 0x1.1p+20);
      case 3:
      case 4:
        return near_quarter_turn();
      case 5:
        return sign() * neighbour(0x1p+20, static_cast<int>(random_.below(5)) - 2);
      case 6:
        return std::ldexp(random_.uniform(-1.0, 1.0), -static_cast<int>(random_.below(60)));
      default:
        return number();
    }
  }

  /// Within a few units in the last place of a multiple of pi/2.
  double near_quarter_turn() {
    const std::uint64_t bits = 1 + random_.below(random_.below(8) == 0 ? 62 : 22);
    const auto turns = static_cast<long>(random_.below(std::uint64_t{1} << bits));
    mpfr_mul_si(turn_, half_pi_, coin() ? turns : -turns, MPFR_RNDN);
    return neighbour(mpfr_get_d(turn_, MPFR_RNDN), static_cast<int>(random_.below(5)) - 2);
  }

  /// An interval that holds `x`: a point, a few units in the last place, some radius, up to half a line.
  rigor::Interval around(double x) {
    const double other = number();
    switch (random_.below(12)) {
      case 0:
      case 1:
        return rigor::Interval(x);
      case 2:
        return ordered(x, neighbour(x, coin() ? 1 : -1));
      case 3:
        return ordered(neighbour(x, -static_cast<int>(random_.below(4))),
                       neighbour(x, static_cast<int>(random_.below(4))));
      case 4:
      case 5:
        return ordered(x, x * (1.0 + std::ldexp(random_.uniform(), -static_cast<int>(random_.below(53)))));
      case 6:
      case 7:
        return ordered(x,
                       x + sign() * std::ldexp(random_.uniform(), 3 - static_cast<int>(random_.below(40))));
      case 8:
        return ordered(x, coin() ? 0.0 : -0.0);
      case 9:
        return ordered(-std::fabs(x), std::fabs(other));
      case 10:
        return ordered(x, other);
      default:
        return random_.below(3) == 0 ? ordered(x, sign() * kInfinity) : ordered(x, std::ldexp(x, 1));
    }
  }

  rigor::Interval interval() { return around(number()); }

  /// A real number of x that is a double: an end, the middle, anywhere between, or next to a multiple of
  /// pi/2.
  double point_of(const rigor::Interval& x) {
    const double low = std::max(x.lower(), -kLargest);
    const double high = std::min(x.upper(), kLargest);
    switch (random_.below(5)) {
      case 0:
        return low;
      case 1:
        return high;
      case 2:
        return std::clamp(0.5 * low + 0.5 * high, low, high);
      case 3:
        return std::clamp(quarter_turn_near(0.5 * low + 0.5 * high), low, high);
      default: {
        const double share = random_.uniform();
        return std::clamp(low * (1.0 - share) + high * share, low, high);
      }
    }
  }

  bool coin() { return random_.below(2) == 0; }

 private:
  double sign() { return coin() ? 1.0 : -1.0; }

  double any_bits() {
    for (;;) {
      const auto candidate = std::bit_cast<double>(random_.word());
      if (std::isfinite(candidate)) {
        return candidate;
      }
    }
  }

  double special() {
    constexpr double kSpecial[] = {0.0, 1.0, kLargest, kSmallest, kSmallestNormal, 0.1, 0.5, 2.0};
    return sign() * kSpecial[random_.below(std::size(kSpecial))];
  }

  double quarter_turn_near(double x) {
    if (std::fabs(x) > 1e15) {
      return x;
    }
    const double half_pi = mpfr_get_d(half_pi_, MPFR_RNDN);
    mpfr_mul_si(turn_, half_pi_, std::lround(x / half_pi), MPFR_RNDN);
    return mpfr_get_d(turn_, MPFR_RNDN);
  }

  static rigor::Interval ordered(double a, double b) {
    return rigor::Interval::from_bounds(std::max(std::min(a, b), -kInfinity), std::max(a, b));
  }

  Random random_;
  mpfr_t turn_{};
  mpfr_t half_pi_{};
};

inline std::string to_text(double x) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%a", x);
  return buffer;
}
inline std::string to_text(const rigor::Interval& x) {
  return "[" + to_text(x.lower()) + ", " + to_text(x.upper()) + "]";
}

/// Counts failures and keeps the first one in words, so that a million checks cost one line.
class Misses {
 public:
  template <typename... Operands>
  void expect(bool holds, const char* what, const Operands&... operands) {
    if (!holds && count_++ == 0) {
      first_ = what;
      ((first_ += " " + to_text(operands)), ...);
    }
  }
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  std::int64_t count_ = 0;
  std::string first_;
};

}  // namespace veritrack::test

/// Fails the test when something was missed, showing the first case.
#define VERITRACK_CHECK_NO_MISSES(misses) \
  CHECK_MESSAGE((misses).count() == 0, "first of ", (misses).count(), ": ", (misses).first())
