#include "checker/quadrature/steady_contraction.hpp"

#include "checker/document/evidence.hpp"
#include "checker/quadrature/steady_start.hpp"

namespace veritrack::checker {

namespace {

bool bears(const SteadySet& set, const Design& design) {
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

}  // namespace

Promises check_steady_contraction(const Tree& claimed, const Design& design, std::int64_t& cells,
                                  Objections& objections) {
  Promises promises;
  Derivation found;
  found.title = "Contraction in a set around the steady state of every frequency of the band";
  // Wide cells are few, narrow ones say more of the steady state.
  const auto branch = steady_branch(design, 0.3, 1e-4);
  const auto fine = branch ? steady_branch(design, 0.05, 2e-5) : std::nullopt;
  const Tree* evidence = claimed.find("evidence");
  std::vector<SteadySet> sets;
  if (fine && evidence != nullptr) {
    for (const Tree& one_set : evidence->elements()) {
      sets.push_back(check_steady_set(one_set, design, *branch, cells, objections));
    }
  }
  const SteadySet* whole = nullptr;
  for (const SteadySet& set : sets) {
    if (set.verified) {
      improve(promises.noise, set.noise);
      improve(promises.slew, set.slew);
      whole = set.name == "start-error" && bears(set, design) ? &set : whole;
    }
  }

  const Ball nothing = Ball::everything();
  const auto add = [&](const char* name, const Range& value, Sense sense) {
    found.quantities.push_back({name, value, sense});
  };
  found.conditions = {
      {"steady-state", R"(X^*(\omega) = G(X^*(\omega)) \text{ on the band})", proved_if(fine.has_value())},
      {"invariant-set", R"(\Omega_{s_j} \to \Omega_{s_{j+1}})", proved_if(whole != nullptr)}};
  found.conditions.back().rhs = one;
  std::optional<Ball> low;
  std::optional<Ball> high;
  if (fine) {
    for (const SteadyCell& cell : *fine) {
      const Ball bias = cell.at(cell.frequency)[2];
      low = low ? min(*low, bias.lower()) : bias.lower();
      high = high ? max(*high, bias.upper()) : bias.upper();
    }
    add("bias_frequency", Range(*low, *high), Sense::encloses);
  }
  if (whole != nullptr) {
    const std::array<Ball, 3> radii = error_radii(*whole);
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
    const auto start = steady_start(
        design, *whole, *fine,
        {said("capture_samples"), level, said("frequency_error_bound"), said("settling_samples")});
    promises.starts_inside = start.has_value();
    promises.ultimate = max(abs(*low), abs(*high)) + whole->levels.back() * radii[2];
    promises.reach = radii[2];
    if (start) {
      promises.bound = start->bound;
      promises.settling = start->settling;
    }
    add("contraction_rate", slowest(*whole), Sense::bounds_above);
    add("radius", one, Sense::encloses);
    add("frequency_error_radius", radii[2], Sense::encloses);
    add("phase_error_radius", radii[1], Sense::encloses);
    add("amplitude_error_radius", radii[0], Sense::encloses);
    add("ultimate_frequency_error", *promises.ultimate, Sense::bounds_above);
    // From the start, or from level 1 when the starts are not known to come into the set.
    add("settling_samples", start ? start->settling : Ball(static_cast<double>(whole->levels.size() - 1)),
        Sense::bounds_above);
    add("frequency_error_bound", promises.bound.value_or(nothing), Sense::bounds_above);
    add("capture_samples", start ? start->samples : nothing, Sense::bounds_above);
    found.conditions.back().lhs = slowest(*whole);
    found.conditions.back().lhs_sense = Sense::bounds_above;
    found.conditions.push_back(
        {"start-in-set", R"(|T (e - e^*)| \le 1,\ -\Delta_{lo} \le P - P^* \le \Delta_{hi})",
         proved_if(start.has_value()), start ? start->level : nothing, one, Sense::bounds_above});
  }
  add("largest_noise", promises.noise.value_or(nothing), Sense::bounds_below);
  add("largest_slew", promises.slew.value_or(nothing), Sense::bounds_below);
  check_derivation(claimed, found, objections);
  return promises;
}

}  // namespace veritrack::checker
