#include "certificates/dft_block/block_loss.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "analysis/dft_block/lock_loss.hpp"
#include "analysis/dft_block/lowest_snr.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/dft_block/block_sentences.hpp"
#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/sets/required_claims.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr int kLossDigits = 3;
/// Within the blocks, where no probability is required.
constexpr double kUsualProbability = 1e-6;

dft_block::LossQuestion loss_question(const BlockTables& tables, const dft_block::LockQuestion& lock) {
  dft_block::LossQuestion question;
  question.problem = lock.problem;
  question.problem.noise = Interval(0.0);
  question.deviation = bin_deviation(tables);
  question.blocks = tables.assume.blocks.value().value;
  question.amplitude_error = lock.amplitude_error;
  question.phase_error = lock.phase_error;
  question.offset_error = lock.offset_error;
  question.covariance = lock.covariance;
  return question;
}

dft_block::LowestSnrQuestion lowest_snr_question(const BlockTables& tables,
                                                 const dft_block::LockQuestion& lock) {
  const auto& required = tables.require.probability_of_losing_lock_below;
  // A little below the required value.
  constexpr double kBelow = 0.999;
  return {loss_question(tables, lock), bin_deviation(with_snr(tables, "0")),
          Interval(kBelow) * Interval(required ? required->value.lower() : kUsualProbability)};
}

/// A quantity that is proved; null where it is not.
const theorems::Quantity* proved_quantity(const theorems::Derivation& found, const char* name) {
  return found.verdict == Verdict::proved ? theorems::applicable_quantity(found, name) : nullptr;
}

/// Bins are one apart, and so are the locks about them.
bool is_lock(const theorems::Quantity& offset_error) {
  return rigor::certainly_less(offset_error.value, Interval(0.5));
}

/// The statement of a derivation in Gaussian noise, after its hypotheses; empty when there is none.
std::optional<Claim> losing_lock(const char* id, const theorems::Derivation& found,
                                 const BlockTables& tables) {
  const theorems::Quantity* probability = proved_quantity(found, "probability_of_losing_lock");
  const theorems::Quantity* error = proved_quantity(found, "offset_error_bound");
  const theorems::Quantity* rms = proved_quantity(found, "rms_offset_error");
  if (probability == nullptr || error == nullptr || rms == nullptr ||
      !rigor::certainly_less(probability->value, Interval(1.0)) || !is_lock(*error)) {
    return std::nullopt;
  }
  Claim claim;
  claim.id = id;
  claim.verdict = Verdict::proved;
  claim.evidence = {*probability, *error, *rms};
  claim.hypotheses = block_hypotheses(tables);
  claim.statement =
      claim.hypotheses +
      fmt::format(
          "the probability that within the first {} blocks the offset error of an estimate exceeds {} bins "
          "is at most {}; while the filter is in lock, the root mean square of that error is at most {} bins "
          "in every block.",
          tables.assume.blocks.value().text, rigor::upper_decimal(error->value, kLossDigits),
          rigor::upper_decimal(probability->value, kLossDigits),
          rigor::upper_decimal(rms->value, kLossDigits));
  return claim;
}

/// The first condition that is not proved.
std::string open_ground(const theorems::Derivation& found) {
  for (const theorems::Condition& condition : found.conditions) {
    if (condition.verdict != Verdict::proved) {
      return condition.reason;
    }
  }
  return "The bound that is proved is 1.";
}

/// The same for the most noise that was proved, where that was searched for.
void add_lowest_snr(Certificate& certificate, const BlockTables& tables) {
  const theorems::Derivation* lowest = find_derivation(certificate, "lowest-snr");
  const theorems::Quantity* decibels = lowest != nullptr ? proved_quantity(*lowest, "lowest_snr") : nullptr;
  if (decibels == nullptr) {
    return;
  }
  std::optional<Claim> claim = losing_lock(
      "dft-block/lowest-snr", *lowest, with_snr(tables, lowest->evidence.front().decimals.front().second));
  if (claim) {
    claim->reason =
        "The same for more noise, or less, than is assumed: the lowest signal-to-noise ratio, in steps of "
        "0.01 dB, for which a set was found and verified.";
    claim->evidence.push_back(*decibels);
    certificate.claims.push_back(std::move(*claim));
  }
}

}  // namespace

void derive_block_loss(Certificate& certificate, const dft_block::LockQuestion& lock) {
  const BlockTables& tables = block_tables(certificate.design);
  certificate.derivations.push_back(dft_block::derive_loss(loss_question(tables, lock)));
  if (certificate.extent == Extent::everything && tables.assume.one_amplitude) {
    certificate.derivations.push_back(dft_block::derive_lowest_snr(lowest_snr_question(tables, lock)));
  }
}

void add_block_loss_claims(Certificate& certificate) {
  const BlockTables& tables = block_tables(certificate.design);
  const theorems::Derivation& found = *find_derivation(certificate, "lock-in-noise");
  const std::string hypotheses = block_hypotheses(tables);
  const std::string& blocks = tables.assume.blocks.value().text;
  std::optional<Claim> proved = losing_lock("dft-block/losing-lock", found, tables);
  const bool says_something = proved.has_value();
  Claim claim = std::move(proved).value_or(Claim{});
  if (says_something) {
    claim.reason = "An exponential of the errors grows by no more than a constant on average in each block.";
  } else {
    claim.id = "dft-block/losing-lock";
    claim.statement =
        hypotheses +
        fmt::format("the probability of losing lock within the first {} blocks is below 1.", blocks);
    claim.reason = open_ground(found);
  }
  certificate.claims.push_back(std::move(claim));
  if (const auto& below = tables.require.probability_of_losing_lock_below) {
    Claim needed =
        required_claim("dft-block/probability-of-losing-lock",
                       fmt::format("within the first {} blocks lock is lost, the offset error exceeding "
                                   "half a bin, with a probability below {}",
                                   blocks, below->text),
                       hypotheses, *below);
    needed.reason = open_ground(found);
    if (says_something) {
      const theorems::Quantity& probability = *proved_quantity(found, "probability_of_losing_lock");
      const bool is_met = rigor::certainly_less(probability.value, below->value);
      needed.verdict = is_met ? Verdict::proved : Verdict::undecided;
      needed.reason =
          fmt::format("The proved bound is {}{}.", rigor::upper_decimal(probability.value, kLossDigits),
                      is_met ? "" : ", which is not what is required");
      if (is_met) {
        needed.evidence = {probability};
      }
    }
    certificate.claims.push_back(std::move(needed));
  }
  add_lowest_snr(certificate, tables);
}

}  // namespace veritrack::certificates
