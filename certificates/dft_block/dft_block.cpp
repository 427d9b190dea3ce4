#include "certificates/dft_block/dft_block.hpp"

#include <fmt/format.h>

#include <utility>

#include "analysis/dft_block/false_lock.hpp"
#include "analysis/dft_block/lock_certificate.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/dft_block/block_loss.hpp"
#include "certificates/dft_block/block_sentences.hpp"
#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/dft_block/false_lock_claims.hpp"
#include "certificates/sets/assumptions_json.hpp"
#include "certificates/sets/required_claims.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Verdict;

constexpr int kBlockDigits = 3;

dft_block::LockQuestion lock_question(const BlockTables& tables) {
  const BlockAssumptions& assume = tables.assume;
  dft_block::LockQuestion question;
  question.problem = {tables.design.q1.value,
                      tables.design.q2.value,
                      tables.design.q3.value,
                      tables.design.r.value,
                      static_cast<int>(tables.design.half_width.nearest),
                      hull(assume.amplitude[0].value, assume.amplitude[1].value),
                      hull(assume.offset[0].value, assume.offset[1].value),
                      assume.noise.value,
                      assume.slew.value};
  question.amplitude_error = assume.initial_amplitude_error.value;
  question.phase_error = assume.initial_phase_error.value;
  question.offset_error = assume.initial_offset_error.value;
  if (!assume.initial_covariance.empty()) {
    rigor::IntervalMatrix<3> covariance;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        covariance(i, j) = assume.initial_covariance[static_cast<std::size_t>(3 * i + j)].value;
      }
    }
    question.covariance = covariance;
  }
  if (tables.require.settled_below) {
    constexpr double kBelow = 0.999;
    question.settled_error = kBelow * tables.require.settled_below->nearest;
  }
  return question;
}

/// The claims, and the derivation that decides them.
class BlockClaims {
 public:
  explicit BlockClaims(Certificate& certificate)
      : certificate_(&certificate),
        tables_(&block_tables(certificate.design)),
        found_(find_derivation(certificate, "lock-set")),
        hypotheses_(block_hypotheses(*tables_)) {}

  void add_all() {
    add_guarantee();
    if (tables_->require.offset_error_below) {
      add_offset_error(*tables_->require.offset_error_below);
    }
    if (tables_->require.settles_within && tables_->require.settled_below) {
      add_settles(*tables_->require.settles_within, *tables_->require.settled_below);
    }
    conclude_requirements(*certificate_);
  }

 private:
  [[nodiscard]] const theorems::Quantity* quantity(const char* name) const {
    return found_->verdict == Verdict::proved ? theorems::applicable_quantity(*found_, name) : nullptr;
  }

  void add(Claim claim) {
    if (claim.verdict == Verdict::undecided && claim.reason.empty()) {
      claim.reason = "Nothing is proved of this design.";
      for (const theorems::Condition& condition : found_->conditions) {
        if (condition.verdict != Verdict::proved) {
          claim.reason = condition.reason;
          break;
        }
      }
    }
    certificate_->claims.push_back(std::move(claim));
  }

  [[nodiscard]] Claim required(const char* id, const Number& number, std::string requirement) const {
    return required_claim(id, std::move(requirement), hypotheses_, number);
  }

  void add_offset_error(const Number& below) {
    Claim claim = required("dft-block/offset-error", below,
                           fmt::format("the offset error is below {} bins in every block", below.text));
    if (const theorems::Quantity* bound = quantity("offset_error_bound")) {
      const bool is_met = rigor::certainly_less(bound->value, below.value);
      claim.verdict = is_met ? Verdict::proved : Verdict::undecided;
      claim.reason =
          fmt::format("The proved bound is {} bins{}.", rigor::upper_decimal(bound->value, kBlockDigits),
                      is_met ? "" : ", which is not what is required");
      if (is_met) {
        claim.evidence = {*bound};
      }
    }
    add(std::move(claim));
  }

  void add_settles(const Number& within, const Number& below) {
    Claim claim =
        required("dft-block/settles", within,
                 fmt::format("from block {} on, the offset error is below {} bins", within.text, below.text));
    const theorems::Quantity* blocks = quantity("settling_blocks");
    const theorems::Quantity* settled = quantity("settled_offset_error");
    if (blocks != nullptr && settled != nullptr) {
      const bool is_met = rigor::certainly_less_equal(blocks->value, within.value) &&
                          rigor::certainly_less(settled->value, below.value);
      claim.verdict = is_met ? Verdict::proved : Verdict::undecided;
      claim.reason =
          fmt::format("It is proved from block {} on{}.", rigor::upper_decimal(blocks->value, kBlockDigits),
                      is_met ? "" : ", which is not what is required");
      if (is_met) {
        claim.evidence = {*blocks, *settled};
      }
    } else if (found_->verdict == Verdict::proved) {
      claim.reason = "No block is proved from which it is: the bound in the long run is larger.";
    }
    add(std::move(claim));
  }

