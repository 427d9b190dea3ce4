#include "checker/dft_block/tone_polynomial.hpp"

#include <utility>
#include <vector>

namespace veritrack::checker {

namespace {

/// Taylor coefficients of sinc about `d`, exact apart from rounding. d y'' + 2 y' + pi^2 d y = 0 gives, with
/// y = sum c_n t^n: d (n+2)(n+1) c_{n+2} + (n+1)(n+2) c_{n+1} + pi^2 (d c_n + c_{n-1}) = 0.
std::vector<Ball> coefficients_far(const Ball& d, std::size_t count) {
  const Ball angle = pi() * d;
  const Ball square_of_pi = square(pi());
  std::vector<Ball> c{sin(angle) / angle};
  c.push_back((cos(angle) - c[0]) / d);
  for (std::size_t n = 0; n + 2 < count; ++n) {
    const Ball product(static_cast<double>((n + 1) * (n + 2)));
    const Ball before = n > 0 ? c[n - 1] : zero;
    c.push_back(-(c[n + 1] / d) - square_of_pi * (d * c[n] + before) / (product * d));
  }
  return c;
}

/// The same near 0, where that divides by little: sum over j of a_j d^j with a_2k = (-1)^k pi^2k / (2k+1)!,
/// each power expanded by the binomial theorem.
std::vector<Ball> coefficients_near(const Ball& d, std::size_t count) {
  constexpr std::size_t kPowers = 60;
  const Ball square_of_pi = square(pi());
  std::vector<Ball> c(count, zero);
  Ball coefficient = one;
  std::vector<Ball> powers{one};
  for (std::size_t j = 1; j <= kPowers; ++j) {
    powers.push_back(powers.back() * d);
  }
  for (std::size_t j = 0; j <= kPowers; j += 2) {
    Ball binomial = one;
    for (std::size_t n = 0; n < count && n <= j; ++n) {
      c[n] += coefficient * binomial * powers[j - n];
      binomial = binomial * Ball(static_cast<double>(j - n)) / Ball(static_cast<double>(n + 1));
    }
    coefficient = -coefficient * square_of_pi / Ball(static_cast<double>((j + 2) * (j + 3)));
  }
  // The remainder of c_n is at most sum_{j > 60} binom(j, n) pi^j/(j+1)! for |d| <= 1: below 1e-40.
  const Ball rest = Ball::within(Ball(1e-30));
  for (Ball& each : c) {
    each += rest;
  }
  return c;
}

}  // namespace

TonePolynomial::TonePolynomial(const Ball& middle, int half_width) {
  std::vector<std::vector<Ball>> taps;
  for (int m = -half_width; m <= half_width; ++m) {
    const Ball d = middle + Ball(static_cast<double>(m));
    const bool is_near = certainly_less(abs(d), Ball(0.5));
    std::vector<Ball> c = is_near ? coefficients_near(d, kTerms) : coefficients_far(d, kTerms);
    taps.push_back(std::move(c));  // the sign (-1)^m goes away in products of the same m
  }
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < kTerms; ++k) {
      products_[i][k] = zero;
      for (const auto& c : taps) {
        products_[i][k] += c[i] * c[k];
      }
    }
  }
  // Powers of x alone, their coefficients first, so that terms of different bins cancel.
  for (std::size_t power = 0; power < kTerms; ++power) {
    aa_[power] = zero;
    ab_[power] = zero;
    bb_[power] = zero;
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t k = 0; k < kTerms; ++k) {
        const Ball by_i(static_cast<double>(i));
        const Ball by_k(static_cast<double>(k));
        if (i + k == power) {
          aa_[power] += products_[i][k];
        } else if (i + k == power + 1) {
          ab_[power] += by_k * products_[i][k];
        } else if (i + k == power + 2) {
          bb_[power] += by_i * by_k * products_[i][k];
        }
      }
    }
  }
  // |c_n| <= pi^n/(n+1)!, so that the coefficients of all products with i + k = n are together at most (2
  // pi)^n/n! for each bin. The remainder has n >= kTerms, and at most two factors i, k <= n and two powers
  // less: n^2 (2 pi)^n/n! reach^(n-2), each less than half of the one before where reach < 1/2.
  rest_ = square(Ball(static_cast<double>(kTerms)));
  for (std::size_t n = 1; n <= kTerms; ++n) {
    rest_ = rest_ * two * pi() / Ball(static_cast<double>(n));
  }
  rest_ = two * Ball(static_cast<double>(2 * half_width + 1)) * rest_;
}

MeetingSums TonePolynomial::at(const Ball& x, const Ball& d) const {
  const Ball reach = max(abs(x).upper(), abs(d).upper());
  if (!certainly_less(reach, half)) {
    const Ball all = Ball::everything();
    return {all, all, all, all, all, all, all};
  }
  std::array<Ball, kTerms> xs;
  std::array<Ball, kTerms> ds;
  std::array<Ball, kTerms> secants;  // (x^k - d^k)/(x - d)
  xs[0] = one;
  ds[0] = one;
  secants[0] = zero;
  for (std::size_t k = 1; k < kTerms; ++k) {
    xs[k] = xs[k - 1] * x;
    ds[k] = ds[k - 1] * d;
    secants[k] = xs[k - 1] + d * secants[k - 1];
  }
  MeetingSums sums{zero, zero, zero, zero, zero, zero, zero};
  for (std::size_t power = 0; power < kTerms; ++power) {
    sums.aa += aa_[power] * xs[power];
    sums.ab += ab_[power] * xs[power];
    sums.bb += bb_[power] * xs[power];
  }
  for (std::size_t i = 0; i < kTerms; ++i) {
    Ball with_truth = zero;
    Ball with_secant = zero;
    for (std::size_t k = 0; k < kTerms; ++k) {
      with_truth += products_[i][k] * ds[k];
      with_secant += products_[i][k] * secants[k];
    }
    sums.at += xs[i] * with_truth;
    sums.ac += xs[i] * with_secant;
    if (i > 0) {
      const Ball slope = Ball(static_cast<double>(i)) * xs[i - 1];
      sums.bt += slope * with_truth;
      sums.bc += slope * with_secant;
    }
  }
  Ball power = one;
  for (std::size_t n = 2; n < kTerms; ++n) {
    power = power * reach;
  }
  const Ball rest = Ball::within(rest_ * power);
  for (Ball* sum : {&sums.aa, &sums.ab, &sums.bb, &sums.at, &sums.bt, &sums.ac, &sums.bc}) {
    *sum += rest;
  }
  return sums;
}

}  // namespace veritrack::checker
