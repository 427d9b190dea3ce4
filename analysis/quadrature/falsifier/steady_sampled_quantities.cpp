#include "analysis/quadrature/falsifier/steady_sampled_quantities.hpp"

#include <algorithm>
#include <limits>

#include "analysis/quadrature/falsifier/sampled_limit.hpp"
#include "analysis/quadrature/falsifier/sampled_text.hpp"

namespace veritrack::quadrature {

using rigor::Interval;

std::vector<SetClaim> claims_of(const trackers::ToneModel<Interval>& design, const sets::LockBranch& branch,
                                const SteadySet& set) {
  const rigor::NearestRounding nearest;
  const trackers::ToneModel<double> middle{midpoint(design.q1), midpoint(design.q2), midpoint(design.r),
                                           midpoint(design.epsilon)};
  const auto& cells = branch.cells;
  std::vector<SetClaim> claims;
  claims.reserve(3);
  for (const std::size_t k : {std::size_t{0}, cells.size() / 2, cells.size() - 1}) {
    const double frequency = cells[k].parameter_center;
    const auto steady =
        sets::propose_fixed_point(sets::QuadraturePolarLoop{design}, cells[k].center, frequency);
    if (steady) {
      const rigor::Vector<9>& x = steady->state;
      claims.emplace_back(set, middle, PolarState{{x[0], x[1], x[2]}, {x[3], x[4], x[5], x[6], x[7], x[8]}},
                          frequency);
    }
  }
  return claims;
}

void add_steady_sampled_quantities(const std::vector<SetClaim>& claims, theorems::Derivation& derivation) {
  if (claims.empty()) {
    return;
  }
  FalsifierOptions effort;
  effort.search_evaluations = 10;
  double limit = std::numeric_limits<double>::infinity();
  double of_radius = 0.0;
  double of_ultimate = 0.0;
  for (const SetClaim& claim : claims) {
    limit = std::min(limit, sampled_radius_limit(claim));
    const Falsification found = try_to_break(claim, effort);
    of_radius = std::max(of_radius, found.from_rim.tightness());
    of_ultimate = std::max(of_ultimate, found.from_zero.tightness());
  }
  const auto add = [&](SampledText text, const char* symbol, const char* formula, double value) {
    add_sampled(derivation, text, {symbol, formula, "docs/leak.md"}, value);
  };
  add(kRadiusLimit, "\\hat\\nu_R", "\\hat R\\,|e_3' T^{-1}|", limit * claims.front().bound_from_rim());
  add(kShareOfLimit, "1 / \\hat R", "", 1.0 / limit);
  add(kBoundTightness, "", "\\sup_{\\text{found}} |\\nu - \\nu^*| / |e_3' T^{-1}|", of_radius);
  add(kUltimateTightness, "", "\\sup_{\\text{found}} |\\nu - \\nu^*| / (s_n |e_3' T^{-1}|)", of_ultimate);
}

}  // namespace veritrack::quadrature
