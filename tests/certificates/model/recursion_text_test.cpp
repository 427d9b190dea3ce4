#include "certificates/model/recursion_text.hpp"

#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/model/model_design.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {

std::vector<std::filesystem::path> model_designs() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(VERITRACK_SOURCE_DIR) /
                                                               "designs" / "models")) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

Model model_of(const std::filesystem::path& path) {
  const rigor::UpwardRounding upward;
  const Design design = read_design_file(path);
  const ModelTables& tables = model_tables(design);
  return make_model(tables.model, tables.assume.signal);
}

/// Code in C, compiled and loaded.
class CompiledStep {
 public:
  explicit CompiledStep(const std::string& code) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / "veritrack-recursion-text-test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "tracker.c") << code;
    const std::string command = "cc -O2 -Wall -Werror -ffp-contract=off -shared -fPIC " +
                                (folder / "tracker.c").string() + " -o " + (folder / "tracker.so").string() +
                                " -lm";
    REQUIRE(std::system(command.c_str()) == 0);  // NOLINT(concurrency-mt-unsafe)
    library_ = dlopen((folder / "tracker.so").c_str(), RTLD_NOW);
    REQUIRE(library_ != nullptr);
    step = reinterpret_cast<decltype(step)>(dlsym(library_, "tracker_step"));
    frequency = reinterpret_cast<decltype(frequency)>(dlsym(library_, "tracker_frequency"));
    start = reinterpret_cast<decltype(start)>(dlsym(library_, "tracker_start"));
    std::filesystem::remove_all(folder);
  }
  ~CompiledStep() { dlclose(library_); }
  CompiledStep(const CompiledStep&) = delete;
  CompiledStep& operator=(const CompiledStep&) = delete;
  CompiledStep(CompiledStep&&) = delete;
  CompiledStep& operator=(CompiledStep&&) = delete;

  void (*step)(const double* state, const double* sample, double* next) = nullptr;
  double (*frequency)(const double* state) = nullptr;
  void (*start)(double amplitude, double omega, double* state) = nullptr;

 private:
  void* library_ = nullptr;
};

TEST_CASE("the C code of every model computes the doubles of the program that is certified") {
  REQUIRE_FALSE(model_designs().empty());
  for (const std::filesystem::path& path : model_designs()) {
    CAPTURE(path);
    const Model model = model_of(path);
    const CompiledStep compiled(recursion_text(model, "a title", CodeLanguage::c));
    std::vector<double> constants;
    for (const language::Constant& constant : model.constants) {
      constants.push_back(constant.nearest);
    }
    std::vector<double> inputs = constants;
    inputs.insert(inputs.end(), {1.25, 0.3});
    std::vector<double> registers;
    std::vector<double> state(model.states.size());
    model.start.run(std::span<const double>(inputs), registers, std::span(state));
    std::vector<double> state_in_c(state.size());
    compiled.start(1.25, 0.3, state_in_c.data());
    CHECK(state == state_in_c);
    trackers::ModelTracker<double> tracker(model.recursion, constants, state);
    test::Random random(5);
    std::vector<double> next(state.size());
    bool same = true;
    for (int k = 0; k < 200; ++k) {
      std::vector<double> samples{std::cos(0.3 * k), std::sin(0.3 * k)};
      samples.resize(model.samples.size());
      samples[0] += random.uniform(-0.01, 0.01);
      tracker.step(std::span<const double>(samples));
      compiled.step(state_in_c.data(), samples.data(), next.data());
      state_in_c = next;
      same = same && tracker.state() == state_in_c && tracker.frequency() == compiled.frequency(next.data());
    }
    CHECK(same);
    CHECK(std::isfinite(tracker.frequency()));
  }
}

}  // namespace
}  // namespace veritrack::certificates
