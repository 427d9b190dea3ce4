#include "certificates/single_channel/markdown_single_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/single_channel/recursion_part.hpp"
#include "certificates/single_channel/single_channel.hpp"
#include "certificates/single_channel/single_channel_design.hpp"

namespace veritrack::certificates {

namespace {

using markdown::enclosure;
using markdown::math;
using rigor::Interval;
using rigor::Verdict;
using theorems::Derivation;

/// The bias in the middle of the band.
Derivation middle_bias(const Certificate& certificate) {
  return *std::find_if(certificate.derivations.begin(), certificate.derivations.end(),
                       [](const Derivation& one) { return one.id == "single-channel-bias"; });
}

Interval value_of(const Derivation& derivation, const char* name) {
  return find_quantity(derivation, name).value;
}

/// The frequency of a bias, as the decimal that it is.
std::string frequency_text(const Certificate& certificate, const Derivation& bias) {
  const Interval value = value_of(bias, "frequency");
  const std::vector<BiasFrequency> all = bias_frequencies(single_channel_tables(certificate.design).assume);
  return std::find_if(all.begin(), all.end(),
                      [&](const BiasFrequency& one) { return rigor::identical(one.value, value); })
      ->text;
}

/// By frequency.
std::vector<Derivation> biases(const Certificate& certificate) {
  std::vector<Derivation> found = derivations_of(certificate, "single-channel-bias");
  std::stable_sort(found.begin(), found.end(), [](const Derivation& a, const Derivation& b) {
    return value_of(a, "frequency").lower() < value_of(b, "frequency").lower();
  });
  return found;
}

std::string bias_sentence(const Certificate& certificate, const Derivation& bias) {
  const std::string frequency = frequency_text(certificate, bias);
  if (bias.verdict != Verdict::proved) {
    return fmt::format(
        "The steady-state frequency error on a noise-free tone of {} rad/sample is not enclosed: {}",
        frequency, bias.conditions.front().reason);
  }
  if (value_of(bias, "min_error") == Interval(0.0) && value_of(bias, "max_error") == Interval(0.0)) {
    return fmt::format(
        "In exact arithmetic, on a noise-free tone of {} rad/sample, the steady-state frequency error is "
        "exactly zero.",
        frequency);
  }
  return fmt::format(
      "In exact arithmetic, on a noise-free tone of {} rad/sample, the steady-state frequency error has "
      "the mean {} "
      "rad/sample; it varies with the phase between the minimum {} and the maximum {} rad/sample.",
      frequency, enclosure(value_of(bias, "mean_bias"), 6), enclosure(value_of(bias, "min_error"), 4),
      enclosure(value_of(bias, "max_error"), 4));
}

/// The bias of the quadrature tracker of the same design values.
std::string quadrature_cell(const Derivation& bias) {
  const theorems::Quantity& quantity = find_quantity(bias, "quadrature_bias");
  return quantity.not_applicable ? "not verified" : enclosure(quantity.value, 4);
}

std::string process_noise_words(const SingleChannelDesignTable& design) {
  switch (design.process_noise) {
    case SingleChannelDesignTable::ProcessNoise::frequency_only:
      return math("Q = q\\,\\mathrm{diag}(0, 0, 1)") + ", as the paper prints it";
    case SingleChannelDesignTable::ProcessNoise::identity:
      return math("Q = q\\,\\mathrm{diag}(1, 1, 1)");
    case SingleChannelDesignTable::ProcessNoise::diagonal:
      break;
  }
  return math("Q = \\mathrm{diag}(q_1, q_1, q_2)");
}

/// How near the bound of the long run is, and what brings it nearer.
std::string first_order_comparison(const Certificate& certificate, double first_order) {
  const double bound = proved_long_run(certificate)->upper();
  const double times = bound / first_order;
  if (!(first_order > 0.0) || !std::isfinite(times)) {
    return "";
  }
  const FrequencyUnits units(single_channel_tables(certificate.design).assume.sample_rate);
  std::string text = fmt::format(
      "*Computed, not proved:* to first order in the errors, the assumed noise and slew bring the frequency "
      "error in the long run to about {:.3g} rad/sample{} at worst (5 frequencies of the band, 48 phases). "
      "The "
      "certified bound is {:.1f} times as large.",
      first_order, units.has_hertz() ? fmt::format(" ({:.3g} Hz)", units.drawn(first_order)) : "", times);
  constexpr double kNear = 2.0;
  if (times > kNear && recursion_part(certificate).can_be_asked) {
    text +=
        " A tighter one, in exact arithmetic, is in the certificate of the same filter as a recursion: "
        "require `largest_noise_at_least`, a little more than is proved here. It takes half a minute for a "
        "narrow band, and minutes for a wide one.";
  }
  return text + "\n\n";
}

}  // namespace

std::string single_channel_remarks(const Certificate& certificate) {
  std::string text;
  if (!biases(certificate).empty()) {  // where only verdicts are requested, no bias is searched for
    text = "- " + bias_sentence(certificate, middle_bias(certificate)) + "\n";
  }
  for (const Claim& claim : certificate.claims) {
    if (claim.id == "single-channel/exponentially-stable-steady-state") {
      text +=
          fmt::format("- {} True: {}. {}\n", claim.statement, markdown::answer(claim.verdict), claim.reason);
    }
  }
  int statements = 0;
  int proved = 0;
  int undecided = 0;
  std::string refuted;
  for (const Claim& claim : certificate.claims) {
    if (claim.id.starts_with("proposition-")) {
      ++statements;
      proved += claim.verdict == Verdict::proved ? 1 : 0;
      undecided += claim.verdict == Verdict::undecided ? 1 : 0;
      if (claim.verdict == Verdict::refuted) {
        refuted += fmt::format("{}`{}`", refuted.empty() ? "" : ", ", claim.id);
      }
    }
  }
  if (statements == 0) {
    return text.empty() ? "" : text + "\n";
  }
  return text + fmt::format(
                    "- Statements on the paper's Propositions 1 and 2: {} true, {} undecided; false: {} (see "
                    "`published-theorems.md`).\n\n",
                    proved, undecided, refuted.empty() ? "none" : refuted);
}

std::string recursion_section(const Certificate& certificate) {
  const RecursionPart& part = recursion_part(certificate);
  const std::optional<Certificate>& recursion = part.certificate;
  const std::string& objection = part.objection;
  std::string comparison =
      part.first_order_error ? first_order_comparison(certificate, *part.first_order_error) : "";
  if (!recursion && objection.empty()) {
    return comparison;
  }
  const std::string heading = comparison + "## The same filter as a recursion\n\n";
  if (!recursion) {
    return heading + objection + "\n\n";
  }
  return heading +
         "This section is the certificate of this filter as a design of the tracker `model`, in exact "
         "arithmetic "
         "and at a constant frequency. Without a leak its sets are ellipsoids of the estimate alone, with "
         "the "
         "covariance between two matrices: the estimate after a sample is affine in the covariance, and the "
         "covariance is monotone. With a leak the covariance is among the states.\n\n" +
         markdown::with_lower_headings(kind_of(recursion->design).sections(*recursion, {}));
}

std::string single_channel_design_section(const Certificate& certificate) {
  const SingleChannelDesignTable& chosen = single_channel_tables(certificate.design).design;
  std::string text = "## The design\n\n";
  text += fmt::format("{}The tracker is `{}`.\n\n",
                      markdown::quotation(certificate.design.name, certificate.design.source),
                      certificate.design.tracker);
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const char* what, const char* symbol, const std::optional<Number>& number,
                       const char* unit) {
    if (number) {
      rows.push_back({what, math(symbol), "`" + number->text + "`", unit});
    }
  };
  rows.push_back({"process noise covariance", "", process_noise_words(chosen), ""});
  add("process noise variance", "q", chosen.q, "signal units² and (rad/sample)²");
  if (chosen.variances) {
    add("process noise variance, in-phase and quadrature", "q_1", (*chosen.variances)[0], "signal units²");
    add("process noise variance, frequency", "q_2", (*chosen.variances)[1], "(rad/sample)²");
  }
  add("measurement noise variance", "r", chosen.r, "signal units²");
  add("ratio of the variances, with q = 1", "\\lambda = r/q", chosen.lambda, "—");
  add("leak of the frequency state", "\\epsilon", chosen.epsilon, "—");
  return text + markdown::table({"Design value", "Symbol", "Value", "Unit"}, rows) + "\n";
}

