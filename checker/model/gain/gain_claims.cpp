#include "checker/model/gain/gain_claims.hpp"

#include <algorithm>

#include "checker/model/false_lock.hpp"
#include "checker/model/gain/loop_verdicts.hpp"
#include "checker/model/gain/stability.hpp"

namespace veritrack::checker {

GainClaims::GainClaims(const Tree& certificate, const ModelDesign& design, const TrackedModel& model,
                       const LoopBounds* loop, const GainNetwork* network)
    : tree_(&certificate.at("design")),
      design_(&design),
      loop_(loop),
      network_(network),
      half_distance_(half_distance_to_false_lock(model, design.lowest, design.highest)),
      exact_words_(*tree_),
      words_(loop != nullptr && loop->is_rounded() ? exact_words_.rounded() : exact_words_),
      required_(certificate, design, "") {
  Objections said_before;  // by the design
  units_ = FrequencyWords(tree_->at("assume"), said_before);
}

GainClaims::Errors GainClaims::errors(const Ball& noise, const Ball& slew) const {
  return loop_ == nullptr ? nullptr : loop_->errors(noise, slew, std::vector<Ball>(loop_->states()));
}

GainClaims::Errors GainClaims::assumed_errors() const {
  return loop_ == nullptr || design_->start_within.empty()
             ? errors(design_->noise, design_->slew)
             : loop_->errors(design_->noise, design_->slew, design_->start_within);
}

GainClaims::Errors GainClaims::errors_from(const Ball& reach, const Ball& noise, const Ball& slew) const {
  if (loop_ == nullptr || !certainly_positive(reach)) {
    return nullptr;
  }
  const std::vector<Ball> start = loop_->starts_within(reach);
  return start.empty() ? nullptr : loop_->errors(noise, slew, start);
}

bool GainClaims::is_lock(const Errors& errors, const Ball& error) const {
  return errors && certainly_less(error, half_distance_) && certainly_at_most(errors->for_ever(), error);
}

bool GainClaims::mean_is_between(const Ball& low, const Ball& high) const {
  const Errors settled = errors(zero, zero);
  if (!settled) {
    return false;
  }
  const Range mean = settled->mean();
  return certainly_at_most(low, mean.low) && certainly_at_most(mean.high, high);
}

bool GainClaims::varies_by_at_most(const Ball& most) const {
  const Errors settled = errors(zero, zero);
  return settled && certainly_at_most(settled->variation(), most);
}

bool GainClaims::has_one_linear_loop() const {
  // To first order the linear recursion is the same at every sample, about a steady state of the true
  // frequency.
  return network_ != nullptr && network_->has_one_matrix() && !design_->amplitude_varies &&
         network_->is_at_rest && certainly_less(abs(network_->bias), half_distance_);
}

std::string GainClaims::assumed_hypotheses() const {
  return words_.assumed_tone(design_->moves()) + words_.assumed_noise(design_->is_noisy()) +
         words_.assumed_start_by_steady_state();
}

std::string GainClaims::settled_hypotheses() const {
  return words_.constant_tone() + ", without noise, " + ModelWords::started_in_steady_state();
}

Claim GainClaims::required_claim(const Tree& claim) const {
  const std::string& id = claim.at("id").text();
  Claim found;
  if (id == kErrorBound || id == kSettlingTime) {
    const Errors bound = assumed_errors();
    found.statement = assumed_hypotheses() + ", " + required_.short_text(id) + ".";
    found.verdict = proved_if(
        bound && (id == kErrorBound ? certainly_less(bound->for_ever(), design_->frequency_error_below->value)
                                    : certainly_less(bound->from(design_->settles_within->value),
                                                     design_->settled_below->value)));
  } else if (id == kBias) {
    const Ball& most = design_->bias->value;
    found.statement = settled_hypotheses() +
                      ", the mean over the phase of the frequency error in the long run is at most " +
                      design_->bias->text + " in absolute value.";
    found.verdict = proved_if(mean_is_between(-most, most));
  } else if (id == kRipple) {
    found.statement = settled_hypotheses() + ", the frequency error in the long run varies by at most " +
                      design_->ripple->text + " over the phase.";
    found.verdict = proved_if(varies_by_at_most(design_->ripple->value));
  } else if (is_about_linear_loop(id)) {
    found.statement = exact_words_.constant_tone() +
                      ", without noise, to first order about the steady state of the certificate, " +
                      required_.short_text(id) + ".";
    found.verdict = has_one_linear_loop() ? linear_loop_verdict(id, *network_, *design_) : Verdict::undecided;
  } else if (id == kLargestNoise) {
    found.statement = words_.constant_tone() + ", " + required_.short_text(id) + ".";
    found.verdict =
        proved_if(is_lock(errors(design_->largest_noise->value, zero), written(claim, "frequency_error")));
  } else if (id == kLargestSlew) {
    found.statement = words_.tone_in_band() + ", without noise, " + required_.short_text(id) + ".";
    found.verdict =
        proved_if(is_lock(errors(zero, design_->largest_slew->value), written(claim, "frequency_error")));
  } else if (id == kRadius) {
    found.statement = words_.assumed_tone(design_->moves()) + words_.assumed_noise(design_->is_noisy()) +
                      ", " + required_.short_text(id) + ".";
    found.verdict = proved_if(is_lock(errors_from(design_->radius->value, design_->noise, design_->slew),
                                      written(claim, "frequency_error")));
  }
  return found;
}

Claim GainClaims::guarantee(const Tree& claim) const {
  const Ball bound = written(claim, "frequency_error");
  const Errors proved = assumed_errors();
  Claim found;
  found.is_summary = true;
  found.hypotheses = assumed_hypotheses();
  found.statement = found.hypotheses + ", the frequency error stays at or below " +
                    units_.at_most(claim.at("frequency_error").text()) + " for ever";
  bool certain = proved && certainly_at_most(proved->for_ever(), bound);
  if (const Tree* settled = claim.find("settled_frequency_error")) {
    const Ball later = written(claim, "settled_frequency_error");
    // cannot bind (bound): it decides only whether the sentence also states the claim, which is checked
    // below.
    if (certainly_less(later, bound)) {
      found.statement += ", and at or below " + units_.at_most(settled->text()) + " in the long run";
    }
    // Less than it in the upper limit: at or below it from some sample on.
    certain = certain && certainly_less(proved->in_long_run(), later);
  }
  found.statement += ".";
  found.verdict = proved_if(certain);
  return found;
}

Claim GainClaims::limits(const Tree& claim) const {
  Claim found;
  found.is_summary = true;
  found.hypotheses = words_.constant_tone();
  found.statement = found.hypotheses + ", the tracker tolerates noise up to " + claim.at("noise").text() +
                    ": a certified invariant set exists in which the frequency error stays at or below " +
                    units_.at_most(claim.at("frequency_error").text());
  const Ball tolerated = written(claim, "noise");
  bool certain =
      certainly_positive(tolerated) && is_lock(errors(tolerated, zero), written(claim, "frequency_error"));
  if (const Tree* reached = claim.find("reach")) {
    found.statement += ", and without noise a certified invariant set in which it stays at or below " +
                       units_.at_most(claim.at("reach_frequency_error").text()) +
                       " contains frequency errors up to " + units_.at_least(reached->text()) +
                       " at every phase";
    certain = certain && is_lock(errors_from(written(claim, "reach"), zero, zero),
                                 written(claim, "reach_frequency_error"));
  }
  found.statement += ".";
  found.verdict = proved_if(certain);
  return found;
}

Claim GainClaims::reach(const Tree& claim) const {
  Claim found = reach_claim(claim, words_, units_);
  found.verdict =
      proved_if(is_lock(errors_from(written(claim, "reach"), zero, zero), written(claim, "frequency_error")));
  return found;
}

Claim GainClaims::slew_limit(const Tree& claim) const {
  const Ball slew = written(claim, "slew");
  Ball together;
  bool certain = certainly_positive(slew);
  Claim found;
  found.is_summary = true;
  found.hypotheses = words_.tone_in_band();
  if (const Tree* noise = claim.find("noise")) {
    together = written(claim, "noise");
    found.hypotheses += ", with noise of at most " + noise->text();
    certain = certain && certainly_positive(together);
  } else {
    found.hypotheses += ", without noise";
  }
  found.statement = found.hypotheses + ", the tracker tolerates a slew up to " +
                    units_.slew(claim.at("slew").text()) +
                    ": a certified invariant set exists in which the frequency error stays at or below " +
                    units_.at_most(claim.at("frequency_error").text()) + ".";
  found.verdict = proved_if(certain && is_lock(errors(together, slew), written(claim, "frequency_error")));
  return found;
}

Claim GainClaims::steady_state(const Tree& claim) const {
  Claim found;
  found.is_summary = true;
  found.hypotheses = settled_hypotheses();
  found.statement =
      found.hypotheses + ", the mean over the phase of the frequency error in the long run is between " +
      units_.between(claim.at("bias_low").text(), claim.at("bias_high").text()) +
      ", and the error varies by at most " + units_.at_most(claim.at("ripple").text()) + " over the phase.";
  const Ball low = written(claim, "bias_low");
  const Ball high = written(claim, "bias_high");
  found.verdict = proved_if(certainly_less(max(abs(low), abs(high)), half_distance_) &&
                            mean_is_between(low, high) && varies_by_at_most(written(claim, "ripple")));
  return found;
}

Claim GainClaims::stability(const Tree& claim) const {
  Claim found;
  found.is_summary = true;
  found.hypotheses = exact_words_.constant_tone() + ", without noise";
  found.statement = found.hypotheses + ", the steady state of the certificate is stable: to first order, ";
  const bool is_constant = has_one_linear_loop();
  if (const Tree* growth = claim.find("growth")) {
    const Ball factor = written(claim, "growth");
    found.statement += "no error about it grows by a factor of " + growth->text() + " or more each sample.";
    const bool grows =
        is_constant && certainly_at_most(one, factor) && an_eigenvalue_beyond(network_->matrix, factor);
    found.verdict = grows ? Verdict::refuted : Verdict::undecided;
    found.finding = "the steady state of the certificate is stable";
    return found;
  }
  const Ball factor = written(claim, "decay");
  found.statement += "errors about it shrink in the long run by a factor of at most " +
                     claim.at("decay").text() + " each sample.";
  found.verdict = proved_if(is_constant && certainly_less(factor, one) &&
                            all_eigenvalues_within(network_->matrix, factor));
  return found;
}

Claim GainClaims::check(const Tree& claim, Objections& objections) const {
  const std::string& id = claim.at("id").text();
  const std::vector<Requirement> asked = required();
  const bool is_asked = std::any_of(asked.begin(), asked.end(),
                                    [&](const Requirement& requirement) { return requirement.claim == id; });
  const bool is_told = id == kGuarantee || id == kLimits || id == kReach || id == kSlewLimit ||
                       id == kSteadyState || id == kStability;
  if (!is_told && (!is_asked || id == kCaptureTime)) {
    objections.emplace_back(is_asked ? "gains do not decide this" : "[require] does not ask for this");
    return {};
  }
  Claim found = id == kGuarantee     ? guarantee(claim)
                : id == kLimits      ? limits(claim)
                : id == kReach       ? reach(claim)
                : id == kSlewLimit   ? slew_limit(claim)
                : id == kSteadyState ? steady_state(claim)
                : id == kStability   ? stability(claim)
                                     : required_claim(claim);
  check_claim(claim, found, objections);
  return found;
}

}  // namespace veritrack::checker
