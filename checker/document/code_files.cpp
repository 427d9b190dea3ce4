#include "checker/document/code_files.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

#include "checker/document/sha256.hpp"

namespace veritrack::checker {

bool is_from_code(const std::string& path) {
  constexpr std::array<std::string_view, 7> kFromCode{"model.samples[", "model.states[",   "model.angles[",
                                                      "model.step",     "model.frequency", "code.compiler",
                                                      "code.listing"};
  return (path.starts_with("code.files[") && path.ends_with(".sha256")) ||
         path.starts_with("code.included[") || path.starts_with("code.arc_tangent.") ||
         std::any_of(kFromCode.begin(), kFromCode.end(), [&](std::string_view each) {
           return each.ends_with('[') ? path.starts_with(each) : path == each;
         });
}

std::vector<const Tree*> code_files(const Tree& code) {
  std::vector<const Tree*> files;
  for (const char* member : {"files", "included"}) {
    for (const Tree& file : code.at(member).elements()) {
      files.push_back(&file);
    }
  }
  return files;
}

void compare_code_files(const Tree& design, const std::filesystem::path& folder, Objections& objections) {
  const Tree* code = design.find("code");
  if (code == nullptr) {
    return;
  }
  for (const Tree* file : code_files(*code)) {
    const std::string& name = file->at("name").text();
    std::ifstream stream(folder / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream || std::filesystem::is_directory(folder / name)) {
      objections.push_back(name + " is not beside the design file");
    } else if (sha256(bytes) != file->at("sha256").text()) {
      objections.push_back(name + " has another SHA-256 than the certificate names");
    }
  }
}

}  // namespace veritrack::checker