std::string bias_section(const Certificate& certificate) {
  const std::vector<Derivation> found = biases(certificate);
  if (found.empty()) {
    return "";
  }
  std::string text = "## The bias\n\n";
  text +=
      "In exact arithmetic, on a noise-free tone of constant frequency, the tracker settles on a periodic "
      "function of the signal's "
      "phase. Its frequency error there (estimate minus true frequency, rad/sample) is enclosed by an "
      "invariant curve that is verified in interval arithmetic. Every start near the curve converges to it, "
      "by the factor per sample in the last column. The mean is over the phase, and also over time unless "
      "the frequency is a rational multiple of $`\\pi`$. The column beside it encloses the means at all "
      "frequencies within 0.002 rad/sample.\n\n";
  std::vector<std::vector<std::string>> rows;
  for (const Derivation& bias : found) {
    const bool proved = bias.verdict == Verdict::proved;
    const auto cell = [&](const char* name, int digits) {
      return proved ? enclosure(value_of(bias, name), digits) : std::string("—");
    };
    const theorems::Quantity& around = find_quantity(bias, "mean_bias_around");
    rows.push_back({frequency_text(certificate, bias), cell("mean_bias", 6), cell("min_error", 4),
                    cell("max_error", 4), around.not_applicable ? "not verified" : enclosure(around.value, 4),
                    markdown::answer(bias.verdict), quadrature_cell(bias),
                    theorems::applicable_quantity(bias, "contraction_rate") != nullptr
                        ? cell("contraction_rate", 3)
                        : bias.conditions.front().reason});
  }
  return text +
         markdown::table({"Frequency, rad/sample", "Mean bias", "Smallest error", "Largest error",
                          "Mean bias within 0.002 rad/sample of it", "Enclosed", "Quadrature tracker",
                          "Rate, or why there is none"},
                         rows) +
         "\n";
}

