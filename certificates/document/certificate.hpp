// A certificate: a design, the claims about it, the verdict on each claim, and the ground for it.
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
#include "analysis/statements/derivation.hpp"
#include "certificates/design/design.hpp"
#include "certificates/document/formal_proof.hpp"
#include "certificates/sets/simulation.hpp"

namespace veritrack::certificates {

/// A statement about the design, decided.
struct Claim {
  std::string id;         ///< e.g. "ekf/frequency-error-bound"
  std::string statement;  ///< one sentence with all its hypotheses, with units
  /// The beginning of the statement, if it states the hypotheses; empty if they stand elsewhere.
  std::string hypotheses = {};
  std::string requirement;   ///< the requirement of [require], in short; empty when there is none
  std::string finding = {};  ///< in short, where the headline names it once it is refuted
  rigor::Verdict verdict = rigor::Verdict::undecided;
  bool required = false;  ///< is in [require] of the design file
  Position position;      ///< of the requirement in the design file; line 0 when it is not required
  std::string reason;     ///< one sentence: the ground for the verdict
  std::vector<theorems::Quantity> evidence;
  /// Further values that the sentence depends on, by name: decimals as they stand in it.
  std::vector<std::pair<std::string, std::string>> values = {};
};

/// The extent of the search.
enum class Extent {
  everything,
  requirements,  ///< everything that decides [require], without long computations that are only reported
                 ///< beside it
  verdicts,      ///< the same verdicts; a search stops as soon as it has them
  quick  ///< a single search for a set that meets all requirements: another extent may prove what it leaves
         ///< undecided
};

struct Certificate {
  Design design;
  Extent extent = Extent::everything;
  search::Deadline deadline;                      ///< of the search, where the kind of tracker keeps one
  std::string design_file;                        ///< its name, without folders
  std::string design_text;                        ///< as read
  std::vector<theorems::Derivation> derivations;  ///< the deductions, by the kind of tracker
  /// The certified bounds on the assumed starts and beyond; empty for a tracker without such a certificate.
  std::optional<sets::KalmanFilterResult> contraction;
  std::vector<Claim> claims;
  /// The verdict on all required claims together; empty when nothing is required: then there is no verdict.
  std::optional<rigor::Verdict> verdict;
  Simulation simulation;  ///< the double-precision run behind the audits and the figures
  std::any particulars;   ///< the data that only this kind of tracker has; its column knows the type
  std::optional<FormalProofs> formal_proofs;  ///< when requested: see coq_document.hpp
};

/// The derivations whose id begins with that prefix.
[[nodiscard]] std::vector<theorems::Derivation> derivations_of(const Certificate& certificate,
                                                               std::string_view prefix);

/// The derivation of that id; null when there is none.
[[nodiscard]] const theorems::Derivation* find_derivation(const Certificate& certificate,
                                                          std::string_view id);

/// "proved", "refuted", "undecided", or "nothing-required".
[[nodiscard]] std::string verdict_text(const Certificate& certificate);

/// The progress of following a set of starts.
struct Progress {
  double proved_share = 0.0;   ///< of the starts, by volume
  double refuted_share = 0.0;  ///< of the starts, by volume
  std::size_t propagations = 0;
};

/// Called now and then with the progress of the long part of the work.
using CertifyProgress = std::function<void(const Progress&)>;

/// Evaluates every statement on the design. `design_text` is the file's text and `design_file` its name
/// without folders, for the documents. Only kinds that are `limited_in_time` look at the deadline. Opens its
/// own rounding scope.
[[nodiscard]] Certificate certify(const Design& design, const std::string& design_file,
                                  const std::string& design_text, const CertifyProgress& progress = {},
                                  Extent extent = Extent::everything, const search::Deadline& deadline = {});

/// Reads the design file at `path` and certifies it. Throws InputError.
[[nodiscard]] Certificate certify_file(const std::filesystem::path& path,
                                       const CertifyProgress& progress = {},
                                       Extent extent = Extent::everything,
                                       const search::Deadline& deadline = {});

}  // namespace veritrack::certificates
