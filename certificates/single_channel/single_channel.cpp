#include "certificates/single_channel/single_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "analysis/sets/fixed_point_bias.hpp"
#include "analysis/single_channel/frozen_observer.hpp"
#include "analysis/single_channel/invariant_curve.hpp"
#include "analysis/single_channel/phase_certificate.hpp"
#include "analysis/single_channel/propositions.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/contraction.hpp"
#include "certificates/sets/guarantee_sentence.hpp"
#include "certificates/sets/required_claims.hpp"
#include "certificates/sets/statement_claim.hpp"
#include "certificates/single_channel/phase_words.hpp"
#include "certificates/single_channel/recursion_part.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;
using single_channel::SteadyStateBias;

/// The bias of the quadrature tracker with the same design values, for comparison; empty when it is not
/// verified at that frequency.
Interval quadrature_bias(const sets::LockBranch& branch, const Interval& frequency) {
  for (const auto& cell : branch.cells) {
    const sets::SteadyStateError error = sets::steady_state_error(cell);
    if (rigor::is_subset(frequency, error.frequency)) {
      return error.frequency_error;
    }
  }
  return Interval::empty();
}

/// The frequencies around one, rad/sample, over which the bias is also enclosed.
constexpr double kBiasHalfWidth = 0.002;

/// The bias over the frequencies around that of `bias`, when there is one; without a leak it is also zero
/// there.
SteadyStateBias bias_around(const trackers::ToneModel<Interval>& design, const SteadyStateBias& bias) {
  constexpr std::size_t kMostCells = 128;  // more would take too long
  SteadyStateBias around;
  around.reason = bias.reason;
  if (bias.verdict == Verdict::proved) {
    const rigor::UpwardRounding upward;
    const Interval interval = Interval(midpoint(bias.frequency)) + rigor::symmetric(kBiasHalfWidth);
    if (!design.without_leak()) {
      around = single_channel::steady_state_bias(design, interval, kMostCells);
    } else if (single_channel::settles_exactly(design, bias.frequency + rigor::symmetric(kBiasHalfWidth))) {
      around = bias;
    } else {
      around.reason = "not all frequencies around it are between 0 and pi";
    }
  }
  return around;
}

theorems::Derivation bias_derivation(const SteadyStateBias& bias, const SteadyStateBias& around,
                                     std::string id, const Interval& quadrature) {
  const std::string source = "this program: invariant curve over the phase";
  theorems::Derivation derivation;
  derivation.id = std::move(id);
  derivation.title = "Steady-state frequency error on a noise-free tone";
  const auto add = [&](const char* name, const char* symbol, const char* formula, const Interval& value) {
    theorems::add_quantity(derivation, {name, symbol, formula, source}, value, bias.reason + ".");
  };
  add("frequency", "\\omega", "", bias.frequency);
  add("mean_bias", "\\bar\\nu", "\\frac1\\pi \\int_0^\\pi \\nu_*(\\varphi)\\,d\\varphi", bias.mean_bias);
  add("min_error", "\\min_\\varphi \\nu_*", "", bias.min_error);
  add("max_error", "\\max_\\varphi \\nu_*", "", bias.max_error);
  const auto add_around = [&](const char* name, const Interval& value) {
    theorems::add_quantity(derivation, {name, "", "", source}, value, around.reason + ".");
  };
  add_around("mean_bias_around", around.mean_bias);
  add_around("min_error_around", around.min_error);
  add_around("max_error_around", around.max_error);
  if (bias.verdict == Verdict::proved && bias.rate) {
    add("contraction_rate", "\\kappa", "", Interval::from_bounds(0.0, *bias.rate));
  }
  theorems::add_quantity(derivation,
                         {"quadrature_bias", "\\nu_*", "",
                          "this program: lock branch of the quadrature tracker, same q1, q2, r, \u03b5"},
                         quadrature, "It is not verified at this frequency.");
  theorems::Condition condition;
  condition.id = "invariant-curve";
  condition.statement = "X_*(\\varphi + \\omega) = G_\\varphi(X_*(\\varphi))";
  condition.verdict = bias.verdict;
  condition.reason = bias.reason + ".";
  derivation.conditions.push_back(condition);
  theorems::conclude(derivation);
  return derivation;
}

/// The P(0|0) for which the sentences are true. A sentence that is not proved names none in particular.
std::string start_covariance_words(const std::optional<single_channel::PhaseSet>& set) {
  if (!set) {
    return "";
  }
  const single_channel::DiagonalStart& start = set->start.value();
  return fmt::format("and with P(0|0) from {} M to {} M, M = [{}, 0, 0; 0, {}, 0; 0, 0, {}]", start.from,
                     start.to, start.signal, start.signal, start.frequency);
}

