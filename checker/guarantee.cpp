#include "checker/guarantee.hpp"

namespace veritrack::checker {

namespace {

const std::string kBound = "ekf/frequency-error-bound";
const std::string kSettling = "ekf/settling-time";
const std::string kSentence = "ekf/guarantee";

bool is_zero(const Tree& number) {
  return certainly_equal(from_decimal(number.at("text").text()), Ball(0.0));
}

/// "With measurement noise of at most ..., started within ..., ": in the words of the design file.
std::string assumptions(const Tree& design) {
  const Tree& assume = design.at("assume");
  const auto words = [&](const char* name) { return assume.at(name).at("text").text(); };
  std::string text = is_zero(assume.at("noise")) ? "Without measurement noise"
                                                 : "With measurement noise of at most " + words("noise");
  text += is_zero(assume.at("slew"))
              ? " and at a constant frequency"
              : " and a frequency that changes by at most " + words("slew") + " rad/sample per sample";
  return text + ", started within " + words("initial_frequency_error") +
         " rad/sample of the true frequency, " + words("initial_phase_error") + " rad of the phase and " +
         words("initial_amplitude_error") + " of the amplitude (" + words("amplitude") + "), ";
}

/// The decimal between the two ends of the sentence; nothing when it has others.
std::optional<Ball> decimal_between(const std::string& text, const std::string& before,
                                    const std::string& after) {
  if (text.size() <= before.size() + after.size() || !text.starts_with(before) || !text.ends_with(after)) {
    return std::nullopt;
  }
  return from_decimal(
      std::string_view(text).substr(before.size(), text.size() - before.size() - after.size()));
}

}  // namespace

bool is_guarantee(const std::string& id) {
  return id == kBound || id == kSettling || id == kSentence;
}

std::vector<std::string> requirements(const Tree& design) {
  std::vector<std::string> ids;
  for (const auto& [name, value] : design.at("require").members()) {
    ids.push_back(name == "frequency_error_below" ? kBound : name == "settles_within" ? kSettling : name);
  }
  return ids;
}

void check_guarantee(const Tree& claim, const Tree& certificate, const Design& design,
                     const Promises& promises, Objections& objections) {
  const std::string& id = claim.at("id").text();
  const Tree& tables = certificate.at("design");
  const Tree& require = tables.at("require");
  const Ball bound = promises.bound.value_or(Ball::everything());
  Claim found;
  found.evidence.push_back({"frequency_error_bound", bound, Sense::bounds_above});
  Verdict below = Verdict::undecided;
  std::string limit;
  if (const Tree* asked = require.find("frequency_error_below")) {
    const Ball value = read_number(*asked, objections);
    limit = asked->at("text").text();
    // A start that is off by as much is allowed, and is not below.
    below = certainly_less(bound, value)                       ? Verdict::proved
            : certainly_at_most(value, design.frequency_error) ? Verdict::refuted
                                                               : Verdict::undecided;
  }
  if (id == kSettling) {
    const Tree& asked = require.at("settles_within");
    const Ball samples = promises.settling.value_or(Ball::everything());
    found.statement = "within " + asked.at("text").text() +
                      " samples the frequency error comes within twice its ultimate bound";
    found.verdict = proved_if(certainly_at_most(samples, read_number(asked, objections)));
    found.evidence = {{"settling_samples", samples, Sense::bounds_above}};
  } else if (id == kBound) {
    found.statement = "the frequency error stays below " + limit + " rad/sample for ever";
    found.verdict = below;
  } else {
    const std::string start = assumptions(tables);
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
