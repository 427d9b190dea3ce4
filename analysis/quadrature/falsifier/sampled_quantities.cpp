#include "analysis/quadrature/falsifier/sampled_quantities.hpp"

#include "analysis/quadrature/falsifier/falsifier.hpp"
#include "analysis/quadrature/falsifier/sampled_limit.hpp"
#include "analysis/theorems/derivation_builder.hpp"

namespace veritrack::quadrature {

using rigor::Interval;

void add_sampled_quantities(const sets::ContractionQuestion& question,
                            const ContractionCertificate& certificate, theorems::Derivation& derivation) {
  const auto& intervals = question.design;
  const trackers::ToneModel<double> design{midpoint(intervals.q1), midpoint(intervals.q2),
                                           midpoint(intervals.r), 0.0};
  const auto add = [&](const char* name, const char* symbol, const char* formula, double value) {
    theorems::add_quantity(derivation, {name, symbol, formula, "docs/contraction.md"}, Interval(value));
    derivation.quantities.back().proved = false;
  };
  const CertifiedSet& set = certificate.set->set;
  const double limit = sampled_radius_limit(set, design);
  add("frequency_error_radius_sampled_limit", "\\hat\\nu_R", "\\hat R\\,|e_3' T^{-1}|",
      error_bounds(set, Interval(limit))[2].upper());
  add("frequency_error_radius_share_of_limit", "R / \\hat R", "", set.radius / limit);
  FalsifierOptions effort;
  effort.search_evaluations = 10;
  if (certificate.bound_set) {
    const Falsification found = try_to_break(certificate.bound_set->set, design, effort);
    add("frequency_error_bound_tightness", "", "\\sup_{\\text{found}} |\\nu| / (R\\,|e_3' T^{-1}|)",
        found.from_rim.tightness());
  }
  if (certificate.ultimate_set) {
    const Falsification found = try_to_break(certificate.ultimate_set->set, design, effort);
    add("ultimate_frequency_error_tightness", "", "\\sup_{\\text{found}} |\\nu| / \\nu_\\infty",
        found.from_zero.tightness());
  }
}

}  // namespace veritrack::quadrature
