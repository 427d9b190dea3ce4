#include "checker/quadrature/steady_contraction.hpp"

#include "checker/document/evidence.hpp"
#include "checker/quadrature/start_covariance.hpp"
#include "checker/quadrature/steady_start.hpp"

namespace veritrack::checker {

namespace {

bool tolerates(const SteadySet& set, const Design& design) {
  return certainly_at_most(design.noise, set.noise) && certainly_at_most(design.slew, set.slew);
}

/// At least s_(j+1)/s_j for all j; 1 when the set does not shrink.
Ball slowest(const SteadySet& set) {
  Ball rate = set.levels.size() > 1 ? zero : one;
  for (std::size_t j = 1; j < set.levels.size(); ++j) {
    rate = max(rate, set.levels[j] / set.levels[j - 1]);
  }
  return rate;
}

void improve(std::optional<Ball>& most, const Ball& value) {
  most = most ? max(*most, value) : value;
}

/// The set for the assumed noise and slew; none when it is not verified.
const SteadySet* whole_of(const std::vector<SteadySet>& sets, const Design& design) {
  const SteadySet* whole = nullptr;
  for (const SteadySet& set : sets) {
    whole = set.verified && set.name == "start-error" && tolerates(set, design) ? &set : whole;
  }
  return whole;
}

/// nu* over the band.
Range bias_of(const std::vector<SteadyCell>& branch) {
  std::optional<Ball> low;
  std::optional<Ball> high;
  for (const SteadyCell& cell : branch) {
    const Ball bias = cell.at(cell.frequency)[2];
    low = low ? min(*low, bias.lower()) : bias.lower();
    high = high ? max(*high, bias.upper()) : bias.upper();
  }
  return {low.value_or(Ball::everything()), high.value_or(Ball::everything())};
}

/// What the certificate says of the assumed starts, which is as far as they are followed.
SteadyStartClaim start_claim(const Tree& claimed) {
  const Tree& quantities = claimed.at("quantities");
  const auto said = [&](const char* name) {
    const Tree* quantity = quantities.find(name);
    return quantity != nullptr ? std::optional(high_of(*quantity)) : std::nullopt;
  };
  std::optional<Ball> level;
  const auto& conditions = claimed.at("conditions").elements();
  if (const Tree* lhs = conditions.empty() ? nullptr : conditions.back().find("lhs")) {
    level = high_of(*lhs);
  }
  return {said("capture_samples"), level, said("frequency_error_bound"), said("settling_samples")};
}

/// What the set and the starts that enter it give.
void add_whole(const SteadySet& whole, const std::optional<SteadyStart>& start, const Promises& promises,
               Derivation& found) {
  const Ball nothing = Ball::everything();
  const std::array<Ball, 3> radii = error_radii(whole);
  const Ball rate = slowest(whole);
  const Settled settled = promises.settled.value_or(Settled{nothing, nothing});
  const std::vector<Quantity> quantities{
      {"contraction_rate", rate, Sense::bounds_above},
      {"radius", one},
      {"frequency_error_radius", radii[2]},
      {"phase_error_radius", radii[1]},
      {"amplitude_error_radius", radii[0]},
      {"ultimate_frequency_error", promises.ultimate.value_or(nothing), Sense::bounds_above},
      {"settling_samples", settled.samples, Sense::bounds_above},
      {"settled_frequency_error", settled.frequency_error, Sense::bounds_above},
      {"frequency_error_bound", promises.bound.value_or(nothing), Sense::bounds_above},
      {"capture_samples", start ? start->samples : nothing, Sense::bounds_above}};
  found.quantities.insert(found.quantities.end(), quantities.begin(), quantities.end());
  found.conditions.back().lhs = rate;
  found.conditions.back().lhs_sense = Sense::bounds_above;
  found.conditions.push_back(
      {"start-in-set", R"(|T (e - e^*)| \le 1,\ -\Delta_{lo} \le P - P^* \le \Delta_{hi})",
       proved_if(start.has_value()), start ? start->level : nothing, one, Sense::bounds_above});
}

}  // namespace

Promises check_steady_contraction(const Tree& claimed, const Design& design, std::int64_t& cells,
                                  Objections& objections) {
  // Wide cells are few, narrow ones say more of the steady state.
  const auto branch = steady_branch(design, 0.3, 3e-5);
  const auto fine = branch ? steady_branch(design, 0.05, 2e-5) : std::nullopt;
  const Tree* evidence = claimed.find("evidence");
  const std::optional<StartCovariance> covariance = read_start_covariance(claimed, design, objections);
  std::vector<SteadySet> sets;
  Promises promises;
  promises.covariance = covariance ? covariance->words : "";
  promises.about_steady_state = true;
  if (fine && evidence != nullptr) {
    for (const Tree& item : evidence->elements()) {
      const Tree& name = item.at("name");
      if (name.is("start-covariance")) {
        continue;
      }
      if (!name.is("start-error") && !name.is("largest-noise") && !name.is("largest-slew")) {
        objections.emplace_back("no set is for this purpose");
        continue;
      }
      // A large set needs to know the steady state better.
      Objections coarse;
      SteadySet checked = check_steady_set(item, design, *branch, cells, coarse);
      if (!checked.verified) {
        checked = check_steady_set(item, design, *fine, cells, objections);
      }
      const SteadySet& set = sets.emplace_back(std::move(checked));
      if (set.verified) {
        improve(promises.noise, set.noise);
        improve(promises.slew, set.slew);
      }
    }
  }
  const SteadySet* whole = whole_of(sets, design);

  Derivation found;
  found.title = "Contraction in a set around the steady state of every frequency of the band";
  found.conditions = {
      {"steady-state", R"(X^*(\omega) = G(X^*(\omega)) \text{ on the band})", proved_if(fine.has_value())},
      {"invariant-set", R"(\Omega_{s_j} \to \Omega_{s_{j+1}})", proved_if(whole != nullptr)}};
  found.conditions.back().rhs = one;
  const Range bias = fine ? bias_of(*fine) : Range(Ball::everything());
  if (fine) {
    found.quantities.push_back({"bias_frequency", bias});
  }
  if (whole != nullptr) {
    const auto start =
        covariance ? steady_start(design, *whole, *fine, *covariance, start_claim(claimed)) : std::nullopt;
    promises.starts_inside = start.has_value();
    promises.reach = error_radii(*whole)[2];
    promises.rate = slowest(*whole);
    promises.ultimate = max(abs(bias.low), abs(bias.high)) + whole->levels.back() * *promises.reach;
    if (start) {
      promises.bound = start->bound;
      const auto claim = settling_claim(claimed.at("quantities"));
      const bool settles = claim && certainly_at_most(start->settling, claim->samples) &&
                           certainly_at_most(*promises.ultimate, claim->frequency_error);
      promises.settled = settles ? claim : std::nullopt;
    }
    add_whole(*whole, start, promises, found);
  }
  const Ball nothing = Ball::everything();
  found.quantities.push_back({"largest_noise", promises.noise.value_or(nothing), Sense::bounds_below});
  found.quantities.push_back({"largest_slew", promises.slew.value_or(nothing), Sense::bounds_below});
  check_derivation(claimed, found, objections);
  return promises;
}

}  // namespace veritrack::checker
