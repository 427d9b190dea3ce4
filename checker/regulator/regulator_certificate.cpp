#include "checker/regulator/regulator_certificate.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "checker/document/design_number.hpp"
#include "checker/document/evidence.hpp"
#include "checker/numbers/decimal_text.hpp"
#include "checker/registry.hpp"
#include "checker/regulator/output_bound.hpp"

namespace veritrack::checker {

namespace {

const std::string kAttenuation = "regulator/attenuation";
const std::string kAttenuatedWithin = "regulator/attenuated-within";
const std::string kOutput = "regulator/output-bound";
const std::string kInput = "regulator/input-bound";
const std::string kTracker = "regulator/frequency-tracker";
const std::string kGuarantee = "regulator/guarantee";
constexpr std::size_t kHighestOrder = 8;

/// " + 0.5 q^-1 - 2 q^-2": numbers from that one on, as they are written.
std::string in_the_delay(const std::vector<Tree>& numbers, std::size_t from) {
  std::string text;
  for (std::size_t i = from; i < numbers.size(); ++i) {
    const std::string& number = text_of(numbers[i]);
    const bool has_sign = number.starts_with('-') || number.starts_with('+');
    text += std::string(number.starts_with('-') ? " - " : " + ") + (has_sign ? number.substr(1) : number) +
            " q^-" + std::to_string(i + 1 - from);
  }
  return text;
}

/// Walks through a certificate of a regulator.
class RegulatorVerifier {
 public:
  RegulatorVerifier(const Tree& certificate, bool all_boxes, Verification& result)
      : certificate_(certificate),
        design_(certificate.at("design")),
        tracker_(certificate.at("frequency_tracker")),
        all_boxes_(all_boxes),
        result_(result) {}

  void run() {
    Objections objections;
    read_plant(objections);
    const std::vector<Requirement> asked = read_requirements(objections);
    result_.parts.push_back({"design", objections});
    if (!objections.empty()) {
      return;  // no statement is made about an invalid design
    }
    verify_the_tracker();
    for (const Tree& derivation : certificate_.at("derivations").elements()) {
      check_one(derivation);
    }
    std::vector<Requirement> all = asked;
    // In the order of the claims.
    if (!inner_.requirements.empty()) {
      all.insert(all.begin(), {kTracker, "the frequency tracker does what its own require asks"});
    }
    check_claims(
        certificate_, all,
        [this](const Tree& claim, Objections& found) { return check_one_claim(claim, found); }, result_);
  }

 private:
  void read_plant(Objections& objections) {
    const Tree& plant = design_.at("plant");
    plant_.a = {one};
    for (const Tree& number : plant.at("a").elements()) {
      plant_.a.push_back(read_number(number, objections));
    }
    for (const Tree& number : plant.at("b").elements()) {
      plant_.b.push_back(read_number(number, objections));
    }
    if (plant_.b.empty() || plant_.a.size() != plant_.b.size() + 1 || plant_.b.size() > kHighestOrder) {
      objections.emplace_back("a plant has one to eight numbers in a and as many in b");
    } else if (!certainly_positive(abs(plant_.b[0]))) {
      objections.emplace_back("b_0 must not be 0");
    }
  }

  std::vector<Requirement> read_requirements(Objections& objections) {
    const Tree& require = design_.at("require");
    for (const auto& [key, value] : require.members()) {
      read_positive(value, key, objections);
      if (key != "attenuation_above" && key != "attenuated_within" && key != "output_below" &&
          key != "input_below") {
        objections.push_back("[require] has no key " + key);
      }
    }
    std::vector<Requirement> asked;
    const auto add = [&](const char* key, const std::string& id) {
      if (require.find(key) != nullptr) {
        asked.push_back({id, required_text(id)});
      }
    };
    if (require.find("attenuated_within") != nullptr && require.find("attenuation_above") == nullptr) {
      objections.emplace_back("attenuated_within needs attenuation_above");
      return asked;
    }
    add("attenuation_above", kAttenuation);
    add("attenuated_within", kAttenuatedWithin);
    add("output_below", kOutput);
    add("input_below", kInput);
    return asked;
  }

  [[nodiscard]] std::string asked_text(const char* key) const {
    return text_of(design_.at("require").at(key));
  }
  [[nodiscard]] std::string required_text(const std::string& id) const {
    if (id == kAttenuation) {
      return "the vibration is attenuated by at least " + asked_text("attenuation_above") +
             " dB in the long run";
    }
    if (id == kAttenuatedWithin) {
      return "from sample " + asked_text("attenuated_within") +
             " on, the vibration is attenuated by at least " + asked_text("attenuation_above") + " dB";
    }
    return id == kOutput ? "the output stays below " + asked_text("output_below") + " for ever"
                         : "the input stays below " + asked_text("input_below") + " for ever";
  }

