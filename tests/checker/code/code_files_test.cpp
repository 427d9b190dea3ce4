// The design file of a recursion that is made of code, and the files of the code beside it.
#include "checker/document/code_files.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "checker/document/design_file.hpp"
#include "checker/document/sha256.hpp"
#include "tests/checker/code/code_design.hpp"

namespace veritrack::checker {
namespace {

constexpr const char* kFile =
    "name = 'loop'\ntracker = 'model'\n[code]\nfiles = ['loop.c']\nflags = ['-DA=1']\n"
    "[assume]\nfrequency = [0.1, 0.2]\nnoise = 0.1\n";
constexpr const char* kCode = "void step(float y) {}\n";

nlohmann::json design() {
  nlohmann::json design = test::detector().json();
  const auto number = [](const char* text) { return nlohmann::json{{"text", text}}; };
  design["name"] = "loop";
  design["source"] = "";
  design["tracker"] = "model";
  design["require"] = nlohmann::json::object();
  design["assume"] = {{"amplitude", number("1")},          {"frequency", {number("0.1"), number("0.2")}},
                      {"frequency_in_hertz", false},       {"slew", number("0")},
                      {"slew_in_hertz_per_second", false}, {"noise", number("0.1")}};
  design["model"]["parameters"] = nlohmann::json::array();
  design["model"]["signal"] = {"A*cos(phi)", "A*sin(phi)"};
  design["code"]["flags"] = {"-DA=1"};
  design["code"]["files"][0]["sha256"] = sha256(kCode);
  return design;
}

Objections compared(const nlohmann::json& design, const std::string& file, const std::string& code) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "veritrack-code-files-test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "loop.c", std::ios::binary) << code;
  Objections objections;
  const nlohmann::json certificate{{"design_sha256", sha256(file)}, {"design", design}};
  compare_with_design_file(read_json(certificate.dump()), file, objections, folder);
  std::filesystem::remove_all(folder);
  return objections;
}

TEST_CASE("the design file and the files of the code are those of the certificate") {
  CHECK(compared(design(), kFile, kCode) == Objections{});
}

TEST_CASE("other files and flags are refused") {
  CHECK(compared(design(), kFile, std::string(kCode) + "\n") ==
        Objections{"loop.c has another SHA-256 than the certificate names"});
  nlohmann::json another = design();
  another["code"]["files"][0]["name"] = "other.c";
  CHECK(compared(another, test::replaced(kFile, "loop.c", "other.c"), kCode) ==
        Objections{"other.c is not beside the design file"});
  CHECK(!compared(another, kFile, kCode).empty());
  CHECK(!compared(design(), test::replaced(kFile, "-DA=1", "-DA=2"), kCode).empty());
  CHECK(!compared(design(), test::replaced(kFile, "flags = ['-DA=1']\n", ""), kCode).empty());
  CHECK(!compared(design(), test::replaced(kFile, "'loop.c'", "'loop.c', 'more.c'"), kCode).empty());
  another = design();
  another.erase("code");
  CHECK(!compared(another, kFile, kCode).empty());
}

TEST_CASE("a recursion that is written down stands in its file") {
  nlohmann::json without = design();
  without.erase("code");
  const std::string file = test::replaced(kFile, "[code]\nfiles = ['loop.c']\nflags = ['-DA=1']\n", "");
  CHECK(!compared(without, file, kCode).empty());
}

TEST_CASE("the words for a listing, in exact arithmetic and in that of the program") {
  const std::string of =
      " of the listing of `step` and `frequency` in loop.c (SHA-256 " + sha256(kCode).substr(0, 16) + "...)";
  const Tree exact = read_json(design().dump());
  CHECK(words_of_arithmetic(exact, false) ==
        "In exact arithmetic" + of + ", angles modulo 2 pi, begun in the ranges that the wraps keep them in");
  const std::string rounded = words_of_arithmetic(exact, true);
  CHECK(rounded.find("In IEEE 754 arithmetic" + of + ", every operation rounded to nearest") == 0);
  CHECK(rounded.find(
            "in the last place, angles modulo 2 pi, begun in the ranges that the wraps keep them in") !=
        std::string::npos);
  nlohmann::json later = design();
  std::string listing = later["code"]["listing"];
  listing.insert(listing.find("sample "), "steps-before 3\n");
  later["code"]["listing"] = listing;
  CHECK(words_of_arithmetic(read_json(later.dump()), false) ==
        "In exact arithmetic" + of +
            " after its first 3 steps, angles modulo 2 pi, begun in the ranges that the wraps keep them in");
  CHECK(words_of_arithmetic(read_json(R"({"model": {}})"), false) == "In exact arithmetic");
}

TEST_CASE("names and digests of files are plain") {
  for (const auto& [member, text] :
       {std::pair("name", "a b.c"), std::pair("name", ""), std::pair("name", "a`.c"),
        std::pair("sha256", "00"), std::pair("sha256", "x")}) {
    nlohmann::json changed = design();
    changed["code"]["files"][0][member] = text;
    Objections objections;
    check_code(read_json(changed.dump()), objections);
    CHECK(!objections.empty());
  }
}

TEST_CASE("files that are included are in the sentence, and compared") {
  nlohmann::json with = design();
  with["code"]["included"] = {{{"name", "loop.h"}, {"sha256", sha256("")}}};
  CHECK(words_of_arithmetic(read_json(with.dump()), false).find("...) and loop.h (SHA-256 ") !=
        std::string::npos);
  CHECK(compared(with, kFile, kCode) == Objections{"loop.h is not beside the design file"});
  with["code"]["included"][0]["name"] = "loop.c";  // there twice
  Objections objections;
  check_code(read_json(with.dump()), objections);
  CHECK(!objections.empty());
}

}  // namespace
}  // namespace veritrack::checker
