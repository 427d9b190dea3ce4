// Two registers of packed.hpp as one scalar, so that the operations of one fill the time in which the other
// waits for a result.
#pragma once

#include <utility>

#include "trackers/packed_sine_cosine.hpp"

namespace veritrack::trackers {

/// The numbers of two registers: those of the second are the upper lanes.
template <typename Scalar, int Lanes>
class PackedPair {
 public:
  using Half = Packed<Scalar, Lanes>;
  static constexpr int kLanes = 2 * Lanes;

  /// All bits of a lane set, or none.
  struct Bits {
    typename Half::Bits first;
    typename Half::Bits second;
    friend Bits operator|(const Bits& a, const Bits& b) { return {a.first | b.first, a.second | b.second}; }
  };

  /// Must be assigned before use.
  PackedPair() = default;
  explicit PackedPair(Scalar all) : first_(all), second_(all) {}
  PackedPair(const Half& first, const Half& second) : first_(first), second_(second) {}

  /// Lane i is number(i).
  template <typename Function>
  [[nodiscard]] static PackedPair of(const Function& number) {
    return {Half::of(number), Half::of([&](int i) { return number(i + Lanes); })};
  }

  [[nodiscard]] const Half& first() const { return first_; }
  [[nodiscard]] const Half& second() const { return second_; }
  [[nodiscard]] Scalar lane(int i) const { return i < Lanes ? first_.lane(i) : second_.lane(i - Lanes); }

  PackedPair operator-() const { return {-first_, -second_}; }
  friend PackedPair operator+(const PackedPair& a, const PackedPair& b) {
    return {a.first_ + b.first_, a.second_ + b.second_};
  }
  friend PackedPair operator-(const PackedPair& a, const PackedPair& b) {
    return {a.first_ - b.first_, a.second_ - b.second_};
  }
  friend PackedPair operator*(const PackedPair& a, const PackedPair& b) {
    return {a.first_ * b.first_, a.second_ * b.second_};
  }
  friend PackedPair operator/(const PackedPair& a, const PackedPair& b) {
    return {a.first_ / b.first_, a.second_ / b.second_};
  }
  friend PackedPair sqrt(const PackedPair& x) { return {sqrt(x.first_), sqrt(x.second_)}; }

  /// Lanes in which x is NaN.
  friend Bits is_nan(const PackedPair& x) { return {is_nan(x.first_), is_nan(x.second_)}; }
  /// a where the bits are set, b elsewhere.
  friend PackedPair select(const Bits& where, const PackedPair& a, const PackedPair& b) {
    return {select(where.first, a.first_, b.first_), select(where.second, a.second_, b.second_)};
  }

 private:
  Half first_;
  Half second_;
};

namespace detail {

/// As that of packed_sine_cosine.hpp.
template <typename Scalar, int Lanes>
[[nodiscard]] inline NearSineCosine<PackedPair<Scalar, Lanes>> near_sin_cos(
    const PackedPair<Scalar, Lanes>& x) {
  const auto first = near_sin_cos(x.first());
  const auto second = near_sin_cos(x.second());
  return {{first.sine, second.sine}, {first.cosine, second.cosine}};
}

/// False only where near_sin_cos(angle) is valid in every lane, and no lane of x is NaN.
template <typename Scalar, int Lanes>
[[nodiscard]] inline bool needs_care(const PackedPair<Scalar, Lanes>& angle,
                                     const PackedPair<Scalar, Lanes>& x) {
  const auto largest = magnitude(angle.first()) + magnitude(angle.second());
  const auto both = x.first().numbers() + x.second().numbers();
  const typename Packed<Scalar, Lanes>::Bits is_no_number =
      both != both;  // NOLINT(misc-redundant-expression)
  return any(typename Packed<Scalar, Lanes>::Bits((largest > static_cast<Scalar>(kLargestPackedAngle)) |
                                                  is_no_number));
}

}  // namespace detail

/// (sin x, cos x) in every lane, rad.
template <typename Scalar, int Lanes>
[[nodiscard]] inline std::pair<PackedPair<Scalar, Lanes>, PackedPair<Scalar, Lanes>> sin_cos(
    const PackedPair<Scalar, Lanes>& x) {
  const auto [sine, cosine] = sin_cos(x.first());
  const auto [upper_sine, upper_cosine] = sin_cos(x.second());
  return {{sine, upper_sine}, {cosine, upper_cosine}};
}

}  // namespace veritrack::trackers
