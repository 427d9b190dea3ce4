// veritrack-verify: reads a certificate and says VERIFIED or NOT VERIFIED.
#include <arb.h>
#include <flint/flint.h>
#include <mpfr.h>
#include <nettle/version.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "checker/document/answer.hpp"
#include "checker/document/design_file.hpp"
#include "checker/document/markdown_file.hpp"
#include "checker/document/sha256.hpp"
#include "checker/numbers/ball.hpp"
#include "checker/numbers/budget.hpp"
#include "checker/verification.hpp"

namespace {

using namespace veritrack::checker;

constexpr int kEverythingProved = 0;
constexpr int kVerified = 1;
constexpr int kMalformed = 2;
constexpr int kNotVerified = 3;

constexpr const char* kUsage =
    "usage: veritrack-verify [OPTIONS] CERTIFICATE.json\n"
    "Verifies every claim of the certificate from its evidence, and prints the sentences that it "
    "establishes.\n"
    "  --design FILE     also that the certificate is about this design file\n"
    "  --code FOLDER     where the files of the design's code are, unless beside the design file\n"
    "  --markdown FILE   also that this certificate.md or published-theorems.md says what was verified; may "
    "be "
    "given\n"
    "                    twice\n"
    "  --full            follow all boxes of starts: with more than 200 only a sample is checked, and the "
    "part is\n"
    "                    NOT VERIFIED\n"
    "  --json            print the answer as JSON\n"
    "  --budget N        operations on balls before giving up (default 4000000000); what is not finished is "
    "NOT\n"
    "                    VERIFIED\n"
    "  --precision BITS  of the arithmetic, 64 to 4096 (default 128)\n"
    "  --help            print this\n"
    "  --version         print the version, the format it reads and the versions of the libraries\n"
    "Examples:\n"
    "  veritrack-verify certificates-out/my-design/certificate.json\n"
    "  veritrack-verify certificate.json --design my-design.toml --markdown certificate.md\n"
    "Exit status: 0 VERIFIED, and everything required is PROVED. 1 VERIFIED, but not all that is required is "
    "PROVED,\n"
    "or nothing is required. 2 malformed, or the answer could not be written. 3 NOT VERIFIED.\n";

struct Options {
  std::string certificate, design;
  std::optional<std::string> code;  ///< a folder
  std::vector<std::string> documents;
  bool all_boxes = false;
  bool as_json = false;
};

/// Not more than the memory of a small machine.
constexpr std::size_t kLargestFile = std::size_t{1} << 28U;

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::array<char, 65536> block{};
  while (file.read(block.data(), block.size()), file.gcount() > 0 && text.size() <= kLargestFile) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad() || !file.eof()) {
    throw Malformed(path + (text.size() > kLargestFile ? ": the file has more than 256 MiB"
                                                       : ": the file cannot be read"));
  }
  return text;
}

/// A whole number from `least` to `most`; nothing for another text.
std::optional<long> whole_number(const std::string& text, long least, long most) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  return !text.empty() && *end == '\0' && value >= least && value <= most ? std::optional(value)
                                                                          : std::nullopt;
}

/// The options; nothing when they are not as the usage says.
std::optional<Options> read_options(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const bool has_value = i + 1 < arguments.size();
    if (argument == "--precision" && has_value) {
      const auto bits = whole_number(arguments[++i], 64, 4096);
      if (!bits) {
        return std::nullopt;
      }
      set_precision(*bits);
    } else if (argument == "--budget" && has_value) {
      const auto operations = whole_number(arguments[++i], 1, 1L << 62U);
      if (!operations) {
        return std::nullopt;
      }
      set_budget(*operations);
    } else if (argument == "--design" && has_value) {
      options.design = arguments[++i];
    } else if (argument == "--code" && has_value) {
      options.code = arguments[++i];
    } else if (argument == "--markdown" && has_value) {
      options.documents.push_back(arguments[++i]);
    } else if (argument == "--full") {
      options.all_boxes = true;
    } else if (argument == "--json") {
      options.as_json = true;
    } else if (options.certificate.empty() && !argument.starts_with("-")) {
      options.certificate = argument;
    } else {
      return std::nullopt;
    }
  }
  return options.certificate.empty() ? std::nullopt : std::optional(options);
}

int run(const Options& options) {
  const std::string text = read_file(options.certificate);
  const Tree certificate = read_json(text);
  Verification found = verify(certificate, options.all_boxes);
  if (!options.design.empty()) {
    Objections objections;
    compare_with_design_file(certificate, read_file(options.design), objections,
                             options.code ? std::filesystem::path(*options.code)
                                          : std::filesystem::path(options.design).parent_path());
    found.parts.push_back({"the design file", objections});
  }
  for (const std::string& document : options.documents) {
    Objections objections;
    compare_with_markdown(found, sha256(text), read_file(document), objections);
    found.parts.push_back({"the document " + document, objections});
  }
  std::fputs((options.as_json ? to_json(found) : to_text(found)).c_str(), stdout);
  return !found.verified() ? kNotVerified : found.requirements_proved ? kEverythingProved : kVerified;
}

/// "  Arb 2.23.0": what runs, and what the program was compiled with unless that is the same.
std::string library(const std::string& name, const std::string& runs, const std::string& compiled) {
  return "  " + name + " " + runs + (runs == compiled ? "" : " (compiled with " + compiled + ")") + "\n";
}

std::string version_text() {
  const auto dotted = [](int major, int minor) {
    return std::to_string(major) + "." + std::to_string(minor);
  };
  return std::string("veritrack-verify " VERITRACK_VERSION ", reads ") + kFormat + "\n" +
         library("Arb", arb_version, ARB_VERSION) + library("FLINT", flint_version, FLINT_VERSION) +
         library("MPFR", mpfr_get_version(), MPFR_VERSION_STRING) +
         library("Nettle", dotted(nettle_version_major(), nettle_version_minor()),
                 dotted(NETTLE_VERSION_MAJOR, NETTLE_VERSION_MINOR));
}

int answer(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1 && (arguments[0] == "--version" || arguments[0] == "--help")) {
    std::fputs(arguments[0] == "--help" ? kUsage : version_text().c_str(), stdout);
    return kEverythingProved;
  }
  const std::optional<Options> options = read_options(arguments);
  if (!options) {
    std::fputs(kUsage, stderr);
    return kMalformed;
  }
  try {
    return run(*options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "veritrack-verify: %s: malformed: %s\n", options->certificate.c_str(), error.what());
    return kMalformed;
  }
}

}  // namespace

int main(int count, char** words) {
  const int status = answer({words + 1, words + count});
  // An answer that nobody can read is no answer.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "veritrack-verify: standard output cannot be written\n");
    return kMalformed;
  }
  return status;
}
