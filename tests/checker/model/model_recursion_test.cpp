// The checker's recursion of a model against the program's: each reads the design file in its own way, and
// writes filters out in its own way.
#include "checker/model/model_recursion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/model/model.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

std::vector<std::filesystem::path> designs_of_models() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(VERITRACK_SOURCE_DIR) /
                                                               "designs" / "models")) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<Ball> balls(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

/// Whether the double is within a part in 10^9 of the ball.
bool agree(double program, const Ball& checker) {
  return checker.finite() && std::abs(program - checker.near()) <= 1e-9 * (1.0 + std::abs(program)) &&
         certainly_less(checker.radius(), Ball(1e-9 * (1.0 + std::abs(program))));
}

TEST_CASE("the checker computes the step of every model as the program does") {
  REQUIRE_FALSE(designs_of_models().empty());
  for (const std::filesystem::path& path : designs_of_models()) {
    CAPTURE(path);
    const rigor::UpwardRounding upward;
    const certificates::Design design = certificates::read_design_file(path);
    const certificates::ModelTables& tables = certificates::model_tables(design);
    const certificates::Model model = certificates::make_model(tables.model, tables.assume.signal);
    const Tree json = read_json(certificates::kind_of(design).design_json(design).dump());
    const ModelRecursion checker(json.at("model"));
    REQUIRE(checker.states() == model.states.size());
    CHECK(checker.state_names() == model.states);
    CHECK(checker.is_angle() == model.recursion.is_angle);
    const rigor::NearestRounding nearest;
    std::vector<double> constants;
    for (const certificates::language::Constant& constant : model.constants) {
      constants.push_back(constant.nearest);
    }
    std::vector<double> inputs = constants;
    const double omega = 0.3;
    inputs.insert(inputs.end(), {1.0, omega});
    std::vector<double> registers;
    std::vector<double> state(model.states.size());
    model.start.run(std::span<const double>(inputs), registers, std::span(state));
    test::Random random(51);
    bool steps_agree = true;
    for (int k = 1; k <= 50; ++k) {
      std::vector<double> sample(model.samples.size());
      inputs = constants;
      inputs.insert(inputs.end(), {1.0, omega * k});
      model.signal.run(std::span<const double>(inputs), registers, std::span(sample));
      const std::vector<Ball> signal = checker.signal<Ball>(Ball(1.0), Ball(omega * k));
      for (std::size_t c = 0; c < sample.size(); ++c) {
        steps_agree = steps_agree && agree(sample[c], signal[c]);
        sample[c] += random.uniform(-0.01, 0.01);
      }
      trackers::ModelTracker<double> program(model.recursion, constants, state);
      program.step(std::span<const double>(sample));
      const std::vector<Ball> next = checker.next(balls(state), balls(sample));
      state = program.state();
      REQUIRE(next.size() == state.size());
      for (std::size_t i = 0; i < state.size(); ++i) {
        steps_agree = steps_agree && agree(state[i], next[i]);
      }
      steps_agree = steps_agree && agree(program.frequency(), checker.frequency(balls(state)));
    }
    CHECK(steps_agree);
  }
}

/// A model with these members changed.
Tree changed(const std::string& change) {
  const auto member = [&](const std::string& name, const std::string& value) {
    const std::string key = "\"" + name + "\":";
    return change.starts_with(key) ? change : key + value;
  };
  return read_json("{" + member("samples", R"json(["y"])json") + "," +
                   member("parameters", R"json([{"name":"k","formula":"1/3"}])json") + "," +
                   member("angles", R"json(["x"])json") + "," + member("frequency", R"json("x")json") + "," +
                   member("signal", R"json(["A*cos(phi)"])json") + "," +
                   member("states", R"json(["x"])json") + "," + member("step", R"json("x' = x + k*y")json") +
                   "}");
}

TEST_CASE("what is no model is refused") {
  CHECK_NOTHROW((void)ModelRecursion(changed("")));
  for (const char* change :
       {R"json("samples":[])json", R"json("samples":["y","z","u"])json", R"json("samples":["x"])json",
        R"json("samples":["k"])json", R"json("parameters":[{"name":"k","formula":"1/0"}])json",
        R"json("parameters":[{"name":"k","formula":"k"}])json",
        R"json("parameters":[{"name":"k","formula":"1"},{"name":"k","formula":"2"}])json",
        R"json("frequency":"y")json", R"json("signal":["A*cos(phi)","A*sin(phi)"])json",
        R"json("signal":["x"])json", R"json("states":[])json", R"json("states":["x","x"])json",
        R"json("states":["x","z"])json", R"json("step":"x' = x + z")json",
        R"json("step":"x' = x\nx' = y")json", R"json("step":"z' = x")json", R"json("step":"x' = x +")json",
        R"json("step":"x' = x\ny = 2")json", R"json("step":"x' = x\nk = 2")json"}) {
    CAPTURE(change);
    CHECK_THROWS_AS((void)ModelRecursion(changed(change)), FormulaError);
  }
}

}  // namespace
}  // namespace veritrack::checker