/// Frequency-only process noise without a leak: no exponentially stable steady state, with the witness.
Claim stability_claim(const Interval& r) {
  Claim claim;
  claim.id = "single-channel/exponentially-stable-steady-state";
  claim.statement = "The tracker has an exponentially stable steady state on a noise-free tone.";
  claim.verdict = rigor::certainly_positive(r) ? Verdict::refuted : Verdict::undecided;
  claim.reason =
      "The amplitude is an uncontrollable mode on the unit circle. In the frame of the signal F has the rows "
      "(1, 0, 0), (0, 1, 1), (0, 0, 1), and w = (1, 0, 0) has w F = w and w Q w' = 0. Each sample adds at "
      "most 1/r to the information on the amplitude, so that with r > 0 its variance falls no faster than "
      "1/k.";
  return claim;
}

/// A frequency of the design file; for one in Hz the double nearest to it, in rad/sample.
BiasFrequency bias_frequency(const Number& number) {
  if (!number.in_hertz) {
    return {number.text, number.value};
  }
  const std::string text = fmt::format("{}", number.nearest);
  return {text, rigor::parse_decimal(text)};
}

trackers::ToneModel<Interval> design_at_unit_amplitude(const SingleChannelEkfTables& tables) {
  return trackers::at_unit_amplitude(enclosed_values(tables.design), tables.assume.amplitude.value);
}

bool has_steady_state(const trackers::ToneModel<Interval>& design) {
  return !(design.q1 == Interval(0.0)) || !design.without_leak();
}

SteadyStateBias steady_state_at(const trackers::ToneModel<Interval>& design, const BiasFrequency& frequency) {
  if (has_steady_state(design)) {
    return single_channel::steady_state_bias(design, frequency.value);
  }
  SteadyStateBias none;
  none.frequency = frequency.value;
  none.reason = "there is no exponentially stable steady state, see the claims";
  return none;
}

/// The propositions of the paper; `at` is the steady state of the design at that frequency.
void add_propositions(Certificate& certificate, const trackers::ToneModel<Interval>& design,
                      const BiasFrequency& frequency, const SteadyStateBias& at) {
  trackers::ToneModel<Interval> without_leak = design;
  without_leak.epsilon = Interval(0.0);
  const SteadyStateBias exact =
      design.without_leak() ? at : single_channel::steady_state_bias(without_leak, frequency.value);
  const auto add_all = [&](const std::vector<theorems::Statement>& statements) {
    std::transform(statements.begin(), statements.end(), std::back_inserter(certificate.claims), to_claim);
  };
  add_all(single_channel::proposition_1_formulas());
  add_all(single_channel::proposition_1_conclusion(at, exact, design.epsilon, frequency.text));
  add_all(single_channel::proposition_2());
}

/// The biases at the frequencies; the middle one is returned.
SteadyStateBias add_biases(Certificate& certificate, const trackers::ToneModel<Interval>& design,
                           const std::vector<BiasFrequency>& frequencies, const Interval& band) {
  const sets::LockBranch quadrature = sets::verify_lock_branch(design, band);
  const std::size_t middle = frequencies.size() / 2;
  SteadyStateBias at_middle;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const SteadyStateBias bias = steady_state_at(design, frequencies[i]);
    if (i == middle) {
      at_middle = bias;
    }
    certificate.derivations.push_back(
        bias_derivation(bias, bias_around(design, bias),
                        i == middle ? "single-channel-bias" : "single-channel-bias/" + frequencies[i].text,
                        quadrature_bias(quadrature, frequencies[i].value)));
  }
  return at_middle;
}

}  // namespace

std::vector<BiasFrequency> bias_frequencies(const Assumptions& assume) {
  const rigor::UpwardRounding upward;
  const auto& [low, high] = assume.frequency;
  if (rigor::identical(low.value, high.value)) {
    return {bias_frequency(low)};
  }
  constexpr int kCount = 9;  // odd: the middle is one of them
  std::vector<BiasFrequency> frequencies;
  frequencies.reserve(kCount);
  frequencies.push_back(bias_frequency(low));
  for (int i = 1; i + 1 < kCount; ++i) {
    const double part = static_cast<double>(i) / (kCount - 1);
    const std::string text = fmt::format("{:.6f}", low.nearest + part * (high.nearest - low.nearest));
    frequencies.push_back({text.substr(0, text.find_last_not_of('0') + 1), rigor::parse_decimal(text)});
  }
  frequencies.push_back(bias_frequency(high));
  return frequencies;
}

