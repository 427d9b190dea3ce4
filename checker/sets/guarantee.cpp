#include "checker/sets/guarantee.hpp"

#include <algorithm>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

const std::string kBound = "ekf/frequency-error-bound";
const std::string kSettling = "ekf/settling-time";
const std::string kSentence = "ekf/guarantee";
const std::string kStays = "the frequency error stays below ";
const std::string kForEver = " rad/sample for ever";

/// A key of [require] that requires a set of at least some size.
struct LeastSize {
  std::string claim, key, quantity, before, after;
  std::optional<Ball> Promises::*size;
};
const std::vector<LeastSize>& least_sizes() {
  static const std::vector<LeastSize> sizes{
      {"ekf/largest-noise", "largest_noise_at_least", "largest_noise",
       "at a constant frequency, the tracker tolerates noise up to ", ": a certified invariant set exists",
       &Promises::noise},
      {"ekf/largest-slew", "largest_slew_at_least", "largest_slew",
       "without noise, the tracker tolerates a slew up to ",
       " rad/sample per sample: a certified invariant set exists", &Promises::slew},
      {"ekf/frequency-error-radius", "frequency_error_radius_at_least", "frequency_error_radius",
       "under the assumed noise and slew, a certified invariant set contains frequency errors up to ",
       " rad/sample", &Promises::reach}};
  return sizes;
}

bool is_zero(const Tree& number) {
  return certainly_equal(from_decimal(number.at("text").text()), zero);
}

/// "With measurement noise of at most ..., started within ..., ": in the words of the design file.
std::string assumptions(const Tree& design, Frequencies frequencies) {
  const Tree& assume = design.at("assume");
  const auto words = [&](const char* name) { return assume.at(name).at("text").text(); };
  std::string text = is_zero(assume.at("noise")) ? "Without measurement noise"
                                                 : "With measurement noise of at most " + words("noise");
  text += is_zero(assume.at("slew"))
              ? " and at a constant frequency"
              : " and a frequency that changes by at most " + words("slew") + " rad/sample per sample";
  if (frequencies == Frequencies::assumed_band) {
    const Tree& band = assume.at("frequency");
    text +=
        " between " + band.at(0).at("text").text() + " and " + band.at(1).at("text").text() + " rad/sample";
  }
  return text + ", started within " + words("initial_frequency_error") +
         " rad/sample of the true frequency, " + words("initial_phase_error") + " rad of the phase and " +
         words("initial_amplitude_error") + " of the amplitude (" + words("amplitude") + "), ";
}

Ball bound_of(const Promises& promises) {
  return promises.bound.value_or(Ball::everything());
}

/// What [require] asks of the frequency error, and whether it is so; no text when it asks for nothing.
struct Limit {
  std::string text;
  Verdict below = Verdict::undecided;
};
Limit limit_of(const Tree& design, const Promises& promises, Objections& objections) {
  const Tree* asked = design.at("require").find("frequency_error_below");
  if (asked == nullptr) {
    return {};
  }
  const Ball value = read_number(*asked, objections);
  Limit limit{asked->at("text").text(), proved_if(certainly_less(bound_of(promises), value))};
  if (limit.below == Verdict::proved) {
    return limit;
  }
  // A start with that much error is allowed, and is not below.
  const Ball start = read_number(design.at("assume").at("initial_frequency_error"), objections);
  const bool exceeded = certainly_at_most(value, start) ||
                        (promises.wrong_lock && certainly_at_most(value, *promises.wrong_lock));
  return {limit.text, exceeded ? Verdict::refuted : Verdict::undecided};
}

Claim settling_of(const Tree& design, const Promises& promises, Objections& objections) {
  const Tree& asked = design.at("require").at("settles_within");
  const Ball samples = promises.settling.value_or(Ball::everything());
  return {"within " + asked.at("text").text() +
              " samples the frequency error comes within twice its ultimate bound",
          proved_if(certainly_at_most(samples, read_number(asked, objections))),
          {{"settling_samples", samples, Sense::bounds_above}}};
}

