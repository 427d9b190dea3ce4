#include "papers/reproductions/entry.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace veritrack::reports {
namespace {

constexpr PrintedNumber kNumber{"paper/table/1", "paper, Table 1", "a number", "2.50"};
constexpr PrintedSentence kSentence{"paper/claim", "paper", "a claim"};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// `size` values about `mean`, half of them on either side.
std::vector<double> values(int size, double mean, double deviation) {
  std::vector<double> result;
  for (int i = 0; i < size; ++i) {
    result.push_back(mean + (i % 2 == 0 ? deviation : -deviation));
  }
  return result;
}

TEST_CASE("a printed number has a value and a last digit") {
  CHECK(kNumber.value() == 2.5);
  CHECK(kNumber.half_unit() == doctest::Approx(0.005));
  CHECK(PrintedNumber{"", "", "", "-3"}.half_unit() == 0.5);
  CHECK_THROWS_AS((void)(PrintedNumber{"", "", "", "2,5"}).value(), std::invalid_argument);
}

TEST_CASE("a number of one run has to lie among the runs") {
  std::vector<double> runs;
  for (int i = 0; i < 400; ++i) {
    runs.push_back(0.01 * i);  // 0 to 3.99
  }
  CHECK(among_runs(kNumber, runs).comes_out == ComesOut::yes);
  CHECK(among_runs({"", "", "", "5.0"}, runs).comes_out == ComesOut::no);
  CHECK(among_runs({"", "", "", "-1.0"}, runs).comes_out == ComesOut::no);
  CHECK(among_runs({"", "", "", "3.93"}, runs).comes_out == ComesOut::undecided);  // about 2 % beyond
  // Ten runs cannot say that it is outside, and NaN is large.
  CHECK(among_runs({"", "", "", "5.0"}, std::vector<double>(runs.begin(), runs.begin() + 10)).comes_out ==
        ComesOut::undecided);
  CHECK(among_runs(kNumber, std::vector<double>(400, kNan)).comes_out == ComesOut::no);
}

TEST_CASE("means: two standard errors of the difference, and enough runs to say the same") {
  CHECK(same_mean(kNumber, 0.1, 1000, values(1000, 2.5, 0.1)).comes_out == ComesOut::yes);
  CHECK(same_mean(kNumber, 0.1, 1000, values(1000, 2.53, 0.1)).comes_out == ComesOut::no);
  CHECK(same_mean(kNumber, 0.1, 1000, values(1000, 2.53, 0.1), 0.05).comes_out == ComesOut::yes);
  CHECK(same_mean(kNumber, 0.1, 1000, values(4, 2.53, 1.0)).comes_out == ComesOut::undecided);
  CHECK(same_mean(kNumber, 0.1, 1000, values(1, 2.5, 0.0)).comes_out == ComesOut::undecided);
  CHECK(same_mean(kNumber, 0.1, 1000, values(10, kNan, 0.0)).comes_out == ComesOut::no);
}

TEST_CASE("numbers without chance are compared after rounding") {
  CHECK(same_number(kNumber, 2.5049).comes_out == ComesOut::yes);
  CHECK(same_number(kNumber, 2.5051).comes_out == ComesOut::no);
  CHECK(same_number(kNumber, kNan).comes_out == ComesOut::no);
  CHECK(near_number(kNumber, 2.6, 0.05).comes_out == ComesOut::yes);
  CHECK(near_number(kNumber, 2.7, 0.05).comes_out == ComesOut::no);
}

TEST_CASE("sentences: usually, always, never, sometimes") {
  const auto held = [](int yes, int no) {
    std::vector<bool> result(static_cast<std::size_t>(yes), true);
    result.insert(result.end(), static_cast<std::size_t>(no), false);
    return result;
  };
  CHECK(share_of_runs(Claimed::usually, held(80, 20)).comes_out == ComesOut::yes);
  CHECK(share_of_runs(Claimed::usually, held(20, 80)).comes_out == ComesOut::no);
  CHECK(share_of_runs(Claimed::usually, held(50, 50)).comes_out == ComesOut::undecided);
  CHECK(share_of_runs(Claimed::always, held(100, 0)).comes_out == ComesOut::yes);
  CHECK(share_of_runs(Claimed::always, held(99, 0)).comes_out == ComesOut::undecided);
  CHECK(share_of_runs(Claimed::always, held(5, 1)).comes_out == ComesOut::no);
  CHECK(share_of_runs(Claimed::never, held(0, 100)).comes_out == ComesOut::yes);
  CHECK(share_of_runs(Claimed::never, held(1, 5)).comes_out == ComesOut::no);
  CHECK(share_of_runs(Claimed::sometimes, held(10, 90)).comes_out == ComesOut::yes);
  CHECK(share_of_runs(Claimed::sometimes, held(0, 1000)).comes_out == ComesOut::no);
  CHECK(share_near(0.68, 0.1, held(680, 320)).comes_out == ComesOut::yes);
  CHECK(share_near(0.68, 0.1, held(400, 600)).comes_out == ComesOut::no);
  CHECK(share_near(0.68, 0.1, held(7, 3)).comes_out == ComesOut::undecided);
}

TEST_CASE("which of two means is smaller") {
  CHECK(smaller_mean(values(100, 1.0, 0.1), values(100, 2.0, 0.2)).comes_out == ComesOut::yes);
  CHECK(smaller_mean(values(100, 2.0, 0.1), values(100, 1.0, 0.2)).comes_out == ComesOut::no);
  CHECK(smaller_mean(values(4, 1.0, 0.1), values(4, 1.01, 3.0)).comes_out == ComesOut::undecided);
  CHECK_THROWS_AS((void)smaller_mean(values(4, 1.0, 0.1), values(3, 1.0, 0.1)), std::invalid_argument);
}

TEST_CASE("the verdict: what comes out agrees; what does not depends on whose the conditions are") {
  const Conditions chosen{Conditions::Kind::chosen, "the signal is unpublished"};
  const Conditions searched{Conditions::Kind::searched, "for either signal"};
  CHECK(verdict_words(entry_of(kNumber, decided(true, ""), chosen)) == "**agrees**");
  CHECK(verdict_words(entry_of(kNumber, decided(false, ""))) == "**does not agree**");
  CHECK(verdict_words(entry_of(kNumber, decided(false, ""), chosen)) ==
        "cannot be compared, because the signal is unpublished");
  CHECK(verdict_words(entry_of(kSentence, decided(false, ""), searched)) ==
        "**does not agree**, for either signal");
  CHECK(verdict_words(entry_of(kSentence, {}, searched)) == "undecided: too few runs");
}

TEST_CASE("a deviation supports nothing where its mean cannot be compared") {
  constexpr Conditions kChosen{Conditions::Kind::chosen, "the signal is unpublished"};
  const Entry right = entry_of(kNumber, {ComesOut::yes, "2.5"}, kChosen);
  const Entry other = entry_of(kNumber, {ComesOut::no, "9"}, kChosen);
  CHECK(beside_mean(right, right).verdict == EntryVerdict::agrees);
  CHECK(beside_mean(right, other).verdict == EntryVerdict::cannot_be_compared);
  CHECK(verdict_words(beside_mean(right, other)) ==
        "cannot be compared, because the mean beside it does not come out");
  CHECK(beside_mean(other, other).because == "the signal is unpublished");
  CHECK(beside_mean(entry_of(kNumber, {ComesOut::undecided, "?"}), other).verdict == EntryVerdict::undecided);
}

TEST_CASE("counts, warnings and the table") {
  const std::array<Entry, 3> entries{entry_of(kNumber, decided(true, "2.5")), entry_of(kSentence, {}),
                                     entry_of(kNumber, decided(true, "2.5"))};
  CHECK(count_sentence(entries) == "2 of 3 entries agree, 1 is undecided.");
  CHECK(count_sentence(entries, "a signal fitted to this table") ==
        "With a signal fitted to this table, 2 of 3 entries agree, 1 is undecided.");
  CHECK(too_few_runs(entries, 1).find("1 run is too few for 1 of the 3 entries") == 0);
  CHECK(too_few_runs(entries, 5).find("5 runs are too few for 1 of the 3 entries") == 0);
  CHECK(too_few_runs(std::span(entries).first(1), 5).empty());
  CHECK(entry_table(entries).find("`paper/table/1`") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
