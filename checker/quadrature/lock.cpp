#include "checker/quadrature/lock.hpp"

#include "checker/quadrature/lock_start.hpp"

namespace veritrack::checker {

Promises check_lock(const Tree& derivation, const Design& design, const GaussianNoise& noise,
                    const std::vector<LockSet>& sets, Objections& objections) {
  const std::optional<StartCovariance> covariance = read_start_covariance(derivation, design, objections);
  Promises promises;
  promises.covariance = covariance ? covariance->words : "";
  Derivation found;
  found.title = "Gaussian noise: the probability of losing lock";
  found.conditions = {
      design.without_leak() ? Condition{"leak", R"(\epsilon = 0)", Verdict::proved, design.epsilon, zero}
                            : Condition{"constant-frequency", "w = 0",
                                        proved_if(certainly_equal(noise.walk, zero)), noise.walk, zero},
      {"drift", R"(E[W(k+1) \mid k] \le \kappa W(k) + c_0 \text{ in the set})", proved_if(!sets.empty())},
      {"rounding", R"(\varrho \le \eta,\ \mu\,hi \le \eta D_h,\ \mu\,lo^{-1} \le (1 - \mu)\,\eta D_l)",
       proved_if(!sets.empty())}};
  if (!sets.empty() && covariance) {
    Ball level;
    Ball limit = sets.front().level;
    for (const LockSet& set : sets) {
      level =
          max(level, start_level(set, {design.amplitude_error, design.phase_error, design.frequency_error},
                                 *covariance));
      limit = min(limit, set.level);
    }
    const bool inside = certainly_at_most(level, limit);
    found.conditions.push_back({"start-in-set", R"(\tfrac12|T e(0)|^2 + \tfrac12\gamma s(P(0))^2 \le L)",
                                proved_if(inside), level, limit, Sense::bounds_above});
    if (inside) {
      promises.losing_lock = promises.lock_reach = zero;
      for (const LockSet& set : sets) {
        promises.losing_lock =
            max(*promises.losing_lock, probability_of_leaving(set, level, noise.samples)).upper();
        promises.lock_reach = max(*promises.lock_reach, largest_frequency_error(set)).upper();
      }
      promises.start_level = level;
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
