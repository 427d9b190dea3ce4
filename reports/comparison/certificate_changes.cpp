#include "reports/comparison/certificate_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace veritrack::reports {

namespace {

using Json = nlohmann::ordered_json;
using Kind = CertificateChange::Kind;

/// What is proved of a value from one side.
struct Bound {
  double value = 0.0;
  bool is_upper = true;  ///< then less is better
};

/// What two certificates may differ in.
struct Contents {
  std::map<std::string, std::string> design;  ///< what is written, by its path
  std::map<std::string, std::string> claims;  ///< verdicts, by id
  std::map<std::string, Bound> bounds;        ///< by name
  std::string verdict;
};

struct Words {
  std::string_view name;
  std::string_view words;
  std::string_view unit;
};

constexpr std::array kWords{
    Words{"frequency_error_bound", "frequency error, for ever", " rad/sample"},
    Words{"frequency_error", "frequency error, for ever or until lock is lost", " rad/sample"},
    Words{"ultimate_frequency_error", "frequency error, in the long run", " rad/sample"},
    Words{"settled_frequency_error", "frequency error once settled", " rad/sample"},
    Words{"settling_samples", "samples until it has settled", ""},
    Words{"frequency_error_radius", "how far off a start may be in frequency", " rad/sample"},
    Words{"reach", "how far off a start may be in frequency", " rad/sample"},
    Words{"largest_noise", "tolerated noise, of the amplitude", ""},
    Words{"noise", "tolerated noise, signal units", ""},
    Words{"largest_slew", "tolerated slew", " rad/sample per sample"},
    Words{"contraction_rate", "factor of the error per sample", ""},
    Words{"probability_of_losing_lock", "probability of losing lock", ""},
    Words{"probability", "probability of losing lock", ""},
    Words{"lock_frequency_error", "frequency error in lock", " rad/sample"},
    Words{"rms_frequency_error", "root mean square of the frequency error in lock", " rad/sample"},
    Words{"lowest_snr", "lowest signal-to-noise ratio", " dB"},
    Words{"snr_db", "lowest signal-to-noise ratio", " dB"},
    Words{"bias", "mean frequency error in the long run, at most", " rad/sample"},
    Words{"ripple", "variation of the frequency error over the phase", " rad/sample"},
};

/// The members of a claim that are decimals of which more is better; of the others less is.
constexpr std::array<std::string_view, 2> kMoreIsBetter{"noise", "reach"};
constexpr std::array<std::string_view, 6> kLessIsBetter{
    "frequency_error", "settled_frequency_error", "ripple", "probability", "snr_db", "bias"};

template <typename Names>
bool is_one_of(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of a design: a number is what is written of it.
void flatten(const std::string& path, const Json& json, std::map<std::string, std::string>& texts) {
  if (json.is_object() && json.contains("text")) {
    texts[path] = json.at("text").get<std::string>();
  } else if (json.is_object()) {
    for (const auto& [name, member] : json.items()) {
      flatten(path.empty() ? name : fmt::format("{}.{}", path, name), member, texts);
    }
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      flatten(fmt::format("{}[{}]", path, i), json.at(i), texts);
    }
  } else {
    texts[path] = json.is_string() ? json.get<std::string>() : json.dump();
  }
}

double number_of(const Json& json) {
  return std::strtod(json.get<std::string>().c_str(), nullptr);  // hexadecimal or decimal
}

void add_bounds(const Json& claim, std::map<std::string, Bound>& bounds) {
  for (const auto& [name, value] : claim.at("evidence").items()) {
    const bool has_low = value.contains("lo");
    const bool has_high = value.contains("hi");
    if (has_low != has_high) {
      bounds.emplace(name, Bound{number_of(value.at(has_high ? "hi" : "lo")), has_high});
    }
  }
  for (const auto& [name, value] : claim.items()) {
    if (is_one_of(kMoreIsBetter, name) || is_one_of(kLessIsBetter, name)) {
      bounds.emplace(name, Bound{number_of(value), is_one_of(kLessIsBetter, name)});
    }
  }
  if (claim.contains("bias_low") && claim.contains("bias_high")) {
    const double largest =
        std::max(std::abs(number_of(claim.at("bias_low"))), std::abs(number_of(claim.at("bias_high"))));
    bounds.emplace("bias", Bound{largest, true});
  }
}

Contents contents_of(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    if (json.at("schema").get<std::string>() != "veritrack/certificate/2") {
      throw std::invalid_argument("no certificate of the format veritrack/certificate/2");
    }
    Contents contents;
    contents.verdict = json.at("verdict").get<std::string>();
    flatten("", json.at("design"), contents.design);
    for (const Json& claim : json.at("claims")) {
      const auto id = claim.at("id").get<std::string>();
      const auto verdict = claim.at("verdict").get<std::string>();
      contents.claims[id] = verdict;
      if (verdict == "proved") {
        add_bounds(claim, contents.bounds);
      }
    }
    return contents;
  } catch (const Json::exception& error) {
    throw std::invalid_argument(fmt::format("no certificate: {}", error.what()));
  }
}

