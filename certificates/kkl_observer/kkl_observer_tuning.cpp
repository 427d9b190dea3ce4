#include "certificates/document/tuning.hpp"

#include <fmt/format.h>

#include "analysis/kkl_observer/kkl_tuning.hpp"
#include "certificates/kkl_observer/kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"

namespace veritrack::certificates {

namespace {

/// A string of one line as TOML.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      result += '\\';
    }
    result += letter;
  }
  return result + "\"";
}

std::string disturbance_text(const std::optional<KklDisturbance>& disturbance) {
  if (!disturbance) {
    return "";
  }
  if (disturbance->bound) {
    return fmt::format("disturbance = {{ bound = {} }} # signal units\n", disturbance->bound->text);
  }
  return fmt::format("disturbance = {{ amplitude = {}, frequency = {} }} # signal units, rad/s\n",
                     disturbance->amplitude->text, disturbance->frequency->text);
}

std::string design_text(const Design& design, const Eigen::Vector4d& lambda) {
  const auto& [chosen, assume, require] = kkl_observer_tables(design);
  std::string text = fmt::format(
      "# Rates chosen by `veritrack tune`.\nname = {}\ntracker = \"kkl-observer\"\n", quoted(design.name));
  text += design.source.empty() ? "" : fmt::format("source = {}\n", quoted(design.source));
  text += fmt::format("\n[design]\nlambda = [{:.4g}, {:.4g}, {:.4g}, {:.4g}] # 1/s\n", lambda(0), lambda(1),
                      lambda(2), lambda(3));
  if (chosen.sampling_interval) {
    text += fmt::format("sampling_interval = {} # s\n", chosen.sampling_interval->text);
  }
  text += fmt::format("\n[assume]\nfrequency = [{}, {}] # rad/s\namplitude = [{}, {}] # signal units\n",
                      assume.frequency[0].text, assume.frequency[1].text, assume.amplitude[0].text,
                      assume.amplitude[1].text);
  text += disturbance_text(assume.disturbance) + "\n[require]\n";
  const auto add = [&text](const char* name, const std::optional<Number>& value) {
    if (value) {
      text += fmt::format("{} = {}\n", name, value->text);
    }
  };
  add("frequency_error_below", require.frequency_error_below);
  add("amplitude_error_below", require.amplitude_error_below);
  add("settles_within", require.settles_within);
  return text;
}

}  // namespace

TuningResult tune_kkl_observer(const Design& design, const TuningRequest& /*request*/) {
  const KklObserverTables& tables = kkl_observer_tables(design);
  if (tables.design.lambda.size() != 4) {
    return {std::nullopt, "Tuning needs the tracker kkl-observer with four filters."};
  }
  if (!tables.assume.disturbance) {
    return {std::nullopt,
            "Tuning needs a disturbance in [assume]: without one there is nothing to minimise."};
  }
  kkl_observer::KklTuningLimits limits;
  if (tables.require.settles_within) {
    limits.settling_time = tables.require.settles_within->nearest;
  }
  kkl_observer::KklRobustnessQuestion question;
  {
    const rigor::UpwardRounding upward;
    question = kkl_robustness_question(tables, rigor::Interval(0.0));
  }
  return {design_text(design, kkl_observer::propose_rates(question, limits)), ""};
}

}  // namespace veritrack::certificates
