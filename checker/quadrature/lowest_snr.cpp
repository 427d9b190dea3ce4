#include "checker/quadrature/lowest_snr.hpp"

#include "checker/document/evidence.hpp"
#include "checker/quadrature/lock_set.hpp"
#include "checker/quadrature/lock_start.hpp"

namespace veritrack::checker {

Ball decibels_of(const Ball& deviation) {
  return -(Ball(10.0) * log(two * square(deviation)) / log(Ball(10.0)));
}

LockSet check_lowest_snr_set(const Tree& tree, const Design& design, const GaussianNoise& noise,
                             std::int64_t& cells, Objections& objections) {
  if (!design.without_leak()) {
    // There each set is for a part of the band only.
    objections.emplace_back("a set for the lowest SNR is for a design without a leak");
  }
  GaussianNoise at_set = noise;
  at_set.deviation = exact_number(tree.at("noise_deviation"));
  return check_lock_set(tree, design, at_set, cells, objections);
}

void check_lowest_snr(const Tree& derivation, const Design& design, const GaussianNoise& noise,
                      const std::optional<LockSet>& set, Promises& promises, Objections& objections) {
  const std::optional<StartCovariance> covariance = read_start_covariance(derivation, design, objections);
  Derivation found;
  found.title = "Gaussian noise: the lowest signal-to-noise ratio";
  found.conditions = {
      {"leak", R"(\epsilon = 0)", proved_if(design.without_leak()), design.epsilon, zero},
      {"drift", R"(E[W(k+1) \mid k] \le \kappa W(k) + c_0 \text{ in the set})", proved_if(set.has_value())},
      {"rounding", R"(\varrho \le \eta,\ \mu\,hi \le \eta D_h,\ \mu\,lo^{-1} \le (1 - \mu)\,\eta D_l)",
       proved_if(set.has_value())}};
  Condition start{"start-in-set", R"(\tfrac12|T e(0)|^2 + \tfrac12\gamma s(P(0))^2 \le L)"};
  if (set && covariance) {
    const Ball level =
        start_level(*set, {design.amplitude_error, design.phase_error, design.frequency_error}, *covariance);
    const bool inside = certainly_at_most(level, set->level);
    start.verdict = proved_if(inside);
    start.lhs = level;
    start.rhs = set->level;
    start.lhs_sense = Sense::bounds_above;
    if (inside) {
      promises.lowest_snr = decibels_of(set->deviation);
      promises.losing_lock_at_lowest_snr = probability_of_leaving(*set, level, noise.samples);
      promises.reach_at_lowest_snr = largest_frequency_error(*set);
      promises.covariance_at_lowest_snr = covariance->words;
      found.quantities = {
          {"lowest_snr", *promises.lowest_snr, Sense::bounds_above},
          {"probability_of_losing_lock", *promises.losing_lock_at_lowest_snr, Sense::bounds_above},
          {"lock_frequency_error", *promises.reach_at_lowest_snr, Sense::bounds_above},
          {"start_level", level, Sense::bounds_above}};
    }
  }
  found.conditions.push_back(start);
  check_derivation(derivation, found, objections);
}

}  // namespace veritrack::checker
