// Numbers and enclosures of an accepted certificate, changed one at a time: what is then not proved must not
// be verified.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "tests/checker/mutation/changes.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::test;

/// Evidence: what still proves everything when it is changed is other evidence.
bool is_evidence(const std::string& place) {
  return place.starts_with("/certified_sets/") ||
         (place.starts_with("/derivations/") && place.find("/evidence/") != std::string::npos);
}

/// Bounds on the KKL observer's errors, and the time from which they are true: what is a little better may be
/// proved anew, on the checker's own cells.
bool is_kkl_bound(const std::string& name, const Pointer& at) {
  static const std::set<std::string> bounds{"frequency_error_bound", "amplitude_error_bound", "settling_time",
                                            "largest_ell", "lhs"};
  return name == "kkl-observer" && bounds.count(at.back()) != 0 &&
         at.to_string().starts_with("/derivations/1/");
}

bool is_zero(const Json& enclosure) {
  return number_of(enclosure["lo"]) == 0.0 && number_of(enclosure["hi"]) == 0.0;
}

/// An enclosure of another number; a number of the design with its text.
void move(Json& enclosure, double factor) {
  const bool zero = is_zero(enclosure);
  double low = number_of(enclosure["lo"]) * factor;
  double high = number_of(enclosure["hi"]) * factor;
  if (enclosure.contains("text")) {
    low = high = zero ? 1e-3 : number_of(enclosure["text"]) * factor;
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", low);
    enclosure["text"] = text;
    enclosure["lo"] = hexadecimal(std::nextafter(low, -HUGE_VAL));
    enclosure["hi"] = hexadecimal(std::nextafter(high, HUGE_VAL));
  } else {
    enclosure["lo"] = hexadecimal(zero ? 1e-3 : std::nextafter(low, -HUGE_VAL));
    enclosure["hi"] = hexadecimal(zero ? 1e-3 : std::nextafter(high, HUGE_VAL));
  }
  enclosure["decimal"] = "[-1e300, 1e300]";
}

/// A bound made weaker (lhs: of an inequality that is proved all the same); another design, of which
/// everything that is said was proved anew; an enclosure wider than the change, which may contain the value
/// before and after; or another point of the search, at which the value is the same to as many digits as the
/// enclosure has.
bool says_no_more(const Json& enclosure, const Pointer& at, double factor) {
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
  static const std::set<std::string> from_below{"one_minus_alpha", "noise_bound", "process_noise_bound"};
  const bool weaker = (factor > 1.0 || is_zero(enclosure) ? from_above : from_below).count(at.back()) != 0;
  const double high = number_of(enclosure["hi"]);
  const bool wide = high - number_of(enclosure["lo"]) > 1e-3 * std::fabs(high);
  const std::string text = at.to_string();
  return weaker || wide || enclosure.contains("text") || text.find("/best_found/") != std::string::npos ||
         text.find("/witness/") != std::string::npos;
}

}  // namespace

TEST_CASE("numbers one part in a thousand away") {
  for (const Subject& subject : kSubjects) {
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
        const std::string text = at.to_string();
        if (!verified(changed)) {
          ++count.refused;
          continue;
        }
        ++count.harmless;
        // Harmless: an end of an enclosure moved outward, which the decimals beside it do not allow; or
        // another set, of which everything that the certificate says was proved anew.
        // Or an end of an enclosure so wide that it contains the value all the same.
        const Json& owner = certificate[at.parent_pointer()];
        const bool wide = owner.is_object() && owner.contains("hi") &&
                          std::fabs(number_of(owner["hi"]) - number_of(owner["lo"])) >
                              1e-3 * std::fabs(number_of(owner["hi"]));
        const bool another_set = is_evidence(text);
        CHECK_MESSAGE((another_set || wide), text << " times " << factor << " is verified");
      }
    }
    MESSAGE(name << ": " << count.refused << " changed numbers refused, " << count.harmless
                 << " proved anew as another set");
    CHECK(count.refused > 0);
  }
}

TEST_CASE("whole enclosures moved, and whole design values, consistently") {
  for (const Subject& subject : kSubjects) {
    const std::string name = subject.name;
    const Json certificate = accepted(name);
    Count count;
    const auto is_enclosure = [&](const Pointer& at) {
      const Json& value = certificate[at];
      return value.is_object() && value.contains("lo") && !at.to_string().starts_with("/design/simulate");
    };
    for (const Pointer& at : places_to_change(subject, certificate, is_enclosure)) {
      for (const double factor : {1.001, 0.999}) {
        Json changed = certificate;
        move(changed[at], factor);
        if (!verified(changed)) {
          ++count.refused;
          continue;
        }
        ++count.harmless;
        CHECK_MESSAGE((says_no_more(certificate[at], at, factor) || is_kkl_bound(name, at)),
                      at.to_string() << " times " << factor << " is verified");
      }
    }
    MESSAGE(name << ": " << count.refused << " moves refused, " << count.harmless
                 << " weaker bounds or other designs proved anew");
  }
}
