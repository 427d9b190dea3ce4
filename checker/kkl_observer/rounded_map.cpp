#include "checker/kkl_observer/rounded_map.hpp"

#include "checker/numbers/rounded_value.hpp"

namespace veritrack::checker {

namespace {

using Value = RoundedValue;

/// Sums over the rates.
struct Rates {
  Ball sum, squares;  ///< lambda'1, |lambda|^2
  Ball gram;          ///< |1|^2 |lambda|^2 - (lambda'1)^2
  Ball largest_square;
};

Rates sums_of(const Filters& lambda) {
  Rates rates{zero, zero, zero, zero};
  for (const Ball& rate : lambda) {
    rates.sum += rate;
    rates.squares += square(rate);
    rates.largest_square = max(rates.largest_square, square(rate));
    for (const Ball& other : lambda) {
      rates.gram += half * square(rate - other);
    }
  }
  return rates;
}

/// The sum of c_i xi_i with |xi| = 1 is at most |c|.
Ball length(const Filters& c) {
  Ball sum(0.0);
  for (const Ball& x : c) {
    sum += square(x);
  }
  return sqrt(sum).upper();
}

/// Does the program find ell |xi|^2 below 2 |M xi|^2?
bool finds_mu_zero(const FilterStates& states, const Rates& rates) {
  Value excitation = held(zero);
  Value norm = held(zero);
  const std::size_t filters = states.lambda.size();
  for (std::size_t i = 0; i < filters; ++i) {
    norm = norm + held(one) * held(one);
    for (std::size_t j = i + 1; j < filters; ++j) {
      for (std::size_t k = j + 1; k < filters; ++k) {
        const auto difference = [&](std::size_t a, std::size_t b) {
          return rounded(abs(states.lambda[a] - states.lambda[b]), zero);
        };
        const Value determinant =
            held(one) * difference(j, k) + held(one) * difference(k, i) + held(one) * difference(i, j);
        excitation = excitation + determinant * determinant;
      }
    }
  }
  const Value excess = held(states.ell) * norm.within(one) + held(two) * excitation.within(rates.gram);
  return certainly_less(states.ell + excess.error, states.largest_ell);
}

/// The state x and x3's own bounds, at |xi| = 1.
struct State {
  Value x1, x2, x3;
};

/// kkl_inverse, with mu = 0. The exact d3 is |N'xi|^2 = |M xi|^2 / gram, z3 = x3 d3.
State state(const FilterStates& states, const Rates& rates) {
  Value p11 = held(zero);
  Value p12 = held(zero);
  Value p13 = held(zero);
  Value p22 = held(zero);
  Value p23 = held(zero);
  Value p33 = held(zero);
  Value right1 = held(zero);
  Value right2 = held(zero);
  Value right3 = held(zero);
  const std::size_t filters = states.lambda.size();
  Filters squared(filters);
  Filters cubed(filters);
  Filters reduced(filters);
  for (std::size_t i = 0; i < filters; ++i) {
    const Ball& rate = states.lambda[i];
    squared[i] = square(rate);
    cubed[i] = rate * squared[i];
    reduced[i] = squared[i] - rates.sum / rates.squares * cubed[i];
    const Value lambda = held(rate);
    const Value xi = held(one);
    const Value lambda_squared = lambda * lambda;
    const Value driven = lambda_squared * xi;
    p11 = p11 + lambda_squared;
    p12 = p12 + lambda;
    p13 = p13 + lambda * xi;
    p22 = p22 + held(one);
    p23 = p23 + xi;
    p33 = p33 + xi * xi;
    right1 = right1 + lambda * driven;
    right2 = right2 + driven;
    right3 = right3 + xi * driven;
  }
  p13 = p13.within(length(states.lambda));
  p23 = p23.within(sqrt(Ball(static_cast<double>(filters))).upper());
  p33 = p33.within(one);
  right1 = right1.within(length(cubed));
  right2 = right2.within(length(squared));
  right3 = right3.within(rates.largest_square);
  const Ball left = rates.gram / rates.squares;  // d2
  const Value u12 = quotient(p12, p11, rates.squares, rates.sum / rates.squares);
  const Value u13 = quotient(p13, p11, rates.squares, p13.size / rates.squares);
  const Value d2 = (p22 + p12 * u12).within(left);
  const Value c23 = (p23 + p12 * u13).within(sqrt(left));
  const Value u23 = quotient(c23, d2, left, one / sqrt(left));
  const Value d3 = (p33 + p13 * u13 + c23 * u23).within(one);
  const Value z2 = (right2 + u12 * right1).within(length(reduced));
  const Value z3 = right3 + u13 * right1 + u23 * z2;
  State found;
  found.x3 = quotient(z3, d3, (states.largest_ell / (two * rates.gram)).lower(), states.most_square);
  found.x2 = quotient(z2, d2, left, z2.size / left) + u23 * found.x3;
  found.x1 =
      quotient(right1, p11, rates.squares, right1.size / rates.squares) + u12 * found.x2 + u13 * found.x3;
  return found;
}

/// In engineering units, for states whose exact amplitude is from `low` to `high`: |x1| <= high, |x2| <= high
/// w_hat.
Value amplitude(const State& at, const FilterStates& states, const Ball& low, const Ball& high) {
  const Value x1 = at.x1.within(high);
  const Value x2 = at.x2.within(high * sqrt(states.most_square));
  const Value second = quotient(x2 * x2, at.x3, states.least_square, square(high));
  return root((x1 * x1 + second).within(square(high)), square(low));
}

}  // namespace

MapRounding map_rounding(const FilterStates& states) {
  MapRounding result{Ball::everything(), Ball::everything()};
  const Rates rates = sums_of(states.lambda);
  // Without a certainly positive largest_ell or least_square a divisor or a root below has no bound.
  if (!finds_mu_zero(states, rates) || !states.most_square.finite()) {
    return result;
  }
  const State at = state(states, rates);
  result.frequency = root(at.x3, states.least_square).error;
  // The bound on x1 and x2 is the largest amplitude.
  const Ball most = sqrt(square(at.x1.size) + square(at.x2.size) / states.least_square).upper();
  Ball low = states.least_amplitude.lower();
  if (!certainly_positive(low) || !certainly_less(low, most)) {
    return result;
  }
  Ball worst(0.0);
  while (!certainly_at_most(most, low)) {
    const Ball high = (Ball(1.25) * low).lower();
    worst = max(worst, amplitude(at, states, low, high).error).upper();
    low = high;
  }
  result.amplitude = worst;
  return result;
}

}  // namespace veritrack::checker
