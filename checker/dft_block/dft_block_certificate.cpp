#include "checker/dft_block/dft_block_certificate.hpp"

#include <map>
#include <set>

#include "checker/dft_block/block_design.hpp"
#include "checker/dft_block/bounded_lock_check.hpp"
#include "checker/dft_block/false_lock_check.hpp"
#include "checker/dft_block/lock_loss_check.hpp"
#include "checker/document/evidence.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

const std::string kGuarantee = "dft-block/guarantee";
const std::string kLosingLock = "dft-block/losing-lock";
const std::string kLowestSnr = "dft-block/lowest-snr";
const std::string kLowest = "lowest-snr";  // the derivation
const std::string kEveryStart = "dft-block/every-start-locks";
const std::string kClaimOf = "dft-block/";  // and the id of a false lock

/// Walks through a certificate of a block tracker.
class BlockVerifier {
 public:
  BlockVerifier(const Tree& certificate, Verification& result)
      : certificate_(certificate), design_(certificate.at("design"), objections_), result_(result) {}

  void run() {
    result_.parts.push_back({"design", objections_});
    if (!objections_.empty()) {
      return;  // no statement is made about an invalid design
    }
    hypotheses_ = design_.hypotheses();
    for (const Tree& derivation : certificate_.at("derivations").elements()) {
      check_one(derivation);
    }
    check_claims(
        certificate_, design_.requirements(),
        [this](const Tree& claim, Objections& found) { return check_one_claim(claim, found); }, result_);
  }

 private:
  void check_one(const Tree& derivation) {
    const std::string& id = derivation.at("id").text();
    Objections objections;
    const bool is_lowest = id == kLowest && design_.is_gaussian() && design_.has_one_amplitude();
    const bool is_known =
        is_lowest || id == (design_.is_gaussian() ? "lock-in-noise" : "lock-set") || is_false_lock(id);
    if (!is_known || !seen_.insert(id).second) {
      result_.parts.push_back({id, {is_known ? "a second derivation of this id" : kUnknown}});
      return;
    }
    if (is_lowest && lowest_snr_text(derivation).empty()) {
      result_.parts.push_back({id, {"the evidence names no signal-to-noise ratio"}});
      return;
    }
    check_derivation(
        derivation,
        is_false_lock(id) ? false_lock(derivation, design_.problem(), objections)
        : design_.is_gaussian()
            ? lock_in_noise(
                  derivation, design_.problem(),
                  {is_lowest ? design_.deviation_at(lowest_snr_text(derivation)) : design_.deviation(),
                   design_.blocks(), design_.start().errors, design_.start().covariance},
                  result_.cells, objections)
            : lock_set(derivation, design_.problem(), design_.start(), result_.cells, objections),
        objections);
    if (objections.empty() && verdict_of(derivation) == Verdict::proved) {
      (is_false_lock(id) ? false_locks_[id] : is_lowest ? lowest_ : proved_) = &derivation;
    }
    result_.parts.push_back({id, objections});
  }

  /// The statement of the verified derivation on the quantity; a ball of everything without one.
  [[nodiscard]] Ball at_most(const char* name) const { return at_most(proved_, name); }
  [[nodiscard]] static Ball at_most(const Tree* proved, const char* name) {
    const Tree* quantity = proved != nullptr ? proved->at("quantities").find(name) : nullptr;
    const Tree* number = quantity != nullptr ? quantity->find("hi") : nullptr;
    return number != nullptr ? exact_number(*number) : Ball::everything();
  }
  [[nodiscard]] Quantity bounded(const char* name) const {
    return {name, at_most(name), Sense::bounds_above};
  }

  Claim check_one_claim(const Tree& claim, Objections& objections) const {
    const std::string& id = claim.at("id").text();
    if (id == kEveryStart) {
      return every_start(claim, objections);
    }
    if (id.starts_with(kClaimOf) && is_false_lock(id.substr(kClaimOf.size()))) {
      return false_lock_claim(claim, id.substr(kClaimOf.size()), objections);
    }
    if (design_.is_gaussian()) {
      return claim_in_noise(claim, objections);
    }
    const bool is_asked = id == kGuarantee ||
                          (id == kOffsetError && design_.asks_for("offset_error_below")) ||
                          (id == kSettles && design_.asks_for("settles_within"));
    if (!is_asked) {
      objections.emplace_back(kUnknown);
      return {};
    }
    Claim found = id == kGuarantee ? guarantee(claim) : required_claim(id);
    if (proved_ == nullptr) {
      objections.emplace_back(kUnverified);
    }
    check_claim(claim, found, objections);
    return found;
  }

