#include "reports/comparison/contract_changes.hpp"

#include <doctest/doctest.h>

#include <array>

#include "analysis/rigor/rounding.hpp"
#include "tests/reports/comparison/values.hpp"

namespace {

using namespace veritrack;           // NOLINT(google-build-using-namespace)
using namespace veritrack::reports;  // NOLINT(google-build-using-namespace)
using test::number;
using Json = nlohmann::ordered_json;
using ContractKind = ContractChange::Kind;

Json filter() {
  return {{"design",
           {{"name", "x"},
            {"tracker", "quadrature-ekf"},
            {"design", {{"q1", number("0.1")}}},
            {"assume", {{"amplitude", number("1")}, {"noise", number("0.02")}}},
            {"require", {{"frequency_error_below", number("0.05")}}}}}};
}

Json loop() {
  return {{"design",
           {{"name", "x"},
            {"tracker", "model"},
            {"model",
             {{"parameters", Json::array({{{"name", "k"}, {"formula", "0.1"}},
                                          {{"name", "T"}, {"formula", "1/rate"}},
                                          {{"name", "rate"}, {"formula", "8000"}}})},
              {"frequency", "w*T"},
              {"signal", Json::array({"A*cos(phi)"})},
              {"step", "e = y\nw' = w + k*e\n"}}},
            {"assume",
             {{"frequency", Json::array({number("100"), number("200")})},
              {"frequency_in_hertz", true},
              {"sample_rate", number("8000")},
              {"start_within", Json::array({{{"name", "w"}, {"formula", "0.1"}}})}}}}}};
}

std::vector<ContractChange> changes(const Json& before, const Json& after) {
  const rigor::UpwardRounding upward;
  return contract_changes(before, after);
}

/// The only change.
ContractChange change(const Json& before, const Json& after) {
  const auto all = changes(before, after);
  REQUIRE(all.size() == 1);
  return all.front();
}

TEST_CASE("the same design is the same contract") {
  CHECK(changes(filter(), filter()).empty());
  CHECK(changes(loop(), loop()).empty());
}

TEST_CASE("what is asked and assumed is told with both values and what became of it") {
  Json after = filter();
  after["design"]["require"]["frequency_error_below"] = number("0.5");
  const auto weaker = change(filter(), after);
  CHECK((weaker.kind == ContractKind::weaker));
  CHECK(weaker.key == "require.frequency_error_below");
  CHECK(weaker.text == "require.frequency_error_below: 0.05 -> 0.5 (asks for less)");
  CHECK((change(after, filter()).kind == ContractKind::stronger));

  after = filter();
  after["design"]["require"].erase("frequency_error_below");
  CHECK(change(filter(), after).text == "require.frequency_error_below: 0.05 -> not given (asks for less)");
  CHECK(change(after, filter()).text == "require.frequency_error_below: not given -> 0.05 (asks for more)");

  after = filter();
  after["design"]["assume"]["noise"] = number("0.01");
  CHECK(change(filter(), after).text == "assume.noise: 0.02 -> 0.01 (covers less)");
  CHECK(change(after, filter()).text == "assume.noise: 0.01 -> 0.02 (covers more)");
  after["design"]["assume"]["noise"] = Json{{"snr_db", number("30")}};
  CHECK(change(filter(), after).text == "assume.noise: 0.02 -> { snr_db = 30 } (cannot be compared)");
}

TEST_CASE("what the engineer chooses is no part of the contract") {
  Json after = filter();
  after["design"]["design"]["q1"] = number("0.2");
  const auto chosen = change(filter(), after);
  CHECK((chosen.kind == ContractKind::chosen));
  CHECK(chosen.text == "design.q1: 0.1 -> 0.2");
}

TEST_CASE("another tracker, and a key without a direction, make another contract") {
  Json after = filter();
  after["design"]["tracker"] = "single-channel-ekf";
  CHECK(change(filter(), after).text == "tracker: quadrature-ekf -> single-channel-ekf (cannot be compared)");
  after = filter();
  after["design"]["assume"]["weather"] = "fine";
  CHECK((change(filter(), after).kind == ContractKind::weaker));
  CHECK((change(after, filter()).kind == ContractKind::weaker));
}

TEST_CASE("a recursion is its formulas; gains may change, and what is assumed may not") {
  Json after = loop();
  after["design"]["model"]["step"] = "e = y\nw' = w + 2*k*e\n";
  CHECK(change(loop(), after).text ==
        "model.step: line 2: w' = w + k*e -> w' = w + 2*k*e (cannot be compared)");
  after = loop();
  after["design"]["model"]["parameters"][0]["formula"] = "0.2";
  CHECK((change(loop(), after).kind == ContractKind::chosen));
  CHECK(change(loop(), after).text == "model.parameters.k: 0.1 -> 0.2");
  // T is in the estimated frequency, and the rate in T.
  after = loop();
  after["design"]["model"]["parameters"][2]["formula"] = "16000";
  CHECK((change(loop(), after).kind == ContractKind::weaker));
  after = loop();
  after["design"]["model"]["signal"] = Json::array({"A*cos(phi) + 0.1*A*cos(2*phi)"});
  CHECK((change(loop(), after).kind == ContractKind::weaker));
  CHECK(change(loop(), after).key == "model.signal");
}

TEST_CASE("of a start set each state is compared") {
  Json after = loop();
  Json& start = after["design"]["assume"]["start_within"];
  start[0]["formula"] = "0.05";
  CHECK(change(loop(), after).text == "assume.start_within.w: 0.1 -> 0.05 (covers less)");
  CHECK(change(loop(), after).key == "assume.start_within");
  start.push_back({{"name", "theta"}, {"formula", "1"}});
  CHECK(changes(loop(), after).size() == 2);
  after["design"]["assume"].erase("start_within");
  CHECK(change(loop(), after).text == "assume.start_within.w: 0.1 -> not given (covers less)");
}

TEST_CASE("the band of a model in Hz and in rad/sample is one band") {
  Json after = loop();
  Json& assume = after["design"]["assume"];
  assume["frequency"] = Json::array({number("0.07"), number("0.16")});
  assume["frequency_in_hertz"] = false;
  CHECK((change(loop(), after).kind == ContractKind::stronger));
  assume["frequency"] = Json::array({number("0.08"), number("0.16")});
  CHECK((change(loop(), after).kind == ContractKind::weaker));
}

TEST_CASE("another sample rate is another contract, with the same band in Hz") {
  Json after = loop();
  after["design"]["assume"]["sample_rate"] = number("16000");
  CHECK(change(loop(), after).text == "assume.sample_rate: 8000 -> 16000 (cannot be compared)");
}

TEST_CASE("Q and R of a filter are chosen, its formulas are not") {
  Json before = loop();
  before["design"]["model"]["ekf"] = {
      {"predict", "x' = x"}, {"Q", Json::array({"q"})}, {"R", Json::array({"r"})}};
  Json after = before;
  after["design"]["model"]["ekf"]["Q"] = Json::array({"2*q"});
  CHECK((change(before, after).kind == ContractKind::chosen));
  CHECK(change(before, after).text == "model.ekf: { Q = [q] } -> { Q = [2*q] }");
  after["design"]["model"]["ekf"]["predict"] = "x' = 2*x";
  CHECK((change(before, after).kind == ContractKind::weaker));
}

TEST_CASE("the tracker of a regulator has its own keys") {
  Json before{{"design", {{"name", "r"}, {"tracker", "vibration-regulator"}}},
              {"frequency_tracker", filter()}};
  Json after = before;
  after["frequency_tracker"]["design"]["assume"]["noise"] = number("0.01");
  CHECK(change(before, after).key == "design.frequency_tracker.assume.noise");
  CHECK(change(before, after).text == "design.frequency_tracker.assume.noise: 0.02 -> 0.01 (covers less)");
  after.erase("frequency_tracker");
  CHECK((change(before, after).kind == ContractKind::weaker));
}

}  // namespace