  /// With the same checks as alone. A regulator inside a regulator is not a tracker with a promise.
  void verify_the_tracker() {
    Objections objections;
    if (tracker_.at("design").at("tracker").text() == design_.at("tracker").text()) {
      result_.parts.push_back({"frequency tracker", {"a regulator is no frequency tracker"}});
      return;
    }
    verify_tracker(tracker_, all_boxes_, inner_);
    result_.cells += inner_.cells;
    for (const Part& part : inner_.parts) {
      result_.parts.push_back({"frequency tracker: " + part.name, part.objections});
    }
    promise_ = frequency_promise(tracker_, inner_, objections);
    if (promise_) {
      hypotheses_ = hypotheses();
    }
    result_.parts.push_back({"frequency tracker, what it promises", objections});
  }

  /// The tracker's guarantee with its hypotheses, then the regulator's.
  [[nodiscard]] std::string hypotheses() const {
    const auto& a = design_.at("plant").at("a").elements();
    const auto& b = design_.at("plant").at("b").elements();
    const bool noisy = !certainly_equal(promise_->noise, zero);
    return promise_->sentence +
           " A regulator that takes its frequencies from this tracker, for the plant A1 x(k+1) = B1 u(k) "
           "with A1 = 1" +
           in_the_delay(a, 0) + " and B1 = " + text_of(b[0]) + in_the_delay(b, 1) +
           (promise_->two_channels ? ", the same in both channels" : "") +
           ", known exactly and at rest at sample 0, and whose own sums are exact, controls the output y = x "
           "+ v from "
           "sample 0 on" +
           (noisy ? "; it sees y with that noise" : "") +
           ". For every such tone v with a frequency between " + promise_->between + " at every sample, ";
  }

  void check_one(const Tree& derivation) {
    const std::string& id = derivation.at("id").text();
    Objections objections;
    if (id != "regulator" || !seen_.insert(id).second) {
      result_.parts.push_back({id, {id == "regulator" ? "a second derivation of this id" : kUnknown}});
      return;
    }
    const Tree* settling = derivation.at("quantities").find("settling_samples");
    const Derivation found = output_bound(
        plant_, promise_, settling != nullptr ? std::optional(high_of(*settling)) : std::nullopt);
    check_derivation(derivation, found, objections);
    if (objections.empty() && verdict_of(derivation) == Verdict::proved) {
      proved_ = &derivation;
    }
    result_.parts.push_back({id, objections});
  }

  /// The statement of the verified derivation on the quantity; a ball of everything without one.
  [[nodiscard]] Ball at_most(const char* name) const { return end_of(name, "hi"); }
  [[nodiscard]] Ball at_least(const char* name) const { return end_of(name, "lo"); }
  [[nodiscard]] Ball end_of(const char* name, const char* end) const {
    const Tree* quantity = proved_ != nullptr ? proved_->at("quantities").find(name) : nullptr;
    const Tree* number = quantity != nullptr ? quantity->find(end) : nullptr;
    return number != nullptr ? exact_number(*number) : Ball::everything();
  }
  static Quantity bounded(const char* name, const Ball& value) { return {name, value, Sense::bounds_above}; }
  static Quantity at_least_so(const char* name, const Ball& value) {
    return {name, value, Sense::bounds_below};
  }

  Claim check_one_claim(const Tree& claim, Objections& objections) const {
    const std::string& id = claim.at("id").text();
    const bool is_asked =
        (id == kAttenuation && design_.at("require").find("attenuation_above") != nullptr) ||
        (id == kAttenuatedWithin && design_.at("require").find("attenuated_within") != nullptr) ||
        (id == kOutput && design_.at("require").find("output_below") != nullptr) ||
        (id == kInput && design_.at("require").find("input_below") != nullptr) ||
        (id == kTracker && !inner_.requirements.empty()) || id == kGuarantee;
    if (!is_asked) {
      objections.emplace_back(kUnknown);
      return {};
    }
    Claim found = id == kTracker ? tracker_claim() : id == kGuarantee ? guarantee(claim) : required_claim(id);
    if (id != kTracker && proved_ == nullptr) {
      objections.emplace_back(kUnverified);
    }
    check_claim(claim, found, objections);
    return found;
  }

  [[nodiscard]] Ball asked(const char* key) const {
    Objections read_before;
    return read_number(design_.at("require").at(key), read_before);
  }

