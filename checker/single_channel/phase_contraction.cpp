#include "checker/single_channel/phase_contraction.hpp"

#include <algorithm>

#include "checker/document/evidence.hpp"
#include "checker/single_channel/covariance_window.hpp"
#include "checker/single_channel/diagonal_start.hpp"
#include "checker/single_channel/error_set.hpp"
#include "checker/single_channel/rounded_step.hpp"

namespace veritrack::checker {

namespace {

/// The verified set of this name; empty when the evidence has none, or some statement in it is not proved.
std::optional<ErrorSet> verified_set(const Tree& derivation, const std::string& name,
                                     const SingleChannelDesign& design, std::int64_t& cells,
                                     Objections& objections,
                                     const std::optional<DiagonalStart>& start = std::nullopt) {
  const Tree* item = find_evidence(derivation, name);
  if (item == nullptr) {
    return std::nullopt;
  }
  const Tree& numbers = item->at("numbers");
  const auto number = [&](const std::string& key) { return exact_number(numbers.at(key)); };
  WindowStatement window;
  window.radius = number("radius");
  window.frequency_variance = number("frequency_variance");
  window.signal_variance = number("signal_variance");
  window.loosening = number("loosening");
  window.slew = number("slew");
  window.curvature = number("curvature");
  window.curvature_weight = number("curvature_weight");
  window.signal_uncertainty = number("signal_uncertainty");
  window.has_least = numbers.find("least_p11") != nullptr;
  if (window.has_least) {
    window.least_p11 = number("least_p11");
    window.least_p22 = number("least_p22");
    window.least_p33 = number("least_p33");
  }
  for (int m = 1; numbers.find("share_" + std::to_string(m)) != nullptr; ++m) {
    window.shares.push_back(number("share_" + std::to_string(m)));
  }
  window.has_starts = start.has_value();
  if (start) {
    window.start_signal = start->to * start->signal;
    window.start_frequency = start->to * start->frequency;
  }
  const Ball noise = number("noise");
  const StepRounding rounding = step_rounding(design, window, noise, start);
  window.covariance_rounding = rounding.covariance;
  const ErrorSet set(window, design, noise, number("start_level"), rounding.error);
  if (rounding.finite() && certainly_not_negative(set.noise()) && certainly_positive(set.start()) &&
      set.keeps(set.start()) && window_is_proved(window, design, cells)) {
    return set;
  }
  objections.push_back("the set \"" + name + "\" is not proved by its evidence");
  return std::nullopt;
}

bool tolerates(const ErrorSet& set, const SingleChannelDesign& design) {
  return certainly_at_most(design.noise, set.noise()) && certainly_at_most(design.slew, set.window().slew);
}

/// The assumed starts are in the set: their errors, and their covariances, which are below those of a tracker
/// that has followed the tone without errors, and stay below. At first the only known bound on the predicted
/// ones is that they are above Q.
bool holds_starts(const ErrorSet& set, const SingleChannelDesign& design, const DiagonalStart& start) {
  return set.window().has_starts && !design.has_given_covariance && set.keeps(level_of(start, design)) &&
         certainly_at_most(set.window().signal_uncertainty, design.q1);
}

/// The reach of the starts of the set, whatever phase and frequency, and the bound that they never exceed.
void add_size(const ErrorSet& set, Derivation& found) {
  const WindowStatement& window = set.window();
  const Ball signal = set.start() * sqrt(window.signal_variance);
  const auto reach = [&](const Ball& least) { return set.start() * root_of_non_negative(max(least, zero)); };
  found.quantities = {
      {"contraction_rate", set.rate()},
      {"radius", set.start()},
      {"frequency_error_radius", Range(reach(window.least_p33), set.frequency_error(set.start()))},
      // At delta_2 = reach, and |z| <= 1 + signal; arg z <= asin(signal).
      {"phase_error_radius", Range(arctangent(reach(window.least_p22) / (one + signal)),
                                   arctangent(signal / sqrt(one - square(signal))))},
      {"amplitude_error_radius", Range(reach(window.least_p11), signal)},
      // Without noise and slew the errors tend to zero.
      {"bias_frequency", zero}};
}

/// The verified sets of the evidence, by what they are for.
struct ErrorSets {
  std::optional<ErrorSet> whole, bound, noisy, slewing;
  Ball start_level;  ///< of the assumed starts in `bound`
};

/// A set, and the level of the starts in it that statements are about.
struct StartSet {
  const ErrorSet& set;
  Ball level;
};

/// The assumed starts in the set that bounds their errors; when they are not in it, every start in the set
/// "start-error".
std::optional<StartSet> starts_of(const ErrorSets& sets, bool starts_inside, bool invariant) {
  if (starts_inside) {
    return StartSet{*sets.bound, sets.start_level};
  }
  return invariant ? std::optional(StartSet{*sets.whole, sets.whole->start()}) : std::nullopt;
}

bool settles(const StartSet& starts, const Settled& claim) {
  constexpr double kMost = 10000.0;
  const double samples = claim.samples.near();
  // cannot bind (Ball(kMost)): it only keeps the work finite.
  return certainly_at_most(claim.samples, Ball(kMost)) &&
         starts.set.settled(starts.level, claim.frequency_error, static_cast<std::size_t>(samples));
}

std::vector<Condition> conditions_of(const ErrorSets& sets, const SingleChannelDesign& design, bool invariant,
                                     bool inside) {
  std::vector<Condition> conditions{
      {"leak", R"(\epsilon = 0)", proved_if(design.without_leak()), design.epsilon, zero},
      {"controllable-amplitude", "q_1 > 0", decide_less(zero, design.q1), design.q1, zero},
      {"invariant-set",
       R"((\kappa_n + c R \sum_m \kappa_m) R + g^n \sqrt n\,u + \varrho \sum_m \kappa_m \le R)",
       proved_if(invariant)}};
  if (sets.whole) {
    conditions.back().lhs = sets.whole->after(sets.whole->window().radius);
    conditions.back().rhs = sets.whole->window().radius;
    conditions.back().lhs_sense = Sense::bounds_above;
    conditions.push_back({"start-in-set", R"(e(0)' P(0)^{-1} e(0) \le R_0^2)", proved_if(inside),
                          inside ? sets.start_level : Ball::everything(),
                          inside ? sets.bound->start() : sets.whole->start(), Sense::bounds_above});
  }
  return conditions;
}

}  // namespace

Promises check_phase_contraction(const Tree& claimed, const SingleChannelDesign& design, std::int64_t& cells,
                                 Objections& objections) {
  const std::optional<DiagonalStart> start = read_diagonal_start(claimed, design, objections);
  const ErrorSets sets{verified_set(claimed, "start-error", design, cells, objections),
                       verified_set(claimed, "frequency-error-bound", design, cells, objections, start),
                       verified_set(claimed, "largest-noise", design, cells, objections),
                       verified_set(claimed, "largest-slew", design, cells, objections),
                       start ? level_of(*start, design) : Ball::everything()};
  Promises promises;
  promises.covariance = start ? start->words : "";
  promises.starts_inside =
      start && sets.bound && tolerates(*sets.bound, design) && holds_starts(*sets.bound, design, *start);
  const auto frequency_errors = [](const ErrorSet& set) { return set.frequency_error(set.window().radius); };
  if (sets.noisy) {
    promises.noise = sets.noisy->noise();
    promises.noise_error = frequency_errors(*sets.noisy);
  }
  if (sets.slewing) {
    promises.slew = sets.slewing->window().slew;
    promises.slew_error = frequency_errors(*sets.slewing);
  }
  Derivation found;
  found.title = "Contraction of the errors over all phases and the band of frequencies";
  const bool invariant = sets.whole && tolerates(*sets.whole, design);
  if (invariant) {
    add_size(*sets.whole, found);
    promises.rate = sets.whole->rate();
    promises.rate_window = sets.whole->samples();
    promises.reach_error = frequency_errors(*sets.whole);
    promises.reach = sets.whole->start() * root_of_non_negative(max(sets.whole->window().least_p33, zero));
  }
  if (const auto starts = starts_of(sets, promises.starts_inside, invariant)) {
    promises.ultimate = starts->set.frequency_error(starts->set.ultimate());
    if (promises.starts_inside) {
      promises.bound = starts->set.frequency_error(starts->set.largest(starts->level));
    }
    if (const auto claim = settling_claim(claimed.at("quantities")); claim && settles(*starts, *claim)) {
      found.quantities.push_back({"settling_samples", claim->samples, Sense::bounds_above});
      found.quantities.push_back({"settled_frequency_error", claim->frequency_error, Sense::bounds_above});
      promises.settled = promises.starts_inside ? claim : std::nullopt;
    }
  }
  add_bounds(promises, found);
  found.conditions = conditions_of(sets, design, invariant, promises.starts_inside);
  check_derivation(claimed, found, objections);
  return promises;
}

}  // namespace veritrack::checker
