#include "papers/ledger/ledger.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/help/texts.hpp"
#include "papers/claims/block_transform_claims.hpp"
#include "papers/claims/design_paper_claims.hpp"
#include "papers/claims/regulator_claims.hpp"
#include "papers/claims/self_tuning_claims.hpp"
#include "papers/claims/sine_filter_claims.hpp"
#include "papers/claims/sine_listing_claims.hpp"
#include "papers/claims/spill_over_claims.hpp"
#include "papers/claims/stability_lemma_claims.hpp"
#include "papers/claims/tracker_theory_claims.hpp"
#include "papers/claims/vibration_loop_claims.hpp"
#include "papers/dft_block/lock_claims.hpp"
#include "papers/dft_block/thesis_claims.hpp"
#include "papers/kkl_observer/injectivity_claims.hpp"
#include "papers/kkl_observer/paper_sentences.hpp"
#include "papers/ledger/published_designs.hpp"
#include "papers/regulator/limit_claims.hpp"
#include "papers/single_channel/paper_sentences.hpp"
#include "papers/single_channel/printed_recursion_claims.hpp"

namespace veritrack::reports::ledger {

namespace {

using rigor::Verdict;
using theorems::FindingKind;

/// The results that the publications state for one of their designs.
certificates::Certificate published_results_of(const certificates::EmbeddedText& file) {
  const rigor::UpwardRounding upward;
  certificates::Certificate certificate;
  certificate.design = certificates::read_design(file.text, file.name);
  certificate.design_file = std::filesystem::path(file.name).filename().string();
  certificate.design_text = file.text;
  certificates::kind_of(certificate.design).published_results(certificate);
  return certificate;
}

class Collection {
 public:
  void add(const certificates::Certificate& certificate) {
    design_ = std::filesystem::path(certificate.design_file).stem().string();
    for (const certificates::Claim& claim : certificate.claims) {
      add(claim.id, certificates::markdown::escaped(claim.statement), claim.verdict, claim.reason);
    }
    for (const theorems::Derivation& derivation : certificate.derivations) {
      for (const theorems::Condition& condition : derivation.conditions) {
        add(derivation.id + "/" + condition.id, certificates::markdown::math(condition.statement),
            condition.verdict, condition.reason);
      }
    }
  }

  /// Statements in which no design enters. Throws std::logic_error when one is not about a publication: it
  /// would have no row.
  void add(const std::vector<theorems::Statement>& statements) {
    design_ = kNoDesign;
    for (const theorems::Statement& statement : statements) {
      if (!theorems::is_published(statement.id)) {
        throw std::logic_error(statement.id + " has no place in a publication (paper_places.cpp)");
      }
      add(statement.id, certificates::markdown::escaped(statement.sentence), statement.verdict,
          statement.witness);
    }
  }

  /// By publication.
  [[nodiscard]] std::vector<Row> rows() && {
    std::stable_sort(rows_.begin(), rows_.end(),
                     [](const Row& a, const Row& b) { return a.place.paper < b.place.paper; });
    return std::move(rows_);
  }

 private:
  void add(const std::string& id, const std::string& words, Verdict verdict, const std::string& ground) {
    if (!theorems::is_published(id)) {
      return;
    }
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& each) { return each.claim == id; });
    if (row == rows_.end()) {
      rows_.push_back({id, theorems::paper_place(id), words, {}, nullptr});
      row = rows_.end() - 1;
    }
    row->verdicts.push_back({design_, verdict, ground});
    const theorems::PaperFinding* finding = theorems::find_paper_finding(id);
    if (verdict == Verdict::refuted ||
        (finding != nullptr && finding->kind == theorems::FindingKind::illegible)) {
      row->finding = finding;
    }
  }

  std::string design_;
  std::vector<Row> rows_;
};

/// The sentence in another reading that is PROVED for every design: "…/errata" beside "…/printed". A repair
/// of ours comes first.
const Row* proved_reading(const Row& row, const std::vector<Row>& rows) {
  constexpr std::string_view kPrinted = "printed";
  const std::string sentence = row.claim.ends_with(kPrinted)
                                   ? row.claim.substr(0, row.claim.size() - kPrinted.size())
                                   : row.claim.substr(0, row.claim.rfind('/') + 1);
  for (const std::string_view reading : {"repaired", "corrected", "errata", "2.36", "2.12"}) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& each) {
      return each.claim == sentence + std::string(reading) && each.is_everywhere(Verdict::proved);
    });
    if (found != rows.end()) {
      return &*found;
    }
  }
  return nullptr;
}

