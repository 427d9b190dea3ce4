#include "checker/sets/guarantee.hpp"

#include <algorithm>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

const std::string kBound = "ekf/frequency-error-bound";
const std::string kSettling = "ekf/settling-time";
const std::string kSentence = "ekf/guarantee";

/// A key of [require] that asks for a set of at least some size.
struct LeastSize {
  std::string claim, key, quantity, before, after;
  std::optional<Ball> Promises::*size;
};
const std::vector<LeastSize>& least_sizes() {
  static const std::vector<LeastSize> sizes{
      {"ekf/largest-noise", "largest_noise_at_least", "largest_noise", "noise of at most ",
       " at a constant frequency is borne: a set of errors is never left", &Promises::noise},
      {"ekf/largest-slew", "largest_slew_at_least", "largest_slew", "a slew of at most ",
       " rad/sample per sample without noise is borne: a set of errors is never left", &Promises::slew},
      {"ekf/frequency-error-radius", "frequency_error_radius_at_least", "frequency_error_radius",
       "under the assumed noise and slew a set of errors is never left that reaches to a frequency error of ",
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

}  // namespace

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
  const Tree& tables = certificate.at("design");
  const Tree& require = tables.at("require");
  const auto assumed = [&](const char* name) {
    return read_number(tables.at("assume").at(name), objections);
  };
  const Ball bound = promises.bound.value_or(Ball::everything());
  Claim found;
  found.evidence = {
      {"frequency_error_bound", bound, Sense::bounds_above},
      {"wrong_lock_frequency_error", promises.wrong_lock.value_or(Ball::everything()), Sense::bounds_below}};
  Verdict below = Verdict::undecided;
  std::string limit;
  if (const Tree* asked = require.find("frequency_error_below")) {
    const Ball value = read_number(*asked, objections);
    limit = asked->at("text").text();
    // A start that is off by as much is allowed, and is not below.
    below = certainly_less(bound, value) ? Verdict::proved
            : certainly_at_most(value, assumed("initial_frequency_error")) ||
                    (promises.wrong_lock && certainly_at_most(value, *promises.wrong_lock))
                ? Verdict::refuted
                : Verdict::undecided;
  }
  if (id == kSettling) {
    const Tree& asked = require.at("settles_within");
    const Ball samples = promises.settling.value_or(Ball::everything());
    found.statement = "within " + asked.at("text").text() +
                      " samples the frequency error comes within twice its ultimate bound";
    found.verdict = proved_if(certainly_at_most(samples, read_number(asked, objections)));
    found.evidence = {{"settling_samples", samples, Sense::bounds_above}};
  } else if (const auto size = std::find_if(least_sizes().begin(), least_sizes().end(),
                                            [&](const LeastSize& known) { return known.claim == id; });
             size != least_sizes().end()) {
    const Tree& asked = require.at(size->key);
    const Ball certified = (promises.*(size->size)).value_or(Ball::everything());
    // Noise is certified relative to the amplitude.
    const Ball unit = size->quantity == "largest_noise" ? assumed("amplitude") : one;
    found.statement = size->before + asked.at("text").text() + size->after;
    found.verdict = proved_if(certainly_at_most(read_number(asked, objections), certified * unit));
    // The reach is an enclosure; the other two are the numbers that a set gives.
    found.evidence = {{size->quantity, certified,
                       size->quantity == "frequency_error_radius" ? Sense::encloses : Sense::bounds_below}};
  } else if (id == kBound) {
    found.statement = "the frequency error stays below " + limit + " rad/sample for ever";
    found.verdict = below;
  } else {
    const std::string start = assumptions(tables, frequencies);
    const std::string stays = start + "the frequency error stays below " + limit + " rad/sample for ever";
    const std::string& statement = claim.at("statement").text();
    found.statement = stays + ".";
    found.verdict = below;
    const std::string exceeds =
        limit.empty() ? start + "the frequency error never exceeds " : stays + ": it never exceeds ";
    if (const auto number = decimal_between(statement, exceeds, " rad/sample.")) {
      found.statement = statement;
      found.verdict =
          proved_if((limit.empty() || below == Verdict::proved) && certainly_at_most(bound, *number));
    }
  }
  check_claim(claim, found, objections);
}

}  // namespace veritrack::checker
