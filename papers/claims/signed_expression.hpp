// A scalar that is an expression, kept in a form in which signs stand outside: with it a program is run on
// symbols, and two runs that give the same expression compute the same for all numbers.
//
// -a b = -(a b), -a - b = -(a + b), a - a = 0, sums and products in either order, sin(-a) = -sin a, cos(-a) =
// cos a, and half a turn: sin(a + pi) = -sin a, cos(a + pi) = -cos a. Nothing else is used: equal expressions
// have equal values, but different expressions may, too.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "analysis/rigor/eigen_scalar.hpp"

namespace veritrack::theorems {

/// One expression; those that are compared have to be made by one thread.
class SignedExpression {
 public:
  /// Zero.
  SignedExpression() = default;
  explicit SignedExpression(double constant)
      : SignedExpression(
            constant == 0.0
                ? SignedExpression()
                : SignedExpression(
                      node("constant " + std::to_string(std::bit_cast<std::uint64_t>(std::fabs(constant))),
                           {}, {}),
                      constant < 0.0)) {}
  /// A variable.
  [[nodiscard]] static SignedExpression symbol(const std::string& name) {
    return {node("symbol " + name, {}, {}), false};
  }

  [[nodiscard]] bool is_zero() const { return id_ == 0 && !half_turn_; }
  friend bool operator==(const SignedExpression& a, const SignedExpression& b) { return a.key() == b.key(); }
  /// This, an angle in rad, and pi.
  [[nodiscard]] SignedExpression half_turn_on() const {
    SignedExpression result = *this;
    result.half_turn_ = !result.half_turn_;
    return result;
  }

  SignedExpression operator-() const { return {whole(), id_ != 0 && !negative_}; }
  friend SignedExpression operator+(const SignedExpression& a, const SignedExpression& b) {
    SignedExpression sum = plain_sum(a, b);
    sum.half_turn_ = a.half_turn_ != b.half_turn_;
    if (a.half_turn_ && b.half_turn_) {
      throw std::logic_error("a sum of two angles with half a turn");
    }
    return sum;
  }
  friend SignedExpression operator-(const SignedExpression& a, const SignedExpression& b) { return a + -b; }
  friend SignedExpression operator*(const SignedExpression& a, const SignedExpression& b) {
    const auto [first, second] = std::minmax({a.whole(), b.whole()});
    if (first == 0) {
      return {};
    }
    return {node("times", {first, false}, {second, false}), a.negative_ != b.negative_};
  }
  friend SignedExpression operator/(const SignedExpression& a, const SignedExpression& b) {
    if (a.whole() == 0) {
      return {};
    }
    return {node("over", {a.whole(), false}, {b.whole(), false}), a.negative_ != b.negative_};
  }
  SignedExpression& operator+=(const SignedExpression& other) { return *this = *this + other; }
  SignedExpression& operator-=(const SignedExpression& other) { return *this = *this - other; }
  SignedExpression& operator*=(const SignedExpression& other) { return *this = *this * other; }

  friend std::pair<SignedExpression, SignedExpression> sin_cos(const SignedExpression& angle) {
    if (angle.id_ == 0) {
      throw std::logic_error("the sine of 0 is not needed here");
    }
    return {{node("sin", {angle.id_, false}, {}), angle.negative_ != angle.half_turn_},
            {node("cos", {angle.id_, false}, {}), angle.half_turn_}};
  }

 private:
  using Part = std::pair<int, bool>;

  SignedExpression(int id, bool negative) : id_(id), negative_(negative) {}

  /// The number of this operation; 0 is zero's.
  static int node(const std::string& operation, Part first, Part second) {
    thread_local std::map<std::tuple<std::string, Part, Part>, int> all;
    return all.emplace(std::tuple(operation, first, second), static_cast<int>(all.size()) + 1).first->second;
  }

  static SignedExpression plain_sum(const SignedExpression& a, const SignedExpression& b) {
    if (a.id_ == 0 || b.id_ == 0) {
      return {a.id_ + b.id_, a.id_ == 0 ? b.negative_ : a.negative_};
    }
    if (a.id_ == b.id_ && a.negative_ != b.negative_) {
      return {};
    }
    const bool in_order = a.id_ <= b.id_;
    const SignedExpression& first = in_order ? a : b;
    const SignedExpression& second = in_order ? b : a;
    return {node("plus", {first.id_, false}, {second.id_, first.negative_ != second.negative_}),
            first.negative_};
  }

  /// The number, for a value that is not an angle with half a turn.
  [[nodiscard]] int whole() const {
    if (half_turn_) {
      throw std::logic_error("half a turn is only added and turned into sine and cosine");
    }
    return id_;
  }
  [[nodiscard]] std::tuple<int, bool, bool> key() const { return {id_, negative_, half_turn_}; }

  int id_ = 0;
  bool negative_ = false;
  bool half_turn_ = false;
};

}  // namespace veritrack::theorems

namespace Eigen {

template <>
struct NumTraits<veritrack::theorems::SignedExpression>
    : veritrack::rigor::CostlyEigenScalar<veritrack::theorems::SignedExpression> {};

}  // namespace Eigen
