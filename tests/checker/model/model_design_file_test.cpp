// The design file of a model against the design in a certificate, for all designs of models.
#include "checker/document/model_design_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "checker/document/design_file.hpp"
#include "checker/document/sha256.hpp"
#include "tests/checker/model/proposed_certificate.hpp"

namespace veritrack::checker {
namespace {

std::string contents(const std::string& name) {
  std::ifstream stream(std::string(VERITRACK_SOURCE_DIR "/designs/models/") + name);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The design as a certificate has it. (Its name and source are those of the file.)
test::Json design_of(const std::string& name) {
  test::Json design = test::ProposedModel(name).design_json();
  const TomlFile file(contents(name));
  for (const char* quoted : {"name", "source"}) {
    design[quoted] = file.table()[quoted].value_or(std::string());
  }
  // What this file asks, whether or not the program writes it yet.
  design["require"] = test::Json::object();
  if (const toml::table* require = file.table()["require"].as_table()) {
    for (const auto& [key, value] : *require) {
      const toml::node* hertz = value.is_table() ? value.as_table()->get("hz") : nullptr;
      design["require"][std::string(key.str())] = test::decimal(
          hertz != nullptr ? file.text(*hertz) + " Hz" : std::string(file.text(value)), 1.0, 1.0);
    }
  }
  return design;
}

Objections compared(const test::Json& design, const std::string& file) {
  Objections objections;
  const test::Json certificate{{"design_sha256", sha256(file)}, {"design", design}};
  compare_with_design_file(read_json(certificate.dump()), file, objections);
  return objections;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_CASE("every design of a model says what the certificate says of it") {
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(VERITRACK_SOURCE_DIR) /
                                                               "designs" / "models")) {
    const std::string name = entry.path().filename();
    CAPTURE(name);
    const Objections objections = compared(design_of(name), contents(name));
    CAPTURE(objections.empty() ? std::string() : objections.front());
    CHECK(objections.empty());
  }
}

TEST_CASE("another file is found out") {
  const std::string name = "single-channel-ekf.toml";
  const test::Json design = design_of(name);
  const std::string file = contents(name);
  const auto objections = [&](const std::string& from, const std::string& to) {
    return compared(design, replaced(file, from, to)).size();
  };
  CHECK(objections("q = 0.005", "q = 0.0050") == 1);
  CHECK(objections("q = 0.005", "q2 = 0.005") == 2);
  CHECK(objections("cos(w)*x1", "cos(w)*x2") == 1);
  CHECK(objections("measure = 'x1'", "measure = 'x2'") == 1);
  CHECK(objections("measure = 'x1'", "measure = ['x1']") == 0);
  CHECK(objections("['q', 0, 0]", "['q', 0, 1]") == 1);
  CHECK(objections("R = 'r'", "R = [['r']]") == 0);
  CHECK(objections("R = 'r'", "R = 'r'\nupdate = 'standard'\njacobian = 'automatic'") == 0);
  CHECK(objections("R = 'r'", "R = 'r'\nupdate = 'another'") == 1);
  CHECK(objections("R = 'r'", "R = 'r'\njacobian = [[1, 0], [0, 1]]") == 4);
  CHECK(objections("samples = 'y'", "samples = ['y', 'z']") >= 1);
  CHECK(objections("samples = 'y'", "samples = 'y'\nangles = ['w']") == 1);
  CHECK(objections("amplitude = 1\n", "") == 0);
  CHECK(objections("amplitude = 1", "amplitude = 2") == 1);
  CHECK(objections("amplitude = 1", "amplitude = [0.9, 1.1]") == 3);
  CHECK(objections("amplitude = 1", "amplitude = [1, 1]") == 3);
  CHECK(objections("[1.4, 1.6]", "[1.4, 1.61]") == 1);
  CHECK(objections("[1.4, 1.6]", "{ hz = [1.4, 1.6] }") == 1);
  CHECK(objections("amplitude = 1", "slew = 0") == 0);
  CHECK(objections("amplitude = 1", "slew = { hz_per_second = 0 }") == 1);
  CHECK(objections("amplitude = 1", "signal = 'A*cos(phi)'") == 0);
  CHECK(objections("amplitude = 1", "signal = '2*A*cos(phi)'") == 1);
  CHECK(objections("amplitude = 1", "start_within = { w = 0.1 }") == 1);
  CHECK(objections("amplitude = 1", "amplitude = true") >= 1);
  CHECK(objections("[assume]", "[require]\nbias_below = 1\n[assume]") == 1);
  CHECK(objections("[assume]", "[require]\nsettles_like = { seconds = 1 }\n[assume]") == 1);
  CHECK(objections("[assume]", "[simulate]\nsamples = 1\n[assume]") == 0);
  CHECK(objections("[assume]", "[another]\nsamples = 1\n[assume]") == 1);
  // Where a simulation begins is no part of what is proved.
  CHECK(objections("x1 = 'A'", "x1 = '2*A'") == 0);
}

TEST_CASE("a range of amplitudes is the one of the file") {
  const std::string name = "single-channel-ekf.toml";
  test::Json design = design_of(name);
  const std::string file = replaced(contents(name), "amplitude = 1", "amplitude = [0.75, 1.25]");
  CHECK(compared(design, file).size() == 3);
  const test::Json low = test::decimal("0.75", 0.75, 0.75);
  const test::Json high = test::decimal("1.25", 1.25, 1.25);
  const auto objections = [&](const test::Json& amplitude) {
    design["assume"]["amplitude"] = amplitude;
    return compared(design, file).size();
  };
  CHECK(objections({low, high}) == 0);
  CHECK(objections({high, low}) == 2);
  CHECK(objections({low, test::decimal("1.125", 1.125, 1.125)}) == 1);
  CHECK(objections(test::Json::array({low})) == 1);
  CHECK(objections({low, high, high}) == 1);
  CHECK(objections(low) == 3);
  CHECK(objections(test::Json::array()) == 2);
  design["assume"].erase("amplitude");
  CHECK(compared(design, file).size() == 2);
}

TEST_CASE("a certificate that says more is found out") {
  const std::string name = "sogi-fll.toml";
  const std::string file = contents(name);
  test::Json design = design_of(name);
  CHECK(compared(design, file).empty());
  design["assume"]["start_within"] = test::Json::array({{{"name", "w"}, {"formula", "1"}}});
  CHECK(compared(design, file).size() == 1);
  design = design_of(name);
  design["assume"]["frequency_in_hertz"] = false;
  CHECK(compared(design, file).size() == 1);
  design = design_of(name);
  design["require"] = test::Json::object();
  CHECK(compared(design, file).size() == 1);
  design = design_of(name);
  design["model"]["parameters"].push_back(design["model"]["parameters"][0]);
  CHECK(compared(design, file).size() == 1);
}

}  // namespace
}  // namespace veritrack::checker
