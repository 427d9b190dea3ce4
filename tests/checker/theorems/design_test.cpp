// Designs of a quadrature tracker that are refused as they are read, and what is known of those that are not.
#include "checker/theorems/design.hpp"

#include <doctest/doctest.h>

#include <map>
#include <string>

using namespace veritrack::checker;

namespace {

struct Number {
  std::string text, value;
};

std::string json_of(const Number& number) {
  return R"({"text": ")" + number.text + R"(", "lo": ")" + number.value + R"(", "hi": ")" + number.value +
         "\"}";
}

struct WrittenDesign {
  std::map<std::string, Number> numbers{{"q1", {"0.5", "0x1p-1"}},
                                        {"q2", {"0.5", "0x1p-1"}},
                                        {"r", {"1", "0x1p+0"}},
                                        {"epsilon", {"0", "0x0p+0"}},
                                        {"amplitude", {"1", "0x1p+0"}}};
};

struct Answer {
  Design design;
  Objections objections;
};
Answer read(const WrittenDesign& written) {
  const std::string one = json_of({"1", "0x1p+0"});
  const auto number = [&](const char* name) {
    return std::string("\"") + name + "\": " + json_of(written.numbers.at(name));
  };
  const Tree tree = read_json(
      R"({"design": {)" + number("q1") + "," + number("q2") + "," + number("r") + "," + number("epsilon") +
      R"(}, "assume": {)" + number("amplitude") + R"(, "frequency": [)" + one + "," + one +
      R"(], "noise": )" + one + R"(, "slew": )" + one + R"(, "initial_amplitude_error": )" + one +
      R"(, "initial_phase_error": )" + one + R"(, "initial_frequency_error": )" + one +
      R"(, "initial_covariance": "steady-state"}, "theorem_2_9": {"R_x": )" + one + R"(, "sigma": )" + one +
      R"(, "gamma_fraction": )" + one + R"(, "c1": )" + one + R"(, "c2": )" + one + "}}");
  Answer answer;
  answer.design = read_design(tree, answer.objections);
  return answer;
}

}  // namespace

TEST_CASE("q1 and q2 are the same only in the units of the signal") {
  WrittenDesign written;
  CHECK(read(written).objections.empty());
  CHECK(read(written).design.q1_equals_q2);
  written.numbers.at("amplitude") = {"2", "0x1p+1"};
  CHECK(read(written).objections.empty());
  CHECK_FALSE(read(written).design.q1_equals_q2);
  CHECK(certainly_equal(read(written).design.q1, Ball(0.125)));
}

TEST_CASE("a leak is not all that there is") {
  WrittenDesign written;
  written.numbers.at("epsilon") = {"1", "0x1p+0"};
  CHECK(read(written).objections.size() == 1);
}

TEST_CASE("noise is Gaussian when it is no number") {
  CHECK(is_gaussian(read_json(R"({"noise": {"snr_db": {}}})")));
  CHECK_FALSE(is_gaussian(read_json(R"({"noise": )" + json_of({"0.75", "0x1.8p-1"}) + "}")));
}
