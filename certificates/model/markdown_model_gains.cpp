#include "certificates/model/markdown_model_gains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/model/gain/gain_attack.hpp"
#include "analysis/model/gain/linear_loop.hpp"
#include "analysis/model/gain/loop_detector.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/model/loop_stability.hpp"
#include "certificates/model/markdown_model_sets.hpp"
#include "certificates/model/model_lock.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/model/operation_words.hpp"
#include "certificates/model/rounding_lines.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/linear_loop_table.hpp"

namespace veritrack::certificates {

namespace {

using model::ProvedSet;
using rigor::Direction;
using rigor::to_decimal;

/// One line for each cause: what an engineer can improve.
std::string budget_table(const model::LoopBounds& bounds, const ModelAssumptions& assume,
                         const FrequencyUnits& units, double turned) {
  const model::ErrorBudget& budget = bounds.budget;
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& cause, double part) {
    if (part > 0.0) {
      rows.push_back({cause, units.at_most(part), fmt::format("{:.3g} %", 100.0 * part / bounds.long_run)});
    }
  };
  add(fmt::format("noise of at most {}{}", assume.noise.text,
                  turned > 0.0 ? fmt::format(", and {:.4f} rad of the arc tangent", turned) : ""),
      budget.noise);
  add(fmt::format("slew of at most {} {}", assume.slew.text,
                  assume.slew_in_hertz_per_second ? "Hz per second" : "rad/sample per sample"),
      budget.slew);
  add(budget.ripple > 0.0
          ? "curvature of the loop's functions, and what turns with the signal to second order"
          : "curvature of the loop's functions at these errors",
      budget.remainders);
  add("what turns with the signal, to first order", budget.ripple);
  add("rounding of the program", budget.rounding);
  add("bias of the steady state, and the rounding of the certificate", budget.steady_state);
  rows.push_back({"together", units.at_most(bounds.long_run), "100 %"});
  return "The frequency error in the long run, by cause (each at most; they are worst cases of the same "
         "sample):\n\n" +
         markdown::table({"Cause", "Frequency error", "Share"}, rows) + "\n";
}

/// "phi + omega - 0.5".
std::string steady_text(const model::SteadyValue& each) {
  std::string value = each.turns != 0 ? (each.turns == 1 ? "phi" : fmt::format("{} phi", each.turns)) : "";
  const auto add = [&](double number, const std::string& unit) {
    if (number != 0.0) {
      value += fmt::format("{}{:.6g}{}",
                           value.empty() ? (number < 0.0 ? "-" : "") : (number < 0.0 ? " - " : " + "),
                           std::fabs(number), unit);
    }
  };
  if (std::fabs(each.per_frequency) == 1.0) {
    value += each.per_frequency < 0.0 ? (value.empty() ? "-omega" : " - omega")
                                      : (value.empty() ? "omega" : " + omega");
  } else {
    add(each.per_frequency, " omega");
  }
  add(each.constant, "");
  return value.empty() ? "0" : value;
}

/// As a factor, with a space after it.
std::string factor_text(const std::string& value) {
  return value == "1" ? "" : value.find(' ') == std::string::npos ? value + " " : "(" + value + ") ";
}

std::string steady_state_table(const model::GainProof& proof, const Model& model) {
  std::vector<std::string> texts;
  for (const model::SteadyValue& each : proof.steady) {
    texts.push_back(steady_text(each));
  }
  std::string note;
  if (const auto vector = model::vector_of(proof.steady)) {
    const std::string angle = texts[vector->real];
    const std::string length = vector->has_length ? factor_text(texts[vector->imaginary]) : "R ";
    texts[vector->real] = length + "cos(" + angle + ")";
    texts[vector->imaginary] = length + "sin(" + angle + ")";
    note =
        vector->has_length
            ? fmt::format(
                  "\n`{0}` and `{1}` are the two parts of a vector that turns with the signal: their errors "
                  "are those of its "
                  "angle and of its length.\n",
                  model.states[vector->real], model.states[vector->imaginary])
            : fmt::format(
                  "\nR is any length above 0: of `{0}` and `{1}` the step takes the direction alone, so both "
                  "are one angle here. An error of their length is gone after a sample. To start in the "
                  "steady state, "
                  "or in it but for other states, they point in this direction. A start with both at 0 has "
                  "no "
                  "direction, and is not covered.\n",
                  model.states[vector->real], model.states[vector->imaginary]);
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    rows.push_back({"`" + model.states[i] + "`", "`" + texts[i] + "`"});
  }
  return "The steady state after a sample at the phase phi, at the frequency omega in rad/sample (all digits "
         "are "
         "in `certificate.json`):\n\n" +
         markdown::table({"State", "Is"}, rows) + note + "\n";
}

/// The changes that would make an unstable loop stable.
std::string stability_text(const Certificate& certificate, const model::GainProof& proof) {
  std::string text =
      "The steady state below is unstable: errors about it grow, however small they are at first. No stable "
      "one was "
      "found from `start`, half a turn further, or by simulation.\n\n";
  std::vector<std::vector<std::string>> rows;
  for (const StabilityLimit& limit :
       stability_limits(model_tables(certificate.design), model::vector_of(proof.steady))) {
    rows.push_back({"`" + limit.parameter + "`", fmt::format("{:.6g}", limit.value),
                    fmt::format("{} {:.4g}",
                                limit.stable == StabilityLimit::Stable::below   ? "below"
                                : limit.stable == StabilityLimit::Stable::above ? "above"
                                                                                : "with the other sign, at",
                                limit.limit)});
  }
  if (!rows.empty()) {
    text += "*Computed, not proved:* one parameter alone would make it stable, the others as they are:\n\n" +
            markdown::table({"Parameter", "Is", "Stable"}, rows) + "\n";
  }
  return text;
}

/// The share of the bound in the long run that a simulation reaches.
std::string attack_text(const ModelSets& sets, const Model& model, const ModelAssumptions& assume,
                        const FrequencyUnits& units) {
  const model::GainProof& proof = *sets.gains;
  const rigor::Interval band = band_of(assume);
  const double noise = assume.noise.value.lower();
  const double slew = slew_of(assume).lower();
  if (!(noise > 0.0 || slew > 0.0) || !proof.gains || !proof.assumed) {
    return "";
  }
  constexpr std::size_t kMostSamples = 200'000;
  const double reached = model::attack_loop(proposed_tone(model, assume), proof.steady, rigor::midpoint(band),
                                            noise, slew, std::min(proof.gains->samples(), kMostSamples));
  return fmt::format(
      "*Simulated, not proved:* the noise and slew that add up most to first order reach a frequency error "
      "of "
      "{:.3g} rad/sample{}: {:.2f} of the certified bound in the long run.\n\n",
      reached, units.has_hertz() ? fmt::format(" ({:.3g} Hz)", units.drawn(reached)) : "",
      reached / proof.assumed->long_run);
}

/// The clamps that act where noise is a little more than what is proved to be tolerated.
std::string clamp_text(const ModelSets& sets, const Model& model, const ModelAssumptions& assume) {
  constexpr double kMore = 1.02;
  const model::GainProof& proof = *sets.gains;
  const std::vector<std::string> clamps = clamps_of(model);
  if (!proof.gains || clamps.empty()) {
    return "";
  }
  const rigor::UpwardRounding upward;
  const double tolerated = sets.noise && sets.noise->is_proved() ? sets.noise->tubes.noise : 0.0;
  const double beyond = std::max(kMore * tolerated, proof.assumed ? 0.0 : assume.noise.value.upper());
  if (proof.gains->acts("a clamp", tolerated) || !proof.gains->acts("a clamp", beyond)) {
    return "";
  }
  return fmt::format(
      "More noise makes a clamp act: {}{}. To first order, errors reach its limits there, and the bounds "
      "close beyond them only if what the clamp takes away comes back smaller: not for a clamp on the whole "
      "phase error of a loop with an integrator (`docs/gain-proof.md`, section 2). Wider limits help, if "
      "those of your program are wider.\n\n",
      clamps.size() == 1 ? "" : "one of ", markdown::escaped(fmt::format("{}", fmt::join(clamps, ", "))));
}

/// Why the most that is tolerated is less than what is assumed and proved.
std::string without_lock(const ModelSets& sets) {
  const std::optional<ProvedSet>& set = sets.assumed;
  return set && set->is_proved() && !names_lock(set->frequency_error, set->half_distance)
             ? fmt::format(
                   "A set is proved for the assumed noise and slew, but no sentence says that the tracker "
                   "tolerates them. {} (`docs/model-proof.md`, section 18).\n\n",
                   lock_objection(set->frequency_error, set->half_distance))
             : std::string();
}

}  // namespace