/// "; in its place: ..." when there is something.
std::string with_repair(const std::string& words, const Row& row, const std::vector<Row>& rows) {
  const Row* reading = proved_reading(row, rows);
  const std::string repair = reading != nullptr ? reading->claim : std::string(row.place.repair);
  return repair.empty() || repair == row.claim ? words : words + "; in its place: " + repair;
}

}  // namespace

bool Row::is_uniform() const {
  return is_everywhere(verdicts.front().verdict);
}

bool Row::is_everywhere(Verdict verdict) const {
  return !verdicts.empty() && std::all_of(verdicts.begin(), verdicts.end(),
                                          [&](const DesignVerdict& each) { return each.verdict == verdict; });
}

bool Row::is_anywhere(Verdict verdict) const {
  return std::any_of(verdicts.begin(), verdicts.end(),
                     [&](const DesignVerdict& each) { return each.verdict == verdict; });
}

bool Row::is_illegible() const {
  return finding != nullptr && finding->kind == FindingKind::illegible;
}

bool Row::stands() const {
  return is_everywhere(Verdict::proved);
}

bool Row::falls() const {
  return is_anywhere(Verdict::refuted);
}

std::vector<Row> collect() {
  Collection collection;
  for (const certificates::EmbeddedText& design : published_designs()) {
    collection.add(published_results_of(design));
  }
  const rigor::UpwardRounding upward;
  collection.add(theorems::block_transform_claims());
  collection.add(dft_block::filter_bank_claims());
  collection.add(dft_block::model_output_claims());
  collection.add(dft_block::observability_claims());
  collection.add(dft_block::tuning_claims());
  collection.add(dft_block::initial_estimate_claims());
  collection.add(dft_block::lock_claims());
  collection.add(theorems::regulator_claims());
  collection.add(theorems::stability_lemma_claims());
  collection.add(theorems::tracker_theory_claims());
  collection.add(theorems::vibration_model_claims());
  collection.add(theorems::self_tuning_claims());
  collection.add(theorems::parameter_convergence_claims());
  collection.add(regulator::limit_polynomial_claims());
  collection.add(regulator::limit_loop_claims());
  collection.add(single_channel::paper_sentences());
  collection.add(single_channel::printed_recursion_claims());
  collection.add(kkl_observer::paper_sentences());
  collection.add(kkl_observer::injectivity_claims());
  collection.add(theorems::design_paper_claims());
  collection.add(theorems::design_paper_lemma_claims());
  collection.add(theorems::design_paper_loop_claims());
  collection.add(theorems::sine_filter_claims());
  collection.add(theorems::sine_listing_claims());
  collection.add(theorems::spill_over_claims());
  return std::move(collection).rows();
}

std::string consequence(const Row& row, const std::vector<Row>& rows) {
  if (row.place.role == theorems::PaperRole::repair) {
    return "ours, in place of what is printed";
  }
  if (row.is_illegible()) {
    return "none that can be decided from the scan";
  }
  if (!row.is_anywhere(Verdict::refuted)) {
    return row.is_everywhere(Verdict::proved) ? "it stands" : "open";
  }
  if (row.place.role == theorems::PaperRole::hypothesis) {
    return with_repair(row.is_everywhere(Verdict::refuted)
                           ? "the theorem says nothing about these designs"
                           : "the theorem says nothing about the designs for which it is refuted",
                       row, rows);
  }
  if (row.finding == nullptr) {
    return with_repair("it fails for the numbers that the publication prints", row, rows);
  }
  switch (row.finding->kind) {
    case FindingKind::false_as_stated:
      return with_repair("what rests on it needs another argument", row, rows);
    case FindingKind::slip_without_consequence: {
      const std::string words = "none: the correction is obvious, or the conclusion stands";
      const Row* reading = proved_reading(row, rows);
      return reading == nullptr ? words : words + "; in its place: " + reading->claim;
    }
    case FindingKind::needs_unstated_assumption:
      return with_repair("it is true under an assumption that should be stated", row, rows);
    case FindingKind::illegible:
      break;  // above
  }
  return "";
}

}  // namespace veritrack::reports::ledger
