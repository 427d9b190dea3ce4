#include "certificates/design/design_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <any>
#include <array>
#include <cerrno>
#include <optional>
#include <system_error>
#include <tuple>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_format.hpp"
#include "certificates/design/file_descriptor.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/design/toml_value.hpp"

namespace veritrack::certificates {

namespace {

// ---- the keys above the first table

template <auto member, std::size_t limit>
void line_of_text(const TomlValue& value, keys::Owner<member>& target) {
  target.*member = value.line_of_text(limit);
}

std::vector<std::string> tracker_names() {
  std::vector<std::string> names;
  for (const DesignFormat* format : design_formats()) {
    names.emplace_back(format->tracker);
  }
  return names;
}

void tracker(const TomlValue& value, Design& design) {
  keys::choose(value, tracker_names(), design.tracker);
}

/// "a", "b" or "c".
std::string allowed_trackers() {
  std::vector<std::string> names = tracker_names();
  for (std::string& name : names) {
    name = fmt::format("\"{}\"", name);
  }
  std::string last = names.back();
  names.pop_back();
  last += others_are_left_out();
  return names.empty() ? last : fmt::format("{} or {}", fmt::join(names, ", "), last);
}

enum class Place { file, table };

/// A design inside another one needs no name.
BoundTable top_keys(Design& design, Place place) {
  constexpr std::string_view kOneLine = "a string on one line, of 1 to 200 bytes";
  static const std::string trackers = allowed_trackers();
  static const std::array top{
      Key<Design>{"name", kOneLine, line_of_text<&Design::name, 200>, keys::kRequired},
      Key<Design>{"tracker", trackers, tracker, keys::kRequired},
      Key<Design>{"source", kOneLine, line_of_text<&Design::source, 200>, keys::kOptional},
  };
  static const std::array inner{Key<Design>{"tracker", trackers, tracker, keys::kRequired}};
  return place == Place::file ? bound_table("", top, design) : bound_table("", inner, design);
}

// ---- unknown keys

std::vector<std::string> names_of(const BoundTable& table) {
  std::vector<std::string> names;
  for (const BoundKey& key : table.keys) {
    names.emplace_back(key.name);
  }
  return names;
}

std::string path_of(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : fmt::format("{}.{}", table, key);
}

/// Every path that means something: "name", "design", "design.q1", ...
std::vector<std::string> known_paths(const BoundTable& top, const std::vector<BoundTable>& tables) {
  std::vector<std::string> paths = names_of(top);
  for (const BoundTable& table : tables) {
    paths.emplace_back(table.name);
    for (const BoundKey& key : table.keys) {
      paths.push_back(path_of(table.name, key.name));
    }
  }
  return paths;
}

/// A key that means nothing.
struct UnknownKey {
  std::string path;
  std::string table;  ///< its table; empty at the top
  Position position;
};

bool stands_before(const Position& a, const Position& b) {
  return std::tie(a.line, a.column) < std::tie(b.line, b.column);
}

/// Keeps the first unknown key of `table` in `first`.
void find_unknown_keys(const toml::table& table, std::string_view table_name,
                       const std::vector<std::string>& known_names, std::optional<UnknownKey>& first) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known_names.begin(), known_names.end(), name) != known_names.end()) {
      continue;
    }
    const Position position = to_position(key.source().begin);
    if (!first || stands_before(position, first->position)) {
      first = {path_of(table_name, name), std::string(table_name), position};
    }
  }
}

/// The trackers whose design files have this key.
std::vector<std::string_view> trackers_with(const UnknownKey& key) {
  std::vector<std::string_view> trackers;
  for (const DesignFormat* format : design_formats()) {
    std::any tables = format->empty_tables();
    for (const BoundTable& table : format->bind_tables(tables)) {
      const bool has_key = std::any_of(table.keys.begin(), table.keys.end(), [&](const BoundKey& each) {
        return table.name == key.table && path_of(table.name, each.name) == key.path;
      });
      if (has_key) {
        trackers.push_back(format->tracker);
      }
    }
  }
  return trackers;
}

/// "nearest known key: design.q1", or the trackers that have the key.
std::string what_is_known(const UnknownKey& unknown, const std::vector<std::string>& paths) {
  const std::vector<std::string_view> trackers = trackers_with(unknown);
  return trackers.empty() ? fmt::format("nearest known key: {}", nearest_key(unknown.path, paths))
                          : fmt::format("it goes with the tracker {}", fmt::join(trackers, " or "));
}

/// Throws InputError at the first key of the file that means nothing for the tracker with these tables.
void reject_unknown_keys(const TomlSource& source, const BoundTable& top,
                         const std::vector<BoundTable>& tables) {
  std::optional<UnknownKey> unknown;
  std::vector<std::string> names_at_top = names_of(top);
  for (const BoundTable& table : tables) {
    names_at_top.emplace_back(table.name);
    if (const toml::table* content = source.root().get_as<toml::table>(table.name)) {
      find_unknown_keys(*content, table.name, names_of(table), unknown);
    }
  }
  find_unknown_keys(source.root(), "", names_at_top, unknown);
  if (!unknown) {
    return;
  }
  std::vector<std::string> allowed = names_at_top;
  for (const BoundTable& table : tables) {
    if (table.name == unknown->table) {
      allowed = names_of(table);
    }
  }
  constexpr std::size_t kShownLimit = 80;
  source.fail(unknown->position,
              fmt::format("unknown key {}; {}; allowed {}: {}", printable(unknown->path, kShownLimit),
                          what_is_known(*unknown, known_paths(top, tables)),
                          unknown->table.empty() ? "at the top" : "in [" + unknown->table + "]",
                          fmt::join(allowed, ", ")));
}

