#include "python/engine/claims_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/verdict.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::python {

namespace {

const char* name_of(theorems::Sense sense) {
  switch (sense) {
    case theorems::Sense::equal:
      return "equal";
    case theorems::Sense::at_most:
      return "at most";
    case theorems::Sense::at_least:
      return "at least";
    case theorems::Sense::sampled:
      return "sampled";
    case theorems::Sense::enclosure:
      break;
  }
  return "enclosure";
}

/// All but those that do not exist for this design.
Json quantities_json(const std::vector<theorems::Quantity>& quantities) {
  Json json = Json::object();
  for (const theorems::Quantity& quantity : quantities) {
    if (!quantity.applies() || rigor::is_empty(quantity.value)) {
      continue;
    }
    json[quantity.name] = {{"lo", rigor::to_hexadecimal(quantity.value.lower())},
                           {"hi", rigor::to_hexadecimal(quantity.value.upper())},
                           {"sense", name_of(quantity.sense)},
                           {"words", quantity.words},
                           {"symbol", quantity.symbol}};
  }
  return json;
}

/// The meaning of a number that a claim has as a decimal.
struct ValueText {
  std::string_view name;
  theorems::Sense sense;
  const char* words;
};

constexpr std::array kValues = {
    ValueText{"frequency_error", theorems::Sense::at_most, "frequency error at every sample, rad/sample"},
    ValueText{"settled_frequency_error", theorems::Sense::at_most,
              "frequency error in the long run, rad/sample"},
    ValueText{"noise", theorems::Sense::at_least, "tolerated noise at a constant frequency, signal units"},
    ValueText{"reach", theorems::Sense::at_least,
              "frequency errors that a certified set contains at every phase, rad/sample"},
    ValueText{"bias_low", theorems::Sense::at_least,
              "mean frequency error in the long run without noise, rad/sample"},
    ValueText{"bias_high", theorems::Sense::at_most,
              "mean frequency error in the long run without noise, rad/sample"},
    ValueText{"ripple", theorems::Sense::at_most,
              "variation of the frequency error over the phase, rad/sample"},
    ValueText{"probability", theorems::Sense::at_most, "probability of losing lock"},
    ValueText{"snr_db", theorems::Sense::at_most, "lowest SNR, dB"},
};

/// The numbers that a claim has as decimals: those of a recursion. Others ("from", "to": a part of the band)
/// are enclosed and have no words.
void add_values(Json& quantities, const certificates::Claim& claim) {
  for (const auto& claimed : claim.values) {
    const std::string& name = claimed.first;
    const std::string& text = claimed.second;
    if (std::isnan(rigor::nearest_double(text))) {
      continue;
    }
    const auto* known =
        std::ranges::find_if(kValues, [&](const ValueText& value) { return value.name == name; });
    const bool is_known = known != kValues.end();
    const rigor::Interval value = rigor::parse_decimal(text);
    quantities[name] = {{"lo", rigor::to_hexadecimal(value.lower())},
                        {"hi", rigor::to_hexadecimal(value.upper())},
                        {"sense", name_of(is_known ? known->sense : theorems::Sense::enclosure)},
                        {"words", is_known ? known->words : ""},
                        {"symbol", ""}};
  }
}

}  // namespace

Json claims_json(const std::vector<certificates::Claim>& all) {
  Json claims = Json::array();
  for (const certificates::Claim& claim : all) {
    Json quantities = quantities_json(claim.evidence);
    add_values(quantities, claim);
    claims.push_back({{"id", claim.id},
                      {"statement", claim.statement},
                      {"requirement", claim.requirement},
                      {"verdict", std::string(rigor::to_string(claim.verdict))},
                      {"required", claim.required},
                      {"reason", claim.reason},
                      {"line", claim.position.line},
                      {"column", claim.position.column},
                      {"quantities", std::move(quantities)}});
  }
  return claims;
}

}  // namespace veritrack::python
