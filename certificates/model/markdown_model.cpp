#include "certificates/model/markdown_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/code_language.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/model/markdown_model_code.hpp"
#include "certificates/model/markdown_model_gains.hpp"
#include "certificates/model/markdown_model_lock.hpp"
#include "certificates/model/markdown_model_phases.hpp"
#include "certificates/model/markdown_model_sets.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/model/recursion_text.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

using markdown::escaped;

std::string quoted(const std::string& text) {
  return "`" + text + "`";
}

/// "`y1`, `y2`": names or formulas of the design file.
std::string listed(const std::vector<SourceText>& texts) {
  std::string list;
  for (const SourceText& text : texts) {
    list += (list.empty() ? "" : ", ") + quoted(text.text);
  }
  return list;
}

std::string equations(const std::vector<NamedText>& texts) {
  std::string list;
  for (const NamedText& text : texts) {
    list += (list.empty() ? "" : ", ") + quoted(text.name.text + " = " + text.formula.text);
  }
  return list;
}

/// The states, each with its unit; the entries of a covariance are only counted.
std::string states_of(const ModelTable& table, std::size_t states) {
  const std::vector<SourceText>& named = table.ekf ? table.ekf->states : table.states;
  std::string list;
  for (const SourceText& state : named) {
    const auto unit = std::find_if(table.units.begin(), table.units.end(),
                                   [&](const NamedText& entry) { return entry.name.text == state.text; });
    list += (list.empty() ? "" : ", ") + quoted(state.text) +
            (unit != table.units.end() ? fmt::format(" ({})", escaped(unit->formula.text)) : "");
  }
  if (states > named.size()) {
    list += fmt::format(", and the {} entries of the covariance's upper triangle", states - named.size());
  }
  return list;
}

std::string design_section(const Certificate& certificate, const ModelTables& tables, const Model& model) {
  const Design& design = certificate.design;
  const auto& [table, assume, require] = tables;
  const std::string text =
      fmt::format("## The design and what is assumed\n\n{}The tracker is a recursion {} (`{}`).\n\n",
                  markdown::quotation(design.name, design.source),
                  table.compiled ? "made of functions of C or C++" : "of the design file", design.tracker);
  std::vector<std::vector<std::string>> rows{
      {table.samples.size() == 1 ? "sample" : "samples, in phase and in quadrature", listed(table.samples),
       "signal units"},
      {"signal without noise, `A` its amplitude, `phi` its phase", listed(signal_of(table, assume.signal)),
       "signal units"},
      {fmt::format("states, {}", model.states.size()), states_of(table, model.states.size()),
       table.units.empty() ? "—" : "in parentheses, as you named them"}};
  if (!table.angles.empty()) {
    rows.push_back({"states that are angles: known up to whole turns only", listed(table.angles), "rad"});
  }
  if (!table.parameters.empty()) {
    rows.push_back({"parameters", equations(table.parameters), "—"});
  }
  rows.push_back({"estimated frequency", quoted(table.frequency.text), "rad/sample"});
  const auto& [least, largest] = assume.amplitude;
  rows.push_back(
      assume.one_amplitude
          ? std::vector<std::string>{"amplitude of the signal, constant", quoted(least.text), "signal units"}
      : assume.constant_amplitude
          ? std::vector<std::string>{"amplitude of the signal, constant, some number within",
                                     fmt::format("[`{}`, `{}`]", least.text, largest.text), "signal units"}
          : std::vector<std::string>{"amplitude of the signal, of each sample, within",
                                     fmt::format("[`{}`, `{}`]", least.text, largest.text), "signal units"});
  const FrequencyUnits units(assume.sample_rate);
  const std::string band = fmt::format("[`{}`, `{}`]", assume.frequency[0].text, assume.frequency[1].text);
  if (units.has_hertz()) {
    rows.push_back({"samples per second", quoted(assume.sample_rate.value().text), "Hz"});
  }
  rows.push_back(
      {"frequency of the signal, always within", band, assume.frequency_in_hertz ? "Hz" : "rad/sample"});
  if (units.has_hertz()) {
    const rigor::Interval radians = band_of(assume);
    rows.push_back({"the same, rounded outward",
                    assume.frequency_in_hertz ? outward(radians) : outward(units.in_hertz(radians)),
                    assume.frequency_in_hertz ? "rad/sample" : "Hz"});
  }
  const bool is_one = table.samples.size() == 1;
  if (assume.gaussian) {
    const GaussianNoise& noise = *assume.gaussian;
    rows.push_back(
        noise.snr_db
            ? std::vector<std::string>{"Gaussian noise: its signal-to-noise ratio A^2/(2 sigma^2), at "
                                       "least",
                                       quoted(noise.snr_db->text), "dB"}
            : std::vector<std::string>{"Gaussian noise: its deviation in each channel, at most",
                                       quoted(noise.deviation->text), "signal units"});
    rows.push_back(
        {"successive samples for which lock is to be kept", quoted(assume.samples.value().text), "samples"});
  } else {
    rows.push_back(
        {is_one ? "noise of each sample, at most" : "noise of each pair of samples, its length, at most",
         quoted(assume.noise.text), "signal units"});
  }
  const bool moves = assume.slew.value.upper() > 0.0;
  rows.push_back({"change of the frequency, at most",
                  moves ? quoted(assume.slew.text) : "none: it is constant",
                  !moves                            ? "—"
                  : assume.slew_in_hertz_per_second ? "Hz per second"
                                                    : "rad/sample per sample"});
  rows.push_back({"deviation of the starts from the steady state, at most",
                  !assume.start_within.empty()    ? equations(assume.start_within)
                  : model_sets(certificate).gains ? "none, where a statement names no other"
                                                  : "any that is inside the certified set",
                  assume.start_within.empty() ? "—" : "of the state"});
  if (!assume.start_exactly.empty()) {
    rows.push_back(
        {"the start, at any phase of the signal", equations(assume.start_exactly), "of the state"});
  }
  return text + markdown::table({"What", "Is", "Unit"}, rows) + "\n";
}

