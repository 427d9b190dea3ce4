// Numbers and enclosures of an accepted certificate, changed one at a time: what is then not proved must not
// be verified.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "tests/checker/mutation/changes.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::test;

/// An end of an enclosure so wide that it contains the value all the same.
bool is_wide(const Json& enclosure) {
  if (!enclosure.is_object() || !enclosure.contains("lo") || !enclosure.contains("hi")) {
    return false;
  }
  const double high = number_of(enclosure["hi"]);
  return high - number_of(enclosure["lo"]) > 1e-3 * std::fabs(high);
}

/// A number of a design: its text, and the tightest doubles around it. Of 17 digits, none is a double.
Json design_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  const double nearest = std::strtod(text, nullptr);
  // The decimal is on one side of the nearest double or the other; long double knows.
  const long double exact = std::strtold(text, nullptr);
  const double low = exact < nearest ? std::nextafter(nearest, -HUGE_VAL) : nearest;
  const double high = exact > nearest ? std::nextafter(nearest, HUGE_VAL) : nearest;
  return {{"text", text}, {"lo", hexadecimal(low)}, {"hi", hexadecimal(high)}};
}

}  // namespace

TEST_CASE("numbers one part in a thousand away") {
  for (const Subject& subject : subjects()) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    REQUIRE(verified(certificate));
    Count count;
    const auto is_number = [&](const Pointer& at) { return is_hexadecimal(certificate[at]); };
    for (const Pointer& at : places_to_change(subject, certificate, is_number)) {
      const double number = number_of(certificate[at]);
      for (const double factor : {1.001, 0.999}) {
        Json changed = certificate;
        changed[at] = hexadecimal(number == 0.0 ? factor - 1.0 : number * factor);
        if (!verified(changed)) {
          ++count.refused;
          continue;
        }
        ++count.harmless;
        CHECK_MESSAGE((says_no_more(changed, certificate) || is_proved_as_named(name, at) ||
                       is_wide(certificate[at.parent_pointer()])),
                      name << ": " << at.to_string() << " times " << factor << " is verified");
      }
    }
    MESSAGE(name << ": " << count.refused << " changed numbers refused, " << count.harmless
                 << " say less, or were proved anew");
    CHECK(count.refused + count.harmless > 0);
  }
}

TEST_CASE("numbers of the design: another design, of which everything is proved anew, or refused") {
  for (const Subject& subject : subjects()) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    const auto is_design_number = [&](const Pointer& at) {
      return certificate[at].is_object() && certificate[at].contains("text");
    };
    for (const Pointer& at : places_to_change(subject, certificate, is_design_number)) {
      const double number = number_of(certificate[at]["text"]);
      for (const double factor : {1.001, 0.999}) {
        Json changed = certificate;
        changed[at] = design_number(number == 0.0 ? std::fabs(factor - 1.0) : number * factor);
        if (!verified(changed)) {
          ++count.refused;
          continue;
        }
        ++count.harmless;
        // The same with the text alone, or with the enclosure alone, is another matter.
        Json half_changed = certificate;
        half_changed[at]["text"] = changed[at]["text"];
        expect_refused(half_changed, name + ": the text of " + at.to_string(), count);
        half_changed = changed;
        half_changed[at]["text"] = certificate[at]["text"];
        expect_refused(half_changed, name + ": the enclosure of " + at.to_string(), count);
      }
    }
    MESSAGE(name << ": " << count.refused << " other designs refused, " << count.harmless << " proved anew");
  }
}
