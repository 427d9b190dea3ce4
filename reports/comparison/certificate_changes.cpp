#include "reports/comparison/certificate_changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "reports/comparison/certificate_contents.hpp"
#include "reports/comparison/contract_changes.hpp"

namespace veritrack::reports {

namespace {

using Json = nlohmann::ordered_json;
using Kind = CertificateChange::Kind;

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
    Words{"slew", "tolerated slew", " rad/sample per sample"},
    Words{"samples", "samples until it is captured", ""},
    Words{"frequency_error_before", "frequency error before it is captured", " rad/sample"},
    Words{"ripple", "variation of the frequency error over the phase", " rad/sample"},
};

/// Rounded to the side that is still true, with as many digits as it takes to tell it from the other one.
std::string text_of(const Bound& bound, const Bound& other) {
  if (!bound.decimal.empty()) {
    return bound.decimal;
  }
  constexpr int kDigits = 4;
  constexpr int kAllDigits = 17;
  const auto text = [&](double value, int digits) {
    return rigor::to_decimal(value, digits, bound.is_upper ? rigor::Direction::up : rigor::Direction::down);
  };
  return text(bound.value, text(bound.value, kDigits) == text(other.value, kDigits) ? kAllDigits : kDigits);
}

/// `label`: the name, or the name and whose it is.
std::string words_of(const std::string& name, const std::string& label, const std::string& change) {
  const auto* const known =
      std::find_if(kWords.begin(), kWords.end(), [&](const Words& words) { return words.name == name; });
  return known == kWords.end() ? fmt::format("{}: {}", label, change)
                               : fmt::format("{}: {}{} ({})", known->words, change, known->unit, label);
}

class Changes {
 public:
  Changes(double tolerance, std::span<const std::string> accepted)
      : tolerance_(tolerance), accepted_(accepted.begin(), accepted.end()) {}

  void of_contracts(const CertificateContents& before, const CertificateContents& after) {
    for (const ContractChange& change : contract_changes(before.json, after.json)) {
      add(change.kind == ContractChange::Kind::weaker     ? Kind::worse
          : change.kind == ContractChange::Kind::stronger ? Kind::better
                                                          : Kind::other,
          change.key, change.text);
      if (change.kind == ContractChange::Kind::weaker) {
        loosened_.push_back(fmt::format("{} {}", change.key, change.what));
      }
    }
    // Nobody has to accept on top of it that what is no longer required is no longer said.
    for (const auto& [id, said] : before.claims) {
      if (said.is_required && !after.claims.contains(id) && has_accepted_requirement_) {
        accepted_results_.insert(id);
        for (const auto& [name, bound] : said.bounds) {
          accepted_results_.insert(name);
        }
      }
    }
  }

  void of_verdicts(const CertificateContents& before, const CertificateContents& after) {
    if (before.verdict != after.verdict) {
      const int from = rank(before.verdict);
      const int to = rank(after.verdict);
      add_result(from < to   ? Kind::better
                 : from > to ? Kind::worse
                             : Kind::other,
                 {}, fmt::format("what is required: {} -> {}", before.verdict, after.verdict));
    }
  }

  void of_claims(const CertificateContents& before, const CertificateContents& after) {
    std::set<std::string> ids;
    for (const CertificateContents* contents : {&before, &after}) {
      for (const auto& [id, said] : contents->claims) {
        ids.insert(id);
      }
    }
    for (const std::string& id : ids) {
      const auto from = before.claims.find(id);
      const auto to = after.claims.find(id);
      const Said* old_said = from != before.claims.end() ? &from->second : nullptr;
      const Said* new_said = to != after.claims.end() ? &to->second : nullptr;
      of_claim(id, old_said, new_said);
    }
  }

  /// Throws NothingToAccept.
  CertificateChanges all() && {
    for (const std::string& key : accepted_) {
      if (!used_.contains(key)) {
        throw NothingToAccept(fmt::format("{} is the key of nothing that is worse; allowed: {}", key,
                                          worse_.empty() ? std::string("no --accept, since nothing is worse")
                                                         : fmt::format("{}", fmt::join(worse_, ", "))));
      }
    }
    return {std::move(list_), std::move(loosened_)};
  }