std::string recursion_section(const Model& model) {
  return "## The recursion\n\nThe certificate concerns this recursion. `veritrack show` prints it as C, "
         "Python "
         "or "
         "Octave, too, for comparison with the program that you run.\n\n" +
         markdown::fenced(recursion_text(model, "the recursion", CodeLanguage::formulas), "") + "\n";
}

std::string coverage_section(const ModelTables& tables, bool bounds_covariance) {
  const bool moves = tables.assume.slew.value.upper() > 0.0;
  const bool is_gaussian = tables.assume.gaussian.has_value();
  return fmt::format(
      "## What this certificate covers, and what it does not\n\n"
      "- Covered: the recursion above in exact arithmetic, for {}, every "
      "phase and every frequency that a statement names.\n"
      "- Not covered: the rounding of the program that runs, quantised samples, and whatever the formulas do "
      "not say, such as resets, lock detectors and limits that act.\n"
      "- The amplitude {}, and the signal has no other components than those of the "
      "signal formula. Everything else in the samples must {}.\n"
      "- The frequency {}. A mean is the mean over the phase of the signal.\n"
      "- The certified sets are the tubes in `certificate.json`. \"Started in the set\" refers to them by "
      "name: `starts`, for large starts without noise, or `assumed`, for the assumed noise and slew{}. How "
      "the tracker gets there from another start is not covered{}.{}\n"
      "- UNDECIDED refutes nothing: another set may exist.\n"
      "- The proof is in `docs/model-proof.md` of the program's sources. Every bound was computed with "
      "outward rounding. Simulations are marked as not proved, and no verdict depends on them.\n\n",
      is_gaussian ? "the noise that a statement names" : "every noise within the assumed bound",
      tables.assume.one_amplitude ? "is exactly the assumed one"
      : tables.assume.constant_amplitude
          ? "is constant and some number of the assumed range, which is cut into parts (a set has tubes for "
            "each part: started in the set is started in those of the part in which the amplitude is)"
          : "of every sample is in the assumed range and may be another one "
            "at each sample",
      is_gaussian ? "be noise of that kind" : "fit into the noise",
      moves
          ? "stays in the band and changes by no more than assumed, or is constant where a statement says so"
          : "is constant",
      is_gaussian ? "; `gaussian` and `lowest-snr`, for Gaussian noise" : "",
      tables.assume.start_exactly.empty() ? ""
                                          : ", but for the start of the design, where a statement says so",
      bounds_covariance
          ? " \"A covariance between the bounds of a set\": the set has a lower and an upper bound, in the "
            "order of "
            "symmetric matrices, of the filter's covariance after the sample at each phase of the signal; "
            "the "
            "covariance at the start is one of these, and every later one is then" +
                std::string(is_gaussian ? ", in Gaussian noise until lock is lost." : ".")
          : "");
}

}  // namespace

std::vector<const Claim*> model_answers(const Certificate& certificate) {
  std::vector<const Claim*> found;
  for (const Claim& claim : certificate.claims) {
    if (!claim.required && claim.verdict != rigor::Verdict::undecided) {
      found.push_back(&claim);
    }
  }
  return found;
}

std::string model_remarks(const Certificate& certificate) {
  return model_answers(certificate).empty() ? "Nothing was proved for the band, nor for a part of it. The "
                                              "reasons are under \"The certified sets\".\n\n"
                                            : "";
}

std::string model_sections(const Certificate& certificate, const MarkdownOptions& options) {
  const rigor::UpwardRounding upward;
  const ModelTables& tables = model_tables(certificate.design);
  const Model model = make_model(tables.model, tables.assume.signal);
  const ModelSets& sets = model_sets(certificate);
  if (const auto& gains = sets.gains) {
    const bool is_rounded = gains->rounding.has_value();
    return design_section(certificate, tables, model) +
           model_code_section(tables, is_rounded, sets.no_rounding) +
           model_gains_section(certificate, model, options) + recursion_section(model) +
           gains_coverage_section(tables, is_rounded, "table");
  }
  const auto& phases = sets.phases;
  if (phases && !phases->room.empty()) {
    return design_section(certificate, tables, model) + model_code_section(tables, true, "") +
           model_phases_section(certificate) +
           "Sets by tubes were not searched for: they are for exact arithmetic.\n\n" +
           recursion_section(model) + gains_coverage_section(tables, true, "curve");
  }
  return design_section(certificate, tables, model) + model_code_section(tables, false, sets.no_rounding) +
         model_lock_section(certificate) + (phases ? model_phases_section(certificate) : std::string()) +
         (sets.averages ? model_averages_section(certificate) : std::string()) +
         model_sets_section(certificate, model, options) + model_bias_section(certificate, options) +
         recursion_section(model) + coverage_section(tables, sets.bounds_covariance);
}

}  // namespace veritrack::certificates
