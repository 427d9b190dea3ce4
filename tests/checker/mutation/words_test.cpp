// Members of an accepted certificate: words changed, members left out, added or doubled, one at a time. What
// is then not proved must not be verified.
#include <doctest/doctest.h>

#include <array>
#include <string>
#include <utility>

#include "tests/checker/mutation/changes.hpp"

using namespace veritrack;
using namespace veritrack::test;

namespace {

/// Refused, or verified and saying no more.
void expect_no_more(const std::string& subject, const Json& certificate, const Json& changed,
                    const std::string& what, Count& count) {
  if (!verified(changed)) {
    ++count.refused;
    return;
  }
  ++count.harmless;
  CHECK_MESSAGE(says_no_more(changed, certificate), subject << ": " << what << " is verified");
}

void report(const Subject& subject, const Count& count, const char* what) {
  MESSAGE(std::string(subject.name) << ": " << count.refused << " " + std::string(what) + " refused, "
                                    << count.harmless << " leave no more claimed");
}

}  // namespace

TEST_CASE("words that say something else") {
  for (const Subject& subject : subjects()) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    const auto is_word = [&](const Pointer& at) {
      return !is_quoted(at) && (certificate[at].is_boolean() ||
                                (certificate[at].is_string() && !is_hexadecimal(certificate[at])));
    };
    for (const Pointer& at : places_to_change(subject, certificate, is_word)) {
      Json changed = certificate;
      if (certificate[at].is_boolean()) {
        changed[at] = !certificate[at].get<bool>();
        expect_no_more(name, certificate, changed, at.to_string(), count);
        continue;
      }
      const std::string text = certificate[at];
      if (at.back() == "verdict") {
        for (const char* verdict : {"proved", "refuted", "undecided", "nothing-required"}) {
          changed[at] = verdict;
          if (text != verdict) {
            expect_refused(changed, name + ": " + at.to_string() + " said to be " + verdict, count);
          }
        }
        continue;
      }
      for (const std::string& other : {text + "!", "1.001" + text, std::string()}) {
        changed[at] = other;
        expect_no_more(name, certificate, changed, at.to_string() + " changed to " + other, count);
      }
    }
    report(subject, count, "changed words");
    CHECK(count.refused > 0);
  }
}

TEST_CASE("what is left out") {
  for (const Subject& subject : subjects()) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    // Without disturbance it is another design, and the sentences say so.
    const auto may_be_needed = [](const Pointer& at) {
      return !at.empty() && at.to_string() != "/design/assume/disturbance";
    };
    for (const Pointer& at : places_to_change(subject, certificate, may_be_needed)) {
      Json changed = certificate;
      Json& parent = changed[at.parent_pointer()];
      if (parent.is_object()) {
        parent.erase(at.back());
      } else {
        parent.erase(std::stoul(at.back()));
      }
      expect_no_more(name, certificate, changed, at.to_string() + " left out", count);
    }
    report(subject, count, "omissions");
  }
}

TEST_CASE("what is added") {
  for (const Subject& subject : subjects()) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    const auto is_object = [&](const Pointer& at) { return certificate[at].is_object(); };
    for (const Pointer& at : places_to_change(subject, certificate, is_object)) {
      static const std::array values{Json("PROVED"), Json(nullptr),  Json(true),
                                     Json::array(),  Json::object(), Json{{"lo", "0x0p+0"}}};
      const Json& value = values[static_cast<std::size_t>(count.refused) % values.size()];
      Json changed = certificate;
      changed[at]["unheard-of"] = value;
      expect_refused(changed, name + ": " + value.dump() + " in " + at.to_string(), count);
    }
    report(subject, count, "additions");
  }
}

TEST_CASE("what is said twice") {
  for (const Subject& subject : subjects()) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    const auto is_element = [&](const Pointer& at) {
      return !at.empty() && certificate[at.parent_pointer()].is_array();
    };
    for (const Pointer& at : places_to_change(subject, certificate, is_element)) {
      Json changed = certificate;
      changed[at.parent_pointer()].push_back(certificate[at]);
      const std::string place = at.to_string();
      if (is_evidence(at)) {
        expect_no_more(name, certificate, changed, place + " said twice", count);
      } else {
        expect_refused(changed, name + ": " + place + " said twice", count);
      }
    }
    report(subject, count, "repetitions");
  }
}

TEST_CASE("duplicate keys are malformed, the order of keys means nothing, that of conditions does") {
  int duplicates = 0;
  for (const Subject& subject : subjects()) {
    const std::string text = accepted(subject.name).dump();
    for (std::size_t at = text.find("{\""); at != std::string::npos; at = text.find("{\"", at + 1)) {
      // The first key of the object once more, before it, with the harmless value null.
      const std::size_t end = text.find('"', at + 2);
      const std::string doubled =
          text.substr(0, at + 1) + text.substr(at + 1, end - at) + ":null," + text.substr(at + 1);
      CHECK_THROWS_AS((void)checker::read_json(doubled), checker::Malformed);
      ++duplicates;
    }
  }
  MESSAGE(duplicates << " duplicate keys malformed");
  const Json certificate = accepted("theorem-2.9");
  const nlohmann::json sorted = nlohmann::json::parse(certificate.dump());
  CHECK(checker::verify(checker::read_json(sorted.dump())).verified());
  Json swapped = certificate;
  std::swap(swapped["derivations"][0]["conditions"][0], swapped["derivations"][0]["conditions"][1]);
  CHECK(!verified(swapped));
}