 private:
  void of_claim(const std::string& id, const Said* from, const Said* to) {
    const std::string old_verdict = from != nullptr ? from->verdict : "not said";
    const std::string new_verdict = to != nullptr ? to->verdict : "not said";
    const bool counts =
        (from != nullptr ? from : to)->is_guaranteed(id) || (to != nullptr && to->is_required);
    if (old_verdict != new_verdict) {
      add_result(!counts                                 ? Kind::other
                 : rank(old_verdict) < rank(new_verdict) ? Kind::better
                                                         : Kind::worse,
                 id, fmt::format("{}: {} -> {}", id, old_verdict, new_verdict));
    } else if (counts) {
      of_bounds(id, *from, *to);
    }
  }

  void of_bounds(const std::string& id, const Said& before, const Said& after) {
    for (const auto& [name, from] : before.bounds) {
      const auto found = after.bounds.find(name);
      if (found == after.bounds.end() || found->second.is_upper != from.is_upper) {
        add_bound_change(id, Kind::worse, name,
                         fmt::format("{} -> not said", text_of(from, {0.0, from.is_upper})));
        continue;
      }
      const Bound& to = found->second;
      const double change = to.value - from.value;
      const double size = std::max(std::abs(from.value), std::abs(to.value));
      if (std::abs(change) <= tolerance_ * size) {
        continue;
      }
      const bool is_better = from.is_upper ? to.value < from.value : to.value > from.value;
      add_bound_change(id, is_better ? Kind::better : Kind::worse, name,
                       fmt::format("{} -> {}", text_of(from, to), text_of(to, from)));
    }
    for (const auto& [name, to] : after.bounds) {
      if (!before.bounds.contains(name)) {
        add_bound_change(id, Kind::better, name,
                         fmt::format("not said -> {}", text_of(to, {0.0, to.is_upper})));
      }
    }
  }

  /// Several claims may have the same bound, which is reported once; of another one it is said whose it is.
  void add_bound_change(const std::string& id, Kind kind, const std::string& name,
                        const std::string& change) {
    if (told_.insert(name + change).second) {
      const bool is_first = named_.insert(name).second;
      add_result(kind, name, words_of(name, is_first ? name : name + " of " + id, change));
    }
  }

  void add_result(Kind kind, const std::string& key, const std::string& text) {
    if (kind == Kind::better && !loosened_.empty()) {
      list_.push_back({Kind::easier, text, key});
    } else if (kind == Kind::worse && accepted_results_.contains(key)) {
      list_.push_back({Kind::accepted, text, key});
    } else {
      add(kind, key, text);
    }
  }

  void add(Kind kind, const std::string& key, const std::string& text) {
    if (kind == Kind::worse && !key.empty()) {
      worse_.insert(key);
      if (accepted_.contains(key)) {
        used_.insert(key);
        has_accepted_requirement_ = has_accepted_requirement_ || key.starts_with("require.");
        kind = Kind::accepted;
      }
    }
    list_.push_back({kind, text, key});
  }

  double tolerance_;
  std::set<std::string> accepted_;
  std::set<std::string> used_;
  std::set<std::string> worse_;
  std::set<std::string> told_;
  std::set<std::string> named_;
  std::set<std::string> accepted_results_;
  bool has_accepted_requirement_ = false;
  std::vector<std::string> loosened_;
  std::vector<CertificateChange> list_;
};

}  // namespace

int CertificateChanges::count(Kind kind) const {
  return static_cast<int>(std::count_if(list.begin(), list.end(),
                                        [&](const CertificateChange& each) { return each.kind == kind; }));
}

void require_certificate(const std::string& text) {
  static_cast<void>(contents_of(text));
}

CertificateChanges certificate_changes(const std::string& old_text, const std::string& new_text,
                                       double tolerance, std::span<const std::string> accepted) {
  const CertificateContents before = contents_of(old_text);
  const CertificateContents after = contents_of(new_text);
  const rigor::UpwardRounding upward;
  try {
    Changes found(tolerance, accepted);
    found.of_contracts(before, after);
    found.of_verdicts(before, after);
    found.of_claims(before, after);
    return std::move(found).all();
  } catch (const Json::exception& error) {
    throw std::invalid_argument(fmt::format("no certificate: {}", error.what()));
  }
}

}  // namespace veritrack::reports
