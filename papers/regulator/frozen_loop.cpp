#include "papers/regulator/frozen_loop.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/branch_and_bound.hpp"

namespace veritrack::regulator {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// |p(e^{-j angle})|^2.
template <typename Scalar>
Scalar power_at(const Polynomial& p, const Scalar& angle) {
  Scalar real(0.0);
  Scalar imaginary(0.0);
  for (std::size_t k = 0; k < p.size(); ++k) {
    const auto [sine, cosine] = sin_cos(Scalar(Scalar(static_cast<double>(k)) * angle));
    real = real + Scalar(p[k]) * cosine;
    imaginary = imaginary + Scalar(p[k]) * sine;
  }
  return square(real) + square(imaginary);
}

/// -|S|^2.
struct NegativePower {
  Polynomial above, below;

  template <typename Vector>
  auto operator()(const Vector& at) const {
    using Scalar = typename Vector::Scalar;
    return Scalar(-(power_at(above, Scalar(at[0])) / power_at(below, Scalar(at[0]))));
  }
};

Verdict is_stable_for_gains(const FrozenLoop& loop, const Interval& gains, int halvings) {
  const Verdict whole = loop.has_poles_within(Interval(1.0), gains);
  if (whole != Verdict::undecided || halvings == 0) {
    return whole;
  }
  const double middle = midpoint(gains);
  return rigor::conjunction(
      {is_stable_for_gains(loop, Interval::from_bounds(gains.lower(), middle), halvings - 1),
       is_stable_for_gains(loop, Interval::from_bounds(middle, gains.upper()), halvings - 1)});
}

}  // namespace

Polynomial product(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) {
    return {};
  }
  Polynomial result(a.size() + b.size() - 1, Interval(0.0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      result[i + k] += a[i] * b[k];
    }
  }
  return result;
}

Interval size_at(const Polynomial& p, const Interval& frequency) {
  return sqrt(power_at(p, frequency));
}

Verdict has_zeros_within(const Polynomial& p, const Interval& radius) {
  if (p.empty() || !certainly_positive(radius)) {
    return Verdict::undecided;
  }
  Polynomial rest = p;
  Interval power(1.0);
  for (auto coefficient = rest.rbegin(); coefficient != rest.rend(); ++coefficient) {
    *coefficient *= power;  // of (radius w)^n p_0 + (radius w)^(n-1) p_1 + ...
    power *= radius;
  }
  while (rest.size() > 1) {
    const Interval last = rest.back() / rest.front();
    if (certainly_less_equal(Interval(1.0), abs(last))) {
      return Verdict::refuted;
    }
    if (!certainly_less(abs(last), Interval(1.0))) {
      return Verdict::undecided;
    }
    Polynomial next(rest.size() - 1);
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i] = rest[i] - last * rest[rest.size() - 1 - i];
    }
    rest = std::move(next);
  }
  return Verdict::proved;
}

Polynomial FrozenLoop::characteristic(const Interval& gain) const {
  Polynomial sum = product(plant_denominator, denominator);
  const Polynomial forward = product(plant_numerator, numerator);
  sum.resize(std::max(sum.size(), forward.size() + 1), Interval(0.0));
  for (std::size_t i = 0; i < forward.size(); ++i) {
    sum[i + 1] += gain * forward[i];
  }
  return sum;
}

Verdict FrozenLoop::has_poles_within(const Interval& radius, const Interval& gain) const {
  return has_zeros_within(characteristic(gain), radius);
}

Verdict FrozenLoop::is_stable_for_gains(const Interval& gains) const {
  constexpr int kHalvings = 16;
  return is_finite(gains) ? regulator::is_stable_for_gains(*this, gains, kHalvings) : Verdict::undecided;
}

Interval FrozenLoop::sensitivity(const Interval& frequency) const {
  return size_at(product(plant_denominator, denominator), frequency) /
         size_at(characteristic(Interval(1.0)), frequency);
}

Interval FrozenLoop::peak_sensitivity() const {
  const rigor::UpwardRounding upward;
  const NegativePower function{product(plant_denominator, denominator), characteristic(Interval(1.0))};
  rigor::IntervalVector<1> frequencies;
  frequencies[0] = Interval::from_bounds(0.0, rigor::pi().upper());
  search::BranchAndBoundSettings<1> settings;
  settings.of_lower_ends = true;
  const search::VerifiedMinimum<1> found = search::minimize_globally<1>(function, frequencies, settings);
  return sqrt(-found.value());
}

}  // namespace veritrack::regulator