  [[nodiscard]] Claim claim_in_noise(const Tree& claim, Objections& objections) const {
    const std::string& id = claim.at("id").text();
    const bool is_required = id == kProbability && design_.asks_for("probability_of_losing_lock_below");
    const bool is_lowest = id == kLowestSnr;
    if (id != kLosingLock && !is_lowest && !is_required) {
      objections.emplace_back(kUnknown);
      return {};
    }
    const Tree* proved = is_lowest ? lowest_ : proved_;
    if (proved == nullptr) {
      objections.emplace_back(kUnverified);
    }
    Claim found;
    if (is_required) {
      found.statement = hypotheses_ + design_.required_text(id) + ".";
      found.verdict = proved_if(is_lock(at_most("offset_error_bound")) &&
                                certainly_less(at_most("probability_of_losing_lock"),
                                               design_.asked("probability_of_losing_lock_below")));
      found.evidence = {bounded("probability_of_losing_lock")};
    } else if (is_lowest && proved != nullptr) {
      const std::string snr = lowest_snr_text(*proved);
      found = losing_lock(claim, *proved, design_.hypotheses_at(snr));
      found.evidence.push_back({"lowest_snr", at_most(proved, "lowest_snr"), Sense::bounds_above});
      if (!at_most(proved, "lowest_snr").finite()) {
        found.verdict = Verdict::undecided;
      }
    } else if (proved != nullptr) {
      found = losing_lock(claim, *proved, hypotheses_);
    }
    check_claim(claim, found, objections);
    return found;
  }

  /// Bins are one apart, and so are the locks about them.
  [[nodiscard]] static bool is_lock(const Ball& offset_error) { return certainly_less(offset_error, half); }

  /// The statement of a derivation in Gaussian noise, with the numbers that the claim names.
  [[nodiscard]] Claim losing_lock(const Tree& claim, const Tree& proved,
                                  const std::string& hypotheses) const {
    const Tree& evidence = claim.at("evidence");
    const auto most = [&](const char* name) { return upper_decimal(high_of(evidence.at(name))); };
    Claim found;
    found.is_summary = true;
    found.verdict = proved_if(certainly_less(at_most(&proved, "probability_of_losing_lock"), one) &&
                              is_lock(at_most(&proved, "offset_error_bound")) &&
                              is_lock(high_of(evidence.at("offset_error_bound"))) &&
                              at_most(&proved, "rms_offset_error").finite());
    for (const char* name : {"probability_of_losing_lock", "offset_error_bound", "rms_offset_error"}) {
      found.evidence.push_back({name, at_most(&proved, name), Sense::bounds_above});
    }
    found.hypotheses = hypotheses;
    found.statement = hypotheses + "the probability that within the first " + design_.assumed_text("blocks") +
                      " blocks the offset error of an estimate exceeds " + most("offset_error_bound") +
                      " bins is at most " + most("probability_of_losing_lock") +
                      "; while the filter is in lock, the root mean square of that error is at most " +
                      most("rms_offset_error") + " bins in every block.";
    return found;
  }

  /// Refuted by any false lock.
  [[nodiscard]] Claim every_start(const Tree& claim, Objections& objections) const {
    Claim found;
    found.is_summary = true;
    found.verdict = false_locks_.empty() ? Verdict::undecided : Verdict::refuted;
    found.statement = design_.filter_words() + ", is fed, without noise, with the bins (4.9) of a tone of " +
                      design_.amplitude_words() + " and a constant offset between " +
                      design_.assumed_text("offset", 0) + " and " + design_.assumed_text("offset", 1) +
                      " bins. Whatever its first prediction and covariance, the offset error of some "
                      "prediction is less than half a bin.";
    if (false_locks_.empty()) {
      objections.emplace_back(kUnverified);
    }
    check_claim(claim, found, objections);
    return found;
  }

