#include "reports/comparison/contract_values.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/reports/comparison/values.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;           // NOLINT(google-build-using-namespace)
using namespace veritrack::reports;  // NOLINT(google-build-using-namespace)
using certificates::KeyContract;
using certificates::Measure;
using certificates::MemberContract;
using certificates::Stronger;
using rigor::Interval;
using test::number;
using Json = nlohmann::ordered_json;

Relation relation(const Json& before, const Json& after, const KeyContract& contract) {
  const rigor::UpwardRounding upward;
  return relation_of({&before}, {&after}, contract);
}

Json range(const char* low, const char* high) {
  return Json::array({number(low), number(high)});
}

TEST_CASE("a number is stronger on the side that its key names") {
  for (const auto& [stronger, up] :
       {std::pair(Stronger::larger, Relation::stronger), std::pair(Stronger::smaller, Relation::weaker),
        std::pair(Stronger::only_equal, Relation::incomparable),
        std::pair(Stronger::unknown, Relation::incomparable),
        std::pair(Stronger::neither, Relation::equal)}) {
    CHECK((relation(number("40"), number("400"), {stronger}) == up));
    CHECK((relation(number("0.10"), number("0.1"), {stronger}) == Relation::equal));
  }
  CHECK((relation(number("400"), number("40"), {Stronger::larger}) == Relation::weaker));
  CHECK((relation(number("400"), number("40"), {Stronger::smaller}) == Relation::stronger));
}

TEST_CASE("a difference in the sixteenth digit is one") {
  CHECK((relation(number("0.02"), number("0.01999999999999999"), {Stronger::larger}) == Relation::weaker));
}

TEST_CASE("what is left out asks for nothing and covers nothing") {
  const rigor::UpwardRounding upward;
  const Json value = number("1");
  for (const Stronger stronger : {Stronger::larger, Stronger::smaller, Stronger::wider}) {
    CHECK((relation_of({&value}, {}, {stronger}) == Relation::weaker));
    CHECK((relation_of({}, {&value}, {stronger}) == Relation::stronger));
  }
  for (const Stronger stronger : {Stronger::only_equal, Stronger::unknown}) {
    CHECK((relation_of({&value}, {}, {stronger}) == Relation::incomparable));
    CHECK((relation_of({}, {&value}, {stronger}) == Relation::incomparable));
  }
}

TEST_CASE("a range has to hold the other one") {
  const KeyContract wider{Stronger::wider};
  const Json band = range("0.1", "0.3");
  CHECK((relation(band, range("0.1", "0.4"), wider) == Relation::stronger));
  CHECK((relation(band, range("0.05", "0.4"), wider) == Relation::stronger));
  CHECK((relation(band, range("0.1", "0.2"), wider) == Relation::weaker));
  CHECK((relation(band, range("0.15", "0.25"), wider) == Relation::weaker));
  CHECK((relation(band, range("0.2", "0.4"), wider) == Relation::incomparable));
  CHECK((relation(band, range("0.10", "0.30"), wider) == Relation::equal));
}

TEST_CASE("one amplitude covers less than one in a range, and that less than one that varies") {
  const KeyContract wider{Stronger::wider};
  const Json one = number("1");
  const Json constant{{"constant", range("0.5", "2")}};
  const Json varying = range("0.5", "2");
  CHECK((relation(one, constant, wider) == Relation::stronger));
  CHECK((relation(constant, varying, wider) == Relation::stronger));
  CHECK((relation(varying, constant, wider) == Relation::weaker));
  CHECK((relation(varying, one, wider) == Relation::weaker));
  CHECK((relation(one, number("2"), wider) == Relation::incomparable));
  CHECK((relation(varying, Json{{"constant", range("0.4", "2")}}, wider) == Relation::incomparable));
}

TEST_CASE("multiples of the steady state hold it; matrices are equal or cannot be compared") {
  const KeyContract wider{Stronger::wider};
  const Json multiples{{"from", number("0.5")}, {"to", number("2")}};
  CHECK((relation("steady-state", multiples, wider) == Relation::stronger));
  CHECK((relation(multiples, "steady-state", wider) == Relation::weaker));
  CHECK((relation("steady-state", "steady-state", wider) == Relation::equal));
  const Json rows = Json::array({range("1", "0"), range("0", "1"), range("0", "1")});
  Json others = rows;
  others[0][0] = number("2");
  CHECK((relation(rows, rows, wider) == Relation::equal));
  CHECK((relation(rows, others, wider) == Relation::incomparable));
  CHECK((relation(rows, "steady-state", wider) == Relation::incomparable));
}

