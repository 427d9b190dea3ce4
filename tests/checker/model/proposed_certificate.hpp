// Evidence for the checker of models, proposed by the program and written as a certificate: for tests that
// change it.
#pragma once

#include <nlohmann/json.hpp>

#include <complex>
#include <cstdio>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/model/model.hpp"

namespace veritrack::test {

using Json = nlohmann::json;

inline std::string hexadecimal(double value) {
  constexpr std::size_t kSize = 64;
  std::array<char, kSize> text{};
  (void)std::snprintf(text.data(), text.size(), "%a", value);
  return text.data();
}
inline Json hexadecimals(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) {
    list.push_back(hexadecimal(value));
  }
  return list;
}

/// A number of a design.
inline Json decimal(const std::string& text, double low, double high) {
  return {{"text", text}, {"lo", hexadecimal(low)}, {"hi", hexadecimal(high)}};
}

inline Json series_json(const std::vector<model::PhaseSeries>& all) {
  Json list = Json::array();
  for (const model::PhaseSeries& series : all) {
    Json harmonics = Json::array();
    for (const auto& harmonic : series.coefficients) {
      Json powers = Json::array();
      for (const std::complex<double>& coefficient : harmonic) {
        powers.push_back(hexadecimals({coefficient.real(), coefficient.imag()}));
      }
      harmonics.push_back(powers);
    }
    list.push_back(harmonics);
  }
  return list;
}

/// A model of the folder designs/models.
struct ProposedModel {
  certificates::Design design;
  certificates::Model model;

  explicit ProposedModel(const std::string& name) : design(read(name)), model(made(design)) {}

  [[nodiscard]] Json design_json() const {
    const rigor::UpwardRounding upward;
    Json json = Json::parse(certificates::kind_of(design).design_json(design).dump());
    json["name"] = "a model";
    json["source"] = "";
    json["tracker"] = "model";
    if (!json.contains("require")) {
      json["require"] = Json::object();
    }
    return json;
  }

  /// A tube on a tone of amplitude 1.
  [[nodiscard]] model::Tube tube(double frequency, double half_width, model::ShapeObjective objective) const {
    const rigor::NearestRounding nearest;
    std::vector<double> constants;
    for (const certificates::language::Constant& constant : model.constants) {
      constants.push_back(constant.nearest);
    }
    model::TrackedTone tone{model::StepMap(model.recursion, constants), {}, 1.0, {}};
    tone.signal = model.samples.size() == 1 ? model::Signal{{{0.0, 1.0}}}
                                            : model::Signal{{{0.0, 1.0}, {0.0, {0.0, -1.0}}}};
    tone.start = [this, constants](double omega) {
      std::vector<double> inputs = constants;
      inputs.insert(inputs.end(), {1.0, omega});
      std::vector<double> registers;
      std::vector<double> state(model.states.size());
      model.start.run(std::span<const double>(inputs), registers, std::span(state));
      return state;
    };
    model::TubeSettings settings;
    settings.shape.objective = objective;
    settings.largest_curve_error = 1e-7;
    const model::TubeProposal proposal = model::propose_tube(tone, frequency, half_width, settings);
    if (!proposal.tube) {
      throw std::runtime_error("no tube: " + model::reason_of(proposal));
    }
    return *proposal.tube;
  }

  static Json cell(const model::Tube& tube, const std::vector<double>& levels,
                   const std::vector<double>& shrinking) {
    return {{"frequency", hexadecimal(tube.frequency)},
            {"half_width", hexadecimal(tube.half_width)},
            {"levels", hexadecimals(levels)},
            {"shrinking", hexadecimals(shrinking)},
            {"turns", tube.turns},
            {"curve", series_json(tube.curve)},
            {"shape", series_json(tube.shape)},
            {"phases", 64},
            {"frequencies", 1}};
  }
  static Json set(const std::string& name, double noise, const Json& cells) {
    return {{"name", name}, {"slew", "0x0p+0"}, {"noise", hexadecimal(noise)}, {"cells", cells}};
  }

 private:
  static certificates::Design read(const std::string& name) {
    const rigor::UpwardRounding upward;
    return certificates::read_design_file(std::string(VERITRACK_SOURCE_DIR "/designs/models/") + name);
  }
  static certificates::Model made(const certificates::Design& design) {
    const rigor::UpwardRounding upward;
    const certificates::ModelTables& tables = certificates::model_tables(design);
    return certificates::make_model(tables.model, tables.assume.signal);
  }
};

/// A claim that says something in values.
inline Json told_claim(const std::string& id, const Json& values, bool required = false) {
  Json claim{{"id", id}, {"verdict", "proved"}, {"required", required}, {"evidence", Json::object()}};
  claim.update(values);
  return claim;
}

/// A phase-locked loop over 0.28 to 0.32 rad/sample, without noise unless a test says otherwise.
inline const Json& loop_certificate() {
  static const Json certificate = [] {
    const ProposedModel loop("type-2-pll.toml");
    const model::Tube starts = loop.tube(0.3, 0.021, model::ShapeObjective::largest_starts);
    const model::Tube noise = loop.tube(0.3, 0.021, model::ShapeObjective::largest_noise);
    Json design = loop.design_json();
    design["assume"]["frequency"] = {decimal("0.28125", 0.28125, 0.28125), decimal("0.3125", 0.3125, 0.3125)};
    design["assume"]["noise"] = decimal("0", 0.0, 0.0);
    Json json{{"schema", "veritrack/certificate/2"},
              {"design_sha256", std::string(64, 'a')},
              {"design", design},
              {"derivations", Json::array()},
              {"verdict", "nothing-required"}};
    json["tubes"] = {
        ProposedModel::set(
            "starts", 0.0,
            Json::array({ProposedModel::cell(starts, {0.012, 0.006, 0.0005, 5e-5}, {0.9998, 0.998, 0.996})})),
        ProposedModel::set("noise", 0.04, Json::array({ProposedModel::cell(noise, {0.0045}, {1.0})}))};
    json["claims"] = {
        told_claim("model/guarantee", {{"frequency_error", "0.014"}, {"settled_frequency_error", "0.0012"}}),
        told_claim("model/limits", {{"noise", "0.039"},
                                    {"frequency_error", "0.01"},
                                    {"reach", "0.0095"},
                                    {"reach_frequency_error", "0.014"}}),
        told_claim("model/steady-state",
                   {{"bias_low", "-0.0001"}, {"bias_high", "0.0001"}, {"ripple", "0.0023"}})};
    return json;
  }();
  return certificate;
}

}  // namespace veritrack::test
