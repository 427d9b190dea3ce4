// Words of an accepted certificate, changed or left out one at a time: what is then not proved must not be
// verified.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "tests/checker/mutation/changes.hpp"

using namespace veritrack;
using namespace veritrack::test;

TEST_CASE("decimals, texts and statements that say more") {
  for (const Subject& subject : kSubjects) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    const auto is_text = [&](const Pointer& at) {
      return !at.empty() && !is_prose(at) && certificate[at].is_string() && !is_hexadecimal(certificate[at]);
    };
    for (const Pointer& at : places_to_change(subject, certificate, is_text)) {
      const std::string text = certificate[at];
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
    MESSAGE(name << ": " << count.refused << " changed words refused");
    CHECK(count.refused > 0);
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
  for (const Subject& subject : kSubjects) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    const auto is_read = [](const Pointer& at) {
      return !at.empty() && !is_prose(at) && !at.to_string().starts_with("/audits") &&
             at.to_string() != "/design/source";
    };
    for (const Pointer& at : places_to_change(subject, certificate, is_read)) {
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
    MESSAGE(name << ": " << count.refused << " omissions refused, " << count.harmless
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
  CHECK(checker::verify(checker::read_json(sorted.dump())).verified());
  Json swapped = certificate;
  std::swap(swapped["derivations"][0]["conditions"][0], swapped["derivations"][0]["conditions"][1]);
  CHECK(!verified(swapped));
  Json twice = certificate;
  twice["derivations"].push_back(twice["derivations"][0]);
  CHECK(!verified(twice));
}