TEST_CASE("inline tables are compared by their members, and different ones cannot be") {
  constexpr std::array kMembers{MemberContract{"snr_db", Stronger::smaller},
                                MemberContract{"deviation", Stronger::larger},
                                MemberContract{"free", Stronger::neither}};
  const KeyContract noise{Stronger::larger, Measure::plain, kMembers};
  const Json ratio{{"snr_db", number("17")}};
  CHECK((relation(ratio, Json{{"snr_db", number("20")}}, noise) == Relation::weaker));
  CHECK((relation(ratio, Json{{"snr_db", number("14")}}, noise) == Relation::stronger));
  CHECK((relation(ratio, Json{{"deviation", number("0.1")}}, noise) == Relation::incomparable));
  CHECK((relation(ratio, number("0.1"), noise) == Relation::incomparable));
  CHECK((relation(number("0.1"), number("0.2"), noise) == Relation::stronger));
  CHECK((relation(Json{{"else", "a"}}, Json{{"else", "b"}}, noise) == Relation::incomparable));
  CHECK((relation(Json{{"free", "a"}, {"snr_db", number("17")}},
                  Json{{"free", "b"}, {"snr_db", number("17")}}, noise) == Relation::equal));
  CHECK((relation(Json{{"snr_db", number("17")}, {"deviation", number("1")}},
                  Json{{"snr_db", number("16")}, {"deviation", number("0.5")}},
                  noise) == Relation::incomparable));
}

TEST_CASE("Hz and rad/sample are compared by the sample rate, and two rates in Hz and seconds") {
  const rigor::UpwardRounding upward;
  const Json forty = test::hertz("40", 0.031415926535897932385);  // at 8 kHz
  const Json less = number("0.0314");
  const Json more = number("0.0315");
  const ContractValue hertz{&forty, false, Interval(8000.0)};
  const KeyContract below{Stronger::smaller, Measure::frequency};
  CHECK((relation_of(hertz, {&less, false, Interval(8000.0)}, below) == Relation::stronger));
  CHECK((relation_of(hertz, {&more, false, Interval(8000.0)}, below) == Relation::weaker));
  CHECK((relation_of(hertz, {&more}, below) == Relation::weaker));
  const Json same_at_16_khz = test::hertz("40", 0.015707963267948966192);
  CHECK((relation_of(hertz, {&same_at_16_khz, false, Interval(16000.0)}, below) == Relation::equal));
  // The same number of rad/sample is twice as many Hz.
  CHECK((relation_of({&less, false, Interval(8000.0)}, {&less, false, Interval(16000.0)}, below) ==
         Relation::weaker));
  const Json samples = number("200");
  const KeyContract within{Stronger::smaller, Measure::samples};
  CHECK((relation_of({&samples, false, Interval(8000.0)}, {&samples, false, Interval(16000.0)}, within) ==
         Relation::stronger));
  const Json band = range("100", "200");
  const KeyContract wider{Stronger::wider, Measure::frequency};
  const Json sampled = range("0.0786", "0.157");
  CHECK((relation_of({&band, true, Interval(8000.0)}, {&sampled, false, Interval(8000.0)}, wider) ==
         Relation::weaker));
  CHECK((relation_of({&band, true}, {&sampled}, wider) == Relation::incomparable));
}

TEST_CASE("what is not a number cannot be compared") {
  const Json broken{{"text", "1"}, {"lo", "nan"}, {"hi", "nan"}};
  CHECK((relation(broken, number("1"), {Stronger::larger}) == Relation::incomparable));
  CHECK((relation(number("1"), broken, {Stronger::smaller}) == Relation::incomparable));
  CHECK((relation(number("1"), "one", {Stronger::larger}) == Relation::incomparable));
}

TEST_CASE("formulas that are numbers have an order, others are equal or cannot be compared") {
  const rigor::UpwardRounding upward;
  const std::string small = "0.01";
  const std::string large = "0.1";
  const std::string formula = "w0/2";
  CHECK((relation_of_formulas(&small, &large) == Relation::stronger));
  CHECK((relation_of_formulas(&large, &small) == Relation::weaker));
  CHECK((relation_of_formulas(&large, nullptr) == Relation::weaker));
  CHECK((relation_of_formulas(nullptr, &large) == Relation::stronger));
  CHECK((relation_of_formulas(&formula, &formula) == Relation::equal));
  CHECK((relation_of_formulas(&formula, &large) == Relation::incomparable));
}

TEST_CASE("there and back: what is weaker one way is stronger the other way") {
  test::Random random;
  const auto some = [&] { return std::to_string(random.below(5)); };
  for (std::int64_t i = 0; i < test::effort(300); ++i) {
    for (const Stronger stronger : {Stronger::larger, Stronger::smaller, Stronger::wider}) {
      const Json a = stronger == Stronger::wider ? range(some().c_str(), "7") : number(some());
      const Json b = stronger == Stronger::wider ? range(some().c_str(), "7") : number(some());
      const Relation there = relation(a, b, {stronger});
      const Relation back = relation(b, a, {stronger});
      CHECK(((there == Relation::stronger) == (back == Relation::weaker)));
      CHECK(((there == Relation::equal) == (back == Relation::equal)));
    }
  }
}

}  // namespace
