// An attack on what is certified of designs/models: many starts on the rims of the certified sets.
//   VERITRACK_TEST_EFFORT=500 certificates_model_tests --test-suite=nightly --test-case="*rim*"
// has a million starts for each set.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/model/set/falsifier.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {

using model::ProvedSet;

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The designs in a fixed order; those whose file name has VERITRACK_TEST_ONLY in it, if that is set.
std::vector<std::filesystem::path> attacked_designs() {
  const char* only = std::getenv("VERITRACK_TEST_ONLY");
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(VERITRACK_SOURCE_DIR "/designs/models")) {
    if (only == nullptr || entry.path().filename().string().find(only) != std::string::npos) {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST_CASE("no start on the rim of a certified set leaves it, under disturbances that push outward" *
          doctest::test_suite("nightly")) {
  const auto starts = static_cast<int>(test::effort(2000));
  constexpr int kSamples = 60;
  constexpr double kSecondsOfSearch = 240.0;  // what is proved by then is attacked
  for (const std::filesystem::path& path : attacked_designs()) {
    CAPTURE(path.filename().string());
    const Design design = [&] {
      const rigor::UpwardRounding upward;
      return read_design(text_of(path), path.filename().string());
    }();
    const ModelTables& tables = model_tables(design);
    const ModelSets sets = certify_sets(tables, Extent::requirements, search::Deadline(kSecondsOfSearch), {});
    const Model model = [&] {
      const rigor::UpwardRounding upward;
      return make_model(tables.model, tables.assume.signal);
    }();
    const model::TrackerModel tracker = [&] {
      const rigor::UpwardRounding upward;
      return proved_model(model, tables.assume);
    }();
    const auto attack = [&](const char* name, const ProvedSet& set) {
      if (set.tubes.tubes.empty()) {
        std::cout << fmt::format("{}, {}: no set\n", path.stem().string(), name) << std::flush;
        return;
      }
      const model::TubeAttack reached = attack_tubes(tracker, set.tubes, {starts, kSamples, 2, test::kSeed});
      CHECK(reached.starts >= starts);  // as many for each part of a range of amplitudes
      CHECK(reached.level_share <= 1.0);
      CHECK(reached.frequency_error <= set.frequency_error);
      std::cout << fmt::format(
                       "{}, {}: {} starts in {} tubes, level at most {:.4f} of the rim, frequency error "
                       "{:.4g}, proved {:.4g}\n",
                       path.stem().string(), name, reached.starts, set.tubes.tubes.size(),
                       reached.level_share, reached.frequency_error, set.frequency_error)
                << std::flush;
    };
    attack("starts", sets.starts);
    if (sets.assumed) {
      attack("assumed", *sets.assumed);
    }
  }
}

}  // namespace
}  // namespace veritrack::certificates
