#include "certificates/quadrature/quadrature_tuning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/gaussian/lock_certificate.hpp"
#include "analysis/quadrature/gaussian/lock_rounding.hpp"
#include "analysis/quadrature/gaussian/mean_square_search.hpp"
#include "analysis/quadrature/leak/steady_certificate.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/lock.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/gaussian_noise.hpp"
#include "certificates/tuning/tuned_file.hpp"
#include "certificates/tuning/value_search.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::array<std::string_view, 8> kObjectives{"long-run", "for-ever", "radius",     "noise",
                                                      "slew",     "rms",      "lowest-snr", "simulated-rms"};

void put(const DesignValues& values, QuadratureEkfTables& tables) {
  tables.design = {number_of(values.q1), number_of(values.q2), number_of(values.r),
                   number_of(values.epsilon)};
}

/// Noise with a bound: certified.
CertifiedValues certified_with_bound(const Design& design, const std::set<Objective>& needed) {
  const rigor::UpwardRounding upward;
  const QuadratureEkfTables& tables = quadrature_tables(design);
  sets::ContractionQuestion question = contraction_question(design);
  question.with_samples = false;
  question.with_limits = needed.contains(Objective::noise) || needed.contains(Objective::slew);
  if (tables.design.without_leak()) {
    return values_of(quadrature::certify_contraction(question).result, tables.require);
  }
  const auto& band = tables.assume.frequency;
  return values_of(
      quadrature::certify_with_leak({question, rigor::hull(band[0].value, band[1].value)}).result,
      tables.require);
}

/// Gaussian noise: estimated from proposals, which start from the last good one.
class LockEstimate {
 public:
  CertifiedValues operator()(const Design& design, const std::set<Objective>& needed) {
    CertifiedValues found;
    const rigor::UpwardRounding upward;
    const quadrature::LockQuestion question = lock_question(quadrature_tables(design));
    const bool leaks = !(question.design.epsilon == rigor::Interval(0.0));
    const bool walks = !(question.frequency_walk == rigor::Interval(0.0));
    if (!quadrature::is_well_posed(question) || (leaks && walks)) {
      return found;
    }
    const auto at_assumed = proposed(question, question.noise_deviation.upper());
    if (!at_assumed) {
      return found;
    }
    found.lock_margin = at_assumed->margin;
    if (needed.contains(Objective::lowest_snr)) {
      found.lowest_snr = lowest_snr(question, at_assumed->margin);
    }
    if (needed.contains(Objective::rms) && at_assumed->margin > 0.0) {
      // The amount that is added before a proof is tried (mean_square_certificate.cpp).
      constexpr double kRoom = 1.08;
      if (const auto form = quadrature::propose_mean_square(quadrature::proposal_request(question).design,
                                                            at_assumed->set)) {
        found.rms = std::sqrt(kRoom * form->bound);
      }
    }
    return found;
  }

 private:
  std::optional<quadrature::LockProposal> proposed(const quadrature::LockQuestion& question,
                                                   double deviation) {
    quadrature::LockQuestion asked = question;
    asked.noise_deviation = rigor::Interval(deviation);
    quadrature::LockRequest request = quadrature::proposal_request(asked);
    const bool leaks = request.design.epsilon != 0.0;
    std::optional<quadrature::LockShape>& near = leaks ? near_with_leak_ : near_;
    request.near = near;
    auto found = quadrature::propose_lock_set(request);
    // The bias grows with the frequency: where one set is not enough for the band, its upper half decides.
    constexpr int kMostHalvings = 3;
    for (int k = 0; leaks && k < kMostHalvings && found && !(found->margin >= kEnoughMargin); ++k) {
      request.lowest_frequency = 0.5 * (request.lowest_frequency + request.highest_frequency);
      found = quadrature::propose_lock_set(request);
    }
    if (found && !quadrature::lock_rounding(asked.design, asked.signal, found->set, asked.samples).has_room) {
      found->margin = -1.0;  // not a proof either
    }
    constexpr double kGood = 0.02;
    if (found && found->margin > kGood) {
      near = found->shape;
    }
    return found;
  }

  /// The change of the margin with the ratio differs little between designs: followed until it is
  /// `kEnoughMargin`.
  double lowest_snr(const quadrature::LockQuestion& question, double margin) {
    constexpr double kMarginPerDecibel = 0.1;
    constexpr double kLongest = 6.0;  // dB
    constexpr int kSteps = 3;
    const double assumed = -10.0 * std::log10(2.0 * std::pow(question.noise_deviation.upper(), 2));
    double decibels = assumed;
    double step = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      step = std::clamp((kEnoughMargin - margin) / kMarginPerDecibel, -kLongest, kLongest);
      decibels += step;
      constexpr double kClose = 0.2;
      if (std::fabs(step) < kClose) {
        break;
      }
      const auto found = proposed(question, std::sqrt(0.5 * std::pow(10.0, -0.1 * decibels)));
      margin = found ? found->margin : -1.0;
    }
    // A failure at the last ratio examined counts as that ratio, and a little more.
    return decibels + std::clamp((kEnoughMargin - margin) / kMarginPerDecibel, -kLongest, kLongest);
  }

  std::optional<quadrature::LockShape> near_;
  std::optional<quadrature::LockShape> near_with_leak_;
};

}  // namespace

std::span<const std::string_view> quadrature_tuning_objectives() {
  return kObjectives;
}

TuningResult tune_quadrature(const Design& design, const TuningRequest& request) {
  const QuadratureEkfTables& tables = quadrature_tables(design);
  const QuadratureDesignTable& table = tables.design;
  const Objective objective = chosen_objective(request.objective, tables.assume);
  const bool is_open = !table.without_leak() && !request.free_leak && frequency_walks(tables.assume);
  if (is_open && asks_for_proofs(objective, tables.require)) {
    return {
        std::nullopt,
        "With a leak and a frequency that walks nothing is certified in Gaussian noise. --free-leak lets the "
        "leak become 0; without a walk the probability and the mean square are certified; without [require], "
        "--objective simulated-rms compares simulations."};
  }
  const auto estimate = std::make_shared<LockEstimate>();
  TuningResult result = tuned<QuadratureEkfTables>(
      design, request,
      {{table.q1.text, table.q2.text, table.r.text, table.epsilon.text},
       put,
       [estimate](const Design& changed, const std::set<Objective>& needed) {
         return quadrature_tables(changed).assume.gaussian ? (*estimate)(changed, needed)
                                                           : certified_with_bound(changed, needed);
       },
       [](const DesignValues& values) {
         return std::vector<DesignEdit>{
             {"q1", values.q1}, {"q2", values.q2}, {"r", values.r}, {"epsilon", values.epsilon}};
       }});
  if (objective == Objective::lowest_snr && !table.without_leak() && !request.free_leak) {
    result.notes.emplace_back(
        "With a leak a certificate is about the assumed ratio only, and the lowest is an estimate: write it "
        "into [assume] and certify, to have it proved.");
  }
  return result;
}

}  // namespace veritrack::certificates
