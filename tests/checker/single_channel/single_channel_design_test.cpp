// Designs of the single-channel tracker that are refused as they are read.
#include "checker/single_channel/single_channel_design.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/golden.hpp"

using namespace veritrack;

TEST_CASE("a leak of the single-channel tracker is below 1") {
  auto design = nlohmann::ordered_json::parse(
      test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/steady-state.json"))["design"];
  const auto objections_with = [&](const std::string& text, const std::string& value) {
    design["design"]["epsilon"]["text"] = text;
    design["design"]["epsilon"]["lo"] = design["design"]["epsilon"]["hi"] = value;
    checker::Objections objections;
    read_single_channel_design(checker::read_json(design.dump()), objections);
    return objections.size();
  };
  CHECK(objections_with("0.5", "0x1p-1") == 0);
  CHECK(objections_with("1", "0x1p+0") == 1);
}