  [[nodiscard]] Claim required_claim(const std::string& id) const {
    Claim found;
    found.statement = hypotheses_ + required_text(id) + ".";
    if (id == kAttenuation) {
      const Ball value = at_least("ultimate_attenuation");
      found.verdict = proved_if(certainly_at_most(asked("attenuation_above"), value));
      found.evidence = {at_least_so("ultimate_attenuation", value)};
    } else if (id == kAttenuatedWithin) {
      const Ball samples = at_most("settling_samples");
      const Ball value = at_least("settled_attenuation");
      found.verdict = proved_if(certainly_at_most(samples, asked("attenuated_within")) &&
                                certainly_at_most(asked("attenuation_above"), value));
      found.evidence = {bounded("settling_samples", samples), at_least_so("settled_attenuation", value)};
    } else {
      const char* quantity = id == kOutput ? "output_bound" : "input_bound";
      const Ball value = at_most(quantity);
      found.verdict = proved_if(certainly_less(value, asked(id == kOutput ? "output_below" : "input_below")));
      found.evidence = {bounded(quantity, value)};
    }
    return found;
  }

  /// With the numbers that the claim names, which are checked beside this.
  [[nodiscard]] Claim guarantee(const Tree& claim) const {
    const Tree& evidence = claim.at("evidence");
    Claim found;
    found.is_summary = true;
    found.verdict = proved_if(at_most("output_bound").finite() && at_most("input_bound").finite());
    found.evidence = {bounded("output_bound", at_most("output_bound")),
                      bounded("input_bound", at_most("input_bound"))};
    found.statement =
        hypotheses_ + "the output never exceeds " + upper_decimal(high_of(evidence.at("output_bound")));
    const auto add = [&](const char* output, const char* attenuation, const std::string& before) {
      found.statement += before + upper_decimal(high_of(evidence.at(output))) + ", at least " +
                         lower_decimal(low_of(evidence.at(attenuation))) + " dB below the tone";
      found.evidence.push_back(bounded(output, at_most(output)));
      found.evidence.push_back(at_least_so(attenuation, at_least(attenuation)));
    };
    const Tree* settling = evidence.find("settling_samples");
    // A bound that is no smaller than that for every sample adds nothing.
    if (settling != nullptr &&
        certainly_less(high_of(evidence.at("settled_output")), high_of(evidence.at("output_bound"))) &&
        upper_decimal(high_of(evidence.at("settled_output"))) !=
            upper_decimal(high_of(evidence.at("output_bound")))) {
      found.evidence.push_back(bounded("settling_samples", at_most("settling_samples")));
      add("settled_output", "settled_attenuation",
          "; from sample " + upper_decimal(high_of(*settling)) + " on it stays at or below ");
    }
    if (evidence.find("ultimate_output") != nullptr) {
      add("ultimate_output", "ultimate_attenuation", "; in the long run it is at most ");
    }
    found.statement +=
        "; the input never exceeds " + upper_decimal(high_of(evidence.at("input_bound"))) + ".";
    return found;
  }

  /// Everything that the tracker's own [require] asks: each of its sentences that is decided this way.
  [[nodiscard]] Claim tracker_claim() const {
    std::vector<Verdict> verdicts;
    for (const Requirement& requirement : inner_.requirements) {
      verdicts.push_back(requirement.verdict);
    }
    Claim found;
    found.verdict = inner_verified() ? all_of(verdicts) : Verdict::undecided;
    for (const Requirement& requirement : inner_.requirements) {
      const auto sentence =
          std::find_if(inner_.sentences.begin(), inner_.sentences.end(), [&](const Sentence& each) {
            return each.id == requirement.claim && each.verdict == found.verdict;
          });
      if (sentence != inner_.sentences.end()) {
        found.statement += (found.statement.empty() ? "" : " ") + sentence->text;
      }
    }
    return found;
  }
  [[nodiscard]] bool inner_verified() const {
    return !inner_.parts.empty() && std::all_of(inner_.parts.begin(), inner_.parts.end(),
                                                [](const Part& part) { return part.objections.empty(); });
  }

  const Tree& certificate_;
  const Tree& design_;
  const Tree& tracker_;  ///< its certificate
  bool all_boxes_;
  Verification& result_;
  DelayPlant plant_;
  Verification inner_;  ///< of the tracker's certificate
  std::optional<FrequencyPromise> promise_;
  std::string hypotheses_;
  std::set<std::string> seen_;
  const Tree* proved_ = nullptr;  ///< the derivation, once verified, and PROVED as a whole
};

}  // namespace

TrackerKind regulator_tracker() {
  return {"vibration-regulator", [](const Tree& certificate, bool all_boxes, Verification& result) {
            RegulatorVerifier(certificate, all_boxes, result).run();
          }};
}

}  // namespace veritrack::checker