trackers::ToneModel<Interval> enclosed_values(const SingleChannelDesignTable& design) {
  using ProcessNoise = SingleChannelDesignTable::ProcessNoise;
  const Interval r = design.lambda ? design.lambda->value : design.r->value;
  if (design.process_noise == ProcessNoise::diagonal) {
    return {(*design.variances)[0].value, (*design.variances)[1].value, r, design.epsilon.value};
  }
  const Interval q = design.q ? design.q->value : Interval(1.0);
  const bool identity = design.process_noise == ProcessNoise::identity;
  return {identity ? q : Interval(0.0), q, r, design.epsilon.value};
}

trackers::ToneModel<double> nearest_values(const SingleChannelDesignTable& design) {
  using ProcessNoise = SingleChannelDesignTable::ProcessNoise;
  const double r = design.lambda ? design.lambda->nearest : design.r->nearest;
  if (design.process_noise == ProcessNoise::diagonal) {
    return {(*design.variances)[0].nearest, (*design.variances)[1].nearest, r, design.epsilon.nearest};
  }
  const double q = design.q ? design.q->nearest : 1.0;
  const bool identity = design.process_noise == ProcessNoise::identity;
  return {identity ? q : 0.0, q, r, design.epsilon.nearest};
}

void single_channel_published_results(Certificate& certificate) {
  const SingleChannelEkfTables& tables = single_channel_tables(certificate.design);
  const trackers::ToneModel<Interval> design = design_at_unit_amplitude(tables);
  const std::vector<BiasFrequency> frequencies = bias_frequencies(tables.assume);
  const BiasFrequency& middle = frequencies[frequencies.size() / 2];
  add_propositions(certificate, design, middle, steady_state_at(design, middle));
}

void certify_single_channel(Certificate& certificate, const CertifyProgress& progress) {
  const SingleChannelEkfTables& tables = single_channel_tables(certificate.design);
  const bool only_verdicts = certificate.extent == Extent::verdicts || certificate.extent == Extent::quick;
  const trackers::ToneModel<Interval> design = design_at_unit_amplitude(tables);
  const std::vector<BiasFrequency> frequencies = bias_frequencies(tables.assume);
  const std::size_t middle = frequencies.size() / 2;

  if (!has_steady_state(design)) {
    certificate.claims.push_back(stability_claim(design.r));
  }
  const Interval band = rigor::hull(tables.assume.frequency[0].value, tables.assume.frequency[1].value);
  SteadyStateBias at_middle;
  if (!only_verdicts) {
    certificate.simulation = simulate_single_channel(tables);
    at_middle = add_biases(certificate, design, frequencies, band);
  }
  single_channel::PhaseQuestion question{contraction_question(design, tables.assume, tables.require), band};
  if (only_verdicts) {
    question.tracker.with_limits =
        tables.require.largest_noise_at_least || tables.require.largest_slew_at_least;
  }
  if (only_verdicts && question.tracker.required.any() && !question.tracker.with_limits &&
      !tables.require.frequency_error_radius_at_least) {
    question.tracker.effort =
        certificate.extent == Extent::quick ? sets::SearchEffort::quick : sets::SearchEffort::sufficient;
  }
  single_channel::PhaseCertificate contraction = single_channel::certify_over_phases(question);
  add_words(contraction);
  certificate.derivations.push_back(std::move(contraction.derivation));
  certificate.contraction = std::move(contraction.result);
  const std::string covariance = start_covariance_words(contraction.bound_set);
  if (!only_verdicts) {
    certificate.derivations.push_back(single_channel::transfer_function(single_channel::mean_gain(
        trackers::at_unit_amplitude(nearest_values(tables.design), tables.assume.amplitude.nearest),
        midpoint(frequencies[middle].value))));
    add_propositions(certificate, design, frequencies[middle], at_middle);
  }
  const GuaranteeTerms terms{tables.assume, tables.require, true, false, covariance, kDoublePrecision};
  add_required_claims(certificate, terms);
  certificate.claims.push_back(guarantee_claim(certificate, terms));
  for (Claim& claim : set_claims(certificate, terms)) {
    certificate.claims.push_back(std::move(claim));
  }
  add_recursion(certificate, progress);
}

}  // namespace veritrack::certificates
