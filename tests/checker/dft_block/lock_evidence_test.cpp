// Evidence for the lock of the block tracker that cannot be any: refused before a cell is looked at.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <utility>

#include "checker/dft_block/block_design.hpp"
#include "checker/dft_block/block_matrices.hpp"
#include "checker/dft_block/bounded_lock_check.hpp"
#include "checker/dft_block/lock_loss_check.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::checker {
namespace {

using Json = nlohmann::json;

const Objections kNoSet{"the evidence is no set"};

Json accepted_block(const std::string& name) {
  return Json::parse(test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/" + name));
}

/// The objections to the derivation, with this number in the evidence of this place; no cell is examined.
Objections objections_with(Json certificate, std::size_t place, const std::string& name,
                           const std::string& number) {
  Json& numbers = certificate["derivations"][0]["evidence"][place]["numbers"];
  REQUIRE(numbers.contains(name));
  numbers[name] = number;
  const Tree tree = read_json(certificate.dump());
  Objections of_design;
  const BlockDesign design(tree.at("design"), of_design);
  REQUIRE(of_design.empty());
  const Tree& derivation = tree.at("derivations").at(0);
  Objections objections;
  std::int64_t cells = 0;
  if (design.is_gaussian()) {
    (void)lock_in_noise(
        derivation, design.problem(),
        {design.deviation(), design.blocks(), design.start().errors, design.start().covariance}, cells,
        objections);
  } else {
    (void)lock_set(derivation, design.problem(), design.start(), cells, objections);
  }
  CHECK(cells == 0);
  return objections;
}

}  // namespace

TEST_CASE("a late stage has limits above 0 and bounds of the covariance between 1 and those of its set") {
  const Json certificate = accepted_block("dft-block.json");
  const std::string above = certificate["derivations"][0]["evidence"][1]["numbers"]["above"];
  using Change = std::pair<std::string, std::string>;
  for (const Change& change :
       {Change{"radius", "0x0p+0"}, Change{"limit_1", "0x0p+0"}, Change{"limit_3", "-0x1p-5"},
        Change{"next_above", "0x1.fffffep-1"}, Change{"next_above", "-0x1p+0"}, Change{"next_above", above},
        Change{"next_below", "0x1.fffffep-1"}, Change{"next_below", above},
        Change{"noise_weight", "0x0p+0"}}) {
    CAPTURE(change.first);
    CAPTURE(change.second);
    CHECK(objections_with(certificate, 1, change.first, change.second) == kNoSet);
  }
}

TEST_CASE("a drift has a growth between 0 and 1, and numbers above 0") {
  const Json certificate = accepted_block("dft-block-gaussian.json");
  for (const char* name : {"radius", "tilt", "growth", "weight", "floor_weight", "slew_share"}) {
    CAPTURE(name);
    CHECK(objections_with(certificate, 0, name, "0x0p+0") == kNoSet);
    CHECK(objections_with(certificate, 0, name, "-0x1p-1") == kNoSet);
  }
  CHECK(objections_with(certificate, 0, "growth", "0x1p+0") == kNoSet);
}

TEST_CASE("a floor of the process noise counts only below the bound of the covariance") {
  BlockProblem problem;
  problem.q1 = problem.q2 = problem.q3 = Ball(20.0);
  problem.r = problem.amplitude_low = problem.amplitude_high = one;
  problem.noise = Ball(0.25);
  problem.slew = zero;
  const auto disturbance = [&](double floor, double above) {
    const BlockSet set{identity(one), Ball(above), one, Ball(floor)};
    return BlockLock(problem, set).disturbance();
  };
  // sqrt((a - q)/r) times the noise.
  CHECK(disturbance(1.0, 5.0).near() == doctest::Approx(0.5));
  CHECK(disturbance(0.0, 4.0).near() == doctest::Approx(0.5));
  CHECK_FALSE(disturbance(1.0, 1.0).finite());
  CHECK_FALSE(disturbance(1.0, 0.5).finite());
  CHECK_FALSE(disturbance(-1.0, 4.0).finite());
  CHECK_FALSE(disturbance(20.0, 25.0).finite());
}

TEST_CASE("noise is assumed for a block at least") {
  for (const auto& [text, number] : {std::pair("1", "0x1p+0"), std::pair("0.5", "0x1p-1")}) {
    Json design = accepted_block("dft-block-gaussian.json")["design"];
    design["assume"]["blocks"] = {{"text", text}, {"lo", number}, {"hi", number}};
    const Tree tree = read_json(design.dump());
    Objections objections;
    const BlockDesign read(tree, objections);
    CHECK(objections == (text == std::string("1") ? Objections{} : Objections{"blocks must be at least 1"}));
  }
}

}  // namespace veritrack::checker
