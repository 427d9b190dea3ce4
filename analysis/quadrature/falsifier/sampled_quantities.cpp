#include "analysis/quadrature/falsifier/sampled_quantities.hpp"

#include "analysis/quadrature/falsifier/falsifier.hpp"
#include "analysis/quadrature/falsifier/sampled_limit.hpp"
#include "analysis/quadrature/falsifier/sampled_text.hpp"

namespace veritrack::quadrature {

using rigor::Interval;

void add_sampled_quantities(const sets::ContractionQuestion& question,
                            const ContractionCertificate& certificate, theorems::Derivation& derivation) {
  const auto& intervals = question.design;
  const trackers::ToneModel<double> design{midpoint(intervals.q1), midpoint(intervals.q2),
                                           midpoint(intervals.r), 0.0};
  const auto add = [&](SampledText text, const char* symbol, const char* formula, double value) {
    add_sampled(derivation, text, {symbol, formula, "docs/contraction.md"}, value);
  };
  const CertifiedSet& set = certificate.set->set;
  const double limit = sampled_radius_limit(set, design);
  add(kRadiusLimit, "\\hat\\nu_R", "\\hat R\\,|e_3' T^{-1}|", error_bounds(set, Interval(limit))[2].upper());
  add(kShareOfLimit, "R / \\hat R", "", set.radius / limit);
  FalsifierOptions effort;
  effort.search_evaluations = 10;
  if (certificate.bound_set) {
    const Falsification found = try_to_break(certificate.bound_set->set, design, effort);
    add(kBoundTightness, "", "\\sup_{\\text{found}} |\\nu| / (R\\,|e_3' T^{-1}|)",
        found.from_rim.tightness());
  }
  if (certificate.ultimate_set) {
    const Falsification found = try_to_break(certificate.ultimate_set->set, design, effort);
    add(kUltimateTightness, "", "\\sup_{\\text{found}} |\\nu| / \\nu_\\infty", found.from_zero.tightness());
  }
}

}  // namespace veritrack::quadrature
