#include "certificates/quadrature/theorem_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::string_view kPrefix = "theorem-2.9/";
constexpr std::string_view kConditions = "/conditions";  // whether a reading applies, reported elsewhere

/// "b_1" and "errata" of "theorem-2.9/b_1/errata".
struct Place {
  std::string name, reading;
};

Place place_of(const std::string& id) {
  const std::string rest = id.substr(kPrefix.size());
  const std::size_t slash = rest.find('/');
  return slash == std::string::npos ? Place{rest, ""} : Place{rest.substr(0, slash), rest.substr(slash + 1)};
}

/// The same text from several readings, once.
struct Voices {
  std::string text, readings;
};

/// All statements on one place.
struct Row {
  std::string name;
  std::vector<Voices> sentences, verdicts, witnesses;
};

void add(std::vector<Voices>& voices, const std::string& text, const std::string& reading) {
  auto same =
      std::find_if(voices.begin(), voices.end(), [&](const Voices& voice) { return voice.text == text; });
  if (same == voices.end()) {
    voices.push_back({text, reading});
  } else {
    same->readings += ", " + reading;
  }
}

/// The texts under each other, each with its readings unless all say the same.
std::string cell(const std::vector<Voices>& voices) {
  std::string text;
  for (const Voices& voice : voices) {
    text += text.empty() ? "" : "; ";
    text += voices.size() == 1 ? voice.text : fmt::format("*{}*: {}", voice.readings, voice.text);
  }
  return text;
}

}  // namespace

std::string proof_section(const Certificate& certificate) {
  std::vector<Row> found;
  for (const Claim& claim : certificate.claims) {
    if (!claim.id.starts_with(kPrefix) || claim.id.ends_with(kConditions)) {
      continue;
    }
    const Place place = place_of(claim.id);
    auto row = std::find_if(found.begin(), found.end(),
                            [&](const Row& candidate) { return candidate.name == place.name; });
    if (row == found.end()) {
      row = found.insert(found.end(), {place.name, {}, {}, {}});
    }
    add(row->sentences, markdown::escaped(claim.statement), place.reading);
    add(row->verdicts, markdown::answer(claim.verdict), place.reading);
    add(row->witnesses, markdown::escaped(claim.reason), place.reading);
  }
  if (found.empty()) {
    return "";
  }
  std::string text = "## The proof of Theorem 2.9, step by step\n\n";
  text +=
      "Each possible gap in the proof (La Scala 1994, chapter 2 and section 3.5) is a sentence with a "
      "verdict. The witness is a point, or a set, where both sides can be evaluated again. Where the "
      "readings differ, both are given; *general* means for every system, *repaired* is our own "
      "correction. The witness of a sentence that is not true begins with the kind of mistake, and the "
      "place.\n\n";
  std::vector<std::vector<std::string>> rows;
  rows.reserve(found.size());
  for (const Row& row : found) {
    rows.push_back({"`" + row.name + "`", cell(row.sentences), cell(row.verdicts), cell(row.witnesses)});
  }
  return text + markdown::table({"Place", "What the proof says", "True", "Witness"}, rows) + "\n";
}

}  // namespace veritrack::certificates
