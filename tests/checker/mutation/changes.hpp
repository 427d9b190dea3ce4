// An accepted certificate, and changes of it one place at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

inline Json accepted(const std::string& name) {
  return Json::parse(read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/" + name + ".json"));
}

inline bool verified(const Json& certificate) {
  try {
    return checker::verify(checker::read_json(certificate.dump())).verified();
  } catch (const checker::Malformed&) {
    return false;
  }
}

/// An accepted certificate, and in how many places each test changes it: as many as cost it a second or two.
/// With VERITRACK_TEST_EFFORT=60 in all of them.
struct Subject {
  const char* name;
  std::int64_t places;
};
inline constexpr std::array kSubjects{
    Subject{"theorem-2.9", 100}, Subject{"one-set", 25},        Subject{"capture", 8},
    Subject{"published", 60},    Subject{"repaired", 80},       Subject{"kkl-observer", 16},
    Subject{"kkl-paper", 25},    Subject{"frozen-filter", 100}, Subject{"phases", 8}};

/// All values with the keys and indices on the way to them, outermost first.
inline void collect(const Json& value, const Pointer& at, std::vector<Pointer>& found) {
  found.push_back(at);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      collect(member, at / key, found);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      collect(value[i], at / i, found);
    }
  }
}
inline std::vector<Pointer> places(const Json& certificate) {
  std::vector<Pointer> found;
  collect(certificate, Pointer(), found);
  return found;
}

/// Some of the places that are asked for, drawn by chance: the same in every run. Of "capture" none that
/// "one-set" has as well.
inline std::vector<Pointer> places_to_change(const Subject& subject, const Json& certificate,
                                             const std::function<bool(const Pointer&)>& is_asked_for) {
  std::vector<Pointer> found = places(certificate);
  std::erase_if(found, [&](const Pointer& at) {
    const std::string text = at.to_string();
    const bool elsewhere = std::string(subject.name) == "capture" &&
                           (text.starts_with("/certified_sets") || text.starts_with("/design"));
    return elsewhere || !is_asked_for(at);
  });
  REQUIRE(!found.empty());
  const auto count = std::min(found.size(), static_cast<std::size_t>(effort(subject.places)));
  Random random;
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(found[i], found[i + random.below(found.size() - i)]);
  }
  found.resize(count);
  return found;
}

inline std::string hexadecimal(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}
inline bool is_hexadecimal(const Json& value) {
  return value.is_string() && value.get<std::string>().find("0x") < 2;
}
/// A hexadecimal number or a decimal.
inline double number_of(const Json& value) {
  return std::strtod(value.get<std::string>().c_str(), nullptr);
}

/// What words, not numbers, say: the grounds, for people. The checker does not read them, and says so.
inline bool is_prose(const Pointer& at) {
  static const std::set<std::string> prose{"reason",   "symbol", "formula", "source", "notes",
                                           "argument", "name",   "file",    "line",   "default"};
  const std::string text = at.to_string();
  return prose.count(at.back()) != 0 || text.find("/notes/") != std::string::npos ||
         text.starts_with("/design/simulate") || text.find("/not_applicable/") != std::string::npos;
}

/// Changes that were refused, and those that leave a certificate that claims no more than was proved.
struct Count {
  int refused = 0, harmless = 0;
};

inline void expect_refused(const Json& changed, const std::string& what, Count& count) {
  const bool is_accepted = verified(changed);
  CHECK_MESSAGE(!is_accepted, what << " is verified");
  count.refused += is_accepted ? 0 : 1;
}

}  // namespace veritrack::test