  /// The proved statements, with all numbers.
  void add_guarantee() {
    Claim claim;
    claim.id = "dft-block/guarantee";
    claim.hypotheses = hypotheses_;
    claim.statement = hypotheses_;
    const theorems::Quantity* ever = quantity("offset_error_bound");
    const theorems::Quantity* last = quantity("ultimate_offset_error");
    if (ever == nullptr || last == nullptr) {
      claim.statement += "the offset error is bounded.";
      add(std::move(claim));
      return;
    }
    const auto most = [](const theorems::Quantity* one) {
      return rigor::upper_decimal(one->value, kBlockDigits);
    };
    claim.verdict = Verdict::proved;
    claim.statement += fmt::format(
        "the offset error of every estimate and prediction is at most {} bins, and in the long run at most "
        "{} bins",
        most(ever), most(last));
    claim.evidence = {*ever, *last};
    const theorems::Quantity* blocks = quantity("settling_blocks");
    const theorems::Quantity* settled = quantity("settled_offset_error");
    if (blocks != nullptr && settled != nullptr && settled->value.upper() < ever->value.upper() &&
        most(settled) != most(ever)) {
      claim.statement += fmt::format("; from block {} on at most {} bins", most(blocks), most(settled));
      claim.evidence.insert(claim.evidence.end(), {*blocks, *settled});
    }
    claim.statement += ".";
    claim.reason = "Every block shortens the errors of a set that noise and slew do not push them out of.";
    add(std::move(claim));
  }

  Certificate* certificate_;
  const BlockTables* tables_;
  const theorems::Derivation* found_;
  std::string hypotheses_;
};

}  // namespace

void certify_dft_block(Certificate& certificate, const CertifyProgress& /*progress*/) {
  const BlockTables& tables = block_tables(certificate.design);
  const dft_block::LockQuestion question = lock_question(tables);
  if (tables.assume.gaussian) {
    derive_block_loss(certificate, question);
  } else {
    certificate.derivations.push_back(dft_block::derive_lock(question));
  }
  // Statements beside [require] are not requested by everyone.
  const bool all = certificate.extent == Extent::everything;
  if (all) {
    for (theorems::Derivation& found : dft_block::derive_false_locks(question.problem)) {
      certificate.derivations.push_back(std::move(found));
    }
  }
  if (tables.assume.gaussian) {
    add_block_loss_claims(certificate);
    conclude_requirements(certificate);
  } else {
    BlockClaims(certificate).add_all();
  }
  if (all) {
    add_false_lock_claims(certificate);
  }
}

Json dft_block_design_json(const Design& read) {
  const auto& [design, assume, require, simulate] = block_tables(read);
  Json amplitude = number_json(assume.amplitude[0]);
  if (!assume.one_amplitude) {
    amplitude = Json::array({number_json(assume.amplitude[0]), number_json(assume.amplitude[1])});
  }
  Json covariance = "steady-state";
  if (!assume.initial_covariance.empty()) {
    covariance = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
      Json row = Json::array();
      for (std::size_t j = 0; j < 3; ++j) {
        row.push_back(number_json(assume.initial_covariance[3 * i + j]));
      }
      covariance.push_back(row);
    }
  }
  Json required = Json::object();
  add_number(required, "offset_error_below", require.offset_error_below);
  add_number(required, "settles_within", require.settles_within);
  add_number(required, "settled_below", require.settled_below);
  add_number(required, "probability_of_losing_lock_below", require.probability_of_losing_lock_below);
  Json chosen{{"q1", number_json(design.q1)},
              {"q2", number_json(design.q2)},
              {"q3", number_json(design.q3)},
              {"r", number_json(design.r)},
              {"half_width", number_json(design.half_width)}};
  add_number(chosen, "block_length", design.block_length);
  add_number(chosen, "centre", design.centre);
  Json assumed{{"amplitude", amplitude},
               {"offset", Json::array({number_json(assume.offset[0]), number_json(assume.offset[1])})},
               {"noise", noise_json(assume.noise, assume.gaussian)},
               {"slew", number_json(assume.slew)},
               {"initial_amplitude_error", number_json(assume.initial_amplitude_error)},
               {"initial_phase_error", number_json(assume.initial_phase_error)},
               {"initial_offset_error", number_json(assume.initial_offset_error)},
               {"initial_covariance", covariance}};
  add_number(assumed, "blocks", assume.blocks);
  return {{"design", chosen}, {"assume", assumed}, {"require", required}};
}

}  // namespace veritrack::certificates
