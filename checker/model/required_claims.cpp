#include "checker/model/required_claims.hpp"

#include <utility>

namespace veritrack::checker {

Ball written(const Tree& claim, const char* name) {
  constexpr std::size_t kLongest = 40;
  const std::string& text = claim.at(name).text();
  if (text.size() > kLongest) {
    throw Malformed("a decimal of more than 40 characters");
  }
  return from_decimal(text);
}

Claim reach_claim(const Tree& claim, const ModelWords& words, const FrequencyWords& units) {
  Claim found;
  found.is_summary = true;
  found.hypotheses = words.constant_tone() + ", without noise";
  found.statement = found.hypotheses +
                    ", a certified invariant set in which the frequency error stays at or below " +
                    units.at_most(claim.at("frequency_error").text()) + " contains frequency errors up to " +
                    units.at_least(claim.at("reach").text()) + " at every phase.";
  return found;
}

RequiredClaims::RequiredClaims(const Tree& certificate, const ModelDesign& design, std::string captured_in)
    : claims_(&certificate.at("claims")),
      design_(&design),
      captured_in_(std::move(captured_in)),
      words_(certificate.at("design")) {
  Objections said_before;  // by the design
  units_ = FrequencyWords(certificate.at("design").at("assume"), said_before);
}

const std::string* RequiredClaims::named_error(const std::string& id) const {
  for (const Tree& claim : claims_->elements()) {
    const Tree* error = claim.at("id").text() == id ? claim.find("frequency_error") : nullptr;
    if (error != nullptr) {
      return &error->text();
    }
  }
  return nullptr;
}

std::string RequiredClaims::in_lock(const std::string& id, const std::string& text) const {
  const std::string* error = named_error(id);
  return error == nullptr ? std::string() : text + units_.at_most(*error);
}

std::string RequiredClaims::short_text(const std::string& id) const {
  if (id == kErrorBound) {
    return "the frequency error stays below " + design_->frequency_error_below->text + " for ever";
  }
  if (id == kSettlingTime) {
    return "from sample " + design_->settles_within->text + " on, the frequency error stays below " +
           design_->settled_below->text;
  }
  if (id == kCaptureTime) {
    return "the tracker is in the set \"" + captured_in_ + "\" of the certificate after at most " +
           design_->captured_within->text + " samples" +
           in_lock(id, ", and there the frequency error stays at or below ");
  }
  // Read only for claims about lock, because every value that is asked for counts as read.
  const auto in_set = [&] { return in_lock(id, " in which the frequency error stays at or below "); };
  if (id == kLargestNoise) {
    return "the tracker tolerates noise up to " + design_->largest_noise->text +
           ": a certified invariant set exists" + in_set();
  }
  if (id == kLargestSlew) {
    return "the tracker tolerates a slew up to " + design_->largest_slew->text +
           ": a certified invariant set exists" + in_set();
  }
  if (id == kRadius) {
    return "a certified invariant set" + in_set() + " contains frequency errors up to " +
           design_->radius->text + " at every phase";
  }
  if (id == kLosingLock) {
    const std::string exceeding = in_lock(id, ", its frequency error exceeding ");
    return "the probability of losing lock" + exceeding + (exceeding.empty() ? "" : ",") + " is below " +
           design_->losing_lock->text + " " + words_.stretch_of_samples();
  }
  if (id == kDamping) {
    return "every mode of the linear loop has a damping ratio of at least " + design_->damping->text;
  }
  if (id == kTimeConstant) {
    return "the slowest mode of the linear loop shrinks by a factor of e in at most " +
           design_->settles_like->text;
  }
  if (id == kNoiseBandwidth) {
    return "the noise bandwidth of the linear loop is below " + design_->noise_bandwidth->text;
  }
  if (id == kGainMargin) {
    return "the linear loop stays stable while the gain of its detector grows by up to " +
           design_->gain_margin->text + " dB";
  }
  if (id == kBias) {
    return "the mean frequency error is at most " + design_->bias->text;
  }
  return "the frequency error varies by at most " + design_->ripple->text;
}

std::vector<Requirement> RequiredClaims::all() const {
  std::vector<Requirement> asked;
  const auto require = [&](bool is_asked, const std::string& id) {
    if (is_asked) {
      asked.push_back({id, short_text(id)});
    }
  };
  require(design_->frequency_error_below.has_value(), kErrorBound);
  require(design_->settles_within.has_value(), kSettlingTime);
  require(design_->captured_within.has_value(), kCaptureTime);
  require(design_->largest_noise.has_value(), kLargestNoise);
  require(design_->largest_slew.has_value(), kLargestSlew);
  require(design_->radius.has_value(), kRadius);
  require(design_->losing_lock.has_value(), kLosingLock);
  require(design_->bias.has_value(), kBias);
  require(design_->ripple.has_value(), kRipple);
  require(design_->damping.has_value(), kDamping);
  require(design_->settles_like.has_value(), kTimeConstant);
  require(design_->noise_bandwidth.has_value(), kNoiseBandwidth);
  require(design_->gain_margin.has_value(), kGainMargin);
  return asked;
}

}  // namespace veritrack::checker
