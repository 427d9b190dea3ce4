#include "certificates/dft_block/false_lock_claims.hpp"

#include <fmt/format.h>

#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "certificates/dft_block/block_sentences.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Verdict;
constexpr int kFalseLockDigits = 4;

std::string decimal_of(const theorems::Evidence& evidence, const std::string& name) {
  for (const auto& [key, text] : evidence.decimals) {
    if (key == name) {
      return text;
    }
  }
  return "";
}

std::string both_ends(const theorems::Quantity& quantity) {
  return fmt::format("{} and {}", rigor::lower_decimal(quantity.value, kFalseLockDigits),
                     rigor::upper_decimal(quantity.value, kFalseLockDigits));
}

Claim false_lock_claim(const BlockTables& tables, const theorems::Derivation& found) {
  const theorems::Quantity& offset = theorems::find_quantity(found, "offset_error");
  const theorems::Quantity& fixed = theorems::find_quantity(found, "fixed_offset_error");
  const theorems::Quantity& amplitude = theorems::find_quantity(found, "amplitude");
  const theorems::Evidence& evidence = found.evidence.front();
  Claim claim;
  claim.id = "dft-block/" + found.id;
  claim.verdict = Verdict::proved;
  claim.statement = fmt::format(
      "{}, is fed, without noise, with the bins (4.9) of a tone of the amplitude {} and the constant offset "
      "{} bins. From every first prediction and covariance of the set {}, the offset error of every "
      "prediction is between {} bins, for ever; it tends to one between {} bins, and the estimated amplitude "
      "to at most {} of the tone's.",
      block_filter_words(tables), decimal_of(evidence, "amplitude"), decimal_of(evidence, "offset"), found.id,
      both_ends(offset), both_ends(fixed), rigor::upper_decimal(amplitude.value, kFalseLockDigits));
  claim.evidence = {offset, fixed, amplitude};
  claim.reason = "The map of a block takes the set into itself and contracts it.";
  return claim;
}

}  // namespace

void add_false_lock_claims(Certificate& certificate) {
  const BlockTables& tables = block_tables(certificate.design);
  Claim every;
  every.id = "dft-block/every-start-locks";
  every.statement = fmt::format(
      "{}, is fed, without noise, with the bins (4.9) of a tone of {} and a constant offset between {} and "
      "{} "
      "bins. Whatever its first prediction and covariance, the offset error of some prediction is less than "
      "half a bin.",
      block_filter_words(tables), block_amplitude_words(tables.assume), tables.assume.offset[0].text,
      tables.assume.offset[1].text);
  every.reason = "No false lock was found, which does not mean that there is none.";
  std::vector<Claim> locks;
  for (const char* id : {"false-lock-below", "false-lock-above"}) {
    const theorems::Derivation* found = find_derivation(certificate, id);
    if (found != nullptr && found->verdict == Verdict::proved) {
      locks.push_back(false_lock_claim(tables, *found));
    }
  }
  if (!locks.empty()) {
    every.verdict = Verdict::refuted;
    every.reason = fmt::format("A start of the set {} stays more than half a bin off for ever.",
                               locks.front().id.substr(std::string("dft-block/").size()));
  }
  certificate.claims.push_back(std::move(every));
  for (Claim& claim : locks) {
    certificate.claims.push_back(std::move(claim));
  }
}

}  // namespace veritrack::certificates
