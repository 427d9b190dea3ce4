// An oracle for Theorem 2.9: the thesis's formulas in MPFR at 400 bits, typed from its text without looking
// at the implementation, in the naive forms in which they are printed (400 bits survive every cancellation in
// them).
#pragma once

#include <mpfr.h>

#include <map>
#include <string>
#include <utility>

namespace veritrack::test {

/// A number of 400 bits.
class Big {
 public:
  Big(double value = 0.0) { init(), mpfr_set_d(value_, value, MPFR_RNDN); }  // NOLINT: converts on purpose
  explicit Big(const std::string& decimal) { init(), mpfr_set_str(value_, decimal.c_str(), 10, MPFR_RNDN); }
  Big(const Big& other) { init(), mpfr_set(value_, other.value_, MPFR_RNDN); }
  Big& operator=(const Big& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Big() { mpfr_clear(value_); }

  friend Big operator+(const Big& a, const Big& b) { return apply(mpfr_add, a, b); }
  friend Big operator-(const Big& a, const Big& b) { return apply(mpfr_sub, a, b); }
  friend Big operator*(const Big& a, const Big& b) { return apply(mpfr_mul, a, b); }
  friend Big operator/(const Big& a, const Big& b) { return apply(mpfr_div, a, b); }
  friend Big max(const Big& a, const Big& b) { return apply(mpfr_max, a, b); }
  friend Big min(const Big& a, const Big& b) { return apply(mpfr_min, a, b); }
  friend Big sqrt(const Big& a) {
    Big result;
    mpfr_sqrt(result.value_, a.value_, MPFR_RNDN);
    return result;
  }
  friend Big pow(const Big& a, long exponent) {
    Big result;
    mpfr_pow_si(result.value_, a.value_, exponent, MPFR_RNDN);
    return result;
  }
  friend bool operator<(const Big& a, const Big& b) { return mpfr_less_p(a.value_, b.value_) != 0; }

  /// lower <= this <= upper, compared exactly.
  bool lies_in(double lower, double upper) const {
    return mpfr_cmp_d(value_, lower) >= 0 && mpfr_cmp_d(value_, upper) <= 0 && mpfr_nan_p(value_) == 0;
  }
  double to_double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  /// d.ddde+xx with that many digits after the point.
  std::string to_string(int digits) const {
    char* text = nullptr;
    mpfr_asprintf(&text, "%.*Re", digits, value_);
    std::string result(text);
    mpfr_free_str(text);
    return result;
  }

 private:
  void init() { mpfr_init2(value_, 400); }
  template <typename Function>
  static Big apply(Function function, const Big& a, const Big& b) {
    Big result;
    function(result.value_, a.value_, b.value_, MPFR_RNDN);
    return result;
  }
  mpfr_t value_;
};

struct OracleInput {
  Big q1, q2, r, R_x, sigma, gamma_fraction, c1, c2;
};

/// Every quantity by its name in certificate.json.
inline std::map<std::string, Big> theorem_2_9_oracle(bool errata, const OracleInput& in) {
  const Big one = 1.0, two = 2.0, four = 4.0, half = 0.5;
  const Big root2 = sqrt(two);
  const Big er = errata ? one - in.sigma : one / root2 - in.sigma;
  const Big rho1 = two * (in.R_x + er), rho2 = root2 * (in.R_x + er), rho3 = rho2, rho4 = rho2, rho5 = one;
  const Big d1 = in.q1, d2 = in.r, a1 = in.q2, a2 = in.q1;
  const Big m = one - root2 * er, n = one + root2 * er;
  const Big b1 =
      errata ? in.sigma / (two * in.r) : one / (two * in.r) * (m * m) * (one - one / four * (m * m));
  const Big b2 = errata ? Big(5.0) / in.r : Big(3.0) / in.r * (n * n);
  const Big p = a1 + one / b1;
  const Big q = one / a2 + b2;
  const Big s = one / a2 + b2 + rho1 * rho1 / d1;
  const Big gamma = in.gamma_fraction / (s * p * p);
  const Big alpha = sqrt(one - gamma / q);
  const Big beta = sqrt(p * q);
  const Big root = sqrt(rho1 * rho1 + one / q * (one / (s * p * p) - gamma)) - rho1;
  const Big ez = min(er, root2 / sqrt(rho4) * sqrt(root));
  const Big dp = two * rho1 * rho2 * p;
  const Big dk = dp * rho5 / d2 * (one + s * rho5 * rho5 / d2);
  // K'' = P'' H'S + 2 P' H' S' + P H' S'' with S = (HPH' + R)^{-1}, |S| <= 1/d2, |S'| <= rho5^2 dp / d2^2 and
  // S'' = 2 S (HP'H') S (HP'H') S - S (HP''H') S.
  const Big dp2 = two * p * (rho3 * rho1 + rho2 * rho2);
  const Big s_first = rho5 * rho5 * dp / (d2 * d2);
  const Big s_second = two * pow(rho5, 4) * dp * dp / pow(d2, 3) + rho5 * rho5 * dp2 / (d2 * d2);
  const Big dk2 = dp2 * rho5 / d2 + two * dp * rho5 * s_first + s * rho5 * s_second;
  const Big zeta_z = dk * rho5 * rho1 * ez;
  const Big w = in.c1 * sqrt(in.q2), v = in.c2 * sqrt(in.r);
  const Big eta = max(p * q * (w + half * rho4 * er * er) + p * rho5 / d2 * v,
                      dk * (rho5 * w + v + half * rho4 * rho5 * er * er) + two * p * q * rho1);
  const Big zeta = two * rho1 * rho5 * dk + rho1 * rho5 * dk2 * er;
  return {{"R_x", in.R_x},
          {"epsilon_r", er},
          {"rho_1", rho1},
          {"rho_2", rho2},
          {"rho_3", rho3},
          {"rho_4", rho4},
          {"rho_5", rho5},
          {"delta_1", d1},
          {"delta_2", d2},
          {"a_1", a1},
          {"a_2", a2},
          {"b_1", b1},
          {"b_2", b2},
          {"p", p},
          {"q", q},
          {"s", s},
          {"gamma", gamma},
          {"beta", beta},
          {"one_minus_alpha", one - alpha},
          {"epsilon_z", ez},
          {"delta_p", dp},
          {"delta_k", dk},
          {"delta_k2", dk2},
          {"zeta_z", zeta_z},
          {"eta", eta},
          {"zeta", zeta},
          {"lhs_2_43", beta * (zeta + eta) + alpha},
          {"lhs_2_44", beta * zeta_z + alpha},
          {"initial_error_bound", ez / sqrt(p * q)}};
}

}  // namespace veritrack::test
