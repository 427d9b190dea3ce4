#include "certificates/help/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <any>
#include <cctype>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>

#include "analysis/statements/paper_findings.hpp"
#include "certificates/design/design_format.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/design/toml_source.hpp"
#include "certificates/help/texts.hpp"

namespace veritrack::certificates {

namespace {

/// A file with explanations.
struct Source {
  std::unique_ptr<TomlSource> toml;
  std::vector<std::string> trackers;  ///< whose keys it explains

  [[nodiscard]] const toml::table* entry(std::string_view table, std::string_view name) const {
    const toml::table* entries = toml->root().get_as<toml::table>(table);
    return entries != nullptr ? entries->get_as<toml::table>(name) : nullptr;
  }
  [[nodiscard]] bool is_for(std::string_view tracker) const {
    return std::find(trackers.begin(), trackers.end(), tracker) != trackers.end();
  }
};

const std::vector<Source>& sources() {
  static const std::vector<Source> read = [] {
    std::vector<Source> all;
    all.reserve(explanation_texts().size());
    for (const EmbeddedText& text : explanation_texts()) {
      Source source{std::make_unique<TomlSource>(text.text, text.name, TomlSource::Origin::built_in), {}};
      for (const toml::node& tracker : *source.toml->root().get_as<toml::array>("trackers")) {
        source.trackers.push_back(tracker.value<std::string>().value());
      }
      all.push_back(std::move(source));
    }
    // The text of a column goes before one for several.
    std::stable_sort(all.begin(), all.end(),
                     [](const Source& a, const Source& b) { return a.trackers.size() < b.trackers.size(); });
    return all;
  }();
  return read;
}

std::string text_of(const toml::table& entry, std::string_view name) {
  return entry[name].value<std::string>().value_or("");
}

void add(Explanation& explanation, std::string heading, std::string text) {
  if (!text.empty()) {
    explanation.parts.emplace_back(std::move(heading), std::move(text));
  }
}

// ---- keys

Explanation explained_key(std::string_view tracker, std::string path, const BoundKey& key) {
  for (const Source& source : sources()) {
    const toml::table* entry = source.is_for(tracker) ? source.entry("key", path) : nullptr;
    if (entry == nullptr) {
      continue;
    }
    Explanation explanation{std::move(path), {std::string(tracker)}, {}};
    add(explanation, "Meaning", text_of(*entry, "means"));
    add(explanation, "Unit", text_of(*entry, "unit"));
    add(explanation, "Allowed", std::string(key.allowed));
    switch (key.absence.rule) {
      case Absence::Rule::is_an_error:
        add(explanation, "Without it", "an error: the key has to be given");
        break;
      case Absence::Rule::is_default:
        add(explanation, "Without it", std::string(key.absence.default_toml));
        break;
      case Absence::Rule::is_nothing:
        add(explanation, "Without it", "none; the key is optional");
        break;
    }
    add(explanation, "More", text_of(source.toml->root(), "more"));
    return explanation;
  }
  throw std::logic_error(fmt::format("the key {} of {} has no explanation", path, tracker));
}

/// Adds the explanation, or adds the tracker to an equal one.
void add_key(std::vector<Explanation>& all, Explanation explanation) {
  const auto same = std::find_if(all.begin(), all.end(), [&](const Explanation& other) {
    return other.name == explanation.name && other.parts == explanation.parts;
  });
  if (same == all.end()) {
    all.push_back(std::move(explanation));
  } else {
    same->trackers.push_back(explanation.trackers.front());
  }
}

void add_keys(std::vector<Explanation>& all) {
  constexpr std::string_view kOneLine = "a string on one line, of 1 to 200 bytes";
  std::string trackers;
  for (const DesignFormat* format : design_formats()) {
    trackers += fmt::format("{}\"{}\"", trackers.empty() ? "" : ", ", format->tracker);
  }
  const std::vector<BoundKey> top{{"name", kOneLine, {}, {}},
                                  {"tracker", trackers, {}, {}},
                                  {"source", kOneLine, {}, {Absence::Rule::is_nothing, {}}}};
  for (const DesignFormat* format : design_formats()) {
    for (const BoundKey& key : top) {
      add_key(all, explained_key(format->tracker, std::string(key.name), key));
    }
    std::any tables = format->empty_tables();
    for (const BoundTable& table : format->bind_tables(tables)) {
      for (const BoundKey& key : table.keys) {
        add_key(all, explained_key(format->tracker, fmt::format("{}.{}", table.name, key.name), key));
      }
    }
  }
}

// ---- claims

Explanation explained_claim(std::string id, std::string says, const toml::table& entry) {
  Explanation explanation{std::move(id), {}, {}};
  add(explanation, "Claim", std::move(says));
  add(explanation, "Unit", text_of(entry, "unit"));
  add(explanation, "Proof", text_of(entry, "proof"));
  add(explanation, "Hypotheses", text_of(entry, "hypotheses"));
  add(explanation, "Source", text_of(entry, "source"));
  if (const theorems::PaperFinding* finding = theorems::find_paper_finding(explanation.name)) {
    add(explanation, "In print", fmt::format("{} ({})", theorems::to_string(finding->kind), finding->place));
  }
  return explanation;
}

void add_claims(std::vector<Explanation>& all) {
  for (const Source& source : sources()) {
    const toml::table* claims = source.toml->root().get_as<toml::table>("claim");
    if (claims == nullptr) {
      continue;
    }
    for (const auto& [key, node] : *claims) {
      const toml::table& entry = *node.as_table();
      const std::string id(key.str());
      if (const toml::table* readings = entry.get_as<toml::table>("readings")) {
        for (const auto& [reading, says] : *readings) {
          all.push_back(explained_claim(fmt::format("{}/{}", id, reading.str()),
                                        says.value<std::string>().value(), entry));
        }
      } else {
        all.push_back(explained_claim(id, text_of(entry, "says"), entry));
      }
    }
  }
}

std::string_view table_of(std::string_view name) {
  return name.substr(0, name.find('.'));
}
std::string_view key_of(std::string_view name) {
  const std::size_t dot = name.find('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}
bool is_key(const Explanation& explanation) {
  return !explanation.trackers.empty();
}

template <typename Predicate>
std::vector<Explanation> those(const Predicate& predicate) {
  std::vector<Explanation> found;
  std::copy_if(explanations().begin(), explanations().end(), std::back_inserter(found), predicate);
  return found;
}

}  // namespace

const std::vector<Explanation>& explanations() {
  static const std::vector<Explanation> all = [] {
    std::vector<Explanation> made;
    add_keys(made);
    add_claims(made);
    return made;
  }();
  return all;
}

std::vector<Explanation> explain(std::string_view word) {
  std::vector<Explanation> found = those([&](const Explanation& one) { return one.name == word; });
  if (found.empty()) {
    found = those([&](const Explanation& one) { return is_key(one) && key_of(one.name) == word; });
  }
  if (found.empty()) {
    found = those([&](const Explanation& one) { return is_key(one) && table_of(one.name) == word; });
  }
  if (found.empty()) {
    // A place of a published proof, in whichever reading.
    found = those([&](const Explanation& one) {
      return !is_key(one) && one.name.starts_with(std::string(word) + "/");
    });
  }
  return found;
}

std::string nearest_explained(std::string_view word) {
  std::vector<std::string> words;
  words.reserve(2 * explanations().size());
  for (const Explanation& explanation : explanations()) {
    words.push_back(explanation.name);
    if (is_key(explanation)) {
      words.emplace_back(key_of(explanation.name));
    }
  }
  return nearest_key(word, words);
}

std::vector<std::string> explanations_with(std::string_view word) {
  constexpr std::size_t kMost = 4;
  constexpr std::size_t kShortest = 3;
  const auto is_same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  const auto has_word = [&](std::string_view text) {
    return std::search(text.begin(), text.end(), word.begin(), word.end(), is_same) != text.end();
  };
  std::vector<std::string> names;
  for (const Explanation& explanation : explanations()) {
    const bool has =
        has_word(explanation.name) || std::any_of(explanation.parts.begin(), explanation.parts.end(),
                                                  [&](const auto& part) { return has_word(part.second); });
    const bool is_new = std::find(names.begin(), names.end(), explanation.name) == names.end();
    if (has && is_new && word.size() >= kShortest && names.size() < kMost) {
      names.push_back(explanation.name);
    }
  }
  return names;
}

}  // namespace veritrack::certificates
