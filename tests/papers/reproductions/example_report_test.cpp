#include "papers/reproductions/example_report.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "papers/reproductions/seed_share.hpp"

namespace veritrack::reports {
namespace {

StartRates rates_of(double frequency_only, double identity) {
  return {{"a start", 0.0, 0.0, 0.0, 1.0},
          {{"one", 1.0}, {"two", frequency_only}},
          {{"one", 1.0}, {"two", identity}}};
}

TEST_CASE("the sentence says which reading reproduces everything, whatever that is") {
  constexpr int kMany = 10'000;
  CHECK(reading_sentence({rates_of(0.05, 0.6)}, kMany).find("Only the reading Q = q diag(1, 1, 1)") !=
        std::string::npos);
  CHECK(reading_sentence({rates_of(0.6, 0.05)}, kMany).find("Only the reading Q = q diag(0, 0, 1)") !=
        std::string::npos);
  CHECK(reading_sentence({rates_of(0.6, 0.6)}, kMany).find("Either reading") != std::string::npos);
  CHECK(reading_sentence({rates_of(0.05, 0.05)}, kMany).find("Neither reading") != std::string::npos);
  CHECK(reading_sentence({rates_of(0.05, 0.05), rates_of(0.05, 0.12)}, kMany)
            .find("Only the reading Q = q diag(1, 1, 1)") != std::string::npos);
}

TEST_CASE("for the ledger: the seven statements at the examples' own noise, and the two slips, each once") {
  const Findings found = example_entries(40);
  std::set<std::string> ids;
  for (const Entry& entry : found.entries) {
    CAPTURE(entry.id);
    CHECK(ids.insert(entry.id).second);
    if (entry.id.find("/printed-") != std::string::npos) {
      CHECK(entry.verdict == EntryVerdict::does_not_agree);
      CHECK(entry.ours.find("0 of ") != std::string::npos);
      continue;
    }
    CHECK(entry.place.find(entry.id.find("example-1") != std::string::npos ? "Example 1" : "Example 2") !=
          std::string::npos);
    CHECK((entry.verdict == EntryVerdict::agrees || entry.verdict == EntryVerdict::undecided));
  }
  CHECK(ids.size() == 9);
}

TEST_CASE("few seeds decide nothing, and the sentence says so") {
  // 0 of 5 may well be a tenth; 3 of 5 certainly is more.
  CHECK(
      too_few_seeds({rates_of(0.0, 0.6)}, 5).find("5 seeds are too few to say whether Q = q diag(0, 0, 1)") ==
      0);
  CHECK(reading_sentence({rates_of(0.0, 0.6)}, 5) == too_few_seeds({rates_of(0.0, 0.6)}, 5));
  CHECK(too_few_seeds({rates_of(0.0, 0.6)}, 200).empty());
  CHECK(too_few_seeds({rates_of(0.1, 0.1)}, 200).find("Q = q diag(0, 0, 1) or Q = q diag(1, 1, 1)") !=
        std::string::npos);
}

TEST_CASE("the interval of a share: Wilson's, by its defining equation") {
  for (const int seeds : {1, 5, 200}) {
    for (const double share : {0.0, 0.2, 1.0}) {
      for (const double end : share_interval(share, seeds)) {
        CHECK((share - end) * (share - end) == doctest::Approx(4.0 * end * (1.0 - end) / seeds));
      }
    }
  }
}

}  // namespace
}  // namespace veritrack::reports
