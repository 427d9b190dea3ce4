#include "certificates/model/model_json.hpp"

#include <cmath>
#include <utility>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/assumptions_json.hpp"

namespace veritrack::certificates {

namespace {

using model::ProvedSet;

Json texts_json(const std::vector<SourceText>& texts) {
  Json list = Json::array();
  for (const SourceText& text : texts) {
    list.push_back(text.text);
  }
  return list;
}

Json named_json(const std::vector<NamedText>& texts) {
  Json list = Json::array();
  for (const NamedText& text : texts) {
    list.push_back({{"name", text.name.text}, {"formula", text.formula.text}});
  }
  return list;
}

Json matrix_json(const std::vector<std::vector<SourceText>>& rows) {
  Json matrix = Json::array();
  for (const std::vector<SourceText>& row : rows) {
    matrix.push_back(texts_json(row));
  }
  return matrix;
}

Json filter_json(const ModelEkfTable& filter) {
  Json json{{"states", texts_json(filter.states)},
            {"predict", filter.predict.text},
            {"measure", texts_json(filter.measure)},
            {"Q", matrix_json(filter.process_noise)},
            {"R", matrix_json(filter.measurement_noise)}};
  if (!filter.jacobian.empty()) {
    json["jacobian"] = matrix_json(filter.jacobian);
  }
  return json;
}

Json series_json(const model::PhaseSeries& series) {
  Json harmonics = Json::array();
  for (const auto& powers : series.coefficients) {
    Json list = Json::array();
    for (const std::complex<double>& coefficient : powers) {
      list.push_back({rigor::to_hexadecimal(coefficient.real()), rigor::to_hexadecimal(coefficient.imag())});
    }
    harmonics.push_back(list);
  }
  return harmonics;
}

Json hexadecimals(const std::vector<double>& numbers) {
  Json list = Json::array();
  for (const double number : numbers) {
    list.push_back(rigor::to_hexadecimal(number));
  }
  return list;
}

Json set_json(const model::TubeSet& set) {
  Json json{{"name", set.name}, {"cells", Json::array()}};
  for (const model::AmplitudePart& part : set.amplitudes) {
    json["amplitude"] = hexadecimals({part.low, part.high});
  }
  if (set.gaussian) {
    const model::GaussianTerms& terms = *set.gaussian;
    json["gaussian"] = {{"deviation", rigor::to_hexadecimal(terms.deviation)},
                        {"most_noise", rigor::to_hexadecimal(terms.most_noise)},
                        {"exponent", rigor::to_hexadecimal(terms.exponent)},
                        {"factor", rigor::to_hexadecimal(terms.factor)},
                        {"constant", rigor::to_hexadecimal(terms.constant)}};
  } else {
    json["slew"] = rigor::to_hexadecimal(set.slew);
    json["noise"] = rigor::to_hexadecimal(set.noise);
  }
  if (set.slew > 0.0) {
    json["crossing"] = hexadecimals(set.crossing);
    if (set.covariance_margin > 0.0) {
      json["margin"] = rigor::to_hexadecimal(set.covariance_margin);
    }
  }
  for (const model::ProvedTube& proved : set.tubes) {
    json["cells"].push_back(tube_json(proved));
  }
  return json;
}

}  // namespace

Json tube_json(const model::ProvedTube& proved) {
  const model::Tube& tube = proved.tube;
  Json json{{"frequency", rigor::to_hexadecimal(tube.frequency)},
            {"half_width", rigor::to_hexadecimal(tube.half_width)},
            {"levels", hexadecimals(proved.levels)},
            {"turns", tube.turns},
            {"curve", Json::array()},
            {"shape", Json::array()},
            {"phases", proved.grid.phases},
            {"frequencies", proved.grid.frequencies}};
  if (!proved.shrinking.empty()) {
    json["shrinking"] = hexadecimals(proved.shrinking);
  }
  for (const model::PhaseSeries& series : tube.curve) {
    json["curve"].push_back(series_json(series));
  }
  for (const model::PhaseSeries& series : tube.shape) {
    json["shape"].push_back(series_json(series));
  }
  if (proved.entry) {
    json["entry"] = {{"margin", rigor::to_hexadecimal(proved.entry->margin)},
                     {"ratio", rigor::to_hexadecimal(proved.entry->ratio)}};
  }
  if (tube.bounds_covariance()) {
    for (const auto& [name, bound] : {std::pair("covariance_low", &tube.covariance_low),
                                      std::pair("covariance_high", &tube.covariance_high)}) {
      json[name] = Json::array();
      for (const model::PhaseSeries& series : *bound) {
        json[name].push_back(series_json(series));
      }
    }
  }
  return json;
}

namespace {

/// The listing is what is verified; files and compiler say where it comes from.
Json code_json(const code::CodeTable& code, const code::CompiledCode& compiled) {
  Json files = Json::array();
  Json included = Json::array();
  for (const code::CodeFile& file : compiled.files) {
    (file.is_included ? included : files).push_back({{"name", file.name}, {"sha256", file.sha256}});
  }
  Json json{{"files", files},
            {"included", included},
            {"flags", texts_json(code.flags)},
            {"compiler", compiled.compiler},
            {"listing", compiled.listing_text}};
  if (const auto& arc = compiled.arc_tangent) {
    json["arc_tangent"] = {{"register", fmt::format("r{}", number_in_text(compiled.listing, arc->value))},
                           {"error", fmt::format("{:.4f}", arc->error)},
                           {"largest", fmt::format("{:.4f}", arc->largest)}};
  }
  return json;
}

}  // namespace

Json model_design_json(const Design& design) {
  const auto& [model, assume, require] = model_tables(design);
  Json amplitude = number_json(assume.amplitude[0]);
  if (!assume.one_amplitude) {
    amplitude = Json::array({number_json(assume.amplitude[0]), number_json(assume.amplitude[1])});
    if (assume.constant_amplitude) {
      amplitude = Json{{"constant", amplitude}};
    }
  }
  Json assumed{{"amplitude", amplitude},
               {"frequency", {number_json(assume.frequency[0]), number_json(assume.frequency[1])}},
               {"frequency_in_hertz", assume.frequency_in_hertz},
               {"slew", number_json(assume.slew)},
               {"slew_in_hertz_per_second", assume.slew_in_hertz_per_second}};
  assumed["noise"] = noise_json(assume.noise, assume.gaussian);
  add_number(assumed, "samples", assume.samples);
  add_number(assumed, "sample_rate", assume.sample_rate);
  if (!assume.start_within.empty()) {
    assumed["start_within"] = named_json(assume.start_within);
  }
  if (!assume.start_exactly.empty()) {
    assumed["start_exactly"] = named_json(assume.start_exactly);
  }
  Json required = require_json(require.sets);
  add_number(required, "captured_within", require.captured_within);
  add_number(required, "bias_below", require.bias_below);
  add_number(required, "ripple_below", require.ripple_below);
  add_number(required, "damping_at_least", require.damping_at_least);
  add_number(required, "settles_like", require.settles_like);
  add_number(required, "noise_bandwidth_below", require.noise_bandwidth_below);
  add_number(required, "gain_margin_at_least", require.gain_margin_at_least);
  Json recursion{{"samples", texts_json(model.samples)},
                 {"parameters", named_json(model.parameters)},
                 {"angles", texts_json(model.angles)},
                 {"frequency", model.frequency.text},
                 {"signal", texts_json(signal_of(model, assume.signal))}};
  if (model.ekf) {
    recursion["ekf"] = filter_json(*model.ekf);
  } else {
    recursion["states"] = texts_json(model.states);
    recursion["step"] = model.step.text;
  }
  if (!model.arithmetic.text.empty()) {
    recursion["arithmetic"] = model.arithmetic.text;
  }
  Json tables{{"model", recursion}, {"assume", assumed}, {"require", required}};
  if (model.compiled) {
    tables["code"] = code_json(model.code, *model.compiled);
  }
  return tables;
}

namespace {

/// Of the states of a program that rounds; 0 of angles.
Json room_json(const std::vector<double>& room) {
  Json json = Json::array();
  for (const double each : room) {
    json.push_back(rigor::to_hexadecimal(std::isfinite(each) ? each : 0.0));
  }
  return json;
}

Json gains_json(const model::GainProof& proof) {
  Json steady = Json::array();
  for (const model::SteadyValue& each : proof.steady) {
    steady.push_back({{"turns", each.turns},
                      {"constant", rigor::to_hexadecimal(each.constant)},
                      {"per_frequency", rigor::to_hexadecimal(each.per_frequency)}});
    if (each.imaginary) {
      steady.back()["imaginary"] = *each.imaginary;
    }
  }
  Json json{{"steady_state", steady}};
  if (proof.gains) {
    json["horizon"] = proof.gains->samples();
    json["blocks"] = proof.gains->blocks();
    if (proof.gains->network().shares_noise) {
      json["one_noise"] = true;
    }
    if (proof.rounding) {
      json["rounding"] = room_json(proof.rounding->room);
    }
  }
  return json;
}

Json floquet_cell_json(const model::FloquetCell& cell, std::size_t parts) {
  Json json{{"frequency", rigor::to_hexadecimal(cell.curve.frequency)},
            {"half_width", rigor::to_hexadecimal(cell.curve.half_width)},
            {"parts", parts},
            {"turns", cell.curve.turns},
            {"curve", Json::array()},
            {"basis", Json::array()},
            {"matrix", Json::array()}};
  for (const model::PhaseSeries& series : cell.curve.curve) {
    json["curve"].push_back(series_json(series));
  }
  for (const model::PhaseSeries& series : cell.basis) {
    json["basis"].push_back(series_json(series));
  }
  for (const std::vector<double>& entry : cell.matrix) {
    json["matrix"].push_back(hexadecimals(entry));
  }
  return json;
}

Json phase_gains_json(const model::PhaseProof& proof) {
  Json json{{"phases", proof.gridding.phases}, {"horizon", proof.gridding.horizon}, {"cells", Json::array()}};
  if (proof.gridding.late_blocks > 0) {
    json["late"] = {{"blocks", proof.gridding.late_blocks}, {"turns", proof.gridding.late_turns}};
  }
  if (!proof.room.empty()) {
    json["rounding"] = room_json(proof.room);
  }
  for (const model::FloquetCell& each : proof.cells) {
    json["cells"].push_back(floquet_cell_json(each, proof.gridding.parts));
  }
  return json;
}

}  // namespace

Json model_evidence_json(const Certificate& certificate) {
  const ModelSets& sets = model_sets(certificate);
  if (sets.gains) {
    return {{"gains", gains_json(*sets.gains)}};
  }
  Json list = Json::array();
  const auto list_all = [&](const model::TubeSet& set) {
    for (const model::TubeSet& part : model::sets_of_amplitudes(set)) {
      list.push_back(set_json(part));
    }
  };
  const auto add = [&](const ProvedSet& set) {
    // A part of the set for the largest slew is not reported.
    if (set.is_proved() || (set.has_part() && set.tubes.name != "slew")) {
      list_all(set.tubes);
    }
  };
  add(sets.starts);
  for (const std::optional<ProvedSet>* set : {&sets.assumed, &sets.long_run, &sets.noise, &sets.slew}) {
    if (*set) {
      add(**set);
    }
  }
  for (const std::optional<ModelLock>* lock : {&sets.gaussian, &sets.lowest_snr}) {
    if (*lock && (*lock)->is_proved()) {
      list.push_back(set_json((*lock)->tubes));
    }
  }
  Json evidence{{"tubes", list}};
  if (sets.phases) {
    evidence["gains"] = phase_gains_json(*sets.phases);
  }
  if (sets.averages) {
    evidence["averages"] = gains_json(sets.averages->proof);
  }
  return evidence;
}

Json model_report_json(const Certificate& certificate) {
  const ModelSets& sets = model_sets(certificate);
  Json json = Json::object();
  if (!sets.linear) {
    return json;
  }
  json["linear_worst_case"] = {{"proved", false},
                               {"frequency", sets.linear->frequency},
                               {"undisturbed", sets.linear->undisturbed},
                               {"disturbed", sets.linear->disturbed}};
  const double bound = best_settled_error_of(sets);
  if (std::isfinite(bound) && sets.linear->disturbed > 0.0) {
    json["linear_worst_case"]["bound_over_it"] = bound / sets.linear->disturbed;
  }
  return json;
}

}  // namespace veritrack::certificates