std::string words_of(const std::string& name, const std::string& from, const std::string& to) {
  const auto* const known =
      std::find_if(kWords.begin(), kWords.end(), [&](const Words& words) { return words.name == name; });
  return known == kWords.end() ? fmt::format("{}: {} -> {}", name, from, to)
                               : fmt::format("{}: {} -> {}{}", known->words, from, to, known->unit);
}

/// Claims about the design itself, not about what somebody has published.
bool is_guarantee(const std::string& id) {
  return id.starts_with("ekf/") || id.starts_with("model/") || id.starts_with("kkl/");
}

/// Calls `tell(name, old, new)` for the names of either; what is missing is null.
template <typename Values, typename Tell>
void compare(const Values& old_values, const Values& new_values, const Tell& tell) {
  for (const auto& [name, value] : old_values) {
    const auto found = new_values.find(name);
    tell(name, &value, found != new_values.end() ? &found->second : nullptr);
  }
  for (const auto& [name, value] : new_values) {
    if (!old_values.contains(name)) {
      tell(name, nullptr, &value);
    }
  }
}

/// A verdict that is not in a certificate is none.
int rank(const std::string& verdict) {
  return verdict == "proved" ? 2 : verdict == "refuted" ? 0 : 1;
}

class Changes {
 public:
  explicit Changes(double tolerance) : tolerance_(tolerance) {}

  void of_designs(const Contents& before, const Contents& after) {
    compare(
        before.design, after.design, [&](const auto& path, const std::string* from, const std::string* to) {
          if (from == nullptr || to == nullptr || *from != *to) {
            add(Kind::other, path, from != nullptr ? *from : "not given", to != nullptr ? *to : "not given");
          }
        });
  }
  void of_verdicts(const Contents& before, const Contents& after) {
    if (before.verdict != after.verdict) {
      const int from = rank(before.verdict);
      const int to = rank(after.verdict);
      add(from < to   ? Kind::better
          : from > to ? Kind::worse
                      : Kind::other,
          "what is required", before.verdict, after.verdict);
    }
  }
  void of_claims(const Contents& before, const Contents& after) {
    compare(before.claims, after.claims, [&](const auto& id, const std::string* from, const std::string* to) {
      const std::string old_verdict = from != nullptr ? *from : "not said";
      const std::string new_verdict = to != nullptr ? *to : "not said";
      if (old_verdict != new_verdict) {
        const Kind kind = !is_guarantee(id)                       ? Kind::other
                          : rank(old_verdict) < rank(new_verdict) ? Kind::better
                                                                  : Kind::worse;
        add(kind, id, old_verdict, new_verdict);
      }
    });
  }
  void of_bounds(const Contents& before, const Contents& after) {
    compare(before.bounds, after.bounds, [&](const auto& name, const Bound* from, const Bound* to) {
      if (from == nullptr || to == nullptr || from->is_upper != to->is_upper) {
        return;  // a claim is missing, which was told
      }
      const double change = to->value - from->value;
      const double size = std::max(std::abs(from->value), std::abs(to->value));
      if (!(std::abs(change) <= tolerance_ * size)) {
        changes.push_back(
            {(change < 0.0) == from->is_upper ? Kind::better : Kind::worse,
             words_of(name, fmt::format("{:.4g}", from->value), fmt::format("{:.4g}", to->value))});
      }
    });
  }

  std::vector<CertificateChange> changes;

 private:
  void add(Kind kind, const std::string& what, const std::string& from, const std::string& to) {
    changes.push_back({kind, fmt::format("{}: {} -> {}", what, from, to)});
  }

  double tolerance_;
};

}  // namespace

void require_certificate(const std::string& text) {
  static_cast<void>(contents_of(text));
}

std::vector<CertificateChange> certificate_changes(const std::string& old_text, const std::string& new_text,
                                                   double tolerance) {
  const Contents before = contents_of(old_text);
  const Contents after = contents_of(new_text);
  Changes found(tolerance);
  found.of_designs(before, after);
  found.of_verdicts(before, after);
  found.of_claims(before, after);
  found.of_bounds(before, after);
  return found.changes;
}

}  // namespace veritrack::reports