std::string gain_limits_table(const ProvedSet* noise, const ProvedSet* slew, const ProvedSet& starts,
                              const FrequencyUnits& units) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& what, const std::string& limit, const ProvedSet& set) {
    rows.push_back({what, limit, units.at_most(set.frequency_error)});
  };
  if (noise != nullptr && noise->is_proved() && noise->tubes.noise > 0.0) {
    add("noise, at a constant frequency",
        to_decimal(noise->tubes.noise, 4, Direction::down) + " signal units", *noise);
  }
  if (slew != nullptr && slew->is_proved() && slew->tubes.slew > 0.0) {
    add("slew, without noise", units.slew(slew->tubes.slew), *slew);
  }
  if (starts.reach > 0.0) {
    add("frequency error at the start, without noise", units.at_least(starts.reach), starts);
  }
  return rows.empty()
             ? ""
             : "The most of each that is proved to be tolerated alone:\n\n" +
                   markdown::table({"Disturbance", "At most", "Frequency error for ever, at most"}, rows) +
                   "\n";
}

std::string model_gains_section(const Certificate& certificate, const Model& model,
                                const MarkdownOptions& options) {
  const ModelAssumptions& assume = model_tables(certificate.design).assume;
  const ModelSets& sets = model_sets(certificate);
  const model::GainProof& proof = *sets.gains;
  const FrequencyUnits units(assume.sample_rate);
  const bool is_average = proof.gains && proof.gains->network().has_ripples;
  std::string text = fmt::format(
      "## The errors of this loop\n\n{}: with angles measured from the phase of the signal it has one steady "
      "state, "
      "and its errors obey a linear recursion up to remainders that are bounded in closed form. Each bound "
      "is the sum "
      "of the worst that every earlier sample can contribute.\n\n",
      is_average ? "On the average the loop does not depend on the phase of its signal, and what turns with "
                   "the signal "
                   "is known"
                 : "The loop does not depend on the phase at which its signal begins");
  if (!proof.gains) {
    text += stability_text(certificate, proof);
  } else if (proof.assumed) {
    text += budget_table(*proof.assumed, assume, units, proof.rounding ? proof.rounding->turned : 0.0);
    text += rounding_line_text(model_tables(certificate.design), proof, units);
    text += attack_text(sets, model, assume, units);
  } else if (!sets.assumed->is_proved()) {
    text +=
        "For the assumed noise and slew no bound was proved: the errors may leave the range in which the "
        "loop's functions are nearly linear.\n\n";
  }
  text += gain_limits_table(sets.noise ? &*sets.noise : nullptr, sets.slew ? &*sets.slew : nullptr,
                            sets.starts, units);
  text += clamp_text(sets, model, assume);
  text += without_lock(sets);
  if (proof.gains) {
    text +=
        linear_loop_table(model::linear_loop(proof.gains->network()), proof.gains->samples(),
                          model::detector_of(proof.gains->network(), proof.steady).loop, assume.sample_rate) +
        model_picture(options, "response.svg");
  }
  return text + steady_state_table(proof, model);
}

