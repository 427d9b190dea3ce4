#include "cli/verifier.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <list>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <vector>

#include "certificates/design/input_error.hpp"
#include "certificates/document/program.hpp"
#include "cli/interruption.hpp"
#include "cli/program.hpp"

namespace veritrack::cli {

namespace {

namespace fs = std::filesystem;
using certificates::Verification;
using Outcome = Verification::Outcome;
using certificates::MemoryFile;
using certificates::ProgramRun;

constexpr const char* kName = "veritrack-verify";
// As checker/main.cpp has them.
constexpr int kVerified = 1;  // or 0: all that is required is proved besides
constexpr int kNotVerified = 3;
constexpr std::size_t kShown = 400;  // characters of an objection

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Throws nlohmann::json::exception for what is no answer.
Verification read_answer(const ProgramRun& run) {
  const nlohmann::json answer = nlohmann::json::parse(run.output);
  Verification result;
  for (const auto& part : answer.at("parts")) {
    ++result.parts;
    auto objections = part.at("objections").get<std::vector<std::string>>();
    if (!objections.empty()) {
      for (std::string& objection : objections) {
        objection = certificates::printable(objection, kShown);
      }
      result.refused.push_back(
          {certificates::printable(part.at("name").get<std::string>(), kShown), std::move(objections)});
    }
  }
  const bool is_verified = answer.at("verified").get<bool>() && run.status <= kVerified && result.parts > 0 &&
                           result.refused.empty();
  result.outcome = is_verified ? Outcome::verified : Outcome::refused;
  if (!is_verified && result.refused.empty()) {
    result.failure = "its answer contradicts itself";
  }
  return result;
}

Verification outcome_of(const ProgramRun& run) {
  std::string failure = run.signal != 0
                            ? fmt::format("it was ended by signal {}", run.signal)
                            : fmt::format("exit status {}: {}", run.status,
                                          certificates::printable(first_line(run.errors), kShown));
  if (run.signal == 0 && (run.status == 0 || run.status == kVerified || run.status == kNotVerified)) {
    try {
      return read_answer(run);
    } catch (const nlohmann::json::exception&) {
      failure = "its answer cannot be read";
    }
  }
  Verification result;
  result.outcome = Outcome::refused;
  result.failure = failure;
  return result;
}

}  // namespace

Verifier::Verifier() {
  path_ = path_beside(kName);
  constexpr std::string_view kExpected = "veritrack-verify " VERITRACK_VERSION ", ";
  std::string found;
  try {
    found = first_line(certificates::run_program(path_.string(), {"--version"}, "").output);
  } catch (const std::system_error&) {
    throw NoVerifier(
        "veritrack-verify is not beside veritrack; `ninja -C build/release veritrack-verify` builds it");
  }
  if (!found.starts_with(kExpected)) {
    throw NoVerifier("the veritrack-verify beside veritrack is not that of release " VERITRACK_VERSION);
  }
}

Verification Verifier::operator()(const reports::TextsToVerify& texts) const {
  std::list<MemoryFile> files;
  std::vector<const MemoryFile*> handed_over;
  std::vector<std::pair<std::string, std::string>> names;  // by path
  const auto hand_over = [&](const std::string& name, const std::string& text) {
    const MemoryFile& file = files.emplace_back(text);
    handed_over.push_back(&file);
    names.emplace_back(file.path(), name);
    return file.path();
  };
  std::vector<std::string> arguments{"--json",
                                     "--full",
                                     hand_over("certificate.json", texts.certificate),
                                     "--design",
                                     hand_over("the design file", texts.design),
                                     "--code",
                                     texts.folder.empty() ? "." : texts.folder.string()};
  for (const auto& [name, text] : texts.documents) {
    arguments.emplace_back("--markdown");
    arguments.push_back(hand_over(name, text));
  }
  const Interruption interruption;  // Ctrl-C ends the checker, and what was found is written
  ProgramRun run = certificates::run_program(path_.string(), arguments, "", handed_over);
  if (run.signal != 0 && Interruption::flag()) {
    return {};
  }
  // The longest first, so that none is taken for the beginning of another.
  std::sort(names.begin(), names.end(),
            [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
  for (const auto& [path, name] : names) {
    replace_all(run.output, path, name);
    replace_all(run.errors, path, name);
  }
  return outcome_of(run);
}

std::string refusal_sentence(const Verification& verification) {
  if (!verification.failure.empty()) {
    return fmt::format("{} gave no answer: {}", kName, verification.failure);
  }
  std::vector<std::string> parts;
  for (const certificates::RefusedPart& part : verification.refused) {
    parts.push_back(fmt::format("{} ({})", part.name, fmt::join(part.objections, "; ")));
  }
  return fmt::format("{} refuses {} of {} parts: {}", kName, parts.size(), verification.parts,
                     fmt::join(parts, "; "));
}

}  // namespace veritrack::cli
