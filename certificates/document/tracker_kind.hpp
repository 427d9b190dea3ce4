// What a kind of tracker is to a certificate: one record for each, made in its column. The registry
// (certificates/registry.cpp) knows them all; nothing else asks which tracker a design is for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/code_language.hpp"
#include "certificates/document/formal_proof.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/number_json.hpp"
#include "certificates/document/tracker_run.hpp"
#include "certificates/document/tuning.hpp"
#include "certificates/sets/frequency_promise.hpp"

namespace veritrack::certificates {

struct TrackerKind {
  std::string_view name;  ///< as the key `tracker` of a design file names it
  /// The tables of the design as certificate.json repeats them: an object with a member a table. What no
  /// proof rests on is left out.
  Json (*design_json)(const Design& design);
  /// Adds everything that can be said of the design. Needs the upward mode.
  void (*certify)(Certificate& certificate, const CertifyProgress& progress);
  /// The claims that answer, on the first page.
  std::vector<const Claim*> (*answers)(const Certificate& certificate);
  /// The sections between what was required and how to reproduce it.
  std::string (*sections)(const Certificate& certificate, const MarkdownOptions& options);

  // What not every kind has: null where it has none.

  /// What the first page reports beside the answers.
  std::string (*remarks)(const Certificate& certificate) = nullptr;

  /// Adds, of everything that `certify` adds, what publications say: the derivations and claims that
  /// theorems::find_paper_place knows. Takes a second at most. Needs the upward mode.
  void (*published_results)(Certificate& certificate) = nullptr;
  /// The sections of published-theorems.md: what the papers say of the design. Empty when that is nothing.
  std::string (*published)(const Certificate& certificate) = nullptr;
  /// Its search ends when the deadline of the certificate is over.
  bool limited_in_time = false;
  /// Members of certificate.json beside derivations and claims, from which something is verified.
  Json (*evidence_json)(const Certificate& certificate) = nullptr;
  /// Members of report.json beside derivations and claims, which are reported and not verified.
  Json (*report_json)(const Certificate& certificate) = nullptr;
  /// Needs the upward mode.
  FormalProofs (*formal_proofs)(const Certificate& certificate) = nullptr;
  /// Opens its own rounding scopes.
  TuningResult (*tune)(const Design& design, const TuningRequest& request) = nullptr;
  /// What `tune` can make best; the first that fits what is assumed is what it makes best unless asked.
  std::span<const std::string_view> tuning_objectives = {};
  /// The step as text. Opens its own rounding scopes.
  std::string (*show)(const Design& design, CodeLanguage language) = nullptr;
  /// The tracker in double precision, and what is assumed of its signal. Throws NotTrackable. Opens its own
  /// rounding scopes.
  TrackerOnSamples (*track)(const Design& design) = nullptr;
  /// What is proved of the frequency error. Needs the upward mode.
  FrequencyPromise (*frequency_promise)(const Certificate& certificate) = nullptr;
};

/// All kinds, in the order of certificates/trackers.def.
[[nodiscard]] std::span<const TrackerKind* const> tracker_kinds();

/// The kind of tracker that a design is for. Throws std::logic_error when the registry has none of that name,
/// which no design that was read can bring about.
[[nodiscard]] const TrackerKind& kind_of(const Design& design);

/// The names of the kinds that have what `has` asks for, as a sentence lists them: "a", "a or b".
[[nodiscard]] std::string names_of_kinds(bool (*has)(const TrackerKind& kind));

}  // namespace veritrack::certificates
