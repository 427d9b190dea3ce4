#include "certificates/model/model_promise.hpp"

#include <algorithm>
#include <string_view>

#include "analysis/rigor/decimal.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

namespace {

/// Why a promise could not be used.
std::string objection_to_use(const ModelAssumptions& assume) {
  if (assume.gaussian) {
    return "its noise is Gaussian, so that no bound on its frequency error is valid for ever";
  }
  if (assume.frequency_in_hertz || assume.slew_in_hertz_per_second) {
    return "its frequencies are in Hz; allowed for a model here: rad/sample";
  }
  if (!assume.one_amplitude) {
    return "its amplitude is a range; allowed for a model here: one amplitude";
  }
  return assume.signal.empty() ? "" : "its [assume] signal is not the tone alone";
}

}  // namespace

FrequencyPromise model_frequency_promise(const Certificate& certificate) {
  const ModelTables& tables = model_tables(certificate.design);
  FrequencyPromise promise;
  promise.amplitude = tables.assume.amplitude[0];
  promise.frequency = tables.assume.frequency;
  promise.noise = tables.assume.noise;
  promise.slew = tables.assume.slew;
  promise.two_channels = tables.model.samples.size() == 2;
  promise.objection = objection_to_use(tables.assume);
  if (!promise.objection.empty()) {
    return promise;
  }
  const auto claim = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [](const Claim& one) { return one.id == "model/guarantee"; });
  const auto value = [&](std::string_view name) -> std::optional<rigor::Interval> {
    const auto found = std::find_if(claim->values.begin(), claim->values.end(),
                                    [&](const auto& one) { return one.first == name; });
    return found != claim->values.end() ? std::optional(rigor::parse_decimal(found->second)) : std::nullopt;
  };
  if (claim == certificate.claims.end() || claim->verdict != rigor::Verdict::proved) {
    promise.objection = "its guarantee is not proved";
  } else if (value("from")) {
    promise.objection = "its guarantee is for a part of the band";
  } else {
    promise.sentence = claim->statement;
    promise.for_ever = value("frequency_error");
    promise.ultimate = value("settled_frequency_error");
  }
  return promise;
}

}  // namespace veritrack::certificates
