#include "certificates/quadrature/markdown_other_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

/// The derivations that have sections of their own elsewhere.
constexpr std::array<std::string_view, 3> kElsewhere = {"theorem-2.9/", "contraction", "capture"};

std::vector<theorems::Derivation> other_results(const Certificate& certificate) {
  std::vector<theorems::Derivation> found;
  std::copy_if(certificate.derivations.begin(), certificate.derivations.end(), std::back_inserter(found),
               [](const theorems::Derivation& derivation) {
                 return std::none_of(kElsewhere.begin(), kElsewhere.end(), [&](std::string_view prefix) {
                   return derivation.id.starts_with(prefix);
                 });
               });
  return found;
}

}  // namespace

std::string other_results_section(const Certificate& certificate) {
  const std::vector<theorems::Derivation> results = other_results(certificate);
  if (results.empty()) {
    return "";
  }
  std::string text =
      "## Other published results for it\n\nResults that Theorem 2.9 builds on or competes with, evaluated "
      "for this design at amplitude 1. Where a result was printed with an error, the reading that can be "
      "proved is also given. No requirement depends on them.\n\n";
  for (const theorems::Derivation& derivation : results) {
    text += fmt::format("### {}: {}\n\n", derivation.title, markdown::satisfied(derivation.verdict));
    text += markdown::conditions_table(derivation) + "\n";
    const std::string notes = markdown::notes_list(derivation);
    text += notes.empty() ? "" : notes + "\n";
  }
  return text;
}

std::string other_constants_section(const Certificate& certificate) {
  const std::vector<theorems::Derivation> results = other_results(certificate);
  if (results.empty()) {
    return "";
  }
  constexpr int kDigits = 7;
  std::string text = "## Constants of the other results\n\n";
  for (const theorems::Derivation& derivation : results) {
    if (derivation.quantities.empty()) {
      continue;
    }
    text += fmt::format("### `{}`\n\n", derivation.id);
    text += markdown::quantities_table(derivation, kDigits) + "\n";
  }
  return text;
}

}  // namespace veritrack::certificates
