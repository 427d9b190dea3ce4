#include "checker/document/answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "checker/document/first_page.hpp"
#include "checker/numbers/ball.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

/// Unicode that controls a terminal or turns the direction of writing: U+0080 to 9F, U+200E and F, U+2028 to
/// 2E, U+2066 to 69, as UTF-8.
bool is_control(std::string_view rest) {
  const auto byte = [&](std::size_t i) { return i < rest.size() ? static_cast<unsigned char>(rest[i]) : 0U; };
  const unsigned second = byte(1);
  const unsigned third = byte(2);
  return byte(0) < 0x20U || byte(0) == 0x7fU || (byte(0) == 0xc2U && second >= 0x80U && second <= 0x9fU) ||
         (byte(0) == 0xe2U && second == 0x80U &&
          (third == 0x8eU || third == 0x8fU || (third >= 0xa8U && third <= 0xaeU))) ||
         (byte(0) == 0xe2U && second == 0x81U && third >= 0xa6U && third <= 0xa9U);
}

/// On one line. Names and objections may hold texts of the certificate, which may try to look as if they were
/// ours.
std::string one_line(const std::string& text) {
  constexpr std::size_t kLongest = 400;
  std::string shown = text.substr(0, kLongest);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    shown[i] = is_control(std::string_view(shown).substr(i)) ? ' ' : shown[i];
  }
  return shown;
}

/// A text of the certificate in quotation marks.
std::string quoted(const std::string& text) {
  std::string shown = one_line(text);
  std::replace(shown.begin(), shown.end(), '"', ' ');
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
    text += (part.objections.empty() ? "verified     " : "NOT VERIFIED ") + one_line(part.name) + "\n";
    for (const std::string& objection : part.objections) {
      text += "             - " + one_line(objection) + "\n";
    }
  }
  const std::string parts = std::to_string(found.parts.size());
  if (!found.verified()) {
    return text + "NOT VERIFIED: " + std::to_string(refused_parts(found)) + " of " + parts + " parts\n";
  }
  text += "\nThe design " + quoted(found.quoted[0]) + ", from " + quoted(found.quoted[1]) +
          ",\nSHA-256 of its file " + quoted(found.design_sha256) + ":\n";
  for (const Requirement& requirement : found.requirements) {
    text += "- required, " + word_of(requirement.verdict) + ": " + requirement.text + "\n";
  }
  for (const Sentence& sentence : found.sentences) {
    if (sentence.is_summary) {
      text += "- " + word_of(sentence.verdict) + ": " + sentence.text + "\n";
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
                                {"verdict", word_of(requirement.verdict)}});
  }
  for (const Sentence& sentence : found.sentences) {
    json["sentences"].push_back(
        {{"claim", sentence.id}, {"verdict", word_of(sentence.verdict)}, {"sentence", sentence.text}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace veritrack::checker
