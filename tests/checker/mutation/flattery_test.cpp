// Certificates that say a little more, step by step, until they are refused.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "tests/checker/mutation/changes.hpp"

using namespace veritrack;
using namespace veritrack::test;

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
    const Pointer quantity("/derivations/1/quantities/" + name + (name == "largest_ell" ? "/lo" : "/hi"));
    double number = number_of(certificate[quantity]);
    int steps = 0;
    for (bool refused = false; !refused && steps < 20; ++steps) {
      number *= factor;
      Json changed = certificate;
      // Wherever it stands: as a quantity, as a side of a condition, as evidence of a claim.
      const std::string before = certificate[quantity];
      for (const Pointer& at : places(certificate)) {
        if (certificate[at] == before) {
          changed[at] = hexadecimal(number);
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
  const Pointer evidence("/derivations/0/evidence/1");
  const Pointer box = evidence / "matrices" / "boxes" / 0;
  const auto with = [&](const Pointer& at, double value) {
    Json changed = certificate;
    changed[at] = hexadecimal(value);
    return changed;
  };
  Count count;
  expect_refused(with(box / 6, 5.0), "captured a sample sooner", count);
  expect_refused(with(box / 7, 0.85 * number_of(certificate[box / 7])), "captured at a smaller level", count);
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
    const Json two{{"lo", "0x1p+1"}, {"hi", "0x1p+1"}};
    for (const char* owner : {"/derivations/0/quantities", "/claims/0/evidence"}) {
      for (const char* name : {"cells", "cells_captured"}) {
        changed[Pointer(owner) / name].update(two);
      }
    }
    CHECK(verified(changed) == (gap == 0.0));
  }
}
