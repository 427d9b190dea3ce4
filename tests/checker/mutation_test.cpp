// Every number and word of an accepted certificate that means something, changed one at a time: what is then
// not proved must not be verified.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"
#include "tests/support/random.hpp"

namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;
using namespace veritrack;

Json accepted(const std::string& name) {
  return Json::parse(test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/" + name + ".json"));
}

bool verified(const std::string& text) {
  try {
    return checker::verify(checker::read_json(text)).verified();
  } catch (const checker::Malformed&) {
    return false;
  }
}
bool verified(const Json& certificate) {
  return verified(certificate.dump());
}

/// All values with the keys and indices that lead to them, outermost first.
void collect(const Json& value, const Pointer& at, std::vector<Pointer>& found) {
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
std::vector<Pointer> places(const Json& certificate) {
  std::vector<Pointer> found;
  collect(certificate, Pointer(), found);
  return found;
}

/// The accepted certificates that are checked in milliseconds. Of the one with hundreds of numbers every
/// eleventh place, more with VERITRACK_TEST_EFFORT; of the one that takes a tenth of a second every fourth of
/// those that are not in "one-set" as well, of the KKL observer every third, and every seventh
/// of the single-channel tracker over all phases.
constexpr std::array kNames{"theorem-2.9",  "one-set",   "capture",       "published", "repaired",
                            "kkl-observer", "kkl-paper", "frozen-filter", "phases"};
std::vector<Pointer> places_to_change(const std::string& name, const Json& certificate) {
  std::vector<Pointer> all = places(certificate);
  static const std::map<std::string, std::int64_t> strides{
      {"published", 11}, {"capture", 4}, {"kkl-observer", 3}, {"phases", 7}};
  const auto slow = strides.find(name);
  if (slow == strides.end()) {
    return all;
  }
  const auto stride = static_cast<std::size_t>(std::max<std::int64_t>(1, slow->second / test::effort(1)));
  std::vector<Pointer> some;
  std::size_t count = 0;
  for (const Pointer& at : all) {
    const std::string text = at.to_string();
    const bool elsewhere =
        name == "capture" && (text.starts_with("/certified_sets") || text.starts_with("/design"));
    if (!elsewhere && count++ % stride == 0) {
      some.push_back(at);
    }
  }
  return some;
}

/// Evidence: what still proves everything when it is changed is other evidence.
bool is_evidence(const std::string& place) {
  return place.starts_with("/certified_sets/") ||
         (place.starts_with("/derivations/") && place.find("/evidence/") != std::string::npos);
}

/// Bounds on the KKL observer's errors, and the time from which they hold: what is a little better may be
/// proved anew, on the checker's own cells.
bool is_kkl_bound(const std::string& name, const Pointer& at) {
  static const std::set<std::string> bounds{"frequency_error_bound", "amplitude_error_bound", "settling_time",
                                            "largest_ell", "lhs"};
  return name == "kkl-observer" && bounds.count(at.back()) != 0 &&
         at.to_string().starts_with("/derivations/1/");
}

std::string hexadecimal(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}
bool is_hexadecimal(const Json& value) {
  return value.is_string() && value.get<std::string>().find("0x") < 2;
}

double number_of(const Json& value) {
  return std::strtod(value.get<std::string>().c_str(), nullptr);
}

/// What words, not numbers, say: the grounds, for people. The checker does not read them, and says so.
bool is_prose(const Pointer& at) {
  static const std::set<std::string> prose{"reason",   "symbol", "formula", "source", "notes",
                                           "argument", "name",   "file",    "line",   "default"};
  const std::string text = at.to_string();
  return prose.count(at.back()) != 0 || text.find("/notes/") != std::string::npos ||
         text.starts_with("/design/simulate") || text.find("/not_applicable/") != std::string::npos;
}

/// A change in one place, and whether it leaves a certificate that claims no more than was proved.
struct Count {
  int refused = 0, harmless = 0;
};

void expect_refused(const Json& changed, const std::string& what, Count& count) {
  const bool accepted = verified(changed);
  CHECK_MESSAGE(!accepted, what << " is verified");
  count.refused += accepted ? 0 : 1;
}

}  // namespace

TEST_CASE("numbers one part in a thousand away") {
  for (const char* name : kNames) {
    const Json certificate = accepted(name);
    REQUIRE(verified(certificate));
    Count count;
    for (const Pointer& at : places_to_change(name, certificate)) {
      const Json& value = certificate[at];
      if (!is_hexadecimal(value)) {
        continue;
      }
      const double number = number_of(value);
      for (const double factor : {1.001, 0.999}) {
        Json changed = certificate;
        changed[at] = hexadecimal(number == 0.0 ? factor - 1.0 : number * factor);
        const std::string text = at.to_string();
        if (!verified(changed)) {
          ++count.refused;
          continue;
        }
        ++count.harmless;
        // Harmless: an end of an enclosure moved outward, which the decimals beside it do not allow; or
        // another set, of which everything that the certificate says was proved anew.
        // Or an end of an enclosure so wide that it holds the value all the same.
        const Json& owner = certificate[at.parent_pointer()];
        const bool wide = owner.is_object() && owner.contains("hi") &&
                          std::fabs(number_of(owner["hi"]) - number_of(owner["lo"])) >
                              1e-3 * std::fabs(number_of(owner["hi"]));
        const bool another_set = is_evidence(text);
        CHECK_MESSAGE((another_set || wide), text << " times " << factor << " is verified");
      }
    }
    MESSAGE(std::string(name) << ": " << count.refused << " changed numbers refused, " << count.harmless
                              << " proved anew as another set");
    CHECK(count.refused > 5);
  }
}

TEST_CASE("a set made larger, faster or tougher step by step is refused before it is twice as good") {
  const Json certificate = accepted("one-set");
  const std::map<std::string, double> flattering{
      {"radius", 1.1}, {"noise", 2.0}, {"rate", 0.99}, {"noise_gain", 0.9}};
  for (const auto& change : flattering) {
    const std::string& key = change.first;
    const double factor = change.second;
    const Pointer at("/certified_sets/0/" + key);
    double number = std::strtod(certificate[at].get<std::string>().c_str(), nullptr);
    bool refused = false;
    for (int i = 0; i < 60 && !refused; ++i) {
      number *= factor;
      Json changed = certificate;
      changed[at] = hexadecimal(number);
      refused = !verified(changed);
      if (refused) {
        MESSAGE(key << " is refused after " << i + 1 << " steps of " << factor);
      }
    }
    CHECK_MESSAGE(refused, key);
  }
}

TEST_CASE("a bound of the KKL observer made better step by step is refused before it is a third better") {
  const Json certificate = accepted("kkl-observer");
  const std::map<std::string, double> flattering{{"frequency_error_bound", 0.98},
                                                 {"amplitude_error_bound", 0.98},
                                                 {"largest_ell", 1.02},
                                                 {"settling_time", 0.95}};
  for (const auto& change : flattering) {
    const std::string& name = change.first;
    const double factor = change.second;
    double number = number_of(certificate[Pointer("/derivations/1/quantities/" + name + "/hi")]);
    int steps = 0;
    for (bool refused = false; !refused && steps < 20; ++steps) {
      number *= factor;
      Json changed = certificate;
      // Wherever it stands: as a quantity, as a side of a condition, as evidence of a claim.
      const std::string before = certificate[Pointer("/derivations/1/quantities/" + name + "/hi")];
      for (const Pointer& at : places(certificate)) {
        if (certificate[at] == before) {
          changed[at] = hexadecimal(number);
          changed[at.parent_pointer() / "decimal"] = "[-1e300, 1e300]";
        }
      }
      refused = !verified(changed);
    }
    MESSAGE(name << " is refused after " << steps << " steps of " << factor);
    CHECK_MESSAGE(steps < 20, name);
  }
}

TEST_CASE("starts captured sooner, nearer, from a cover with a gap, or under less noise are refused") {
  const Json certificate = accepted("capture");
  const Pointer evidence("/derivations/0/evidence/0");
  const Pointer box = evidence / "matrices" / "boxes" / 0;
  const auto with = [&](const Pointer& at, double value) {
    Json changed = certificate;
    changed[at] = hexadecimal(value);
    return changed;
  };
  Count count;
  expect_refused(with(box / 6, 5.0), "captured a sample sooner", count);
  expect_refused(with(box / 7, 0.99 * number_of(certificate[box / 7])), "captured at a smaller level", count);
  expect_refused(with(box / 7, -number_of(certificate[box / 7])), "captured at a negative level", count);
  expect_refused(with(evidence / "numbers" / "noise", 0.0), "followed without noise", count);
  for (std::size_t side = 0; side < 6; ++side) {
    expect_refused(with(box / side, 0.9 * number_of(certificate[box / side])), "a smaller box", count);
  }
  // Two boxes that meet, and two with a gap between them.
  for (const double gap : {0.0, 1e-9}) {
    Json changed = certificate;
    Json& boxes = changed[evidence / "matrices" / "boxes"];
    boxes.push_back(boxes[0]);
    boxes[0][5] = hexadecimal(0.001);
    boxes[1][4] = hexadecimal(0.001 + gap);
    const Json two{{"lo", "0x1p+1"}, {"hi", "0x1p+1"}, {"decimal", "[2, 2]"}};
    for (const char* owner : {"/derivations/0/quantities", "/claims/0/evidence"}) {
      for (const char* name : {"cells", "cells_captured"}) {
        changed[Pointer(owner) / name].update(two);
      }
    }
    CHECK(verified(changed) == (gap == 0.0));
  }
}

TEST_CASE("decimals, texts and statements that say more") {
  for (const char* name : kNames) {
    const Json certificate = accepted(name);
    Count count;
    for (const Pointer& at : places_to_change(name, certificate)) {
      const Json& value = certificate[at];
      if (at.empty() || is_prose(at) || !value.is_string() || is_hexadecimal(value)) {
        continue;
      }
      const std::string text = value.get<std::string>();
      Json changed = certificate;
      if (at.back() == "decimal") {
        changed[at] = "[0.1234, 0.1235]";
      } else if (at.back() == "text" && text != "0.0") {
        changed[at] = "1.001" + text;  // another number
      } else if (at.back() == "verdict") {
        for (const char* verdict : {"proved", "refuted"}) {
          if (text != verdict) {
            changed[at] = verdict;
            expect_refused(changed, at.to_string() + " said to be " + verdict, count);
          }
        }
        continue;
      } else {
        // Of an undecided claim the words claim nothing, nor does what a set was made for.
        const Json& parent = certificate[at.parent_pointer()];
        const bool claims_nothing = parent.contains("verdict") && parent["verdict"] == "undecided" &&
                                    at.to_string().starts_with("/claims/") && at.back() == "statement";
        if (claims_nothing || at.back() == "purpose") {
          continue;
        }
        changed[at] = text + "!";
      }
      expect_refused(changed, at.to_string(), count);
    }
    MESSAGE(std::string(name) << ": " << count.refused << " changed words refused");
    CHECK(count.refused > 5);
  }
}

TEST_CASE("whole enclosures moved, and whole design values, consistently") {
  for (const char* name : kNames) {
    const Json certificate = accepted(name);
    Count count;
    for (const Pointer& at : places_to_change(name, certificate)) {
      const Json& value = certificate[at];
      if (!value.is_object() || !value.contains("lo") || at.to_string().starts_with("/design/simulate")) {
        continue;
      }
      const auto end = [&](const char* key) {
        return std::strtod(value[key].get<std::string>().c_str(), nullptr);
      };
      for (const double factor : {1.001, 0.999}) {
        Json changed = certificate;
        Json& moved = changed[at];
        const bool zero = end("lo") == 0.0 && end("hi") == 0.0;
        moved["lo"] = hexadecimal(zero ? 1e-3 : std::nextafter(end("lo") * factor, -HUGE_VAL));
        moved["hi"] = hexadecimal(zero ? 1e-3 : std::nextafter(end("hi") * factor, HUGE_VAL));
        moved["decimal"] = "[-1e300, 1e300]";
        if (value.contains("text")) {
          char text[40];
          const double number =
              zero ? 1e-3 : std::strtod(value["text"].get<std::string>().c_str(), nullptr) * factor;
          std::snprintf(text, sizeof text, "%.17g", number);
          moved["text"] = text;
          moved["lo"] = hexadecimal(std::nextafter(number, -HUGE_VAL));
          moved["hi"] = hexadecimal(std::nextafter(number, HUGE_VAL));
        }
        if (!verified(changed)) {
          ++count.refused;
          continue;
        }
        ++count.harmless;
        // A bound made weaker (lhs: of an inequality that is proved all the same); another design, of which
        // everything that is said was proved anew; or another point of the search, at which the value is the
        // same to as many digits as the enclosure has.
        static const std::set<std::string> from_above{"capture_samples",
                                                      "frequency_error_bound",
                                                      "amplitude_error_bound",
                                                      "settling_time",
                                                      "injectivity_constant",
                                                      "continuity_modulus",
                                                      "s",
                                                      "curvature",
                                                      "process_gain",
                                                      "measurement_gain",
                                                      "rate",
                                                      "p_sound_printed",
                                                      "p_sound_errata",
                                                      "predicted_bound",
                                                      "ultimate_frequency_error",
                                                      "settling_samples",
                                                      "lhs"};
        static const std::set<std::string> from_below{"one_minus_alpha", "noise_bound",
                                                      "process_noise_bound"};
        const bool weaker = (factor > 1.0 || zero ? from_above : from_below).count(at.back()) != 0;
        const bool another_design = value.contains("text");
        // An enclosure wider than the change may hold the value before and after.
        const bool wide = end("hi") - end("lo") > 1e-3 * std::fabs(end("hi"));
        const bool another_point = at.to_string().find("/best_found/") != std::string::npos ||
                                   at.to_string().find("/witness/") != std::string::npos;
        const bool another_bound = is_kkl_bound(name, at);
        CHECK_MESSAGE((weaker || wide || another_design || another_point || another_bound),
                      at.to_string() << " times " << factor << " is verified");
      }
    }
    MESSAGE(std::string(name) << ": " << count.refused << " moves refused, " << count.harmless
                              << " weaker bounds or other designs proved anew");
  }
}

TEST_CASE("what is dropped") {
  // What may go: a statement nobody else needs, and what is only for people.
  const auto may_go = [](const std::string& text) {
    const auto inside = [&](const char* start, std::ptrdiff_t depth) {
      return text.starts_with(start) && std::count(text.begin(), text.end(), '/') == depth;
    };
    return inside("/claims/", 2) || inside("/comparison/", 2) || inside("/derivations/", 2) ||
           text.find("/quantities/") != std::string::npos || text.ends_with("/lhs") ||
           text.ends_with("/rhs") || text == "/design/assume/disturbance" ||
           text.find("/feasibility") != std::string::npos || text.ends_with("/not_applicable") ||
           inside("/comparison/", 3) || text.find("/evidence/") != std::string::npos;
  };
  for (const char* name : kNames) {
    const Json certificate = accepted(name);
    Count count;
    for (const Pointer& at : places_to_change(name, certificate)) {
      if (at.empty() || is_prose(at) || at.to_string().starts_with("/audits") ||
          at.to_string() == "/design/source") {
        continue;
      }
      Json changed = certificate;
      Json& parent = changed[at.parent_pointer()];
      if (parent.is_object()) {
        parent.erase(at.back());
      } else {
        parent.erase(std::stoul(at.back()));
      }
      const bool required = at.to_string().starts_with("/claims/") && certificate[at].is_object() &&
                            certificate[at].value("required", false);
      if (verified(changed)) {
        ++count.harmless;
        const Json& owner = certificate[at.parent_pointer()];
        const bool of_undecided_claim = at.to_string().starts_with("/claims/") && owner.is_object() &&
                                        owner.value("verdict", "") == "undecided";
        CHECK_MESSAGE((of_undecided_claim || (may_go(at.to_string()) && !required)),
                      at.to_string() << " dropped is verified");
      } else {
        ++count.refused;
      }
    }
    MESSAGE(std::string(name) << ": " << count.refused << " omissions refused, " << count.harmless
                              << " leave less claimed");
  }
}

TEST_CASE("duplicate keys are malformed, the order of keys means nothing, that of conditions does") {
  const Json certificate = accepted("theorem-2.9");
  const std::string text = certificate.dump();
  int duplicates = 0;
  for (std::size_t at = text.find("{\""); at != std::string::npos; at = text.find("{\"", at + 1)) {
    // The first key of the object once more, before it, with the harmless value null.
    const std::size_t end = text.find('"', at + 2);
    const std::string doubled =
        text.substr(0, at + 1) + text.substr(at + 1, end - at) + ":null," + text.substr(at + 1);
    CHECK_THROWS_AS((void)checker::read_json(doubled), checker::Malformed);
    ++duplicates;
  }
  MESSAGE(duplicates << " duplicate keys malformed");
  const nlohmann::json sorted = nlohmann::json::parse(text);
  CHECK(verified(sorted.dump()));
  Json swapped = certificate;
  std::swap(swapped["derivations"][0]["conditions"][0], swapped["derivations"][0]["conditions"][1]);
  CHECK(!verified(swapped));
  Json twice = certificate;
  twice["derivations"].push_back(twice["derivations"][0]);
  CHECK(!verified(twice));
}
