#include "certificates/tuning/design_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "certificates/design/toml_source.hpp"

namespace veritrack::certificates {

namespace {

/// A part of the text, in bytes, and its replacement.
struct Replacement {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// The places of things in a text that toml++ has parsed.
class Places {
 public:
  Places(const TomlSource& source, std::string_view text)
      : source_(&source), text_(text), start_(source.text_from({1, 1}).data()) {}

  [[nodiscard]] std::size_t offset(const toml::source_position& position) const {
    return static_cast<std::size_t>(source_->text_from(to_position(position)).data() - start_);
  }
  [[nodiscard]] std::size_t line_begin(std::size_t offset) const {
    const std::size_t before = offset == 0 ? std::string_view::npos : text_.rfind('\n', offset - 1);
    return before == std::string_view::npos ? 0 : before + 1;
  }
  /// Just behind the line feed.
  [[nodiscard]] std::size_t line_end(std::size_t offset) const {
    const std::size_t feed = text_.find('\n', offset);
    return feed == std::string_view::npos ? text_.size() : feed + 1;
  }
  /// Whether the line says "key = ..." and nothing before.
  [[nodiscard]] bool has_line(const std::string& key, std::size_t value) const {
    std::string before(text_.substr(line_begin(value), value - line_begin(value)));
    before.erase(
        std::remove_if(before.begin(), before.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
        before.end());
    return before == key + "=";
  }

 private:
  const TomlSource* source_;
  std::string_view text_;
  const char* start_;
};

/// The text without the byte order mark with which it may begin.
std::string_view without_mark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  return text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}

std::string replaced(const std::string& text, std::vector<Replacement> replacements) {
  const std::size_t skipped = text.size() - without_mark(text).size();
  // The later ones first: positions before them stay as they are.
  std::stable_sort(replacements.begin(), replacements.end(),
                   [](const Replacement& a, const Replacement& b) { return a.begin > b.begin; });
  std::string result = text;
  for (const Replacement& each : replacements) {
    result.replace(skipped + each.begin, each.end - each.begin, each.text);
  }
  return result;
}

}  // namespace

std::optional<std::string> with_design_values(const std::string& text, const std::vector<DesignEdit>& edits) {
  const std::string_view seen = without_mark(text);
  const TomlSource source(text, "design");
  const Places places(source, seen);
  const toml::table* table = source.root()["design"].as_table();
  if (table == nullptr || table->is_inline()) {
    return std::nullopt;
  }
  std::vector<Replacement> replacements;
  std::size_t last_line = places.line_end(places.offset(table->source().begin));
  for (const auto& [key, node] : *table) {
    if (node.source().end.line < node.source().begin.line || node.is_table()) {
      continue;  // [design.further] and dotted keys
    }
    last_line = std::max(last_line, places.line_end(places.offset(node.source().end)));
  }
  std::string added;
  for (const DesignEdit& edit : edits) {
    const toml::node* node = table->get(edit.key);
    if (node == nullptr) {
      added += edit.value ? fmt::format("{} = {}\n", edit.key, *edit.value) : "";
      continue;
    }
    const std::size_t begin = places.offset(node->source().begin);
    const std::size_t end = places.offset(node->source().end);
    if (!places.has_line(edit.key, begin) || !(begin < end)) {
      return std::nullopt;
    }
    if (edit.value) {
      replacements.push_back({begin, end, *edit.value});
    } else {
      replacements.push_back({places.line_begin(begin), places.line_end(end), ""});
    }
  }
  if (!added.empty()) {
    const bool needs_feed = last_line > 0 && last_line == seen.size() && seen[last_line - 1] != '\n';
    replacements.push_back({last_line, last_line, (needs_feed ? "\n" : "") + added});
  }
  return replaced(text, std::move(replacements));
}

std::optional<std::string> with_parameter_values(const std::string& text,
                                                 const std::vector<DesignEdit>& edits) {
  const std::string_view seen = without_mark(text);
  const TomlSource source(text, "design");
  const Places places(source, seen);
  std::vector<Replacement> replacements;
  for (const DesignEdit& edit : edits) {
    const toml::node* node = source.root()["model"]["parameters"][edit.key].node();
    const std::size_t begin = node == nullptr ? 0 : places.offset(node->source().begin);
    const std::size_t end = node == nullptr ? 0 : places.offset(node->source().end);
    if (!(begin < end)) {
      return std::nullopt;
    }
    replacements.push_back({begin, end, edit.value.value()});
  }
  return replaced(text, std::move(replacements));
}

}  // namespace veritrack::certificates
