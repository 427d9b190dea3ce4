#include "checker/quadrature/steady_contraction.hpp"

#include "checker/document/evidence.hpp"
#include "checker/quadrature/start_covariance.hpp"
#include "checker/quadrature/steady_pieces.hpp"

namespace veritrack::checker {

namespace {

bool tolerates(const SteadyPieces& cover, const Design& design) {
  return certainly_at_most(design.noise, noise_of(cover)) && certainly_at_most(design.slew, slew_of(cover));
}

void raise_to(std::optional<Ball>& most, const Ball& value) {
  most = most ? max(*most, value) : value;
}

/// The sets for a purpose that tolerate the assumed noise and slew; none when they are not verified.
const SteadyPieces* cover_for(const std::string& purpose, const std::vector<SteadyPieces>& covers,
                              const Design& design) {
  const SteadyPieces* found = nullptr;
  for (const SteadyPieces& cover : covers) {
    found = cover.verified && cover.name == purpose && tolerates(cover, design) ? &cover : found;
  }
  return found;
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

/// The certificate's statement on the assumed starts; they are followed as far as that.
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

/// The size of the sets.
void add_radii(const SteadyPieces& cover, Derivation& found) {
  const std::array<Ball, 3> radii = error_radii(cover);
  found.quantities.push_back({"frequency_error_radius", radii[2]});
  found.quantities.push_back({"phase_error_radius", radii[1]});
  found.quantities.push_back({"amplitude_error_radius", radii[0]});
}

/// The promises of the sets and of the starts that enter them.
void add_whole(const SteadyPieces& whole, const std::optional<SteadyStart>& start, const Promises& promises,
               Derivation& found) {
  const Ball nothing = Ball::everything();
  const Ball rate = slowest(whole);
  const Settled settled = promises.settled.value_or(Settled{nothing, nothing});
  const std::vector<Quantity> quantities{
      {"contraction_rate", rate, Sense::bounds_above},
      {"radius", one},
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
  // Wide cells are few; narrow ones enclose the steady state more tightly.
  const auto branch = steady_branch(design, 0.3, 3e-5);
  const auto fine = branch ? steady_branch(design, 0.05, 2e-5) : std::nullopt;
  const Tree* evidence = claimed.find("evidence");
  const std::optional<StartCovariance> covariance = read_start_covariance(claimed, design, objections);
  std::vector<SteadyPieces> covers;
  Promises promises;
  promises.covariance = covariance ? covariance->words : "";
  promises.about_steady_state = true;
  if (fine && evidence != nullptr) {
    covers = check_steady_covers(*evidence, design, {*branch, *fine}, cells, objections);
    for (const SteadyPieces& cover : covers) {
      if (cover.verified) {
        raise_to(promises.noise, noise_of(cover));
        raise_to(promises.slew, slew_of(cover));
        raise_to(promises.noise_error, largest_error(cover));
      }
    }
  }
  promises.slew_error = promises.noise_error;  // of every set
  const SteadyPieces* whole = cover_for("start-error", covers, design);
  const SteadyPieces* widest = cover_for("frequency-error-radius", covers, design);

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
  if (const SteadyPieces* largest = widest != nullptr ? widest : whole) {
    promises.reach = error_radii(*largest)[2];
    promises.reach_error = largest_error(*largest);
    add_radii(*largest, found);
  }
  if (whole != nullptr) {
    const auto start =
        covariance ? steady_start(design, *whole, *covariance, start_claim(claimed)) : std::nullopt;
    promises.starts_inside = start.has_value();
    if (widest == nullptr) {
      promises.rate = slowest(*whole);
    }
    promises.ultimate = ultimate_error(*whole);
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
