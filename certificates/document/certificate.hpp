// A certificate: a design, what was claimed of it, the verdict on each claim, and the ground for it.
#pragma once

#include <any>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/rigor/verdict.hpp"
#include "analysis/search/deadline.hpp"
#include "analysis/sets/kalman_filter_result.hpp"
#include "analysis/theorems/derivation.hpp"
#include "certificates/design/design.hpp"
#include "certificates/document/formal_proof.hpp"
#include "certificates/sets/simulation.hpp"

namespace veritrack::certificates {

/// A statement about the design, decided.
struct Claim {
  std::string id;         ///< e.g. "ekf/frequency-error-bound"
  std::string statement;  ///< one sentence with all its hypotheses, with units
  /// How the statement begins, where it says on what it rests; empty where it does so elsewhere.
  std::string hypotheses = {};
  std::string requirement;  ///< what [require] asks, in short; empty when it does not
  rigor::Verdict verdict = rigor::Verdict::undecided;
  bool required = false;  ///< is in [require] of the design file
  Position position;      ///< of the requirement in the design file; line 0 when it is not required
  std::string reason;     ///< one sentence: the ground for the verdict
  std::vector<theorems::Quantity> evidence;
  /// Further values that make the sentence what it is, by name: decimals as they stand in it.
  std::vector<std::pair<std::string, std::string>> values = {};
};

/// How much is looked for.
enum class Extent {
  everything,
  requirements,  ///< what decides [require], and not what takes long and is only reported beside it
  verdicts,      ///< the same verdicts; a search stops as soon as it has them
  quick  ///< one search for a set that does all that is required, and no other: what that leaves undecided,
         ///< another extent may prove
};

struct Certificate {
  Design design;
  Extent extent = Extent::everything;
  search::Deadline deadline;                      ///< of the search, where the kind of tracker keeps one
  std::string design_file;                        ///< its name, without folders
  std::string design_text;                        ///< as read
  std::vector<theorems::Derivation> derivations;  ///< what follows from what, by the kind of tracker
  /// What is certified of the assumed starts and beyond; none for a tracker without such a certificate.
  std::optional<sets::KalmanFilterResult> contraction;
  std::vector<Claim> claims;
  /// Of all required claims together; none when nothing is required, which is no verdict at all.
  std::optional<rigor::Verdict> verdict;
  Simulation simulation;  ///< the double-precision run behind the audits and the figures
  std::any particulars;   ///< what only this kind of tracker has; its column knows the type
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

/// How far following a set of starts has come.
struct Progress {
  double proved_share = 0.0;   ///< of the starts, by volume
  double refuted_share = 0.0;  ///< of the starts, by volume
  std::size_t propagations = 0;
};

/// Told how far the long part of the work has come, now and then.
using CertifyProgress = std::function<void(const Progress&)>;

/// Evaluates everything that can be said of the design. `design_text` is the file's text and `design_file`
/// its name without folders, for the documents. Only kinds that are `limited_in_time` look at the deadline.
/// Opens its own rounding scope.
[[nodiscard]] Certificate certify(const Design& design, const std::string& design_file,
                                  const std::string& design_text, const CertifyProgress& progress = {},
                                  Extent extent = Extent::everything, const search::Deadline& deadline = {});

/// Reads the design file at `path` and certifies it. Throws InputError.
[[nodiscard]] Certificate certify_file(const std::filesystem::path& path,
                                       const CertifyProgress& progress = {},
                                       Extent extent = Extent::everything,
                                       const search::Deadline& deadline = {});

}  // namespace veritrack::certificates
