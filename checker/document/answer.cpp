#include "checker/document/answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "checker/numbers/ball.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

const char* word(Verdict verdict) {
  return verdict == Verdict::proved ? "PROVED" : verdict == Verdict::refuted ? "REFUTED" : "UNDECIDED";
}

/// A text of the certificate, on one line and in quotation marks: it is not ours, and may try to look as if
/// it were.
std::string quoted(const std::string& text) {
  constexpr std::size_t kLongest = 200;
  std::string shown = text.substr(0, kLongest);
  for (char& c : shown) {
    c = static_cast<unsigned char>(c) < 0x20 || c == '"' || c == 0x7f ? ' ' : c;
  }
  return '"' + shown + '"';
}

std::size_t refused_parts(const Verification& found) {
  return static_cast<std::size_t>(std::count_if(found.parts.begin(), found.parts.end(),
                                                [](const Part& part) { return !part.objections.empty(); }));
}

}  // namespace

std::string to_text(const Verification& found) {
  std::string text;
  for (const Part& part : found.parts) {
    text += (part.objections.empty() ? "verified     " : "NOT VERIFIED ") + part.name + "\n";
    for (const std::string& objection : part.objections) {
      text += "             - " + objection + "\n";
    }
  }
  const std::string parts = std::to_string(found.parts.size());
  if (!found.verified()) {
    return text + "NOT VERIFIED: " + std::to_string(refused_parts(found)) + " of " + parts + " parts\n";
  }
  text += "\nThe design " + quoted(found.quoted[0]) + ", from " + quoted(found.quoted[1]) +
          ",\nSHA-256 of its file " + quoted(found.design_sha256) + ":\n";
  for (const Requirement& requirement : found.requirements) {
    text += std::string("- required, ") + word(requirement.verdict) + ": " + requirement.text + "\n";
  }
  for (const Sentence& sentence : found.sentences) {
    if (sentence.is_summary) {
      text += std::string("- ") + word(sentence.verdict) + ": " + sentence.text + "\n";
    }
  }
  const std::string rest = found.requirements_proved    ? "everything required is PROVED"
                           : found.requirements.empty() ? "nothing is required"
                                                        : "not everything required is PROVED";
  return text + "VERIFIED: all " + parts + " parts, " + std::to_string(precision()) + " bits; " + rest + "\n";
}

std::string to_json(const Verification& found) {
  using Json = nlohmann::ordered_json;
  Json json{
      {"verified", found.verified()},
      {"requirements_proved", found.verified() && found.requirements_proved},
      {"design", {{"name", found.quoted.empty() ? "" : found.quoted[0]}, {"sha256", found.design_sha256}}},
      {"bits", static_cast<long>(precision())},
      {"operations", operations_spent()},
      {"parts", Json::array()},
      {"required", Json::array()},
      {"sentences", Json::array()}};
  for (const Part& part : found.parts) {
    json["parts"].push_back({{"name", part.name}, {"objections", part.objections}});
  }
  for (const Requirement& requirement : found.requirements) {
    json["required"].push_back({{"claim", requirement.claim},
                                {"requirement", requirement.text},
                                {"verdict", word(requirement.verdict)}});
  }
  for (const Sentence& sentence : found.sentences) {
    json["sentences"].push_back(
        {{"claim", sentence.id}, {"verdict", word(sentence.verdict)}, {"sentence", sentence.text}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace veritrack::checker