Claim size_of(const LeastSize& size, const Tree& design, const Promises& promises, Objections& objections) {
  const Tree& asked = design.at("require").at(size.key);
  const Ball certified = (promises.*(size.size)).value_or(Ball::everything());
  // Noise is certified relative to the amplitude.
  const Ball unit =
      size.quantity == "largest_noise" ? read_number(design.at("assume").at("amplitude"), objections) : one;
  // The reach is an enclosure; the other two are the numbers that a set gives.
  const Sense sense = size.quantity == "frequency_error_radius" ? Sense::encloses : Sense::bounds_below;
  const bool from_steady_state = promises.about_steady_state && size.quantity == "frequency_error_radius";
  return {size.before + asked.at("text").text() + size.after +
              (from_steady_state ? ", measured from the steady state" : ""),
          proved_if(certainly_at_most(read_number(asked, objections), certified * unit)),
          {{size.quantity, certified, sense}}};
}

/// The guarantee: that the error stays below the limit, and what it never exceeds when the statement says so.
Claim sentence_of(const std::string& statement, const std::string& start, const Limit& limit,
                  const Promises& promises) {
  const std::string stays = start + kStays + limit.text + kForEver;
  const std::string exceeds =
      limit.text.empty() ? start + "the frequency error never exceeds " : stays + ": it never exceeds ";
  if (const auto number = decimal_between(statement, exceeds, " rad/sample.")) {
    const bool stays_below = limit.text.empty() || limit.below == Verdict::proved;
    return {statement, proved_if(stays_below && certainly_at_most(bound_of(promises), *number)), {}};
  }
  return {stays + ".", limit.below, {}};
}

}  // namespace

void add_bounds(const Promises& promises, Derivation& found) {
  const auto add = [&](const char* name, const std::optional<Ball>& value, Sense sense) {
    found.quantities.push_back({name, value.value_or(Ball::everything()), sense});
  };
  add("ultimate_frequency_error", promises.ultimate, Sense::bounds_above);
  add("frequency_error_bound", promises.bound, Sense::bounds_above);
  add("largest_noise", promises.noise, Sense::bounds_below);
  add("largest_slew", promises.slew, Sense::bounds_below);
}

bool is_guarantee(const std::string& id) {
  const auto& sizes = least_sizes();
  return id == kBound || id == kSettling || id == kSentence ||
         std::any_of(sizes.begin(), sizes.end(), [&](const LeastSize& size) { return size.claim == id; });
}

std::vector<std::string> requirements(const Tree& design) {
  std::vector<std::string> ids;
  for (const auto& [name, value] : design.at("require").members()) {
    std::string id = name == "frequency_error_below" ? kBound : name == "settles_within" ? kSettling : name;
    for (const LeastSize& size : least_sizes()) {
      id = size.key == name ? size.claim : id;
    }
    ids.push_back(id);
  }
  return ids;
}

std::optional<SettlingClaim> settling_claim(const Tree& quantities) {
  const Tree* samples = quantities.find("settling_samples");
  const Tree* ultimate = quantities.find("ultimate_frequency_error");
  if (samples == nullptr || ultimate == nullptr) {
    return std::nullopt;
  }
  return SettlingClaim{low_of(*samples), two * low_of(*ultimate)};
}

void check_guarantee(const Tree& claim, const Tree& certificate, const Promises& promises,
                     Frequencies frequencies, Objections& objections) {
  const std::string& id = claim.at("id").text();
  const Tree& design = certificate.at("design");
  const Limit limit = limit_of(design, promises, objections);
  const auto& sizes = least_sizes();
  const auto size =
      std::find_if(sizes.begin(), sizes.end(), [&](const LeastSize& known) { return known.claim == id; });
  Claim found;
  if (id == kSettling) {
    found = settling_of(design, promises, objections);
  } else if (size != sizes.end()) {
    found = size_of(*size, design, promises, objections);
  } else {
    found = id == kBound ? Claim{kStays + limit.text + kForEver, limit.below, {}}
                         : sentence_of(claim.at("statement").text(), assumptions(design, frequencies), limit,
                                       promises);
    found.evidence = {{"frequency_error_bound", bound_of(promises), Sense::bounds_above},
                      {"wrong_lock_frequency_error", promises.wrong_lock.value_or(Ball::everything()),
                       Sense::bounds_below}};
  }
  check_claim(claim, found, objections);
}

}  // namespace veritrack::checker
