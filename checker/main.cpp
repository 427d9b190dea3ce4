// veritrack-verify: reads a certificate and says VERIFIED or NOT VERIFIED.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "checker/numbers/ball.hpp"
#include "checker/verification.hpp"

namespace {

constexpr int kVerified = 0;
constexpr int kNotVerified = 1;
constexpr int kMalformed = 2;

constexpr const char* kUsage =
    "usage: veritrack-verify [--precision BITS] [--full] CERTIFICATE.json\nVerifies every claim of the "
    "certificate from its evidence. With more than 200 boxes of starts only a sample is\nchecked, and the "
    "part is NOT VERIFIED unless --full is given. Exit status: 0 VERIFIED, 1 NOT VERIFIED, 2 malformed.\n";

int run(const std::string& path, bool all_boxes) {
  using namespace veritrack::checker;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) {
    throw Malformed("the file cannot be read");
  }
  const Verification result = verify(read_json(text), all_boxes);
  std::size_t refused = 0;
  for (const Part& part : result.parts) {
    std::printf("%s %s\n", part.objections.empty() ? "verified    " : "NOT VERIFIED", part.name.c_str());
    refused += part.objections.empty() ? 0U : 1U;
    for (const std::string& objection : part.objections) {
      std::printf("             - %s\n", objection.c_str());
    }
  }
  if (result.verified()) {
    std::printf("VERIFIED: all %zu parts, %ld bits\n", result.parts.size(), static_cast<long>(precision()));
    return kVerified;
  }
  std::printf("NOT VERIFIED: %zu of %zu parts\n", refused, result.parts.size());
  return kNotVerified;
}

}  // namespace

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  std::string path;
  bool all_boxes = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--precision" && i + 1 < arguments.size()) {
      const long bits = std::strtol(arguments[++i].c_str(), nullptr, 10);
      if (bits < 64 || bits > 4096) {
        std::fprintf(stderr, "veritrack-verify: the precision must be from 64 to 4096 bits\n");
        return kMalformed;
      }
      veritrack::checker::set_precision(bits);
    } else if (argument == "--full") {
      all_boxes = true;
    } else if (path.empty() && !argument.starts_with("-")) {
      path = argument;
    } else {
      std::fputs(kUsage, stderr);
      return kMalformed;
    }
  }
  if (path.empty()) {
    std::fputs(kUsage, stderr);
    return kMalformed;
  }
  try {
    return run(path, all_boxes);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "veritrack-verify: %s: malformed: %s\n", path.c_str(), error.what());
    return kMalformed;
  }
}
