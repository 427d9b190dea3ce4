#include "reports/comparison/certificate_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace veritrack::reports {

namespace {

using Json = nlohmann::ordered_json;

/// The members of a claim that are decimals of which more is better; of the others less is.
constexpr std::array<std::string_view, 3> kMoreIsBetter{"noise", "reach", "slew"};
constexpr std::array<std::string_view, 8> kLessIsBetter{
    "frequency_error", "settled_frequency_error", "ripple", "probability",
    "snr_db",          "frequency_error_before",  "bias",   "samples"};

template <typename Names>
bool is_one_of(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

double number_of(const Json& json) {
  return std::strtod(json.get<std::string>().c_str(), nullptr);  // hexadecimal or decimal
}

/// Keeps the worse one where a claim stands more than once, for each part of a band.
void add_bound(std::map<std::string, Bound>& bounds, const std::string& name, const Bound& bound) {
  const auto [place, is_new] = bounds.emplace(name, bound);
  const bool is_better =
      bound.is_upper ? bound.value <= place->second.value : bound.value >= place->second.value;
  if (!is_new && !is_better) {
    place->second = bound;
  }
}

void add_bounds(const Json& claim, std::map<std::string, Bound>& bounds) {
  for (const auto& [name, value] : claim.at("evidence").items()) {
    const bool has_low = value.contains("lo");
    const bool has_high = value.contains("hi");
    if (has_low != has_high) {
      add_bound(bounds, name, {number_of(value.at(has_high ? "hi" : "lo")), has_high});
    }
  }
  for (const auto& [name, value] : claim.items()) {
    if (is_one_of(kMoreIsBetter, name) || is_one_of(kLessIsBetter, name)) {
      add_bound(bounds, name, {number_of(value), is_one_of(kLessIsBetter, name), value.get<std::string>()});
    }
  }
  if (claim.contains("bias_low") && claim.contains("bias_high")) {
    const double low = std::abs(number_of(claim.at("bias_low")));
    const double high = std::abs(number_of(claim.at("bias_high")));
    const auto larger = claim.at(low <= high ? "bias_high" : "bias_low").get<std::string>();
    add_bound(bounds, "bias",
              {low <= high ? high : low, true, larger.substr(larger.starts_with('-') ? 1 : 0)});
  }
}

bool is_guarantee(const std::string& id) {
  constexpr std::array<std::string_view, 6> kColumns{"ekf/",       "model/",     "kkl/",
                                                     "dft-block/", "regulator/", "recursion/"};
  return !id.starts_with("dft-block/false-lock") &&
         std::any_of(kColumns.begin(), kColumns.end(),
                     [&](const std::string_view column) { return id.starts_with(column); });
}

}  // namespace

bool Said::is_guaranteed(const std::string& id) const {
  return is_required || is_guarantee(id);
}

int rank(const std::string& verdict) {
  return verdict == "proved" ? 2 : verdict == "refuted" ? 0 : 1;
}

CertificateContents contents_of(const std::string& text) {
  try {
    CertificateContents contents{Json::parse(text), {}, {}};
    const Json& json = contents.json;
    if (json.at("schema").get<std::string>() != "veritrack/certificate/2") {
      throw std::invalid_argument("no certificate of the format veritrack/certificate/2");
    }
    contents.verdict = json.at("verdict").get<std::string>();
    static_cast<void>(json.at("design").at("tracker").get<std::string>());
    for (const Json& claim : json.at("claims")) {
      const auto verdict = claim.at("verdict").get<std::string>();
      const auto [place, is_new] = contents.claims.emplace(claim.at("id").get<std::string>(), Said{verdict});
      Said& said = place->second;
      said.verdict = rank(verdict) < rank(said.verdict) ? verdict : said.verdict;
      said.is_required = said.is_required || claim.value("required", false);
      if (verdict == "proved") {
        add_bounds(claim, said.bounds);
      }
    }
    return contents;
  } catch (const Json::exception& error) {
    throw std::invalid_argument(fmt::format("no certificate: {}", error.what()));
  }
}

}  // namespace veritrack::reports
