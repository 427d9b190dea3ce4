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
  bool takes_a_second = false;  ///< to be verified once; changed only where tests have their full effort
};
inline constexpr std::array kSubjects{Subject{"theorem-2.9", 60},
                                      Subject{"one-set", 12},
                                      Subject{"given-covariance", 6},
                                      Subject{"settling", 4},
                                      Subject{"capture", 4},
                                      Subject{"contraction", 1, true},
                                      Subject{"published", 40},
                                      Subject{"repaired", 40},
                                      Subject{"kkl-observer", 8},
                                      Subject{"kkl-paper", 12},
                                      Subject{"frozen-filter", 100},
                                      Subject{"phases", 4},
                                      Subject{"steady-state", 1, true},
                                      Subject{"steady-set", 3},
                                      Subject{"lock", 3},
                                      Subject{"mean-square", 2, true},
                                      Subject{"mean-square-with-leak", 1, true},
                                      Subject{"model-observer", 3},
                                      Subject{"model-moving", 3},
                                      Subject{"model-gaussian", 3}};

/// Those that are changed with the effort that is asked for.
inline std::vector<Subject> subjects() {
  constexpr std::int64_t kWhole = 100;
  std::vector<Subject> chosen;
  for (const Subject& subject : kSubjects) {
    if (!subject.takes_a_second || effort(kWhole) >= kWhole) {
      chosen.push_back(subject);
    }
  }
  return chosen;
}

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

/// Some of the places that are asked for, drawn by chance: the same in every run.
inline std::vector<Pointer> places_to_change(const Subject& subject, const Json& certificate,
                                             const std::function<bool(const Pointer&)>& is_asked_for) {
  std::vector<Pointer> found = places(certificate);
  std::erase_if(found, [&](const Pointer& at) { return !is_asked_for(at); });
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

/// Texts that the checker quotes, and nothing rests on.
inline bool is_quoted(const Pointer& at) {
  static const std::set<std::string> quoted{"/design/name", "/design/source", "/design_sha256"};
  return quoted.count(at.to_string()) != 0;
}
/// What proves, and does not claim: when it is changed and everything is still proved, it is other evidence.
inline bool is_evidence(const Pointer& at) {
  const std::string text = at.to_string();
  return text.starts_with("/certified_sets/") || text.starts_with("/tubes/") ||
         (text.starts_with("/derivations/") && text.find("/evidence/") != std::string::npos);
}

/// Is every end of the changed value there, and no better, in the original one?
inline bool value_says_no_more(const Json& changed, const Json& original) {
  return std::all_of(changed.items().begin(), changed.items().end(), [&](const auto& end) {
    if (!original.contains(end.key())) {
      return false;
    }
    const double now = number_of(end.value());
    const double before = number_of(original[end.key()]);
    return end.key() == "lo" ? now <= before : now >= before;
  });
}
inline bool values_say_no_more(const Json& changed, const Json& original) {
  return std::all_of(changed.items().begin(), changed.items().end(), [&](const auto& value) {
    return original.contains(value.key()) && value_says_no_more(value.value(), original[value.key()]);
  });
}
/// The member is as it was, or is not there.
inline bool is_kept_or_dropped(const Json& changed, const Json& original, const char* name) {
  return !changed.contains(name) || (original.contains(name) && changed[name] == original[name]);
}
inline bool condition_says_no_more(const Json& changed, const Json& original) {
  const auto side = [&](const char* name) {
    return !changed.contains(name) ||
           (original.contains(name) && value_says_no_more(changed[name], original[name]));
  };
  return changed["verdict"] == original["verdict"] && side("lhs") && side("rhs");
}
/// Of each of them there was one with this id of which at least as much was said.
inline bool each_says_no_more(const Json& changed, const Json& original,
                              const std::function<bool(const Json&, const Json&)>& says_no_more) {
  return std::all_of(changed.begin(), changed.end(), [&](const Json& item) {
    const auto before = std::find_if(original.begin(), original.end(),
                                     [&](const Json& one_of) { return one_of["id"] == item["id"]; });
    return before != original.end() && says_no_more(item, *before);
  });
}
inline bool feasibility_says_no_more(const Json& changed, const Json& original) {
  const bool bound = !changed.contains("lower_bound") ||
                     (original.contains("lower_bound") &&
                      value_says_no_more(changed["lower_bound"], original["lower_bound"]));
  return changed["verdict"] == original["verdict"] && bound &&
         (!changed["every_design"].get<bool>() || original["every_design"].get<bool>());
}
inline bool derivation_says_no_more(const Json& changed, const Json& original) {
  const bool feasibility = !changed.contains("feasibility") ||
                           (original.contains("feasibility") &&
                            feasibility_says_no_more(changed["feasibility"], original["feasibility"]));
  return values_say_no_more(changed["quantities"], original["quantities"]) && feasibility &&
         each_says_no_more(changed["conditions"], original["conditions"], condition_says_no_more) &&
         is_kept_or_dropped(changed, original, "verdict");
}
inline bool claim_says_no_more(const Json& changed, const Json& original) {
  return changed["verdict"] == original["verdict"] && changed["required"] == original["required"] &&
         is_kept_or_dropped(changed, original, "frequency") &&
         values_say_no_more(changed["evidence"], original["evidence"]);
}
/// Of the same design. The evidence may be other evidence.
inline bool says_no_more(Json changed, Json original) {
  for (Json* certificate : {&changed, &original}) {
    (*certificate)["design"].erase("name");
    (*certificate)["design"].erase("source");
  }
  return changed["design"] == original["design"] && changed["verdict"] == original["verdict"] &&
         each_says_no_more(changed["derivations"], original["derivations"], derivation_says_no_more) &&
         each_says_no_more(changed["claims"], original["claims"], claim_says_no_more);
}

/// Numbers that the checker does not compute and compare: it proves the one that the certificate names, and a
/// little more than that may be true.
inline bool is_proved_as_named(const std::string& subject, const Pointer& at) {
  static const std::set<std::string> bounds{"frequency_error_bound", "amplitude_error_bound", "settling_time",
                                            "largest_ell", "lhs"};
  static const std::set<std::string> settling{"settling_samples", "settled_frequency_error"};
  const std::string owner = at.back() == "lo" || at.back() == "hi" ? at.parent_pointer().back() : at.back();
  // The level of the starts is stated with a hundredth more, so that the checker's own bound is below it.
  return settling.count(owner) != 0 ||
         ((subject == "lock" || subject == "mean-square" || subject == "mean-square-with-leak") &&
          (owner == "start_level" || owner == "lhs")) ||
         (subject == "kkl-observer" && bounds.count(owner) != 0 &&
          at.to_string().starts_with("/derivations/1/"));
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
