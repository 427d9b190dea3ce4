#include "certificates/quadrature/lowest_snr.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "analysis/quadrature/contraction/set_search.hpp"
#include "analysis/quadrature/falsifier/drift_attack.hpp"
#include "analysis/quadrature/falsifier/sampled_text.hpp"
#include "analysis/quadrature/gaussian/lowest_snr.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/lock.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;

constexpr const char* kSource = "docs/gaussian.md";

/// The assumptions with this signal-to-noise ratio, in decimals, in place of theirs.
Assumptions with_snr(Assumptions assume, const std::string& decibels) {
  assume.gaussian = noise_of_snr(decibels);
  return assume;
}

trackers::ToneModel<double> nearest_design_of(const QuadratureEkfTables& tables) {
  const rigor::NearestRounding nearest;
  return nearest_at_unit_amplitude(tables);
}

/// The ratio at which the noise bound of the contraction certificate is exceeded rarely enough: N exp(-V^2/(2
/// sigma^2)) = p.
std::optional<double> union_bound_decibels(const quadrature::LockQuestion& question) {
  sets::ContractionQuestion bounded;
  bounded.design = question.design;
  const std::optional<quadrature::Verification> found =
      quadrature::find_set(bounded, quadrature::Objective::noise);
  if (!found || found->verdict != rigor::Verdict::proved || !(found->set.noise > 0.0)) {
    return std::nullopt;
  }
  const double exponent = std::log(question.samples.upper() / question.probability);
  return 10.0 * std::log10(exponent / (found->set.noise * found->set.noise));
}

void add_comparison_by_simulation(Certificate& certificate, const quadrature::LockQuestion& question,
                                  theorems::Derivation& derivation) {
  QuadratureParticulars& particulars = quadrature_particulars(certificate);
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  {
    const auto& walk = tables.assume.frequency_walk;
    particulars.lock_loss =
        quadrature::simulate_lock_loss(nearest_design_of(tables), walk ? walk->nearest : 0.0);
  }
  if (particulars.lock_loss->law) {
    const double rate = question.probability / question.samples.upper();
    quadrature::add_sampled(
        derivation,
        {"simulated_lowest_snr",
         "signal-to-noise ratio at which the simulated rate of losing lock is that probability a sample, "
         "extrapolated with log rate linear in 1/sigma^2, dB"},
        {"", "", kSource}, particulars.lock_loss->law->decibels_of(rate));
  }
  if (question.frequency_walk == Interval(0.0)) {
    particulars.union_bound_snr = union_bound_decibels(question);
  }
  if (const auto& decibels = particulars.union_bound_snr) {
    quadrature::add_sampled(
        derivation,
        {"union_bound_snr",
         "signal-to-noise ratio at which the largest noise of the certificate for bounded noise is exceeded "
         "within the samples with that probability at most, dB"},
        {"", "10\\log_{10}(\\log(N/p)/V^2)", kSource}, *decibels);
  }
}

}  // namespace

void add_lowest_snr(Certificate& certificate, const quadrature::LockQuestion& question,
                    const quadrature::LockCertificate& found, const GuaranteeTerms& terms) {
  if (!quadrature_tables(certificate.design).design.without_leak()) {
    return;
  }
  quadrature::LockQuestion asked = question;
  if (!found.sets.empty()) {
    // The same starts as those of the guarantee.
    asked.starts.covariance.multiples = found.covariance_multiples;
    asked.starts.covariance.is_given = true;
  }
  quadrature::LowestSnr lowest = quadrature::certify_lowest_snr(asked, found.proposal);
  QuadratureParticulars& particulars = quadrature_particulars(certificate);
  particulars.lowest_snr_set = lowest.set;
  if (lowest.set) {
    add_start_covariance(particulars.start_covariance, lowest.covariance_multiples, lowest.derivation);
    const quadrature::DriftAttack attack =
        quadrature::attack_drift(*lowest.set, nearest_design_of(quadrature_tables(certificate.design)));
    quadrature::add_sampled(
        lowest.derivation,
        {"drift_excess",
         "largest excess of the drift that ascent found in the set; above 0 would be an alarm"},
        {"", "\\log E[W(k+1)] - \\log(\\kappa W(k) + c_0)", kSource}, attack.closest);
  }
  add_comparison_by_simulation(certificate, question, lowest.derivation);
  if (const auto* decibels = theorems::applicable_quantity(lowest.derivation, "lowest_snr")) {
    constexpr int kDigits = 4;
    const Assumptions assume = with_snr(terms.assume, rigor::upper_decimal(decibels->value, kDigits));
    const GuaranteeTerms at_lowest{
        assume,
        terms.require,
        terms.in_band,
        terms.two_channels,
        covariance_words(particulars.start_covariance, lowest.covariance_multiples),
        terms.arithmetic};
    Claim claim = lock_guarantee(lowest.derivation, at_lowest);
    claim.id = "ekf/lowest-snr";
    claim.reason =
        "The same for more noise, or less, than is assumed: a set for the lowest signal-to-noise ratio at "
        "which the search, in steps of 0.25 dB, found one that can be proved in a minute.";
    claim.evidence.push_back(*decibels);
    certificate.claims.push_back(std::move(claim));
  }
  certificate.derivations.push_back(std::move(lowest.derivation));
}

std::string lowest_snr_section(const Certificate& certificate) {
  const theorems::Derivation* derivation = find_derivation(certificate, "lowest-snr");
  if (derivation == nullptr) {
    return {};
  }
  return fmt::format(
             "## The lowest signal-to-noise ratio, conditions {}\n\n{}. The simulated ratio and that of the "
             "union "
             "bound are for comparison, and prove nothing.\n\n",
             markdown::satisfied(derivation->verdict), derivation->title) +
         markdown::conditions_table(*derivation) + "\n" + markdown::quantities_table(*derivation) + "\n";
}

}  // namespace veritrack::certificates