// ---- reading

void read_default(const BoundKey& key, const std::string& path) {
  const TomlSource source(fmt::format("value = {}", key.absence.default_toml), "default values",
                          TomlSource::Origin::built_in);
  key.read(TomlValue(source, *source.root().get("value"), path, key.allowed));
}

/// Reads the keys of one table. `content` is null when the file does not have it.
void read_table(const TomlSource& source, const toml::table* content, const BoundTable& table,
                std::map<std::string, Position>& positions) {
  for (const BoundKey& key : table.keys) {
    const std::string path = path_of(table.name, key.name);
    if (const toml::node* node = content != nullptr ? content->get(key.name) : nullptr) {
      const TomlValue value(source, *node, path, key.allowed);
      key.read(value);
      positions[path] = value.position();
    } else if (key.absence.rule == Absence::Rule::is_default) {
      read_default(key, path);
    } else if (key.absence.rule == Absence::Rule::is_an_error) {
      if (content == nullptr) {
        source.fail(source.end(), fmt::format("missing table [{}]; allowed: a table with {}", table.name,
                                              fmt::join(names_of(table), ", ")));
      }
      const Position start = table.name.empty() ? Position{1, 1} : to_position(content->source().begin);
      source.fail(start, fmt::format("missing key {}; allowed: {}", path, key.allowed));
    }
  }
}

/// The table of that name, null when there is none. Throws InputError when it is not a table.
const toml::table* find_table(const TomlSource& source, std::string_view name) {
  const toml::node* node = source.root().get(name);
  if (node == nullptr) {
    return nullptr;
  }
  if (!node->is_table()) {
    const std::string allowed = fmt::format("a table, [{}]", name);
    TomlValue(source, *node, std::string(name), allowed).refuse_kind();
  }
  return node->as_table();
}

/// The format that the file should have: that of its tracker. A tracker that is missing or unknown is
/// reported when the key is read; until then the file is treated as one for the first tracker.
const DesignFormat& expected_format(const TomlSource& source) {
  const std::string_view tracker = source.root()["tracker"].value<std::string_view>().value_or("");
  const auto formats = design_formats();
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const DesignFormat* format) { return format->tracker == tracker; });
  return found != formats.end() ? **found : *formats.front();
}

Design read_from(const TomlSource& source, Place place) {
  const DesignFormat& format = expected_format(source);
  Design design;
  design.tables = format.empty_tables();
  const BoundTable top = top_keys(design, place);
  const std::vector<BoundTable> tables = format.bind_tables(design.tables);
  // Keys of an unknown tracker are not those of another one.
  if (source.root()["tracker"].value<std::string_view>().value_or(format.tracker) == format.tracker) {
    reject_unknown_keys(source, top, tables);
  }
  read_table(source, &source.root(), top, design.positions);
  for (const BoundTable& table : tables) {
    read_table(source, find_table(source, table.name), table, design.positions);
  }
  const auto require = [&](const std::optional<TableObjection>& objection) {
    if (objection) {
      const toml::table* table = find_table(source, objection->table);
      const Position begin = table == nullptr ? Position{1, 1} : to_position(table->source().begin);
      source.fail(objection->position.value_or(begin), objection->message);
    }
  };
  if (format.complete != nullptr) {
    require(format.complete(design.tables, source.file_name()));
  }
  if (format.objection != nullptr) {
    require(format.objection(design.tables));
  }
  return design;
}

}  // namespace

Design read_design(std::string_view text, std::string_view file_name) {
  const TomlSource source(text, file_name);
  const rigor::UpwardRounding upward;
  return read_from(source, Place::file);
}

Design read_inner_design(const TomlValue& table) {
  return read_from(table.as_file(), Place::table);
}

std::string read_design_text(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& message) { throw InputError(path.string(), Position{}, message); };
  const auto fail_with_error_number = [&](int error) {
    fail(fmt::format("cannot be read: {}; allowed: a readable design file",
                     std::generic_category().message(error)));
  };
  // O_NONBLOCK: opening a named pipe would otherwise wait for somebody to write to it.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.get(), &status) != 0) {
    fail_with_error_number(errno);
  }
  if (!S_ISREG(status.st_mode)) {
    fail(fmt::format("{}; allowed: a design file",
                     S_ISDIR(status.st_mode) ? "is a directory" : "is not a regular file"));
  }
  if (status.st_size > static_cast<off_t>(TomlSource::kSizeLimit)) {
    fail(fmt::format("has {} bytes; allowed: a design file of up to 1 MiB", status.st_size));
  }
  // One byte more than allowed, so that a file that grows meanwhile is refused by read_design and not cut
  // off.
  std::string text(TomlSource::kSizeLimit + 1, '\0');
  std::size_t length = 0;
  while (length < text.size()) {
    const ssize_t count = file.read(text.data() + length, text.size() - length);
    if (count < 0) {
      fail_with_error_number(errno);
    }
    if (count == 0) {
      break;
    }
    length += static_cast<std::size_t>(count);
  }
  text.resize(length);
  return text;
}

Design read_design_file(const std::filesystem::path& path) {
  return read_design(read_design_text(path), path.string());
}

}  // namespace veritrack::certificates
