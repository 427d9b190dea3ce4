// Does the value of a formula depend on its variables?
#pragma once

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// A scalar that records only whether it may depend on a variable.
struct Dependence {
  bool depends = false;

  Dependence() = default;
  Dependence(const Ball& /*constant*/) {}  // NOLINT(google-explicit-constructor)
  Dependence(double /*constant*/) {}       // NOLINT(google-explicit-constructor)
  static Dependence variable() {
    Dependence x;
    x.depends = true;
    return x;
  }
  friend Dependence operator+(const Dependence& x, const Dependence& y) { return either(x, y); }
  friend Dependence operator-(const Dependence& x, const Dependence& y) { return either(x, y); }
  friend Dependence operator*(const Dependence& x, const Dependence& y) { return either(x, y); }
  friend Dependence operator/(const Dependence& x, const Dependence& y) { return either(x, y); }
  friend Dependence operator-(const Dependence& x) { return x; }
  friend Dependence sqrt(const Dependence& x) { return x; }
  friend Dependence exp(const Dependence& x) { return x; }
  friend Dependence log(const Dependence& x) { return x; }
  friend Dependence sin(const Dependence& x) { return x; }
  friend Dependence cos(const Dependence& x) { return x; }
  friend Dependence tangent(const Dependence& x) { return x; }
  friend Dependence arcsine(const Dependence& x) { return x; }
  friend Dependence arccosine(const Dependence& x) { return x; }
  friend Dependence arctangent(const Dependence& x) { return x; }
  friend Dependence arctangent2(const Dependence& y, const Dependence& x) { return either(x, y); }
  friend Dependence stays_within(const Dependence& x, const Dependence& low, const Dependence& high) {
    return either(x, either(low, high));
  }
  friend Dependence larger(const Dependence& x, const Dependence& y) { return either(x, y); }
  friend Dependence clamped(const Dependence& x, const Dependence& low, const Dependence& high) {
    return either(x, either(low, high));
  }
  friend Dependence chosen(const Dependence& positive, const Dependence& a, const Dependence& b) {
    return either(positive, either(a, b));
  }
  friend Dependence sign_of(const Dependence& x) { return x; }

 private:
  static Dependence either(const Dependence& x, const Dependence& y) {
    Dependence result;
    result.depends = x.depends || y.depends;
    return result;
  }
};

}  // namespace veritrack::checker