std::string transfer_function_section(const Certificate& certificate) {
  const std::vector<Derivation> found = derivations_of(certificate, "single-channel/transfer-function");
  if (found.empty()) {
    return "";
  }
  const Derivation& derivation = found.front();
  return "## The frozen filter\n\n" + derivation.title + ": conditions " +
         markdown::satisfied(derivation.verdict) + ".\n\n" + markdown::quantities_table(derivation) + "\n" +
         markdown::conditions_table(derivation) + "\n" + markdown::notes_list(derivation) + "\n";
}

std::string proposition_section(const Certificate& certificate) {
  std::vector<std::vector<std::string>> rows;
  for (const Claim& claim : certificate.claims) {
    if (claim.id.starts_with("proposition-")) {
      rows.push_back({"`" + claim.id + "`", claim.statement, markdown::answer(claim.verdict), claim.reason});
    }
  }
  if (rows.empty()) {
    return "";
  }
  return "## What was found about the paper\n\nS. Bittanti and S. M. Savaresi, *On the Parameterization and "
         "Design of an Extended Kalman Filter Frequency Tracker*, IEEE Trans. Automatic Control 45(9), "
         "2000.\n\n" +
         markdown::table({"Claim", "Statement", "True", "Ground"}, rows) + "\n";
}

std::string single_channel_coverage_section() {
  return "## What this certificate covers, and what it does not\n\n- Covered: every enclosure was computed "
         "with outward-rounded interval arithmetic from the design values; the true value lies in it.\n- The "
         "contraction certificate is valid at every phase, for every frequency that stays in "
         "the band, and for any noise and any change of frequency within the bounds, with any statistics. It "
         "covers a tracker without a leak, started with the steady-state covariance, and a signal of "
         "constant amplitude.\n- Results proved by the structure of the filter cover the tracker with a "
         "leak, too, "
         "at a constant frequency and in exact arithmetic, started in the sets that are named.\n- The bias "
         "is that of the steady state which the tracker reaches from the "
         "exact estimate, on a tone without noise at the frequencies of the table, and around them where the "
         "table says so. Elsewhere it is not enclosed.\n- The contraction certificate covers the tracker as "
         "it "
         "runs in double precision: IEEE 754, rounding to nearest, sine and cosine of the C library within 1 "
         "ulp, without -ffast-math. The rounding error of a step is bounded and added to noise and slew "
         "(docs/rounding.md). The bias, the frozen filter and the statements on the paper's propositions are "
         "about exact arithmetic.\n- The figures of the run show one simulation "
         "in double precision and prove nothing.\n\n";
}

}  // namespace veritrack::certificates
