// The interface of a kind of tracker to certificates: one record for each, made in its column. The registry
// (certificates/registry.cpp) knows them all; nothing else asks which tracker a design is for.
#pragma once

#include <filesystem>
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
#include "certificates/document/tie.hpp"
#include "certificates/document/tracker_run.hpp"
#include "certificates/document/tuning.hpp"
#include "certificates/sets/frequency_promise.hpp"

namespace veritrack::certificates {

struct TrackerKind {
  std::string_view name;  ///< as the key `tracker` of a design file names it
  /// The tables of the design as certificate.json repeats them: an object with one member for each table.
  /// Values that no proof rests on are left out.
  Json (*design_json)(const Design& design);
  /// Adds every statement on the design. Needs the upward mode.
  void (*certify)(Certificate& certificate, const CertifyProgress& progress);
  /// The claims that answer, on the first page.
  std::vector<const Claim*> (*answers)(const Certificate& certificate);
  /// The sections between what was required and how to reproduce it.
  std::string (*sections)(const Certificate& certificate, const MarkdownOptions& options);

  // Members that not every kind has: null where it has none.

  /// The first page's reports beside the answers.
  std::string (*remarks)(const Certificate& certificate) = nullptr;

  /// Adds only the part of `certify` on publications: the derivations and claims that
  /// theorems::find_paper_place knows. Takes a second at most. Needs the upward mode.
  void (*published_results)(Certificate& certificate) = nullptr;
  /// The sections of published-theorems.md: the statements of the papers about the design. Empty when there
  /// are none.
  std::string (*published)(const Certificate& certificate) = nullptr;
  /// Whether its search ends at the deadline of the certificate.
  bool limited_in_time = false;
  /// Members of certificate.json beside derivations and claims, from which something is verified.
  Json (*evidence_json)(const Certificate& certificate) = nullptr;
  /// Members of report.json beside derivations and claims, which are reported and not verified.
  Json (*report_json)(const Certificate& certificate) = nullptr;
  /// Needs the upward mode.
  FormalProofs (*formal_proofs)(const Certificate& certificate) = nullptr;
  /// Opens its own rounding scopes.
  TuningResult (*tune)(const Design& design, const TuningRequest& request) = nullptr;
  /// The objectives of `tune`; the first that fits the assumptions is the default.
  std::span<const std::string_view> tuning_objectives = {};
  /// The design file names its parameters; the request of `tune` says which of them may change.
  bool names_parameters = false;
  /// The step as text. Opens its own rounding scopes.
  std::string (*show)(const Design& design, CodeLanguage language) = nullptr;
  /// The user's program is built, run, and compared with the design's code. Throws InputError for a design
  /// without code.
  TieAnswer (*tie)(const Design& design, const std::filesystem::path& design_file,
                   const TieRequest& request) = nullptr;
  /// The tracker in double precision, and the assumptions on its signal. Throws NotTrackable. Opens its own
  /// rounding scopes.
  TrackerOnSamples (*track)(const Design& design) = nullptr;
  /// The proved bounds on the frequency error. Needs the upward mode.
  FrequencyPromise (*frequency_promise)(const Certificate& certificate) = nullptr;
};

/// All kinds, in the order of certificates/trackers.def.
[[nodiscard]] std::span<const TrackerKind* const> tracker_kinds();

/// The kind of tracker that a design is for. Throws std::logic_error when the registry has none of that name,
/// which cannot happen for a design that was read.
[[nodiscard]] const TrackerKind& kind_of(const Design& design);

/// The names of the kinds that have what `has` asks for, as a sentence lists them: "a", "a or b".
[[nodiscard]] std::string names_of_kinds(bool (*has)(const TrackerKind& kind));

}  // namespace veritrack::certificates
