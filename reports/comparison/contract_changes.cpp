#include "reports/comparison/contract_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include "certificates/design/input_error.hpp"
#include "reports/comparison/contract_values.hpp"
#include "reports/comparison/shown_values.hpp"

namespace veritrack::reports {

namespace {

using certificates::KeyContract;
using certificates::Stronger;
using Json = nlohmann::ordered_json;
using ContractKind = ContractChange::Kind;
using Names = std::vector<std::string>;

const Json* member_of(const Json* json, const std::string& name) {
  return json != nullptr && json->is_object() && json->contains(name) ? &json->at(name) : nullptr;
}

/// The members of either, each once.
Names names_of(const Json* before, const Json* after) {
  Names names;
  for (const Json* json : {before, after}) {
    if (json == nullptr || !json->is_object()) {
      continue;
    }
    for (const auto& [name, value] : json->items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  return names;
}

/// The formula of that name in a list of names and formulas.
const std::string* formula_of(const Json* list, const std::string& name) {
  if (list != nullptr && list->is_array()) {
    for (const Json& each : *list) {
      if (each.at("name") == name) {
        return each.at("formula").get_ptr<const std::string*>();
      }
    }
  }
  return nullptr;
}

Names formula_names(const Json* before, const Json* after) {
  Names names;
  for (const Json* list : {before, after}) {
    for (const Json& each : list != nullptr ? *list : Json::array()) {
      const auto name = each.at("name").get<std::string>();
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  return names;
}

/// Whether a formula names it: as a word, not as a part of one.
bool uses(const std::string& formula, const std::string& name) {
  const auto is_letter = [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
  };
  for (std::size_t at = formula.find(name); at != std::string::npos; at = formula.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_letter(formula[at - 1])) && (end == formula.size() || !is_letter(formula[end]))) {
      return true;
    }
  }
  return false;
}

/// All texts in it.
void add_texts(const Json* json, Names& texts) {
  if (json == nullptr) {
    return;
  }
  if (json->is_string()) {
    texts.push_back(json->get<std::string>());
  } else if (json->is_structured()) {
    for (const Json& each : *json) {
      add_texts(&each, texts);
    }
  }
}

/// The changes of one design.
class DesignChanges {
 public:
  /// `prefix` stands in front of the keys.
  DesignChanges(const Json& before, const Json& after, std::string prefix)
      : before_(before), after_(after), prefix_(std::move(prefix)) {}

  std::vector<ContractChange> all() {
    for (const std::string& table : names_of(&before_, &after_)) {
      const Json* from = member_of(&before_, table);
      const Json* to = member_of(&after_, table);
      if (table == "tracker") {
        add(table, {Stronger::only_equal}, {from}, {to});
      } else if (table == "name" || table == "source") {
        add(table, {Stronger::neither}, {from}, {to});
      } else {
        add_table(table, from, to);
      }
    }
    return std::move(changes_);
  }

 private:
  [[nodiscard]] static std::string tracker_of(const Json& design) {
    return design.at("tracker").get<std::string>();
  }

  /// That of both trackers; `unknown` where they differ.
  [[nodiscard]] KeyContract contract(const std::string& table, const std::string& key) const {
    // The signal of a model stands where the recursion is, with its default.
    const std::string home = table == "model" && key == "signal" ? "assume" : table;
    const KeyContract from = certificates::contract_of(tracker_of(before_), home, key);
    const KeyContract to = certificates::contract_of(tracker_of(after_), home, key);
    const bool agree = from.stronger == to.stronger && from.measure == to.measure;
    return from.stronger == Stronger::unknown || agree ? to
           : to.stronger == Stronger::unknown          ? from
                                                       : KeyContract{};
  }

  [[nodiscard]] static ContractValue value_of(const Json& design, const std::string& table,
                                              const std::string& key) {
    const Json* assume = member_of(&design, "assume");
    ContractValue value{member_of(member_of(&design, table), key)};
    if (const Json* rate = member_of(assume, "sample_rate")) {
      value.sample_rate = number_in(*rate);
    }
    const Json* flag =
        table != "assume" ? nullptr
                          : member_of(assume, key == "slew" ? "slew_in_hertz_per_second" : key + "_in_hertz");
    value.in_hertz = flag != nullptr && flag->get<bool>();
    return value;
  }

  void add_table(const std::string& table, const Json* from, const Json* to) {
    for (const std::string& key : names_of(from, to)) {
      if (key == "frequency_in_hertz" || key == "slew_in_hertz_per_second") {
        continue;  // says what the numbers of another key are in
      }
      const KeyContract of_key = contract(table, key);
      const std::string path = fmt::format("{}.{}", table, key);
      if (of_key.stronger == Stronger::larger_of_each || of_key.stronger == Stronger::as_it_is_used) {
        add_formulas(path, of_key.stronger, member_of(from, key), member_of(to, key));
      } else {
        add(path, of_key, value_of(before_, table, key), value_of(after_, table, key));
      }
    }
  }

  void add_formulas(const std::string& path, Stronger stronger, const Json* from, const Json* to) {
    for (const std::string& name : formula_names(from, to)) {
      const std::string* old_formula = formula_of(from, name);
      const std::string* new_formula = formula_of(to, name);
      Relation relation = relation_of_formulas(old_formula, new_formula);
      if (relation == Relation::equal) {
        continue;
      }
      const bool is_chosen = stronger == Stronger::as_it_is_used && !is_assumed(name);
      if (stronger == Stronger::as_it_is_used) {
        relation = Relation::incomparable;
      }
      constexpr std::size_t kLongest = 80;
      const auto shown = [](const std::string* formula) {
        return formula == nullptr ? std::string("not given") : certificates::printable(*formula, kLongest);
      };
      tell(path, fmt::format("{}.{}", path, certificates::printable(name, kLongest)),
           fmt::format("{} -> {}", shown(old_formula), shown(new_formula)), relation, is_chosen);
    }
  }

  /// Whether a parameter is in what is assumed or estimated, of either design, by way of others as well.
  [[nodiscard]] bool is_assumed(const std::string& parameter) const {
    for (const Json* design : {&before_, &after_}) {
      const Json* model = member_of(design, "model");
      const Json* assume = member_of(design, "assume");
      Names texts;
      for (const Json* part : {member_of(model, "frequency"), member_of(model, "signal"),
                               member_of(assume, "start_within"), member_of(assume, "start_exactly")}) {
        add_texts(part, texts);
      }
      const Json* parameters = member_of(model, "parameters");
      Names used;
      for (std::size_t i = 0; i < texts.size(); ++i) {
        for (const std::string& name : formula_names(parameters, nullptr)) {
          if (uses(texts[i], name) && std::find(used.begin(), used.end(), name) == used.end()) {
            used.push_back(name);
            texts.push_back(*formula_of(parameters, name));
          }
        }
      }
      if (std::find(used.begin(), used.end(), parameter) != used.end()) {
        return true;
      }
    }
    return false;
  }

  void add(const std::string& path, const KeyContract& of_key, const ContractValue& from,
           const ContractValue& to) {
    const bool is_chosen = of_key.stronger == Stronger::neither;
    const Relation relation = relation_of(from, to, is_chosen ? KeyContract{Stronger::only_equal} : of_key);
    if (relation != Relation::equal) {
      tell(path, path, shown_values(from, to, of_key.measure), relation, is_chosen);
    } else if (const std::vector<Json> chosen = chosen_members(of_key, from, to); !chosen.empty()) {
      tell(path, path, shown_values({&chosen[0]}, {&chosen[1]}, of_key.measure), relation, true);
    }
  }

  /// The members that are no part of the contract, where they differ.
  static std::vector<Json> chosen_members(const KeyContract& of_key, const ContractValue& from,
                                          const ContractValue& to) {
    std::vector<Json> chosen{Json::object(), Json::object()};
    for (const auto& member : of_key.members) {
      const std::string name(member.name);
      const Json* old_value = member_of(from.json, name);
      const Json* new_value = member_of(to.json, name);
      if (member.stronger == Stronger::neither && old_value != nullptr && new_value != nullptr &&
          *old_value != *new_value) {
        chosen[0][name] = *old_value;
        chosen[1][name] = *new_value;
      }
    }
    return chosen[0].empty() ? std::vector<Json>() : chosen;
  }

  void tell(const std::string& path, const std::string& shown_path, const std::string& values,
            Relation relation, bool is_chosen) {
    const std::string shown = fmt::format("{}{}: {}", prefix_, shown_path, values);
    if (is_chosen) {
      changes_.push_back({ContractKind::chosen, prefix_ + path, {}, shown});
      return;
    }
    const bool is_asked = path.starts_with("require.");
    const std::string what = relation == Relation::stronger ? (is_asked ? "asks for more" : "covers more")
                             : relation == Relation::weaker ? (is_asked ? "asks for less" : "covers less")
                                                            : "cannot be compared";
    changes_.push_back({relation == Relation::stronger ? ContractKind::stronger : ContractKind::weaker,
                        prefix_ + path, what, fmt::format("{} ({})", shown, what)});
  }

  const Json& before_;
  const Json& after_;
  std::string prefix_;
  std::vector<ContractChange> changes_;
};

}  // namespace

std::vector<ContractChange> contract_changes(const Json& before, const Json& after) {
  std::vector<ContractChange> changes = DesignChanges(before.at("design"), after.at("design"), {}).all();
  const Json* from = member_of(&before, "frequency_tracker");
  const Json* to = member_of(&after, "frequency_tracker");
  const std::string inner = "design.frequency_tracker";
  if (from != nullptr && to != nullptr) {
    for (ContractChange& change : DesignChanges(from->at("design"), to->at("design"), inner + ".").all()) {
      changes.push_back(std::move(change));
    }
  } else if (from != to) {
    changes.push_back({ContractKind::weaker, inner, "cannot be compared",
                       fmt::format("{}: {} (cannot be compared)", inner,
                                   from == nullptr ? "not given -> a tracker" : "a tracker -> not given")});
  }
  return changes;
}

}  // namespace veritrack::reports
