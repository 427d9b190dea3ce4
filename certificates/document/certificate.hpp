// A certificate: a design, what was claimed of it, the verdict on each claim, and the ground for it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/quadrature/capture/capture_basin.hpp"
#include "analysis/quadrature/capture/capture_region.hpp"
#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/rigor/verdict.hpp"
#include "analysis/sets/contraction_result.hpp"
#include "analysis/theorems/audit.hpp"
#include "analysis/theorems/derivation.hpp"
#include "certificates/design/design.hpp"
#include "certificates/document/formal_proof.hpp"
#include "certificates/sets/simulation.hpp"

namespace veritrack::certificates {

/// A statement about the design, decided.
struct Claim {
  std::string id;         ///< e.g. "ekf/frequency-error-bound"
  std::string statement;  ///< one sentence of Markdown, with units
  rigor::Verdict verdict = rigor::Verdict::undecided;
  bool required = false;  ///< stands in [require] of the design file
  Position position;      ///< of the requirement in the design file; line 0 when it is not required
  std::string reason;     ///< one sentence: the ground for the verdict
  std::vector<theorems::Quantity> evidence;
};

/// The audit of one reading of the theorem along the simulated trajectory.
struct AuditedDerivation {
  std::string derivation;  ///< the id of the derivation whose constants were audited
  theorems::Audit audit;
};

/// A set that the tracker never leaves, with what it was made for: evidence that can be checked again without
/// the search that found it.
struct NamedSet {
  std::string purpose;  ///< as in certificate.schema.json, e.g. "start-error"
  quadrature::CertifiedSet set;
};

/// The assumed starts, followed because they exceed the certified set.
struct FollowedStarts {
  quadrature::Region region;           ///< with the assumed noise and slew
  quadrature::SimulatedBasin basin;    ///< without, by simulation: proves nothing
  std::vector<double> frequency_tube;  ///< see quadrature::StartCapture; empty unless PROVED
};

/// What one result gives for the design, side by side with the others.
struct ComparedResult {
  std::string result;                     ///< the derivation's id, or "simulation"
  std::optional<rigor::Verdict> verdict;  ///< of its conditions; none for a simulation
  std::optional<rigor::Interval>
      frequency_error;                   ///< of the start, certified up to the lower end, rad/sample
  std::optional<rigor::Interval> noise;  ///< up to the lower end, relative to the amplitude
  std::optional<rigor::Interval> rate;   ///< factor per sample, at most the upper end
  bool simulated = false;                ///< proves nothing
};

struct Certificate {
  Design design;
  std::string design_file;  ///< its name, without folders
  std::string design_text;  ///< as read
  /// The published theorem in its readings ("theorem-2.9/..."), then what this program proves
  /// ("contraction"; then, when the starts exceed the certified set, "capture" and perhaps
  /// "capture/noise-free" and "capture/reduced-noise").
  std::vector<theorems::Derivation> derivations;
  /// What is certified of the assumed starts and beyond; none for a tracker without such a certificate.
  std::optional<sets::ContractionResult> contraction;
  std::vector<NamedSet> certified_sets;
  std::optional<FollowedStarts> followed_starts;  ///< none when the certified set holds the assumed starts
  std::vector<AuditedDerivation> audits;
  std::vector<ComparedResult> comparison;
  std::vector<Claim> claims;
  /// Of all required claims together; none when nothing is required, which is no verdict at all.
  std::optional<rigor::Verdict> verdict;
  Simulation simulation;                      ///< the double-precision run behind the audits and the figures
  std::optional<FormalProofs> formal_proofs;  ///< when asked for: see coq_document.hpp
};

/// The derivations whose id begins with that prefix.
[[nodiscard]] std::vector<theorems::Derivation> derivations_of(const Certificate& certificate,
                                                               std::string_view prefix);

/// The derivation of that id; null when there is none.
[[nodiscard]] const theorems::Derivation* find_derivation(const Certificate& certificate,
                                                          std::string_view id);

/// "proved", "refuted", "undecided", or "nothing-required".
[[nodiscard]] std::string verdict_text(const Certificate& certificate);

/// Told how far the long part of the work has come, now and then.
using CertifyProgress = std::function<void(const quadrature::RegionProgress&)>;

/// Evaluates everything that can be said of the design. `design_text` is the file's text and `design_file`
/// its name without folders, for the documents. Opens its own rounding scope.
[[nodiscard]] Certificate certify(const Design& design, const std::string& design_file,
                                  const std::string& design_text, const CertifyProgress& progress = {});

/// Reads the design file at `path` and certifies it. Throws InputError.
[[nodiscard]] Certificate certify_file(const std::filesystem::path& path,
                                       const CertifyProgress& progress = {});

}  // namespace veritrack::certificates