std::string gains_coverage_section(const ModelTables& tables, bool is_rounded,
                                   std::string_view steady_state) {
  return fmt::format(
      "## What this certificate covers, and what it does not\n\n"
      "- Covered: {}, for every noise within the assumed bound, every phase and every frequency that a "
      "statement names.\n"
      "- Not covered: {}.\n"
      "- The amplitude {}, and the signal has no other components. Everything else in the samples must fit "
      "into "
      "the noise.\n"
      "- *The steady state of the certificate* is the {} above: the state in which the loop stays without "
      "noise, up to rounding and to what turns with the signal. *A certified invariant set* is the set of "
      "all states that the loop can reach "
      "from "
      "there, or from the starts that a statement names.\n"
      "- UNDECIDED refutes nothing.\n"
      "- The proof is in `docs/gain-proof.md` of the program's sources. Every bound was computed with "
      "outward "
      "rounding. Simulations are marked as not proved, and no verdict depends on them.\n\n",
      is_rounded ? tables.model.compiled ? "the listing above in the program's arithmetic"
                                         : "the recursion above in its arithmetic"
                 : "the recursion above in exact arithmetic",
      is_rounded ? "the quantisation of samples, and interrupts that change a state between two operations"
                 : "the rounding of the program that runs, quantised samples, and whatever the formulas do "
                   "not say, such as resets, lock detectors and limits that act",
      tables.assume.one_amplitude ? "is exactly the assumed one"
      : tables.assume.constant_amplitude
          ? "is constant and some number of the assumed range"
          : "of every sample is in the assumed range and may be another one at each "
            "sample",
      steady_state);
}

}  // namespace veritrack::certificates
