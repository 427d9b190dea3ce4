#include "checker/quadrature/lock.hpp"

#include "checker/quadrature/lock_start.hpp"

namespace veritrack::checker {

Promises check_lock(const Tree& derivation, const Design& design, const GaussianNoise& noise,
                    const std::optional<LockSet>& set, Objections& objections) {
  const std::optional<StartCovariance> covariance = read_start_covariance(derivation, design, objections);
  Promises promises;
  promises.covariance = covariance ? covariance->words : "";
  Derivation found;
  found.title = "Gaussian noise: the probability of losing lock";
  found.conditions = {
      {"leak", R"(\epsilon = 0)", proved_if(design.without_leak()), design.epsilon, zero},
      {"drift", R"(E[W(k+1) \mid k] \le \kappa W(k) + c_0 \text{ in the set})", proved_if(set.has_value())},
      {"rounding", R"(\varrho \le \eta,\ \mu\,hi \le \eta D_h,\ \mu\,lo^{-1} \le (1 - \mu)\,\eta D_l)",
       proved_if(set.has_value())}};
  if (set && covariance) {
    const Ball level =
        start_level(*set, {design.amplitude_error, design.phase_error, design.frequency_error}, *covariance);
    const bool inside = certainly_at_most(level, set->level);
    found.conditions.push_back({"start-in-set", R"(\tfrac12|T e(0)|^2 + \tfrac12\gamma s(P(0))^2 \le L)",
                                proved_if(inside), level, set->level, Sense::bounds_above});
    if (inside) {
      promises.losing_lock = probability_of_leaving(*set, level, noise.samples);
      promises.lock_reach = largest_frequency_error(*set);
      found.quantities = {{"probability_of_losing_lock", *promises.losing_lock, Sense::bounds_above},
                          {"lock_frequency_error", *promises.lock_reach, Sense::bounds_above},
                          {"start_level", level, Sense::bounds_above}};
    }
  } else {
    found.conditions.push_back({"start-in-set", "", Verdict::undecided});
  }
  check_derivation(derivation, found, objections);
  return promises;
}

}  // namespace veritrack::checker
