#include "certificates/design/design_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>
#include <tuple>
#include <variant>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_keys.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/design/toml_value.hpp"
#include "certificates/document/file_descriptor.hpp"

namespace veritrack::certificates {

namespace {

// ---- unknown keys

template <typename Target>
std::vector<std::string> names_of(std::span<const Key<Target>> keys) {
  std::vector<std::string> names;
  for (const Key<Target>& key : keys) {
    names.emplace_back(key.name);
  }
  return names;
}

/// Every path that means something: "name", "design", "design.q1", ...
template <typename Tables>
std::vector<std::string> known_paths() {
  std::vector<std::string> paths = names_of(top_keys());
  for_each_table<Tables>([&](const std::string& table, auto keys, auto) {
    paths.push_back(table);
    for (const auto& key : keys) {
      paths.push_back(fmt::format("{}.{}", table, key.name));
    }
  });
  return paths;
}

/// A key that means nothing.
struct UnknownKey {
  std::string path;
  std::string table;  ///< where it stands; empty at the top
  Position position;
};

bool stands_before(const Position& a, const Position& b) {
  return std::tie(a.line, a.column) < std::tie(b.line, b.column);
}

/// Keeps the first unknown key of `table` in `first`.
void find_unknown_keys(const toml::table& table, const std::string& table_name,
                       const std::vector<std::string>& known_names, std::optional<UnknownKey>& first) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known_names.begin(), known_names.end(), name) != known_names.end()) {
      continue;
    }
    const Position position = to_position(key.source().begin);
    if (!first || stands_before(position, first->position)) {
      first = {table_name.empty() ? name : fmt::format("{}.{}", table_name, name), table_name, position};
    }
  }
}

/// Throws InputError at the first key of the file that means nothing for the tracker with these tables.
template <typename Tables>
void reject_unknown_keys(const TomlSource& source) {
  std::optional<UnknownKey> unknown;
  std::vector<std::string> names_at_top = names_of(top_keys());
  for_each_table<Tables>([&](const std::string& table, auto keys, auto) {
    names_at_top.push_back(table);
    if (const toml::table* content = source.root().get_as<toml::table>(table)) {
      find_unknown_keys(*content, table, names_of(keys), unknown);
    }
  });
  find_unknown_keys(source.root(), "", names_at_top, unknown);
  if (!unknown) {
    return;
  }
  std::vector<std::string> allowed = names_at_top;
  for_each_table<Tables>([&](const std::string& table, auto keys, auto) {
    if (table == unknown->table) {
      allowed = names_of(keys);
    }
  });
  constexpr std::size_t kShownLimit = 80;
  source.fail(
      unknown->position,
      fmt::format("unknown key {}; nearest known key: {}; allowed {}: {}",
                  printable(unknown->path, kShownLimit), nearest_key(unknown->path, known_paths<Tables>()),
                  unknown->table.empty() ? "at the top" : "in [" + unknown->table + "]",
                  fmt::join(allowed, ", ")));
}

// ---- reading

template <typename Target>
void read_default(const Key<Target>& key, const std::string& path, Target& target) {
  const TomlSource source(fmt::format("value = {}", key.absence.default_toml), "default values",
                          TomlSource::Origin::built_in);
  key.read(TomlValue(source, *source.root().get("value"), path, key.allowed), target);
}

/// Reads the keys of one table into `target`. `table` is null when the file does not have it.
template <typename Target>
void read_table(const TomlSource& source, const toml::table* table, const std::string& table_name,
                std::span<const Key<Target>> keys, Target& target,
                std::map<std::string, Position>& positions) {
  for (const Key<Target>& key : keys) {
    const std::string path =
        table_name.empty() ? std::string(key.name) : fmt::format("{}.{}", table_name, key.name);
    if (const toml::node* node = table != nullptr ? table->get(key.name) : nullptr) {
      const TomlValue value(source, *node, path, key.allowed);
      key.read(value, target);
      positions[path] = value.position();
    } else if (key.absence.rule == Absence::Rule::is_default) {
      read_default(key, path, target);
    } else if (key.absence.rule == Absence::Rule::is_an_error) {
      if (table == nullptr) {
        source.fail(source.end(), fmt::format("missing table [{}]; allowed: a table with {}", table_name,
                                              fmt::join(names_of(keys), ", ")));
      }
      const Position start = table_name.empty() ? Position{1, 1} : to_position(table->source().begin);
      source.fail(start, fmt::format("missing key {}; allowed: {}", path, key.allowed));
    }
  }
}

/// The table of that name, null when there is none. Throws InputError when it is something else.
const toml::table* find_table(const TomlSource& source, const std::string& name) {
  const toml::node* node = source.root().get(name);
  if (node == nullptr) {
    return nullptr;
  }
  if (!node->is_table()) {
    const std::string allowed = fmt::format("a table, [{}]", name);
    TomlValue(source, *node, name, allowed).refuse_kind();
  }
  return node->as_table();
}

/// The tables that the file should have: those of its tracker. A tracker that is missing or unknown is
/// reported when the key is read; until then the file is taken for one of the first tracker.
decltype(Design::tables) expected_tables(const TomlSource& source) {
  const auto tracker = source.root()["tracker"].value<std::string_view>();
  return make_tables(tracker.value_or("")).value_or(decltype(Design::tables){});
}

/// Where a table of the file begins.
Position start_of(const TomlSource& source, const std::string& table) {
  return to_position(find_table(source, table)->source().begin);
}

/// What no single key can say. Throws InputError.
template <typename Tables>
void check_together(const TomlSource& /*source*/, const Tables& /*tables*/) {}

void check_together(const TomlSource& source, const SingleChannelEkfTables& tables) {
  const SingleChannelEkfDesign& design = tables.design;
  const bool by_variances = design.variances.has_value();
  const bool by_ratio = design.lambda.has_value();
  const bool consistent = by_ratio ? !design.q && !design.r && !by_variances
                                   : design.r.has_value() && design.q.has_value() != by_variances;
  if (!consistent) {
    source.fail(
        start_of(source, "design"),
        "the keys of [design] do not go together; allowed: q and r; or lambda = r/q alone (q = 1); or "
        "r with process_noise = { q1 = ..., q2 = ... }");
  }
}

template <typename Tables>
void read_tables(const TomlSource& source, Design& design, Tables& tables) {
  reject_unknown_keys<Tables>(source);
  read_table(source, &source.root(), "", top_keys(), design, design.positions);
  for_each_table<Tables>([&](const std::string& name, auto keys, auto member) {
    read_table(source, find_table(source, name), name, keys, tables.*member, design.positions);
  });
  check_together(source, tables);
}

}  // namespace

Design read_design(std::string_view text, std::string_view file_name) {
  const TomlSource source(text, file_name);
  const rigor::UpwardRounding upward;
  Design design;
  design.tables = expected_tables(source);
  std::visit([&](auto& tables) { read_tables(source, design, tables); }, design.tables);
  return design;
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