  [[nodiscard]] Claim false_lock_claim(const Tree& claim, const std::string& id,
                                       Objections& objections) const {
    Claim found;
    const auto lock = false_locks_.find(id);
    if (lock == false_locks_.end()) {
      objections.emplace_back(kUnverified);
      return found;
    }
    const Tree& said = claim.at("evidence");
    const Tree& quantities = lock->second->at("quantities");
    constexpr int kDigits = 4;
    const auto both_ends = [&](const char* name) {
      return lower_decimal(low_of(said.at(name)), kDigits) + " and " +
             upper_decimal(high_of(said.at(name)), kDigits);
    };
    const auto established = [&](const char* name) -> Range {
      const Tree* value = quantities.find(name);
      return value == nullptr ? Range(Ball::everything()) : Range(low_of(*value), high_of(*value));
    };
    const Tree* amplitude = quantities.find("amplitude");
    const FalseLockTone tone = false_lock_tone(*lock->second);
    found.verdict = Verdict::proved;
    found.evidence = {
        {"offset_error", established("offset_error")},
        {"fixed_offset_error", established("fixed_offset_error")},
        {"amplitude", amplitude == nullptr ? Ball::everything() : high_of(*amplitude), Sense::bounds_above}};
    found.statement = design_.filter_words() +
                      ", is fed, without noise, with the bins (4.9) of a tone of the amplitude " +
                      tone.amplitude + " and the constant offset " + tone.offset +
                      " bins. From every first prediction and covariance of the set " + id +
                      ", the offset error of every prediction is between " + both_ends("offset_error") +
                      " bins, for ever; it tends to one between " + both_ends("fixed_offset_error") +
                      " bins, and the estimated amplitude to at most " +
                      upper_decimal(high_of(said.at("amplitude")), kDigits) + " of the tone's.";
    check_claim(claim, found, objections);
    return found;
  }

  [[nodiscard]] Claim required_claim(const std::string& id) const {
    Claim found;
    found.statement = hypotheses_ + design_.required_text(id) + ".";
    if (id == kOffsetError) {
      found.verdict =
          proved_if(certainly_less(at_most("offset_error_bound"), design_.asked("offset_error_below")));
      found.evidence = {bounded("offset_error_bound")};
    } else {
      found.verdict =
          proved_if(certainly_at_most(at_most("settling_blocks"), design_.asked("settles_within")) &&
                    certainly_less(at_most("settled_offset_error"), design_.asked("settled_below")));
      found.evidence = {bounded("settling_blocks"), bounded("settled_offset_error")};
    }
    return found;
  }

  /// With the numbers that the claim names, which are checked beside this.
  [[nodiscard]] Claim guarantee(const Tree& claim) const {
    const Tree& evidence = claim.at("evidence");
    const auto most = [&](const char* name) { return upper_decimal(high_of(evidence.at(name))); };
    Claim found;
    found.is_summary = true;
    found.verdict =
        proved_if(at_most("offset_error_bound").finite() && at_most("ultimate_offset_error").finite());
    found.evidence = {bounded("offset_error_bound"), bounded("ultimate_offset_error"),
                      bounded("settling_blocks"), bounded("settled_offset_error")};
    found.hypotheses = hypotheses_;
    found.statement = hypotheses_ + "the offset error of every estimate and prediction is at most " +
                      most("offset_error_bound") + " bins, and in the long run at most " +
                      most("ultimate_offset_error") + " bins";
    const Tree* settled = evidence.find("settled_offset_error");
    // A bound that is no smaller than that for every block adds nothing.
    if (settled != nullptr && certainly_less(high_of(*settled), high_of(evidence.at("offset_error_bound"))) &&
        most("settled_offset_error") != most("offset_error_bound")) {
      found.statement +=
          "; from block " + most("settling_blocks") + " on at most " + most("settled_offset_error") + " bins";
    }
    found.statement += ".";
    return found;
  }

  const Tree& certificate_;
  Objections objections_;  ///< to the design
  BlockDesign design_;
  Verification& result_;
  std::string hypotheses_;
  std::set<std::string> seen_;
  /// The derivation "lock-set" or "lock-in-noise", and "lowest-snr", once verified, and PROVED as a whole.
  const Tree* proved_ = nullptr;
  const Tree* lowest_ = nullptr;
  std::map<std::string, const Tree*> false_locks_;  ///< likewise, by their ids
};

}  // namespace

TrackerKind dft_block_tracker() {
  return {"dft-block-ekf", [](const Tree& certificate, bool /*all_boxes*/, Verification& result) {
            BlockVerifier(certificate, result).run();
          }};
}

}  // namespace veritrack::checker
