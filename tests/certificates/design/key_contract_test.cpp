#include "certificates/design/key_contract.hpp"

#include <doctest/doctest.h>

#include <any>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_format.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace {

using namespace veritrack;                // NOLINT(google-build-using-namespace)
using namespace veritrack::certificates;  // NOLINT(google-build-using-namespace)

/// Calls `tell(tracker, table, key)` for every key of every tracker.
template <typename Tell>
void for_each_key(const Tell& tell) {
  for (const DesignFormat* format : design_formats()) {
    std::any tables = format->empty_tables();
    for (const BoundTable& table : format->bind_tables(tables)) {
      for (const BoundKey& key : table.keys) {
        tell(*format, table, key);
      }
    }
  }
}

std::vector<std::filesystem::path> all_designs() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"designs", "tests/certificates"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(VERITRACK_SOURCE_DIR) / folder)) {
      const std::string name = entry.path().string();
      if (entry.path().extension() == ".toml" && name.find("malformed") == std::string::npos &&
          name.find("rejected") == std::string::npos) {
        files.push_back(entry.path());
      }
    }
  }
  return files;
}

}  // namespace

TEST_CASE("every key of every tracker says which of two values makes the stronger contract") {
  for_each_key([](const DesignFormat& format, const BoundTable& table, const BoundKey& key) {
    INFO(format.tracker, ": ", table.name, ".", key.name);
    CHECK((key.contract.stronger != Stronger::unknown));
    CHECK((contract_of(format.tracker, table.name, key.name).stronger == key.contract.stronger));
    for (const MemberContract& member : key.contract.members) {
      CHECK((member.stronger != Stronger::unknown));
    }
    // What is asked or assumed is part of the contract, and what is simulated is not.
    const bool is_contract = table.name == "assume" || table.name == "require";
    const bool is_none = table.name == "simulate" || table.name == "theorem_2_9";
    CHECK((!is_contract || key.contract.stronger != Stronger::neither));
    CHECK((!is_none || key.contract.stronger == Stronger::neither));
  });
}

TEST_CASE("what is required has the direction that its name says") {
  for_each_key([](const DesignFormat& format, const BoundTable& table, const BoundKey& key) {
    if (table.name != "require") {
      return;
    }
    INFO(format.tracker, ": ", key.name);
    const bool is_floor = key.name.ends_with("_at_least") || key.name.ends_with("_above");
    const bool is_ceiling = key.name.ends_with("_below") || key.name.ends_with("_within") ||
                            key.name == "settles_like";  // as what takes that time, or less
    REQUIRE(is_floor != is_ceiling);
    CHECK((key.contract.stronger == (is_floor ? Stronger::larger : Stronger::smaller)));
  });
}

TEST_CASE("what is no key has no direction") {
  CHECK((contract_of("quadrature-ekf", "assume", "nothing").stronger == Stronger::unknown));
  CHECK((contract_of("quadrature-ekf", "nothing", "noise").stronger == Stronger::unknown));
  CHECK((contract_of("nothing", "assume", "noise").stronger == Stronger::unknown));
}

TEST_CASE("certificate.json repeats every key of the contract that a design file gives") {
  const rigor::UpwardRounding upward;
  std::set<std::string> seen;
  for (const std::filesystem::path& file : all_designs()) {
    const Design design = [&] {
      const rigor::NearestRounding nearest;
      return read_design_file(file);
    }();
    const Json json = kind_of(design).design_json(design);
    for (const auto& [path, position] : design.positions) {
      const auto dot = path.find('.');
      if (dot == std::string::npos) {
        continue;
      }
      std::string table = path.substr(0, dot);
      const std::string key = path.substr(dot + 1);
      const Stronger stronger = contract_of(design.tracker, table, key).stronger;
      seen.insert(design.tracker + ": " + path);
      table = path == "assume.signal" ? "model" : table;
      INFO(file.string(), ": ", path);
      CHECK((stronger == Stronger::neither || stronger == Stronger::inner_design ||
             (json.contains(table) && json.at(table).contains(key))));
    }
  }
  // Written by the code that writes them for another tracker.
  const std::set<std::string> elsewhere{
      "single-channel-ekf: assume.amplitude", "single-channel-ekf: assume.initial_covariance",
      "single-channel-ekf: require.largest_slew_at_least", "model: require.largest_noise_at_least"};
  for_each_key([&](const DesignFormat& format, const BoundTable& table, const BoundKey& key) {
    const std::string name =
        std::string(format.tracker) + ": " + std::string(table.name) + "." + std::string(key.name);
    INFO("in no design file of the tests: ", name);
    CHECK((key.contract.stronger == Stronger::neither || seen.contains(name) || elsewhere.contains(name)));
  });
}
