#include "checker/single_channel/frozen_filter.hpp"

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

void check_transfer_function(const Tree& claimed, Objections& objections) {
  Derivation found;
  found.title = "Stability of the tracker with frozen frequency and gain, from measurement to innovation";
  const auto chosen = [&](const char* name) {
    const Tree& quantity = claimed.at("quantities").at(name);
    Ball value = low_of(quantity);
    found.quantities.push_back({name, value});
    if (!certainly_equal(value, high_of(quantity))) {
      objections.push_back(std::string(name) + " is a choice, and must be one number");
    }
    return value;
  };
  const Ball k1 = chosen("gain_1");
  const Ball k2 = chosen("gain_2");
  const Ball angle = chosen("zero_angle");
  const Ball half_trace = half * (k2 * sin(angle) + (two - k1) * cos(angle));
  const Ball determinant = one - k1;
  const Ball discriminant = square(half_trace) - determinant;
  const bool complex = certainly_less(discriminant, zero);
  found.quantities.push_back(
      {"pole_radius", complex ? sqrt(determinant) : abs(half_trace) + sqrt(discriminant)});
  const Ball at_1 = one + determinant - two * half_trace;
  const Ball at_minus_1 = one + determinant + two * half_trace;
  found.conditions = {
      {"jury-product", "|1 - K_1| < 1", decide_less(abs(determinant), one), abs(determinant), one},
      {"jury-at-1", "0 < D(1)", decide_less(zero, at_1), zero, at_1},
      {"jury-at-minus-1", "0 < D(-1)", decide_less(zero, at_minus_1), zero, at_minus_1}};
  check_derivation(claimed, found, objections);
}

}  // namespace veritrack::checker
