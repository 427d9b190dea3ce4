#include "certificates/regulator/regulator.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "analysis/regulator/output_bound.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/document/json.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/required_claims.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr int kDigits = 3;

std::vector<Interval> values_of(const std::vector<Number>& numbers) {
  std::vector<Interval> values;
  values.reserve(numbers.size());
  for (const Number& number : numbers) {
    values.push_back(number.value);
  }
  return values;
}

regulator::RegulatorQuestion question_of(const RegulatorTables& tables, const FrequencyPromise& promise) {
  regulator::RegulatorQuestion question;
  question.a = values_of(tables.plant.a);
  question.a.insert(question.a.begin(), Interval(1.0));
  question.b = values_of(tables.plant.b);
  question.amplitude = promise.amplitude.value;
  question.noise = promise.noise.value;
  question.lowest = promise.frequency[0].value;
  question.highest = promise.frequency[1].value;
  question.slew = promise.slew.value;
  question.tracker.for_ever = promise.for_ever;
  if (promise.settling_samples) {
    question.tracker.settled = {*promise.settling_samples, *promise.settled_error};
  }
  question.tracker.ultimate = promise.ultimate;
  return question;
}

/// Everything before the claim: the tracker's guarantee with its hypotheses, then the regulator's.
std::string hypotheses_of(const RegulatorTables& tables, const FrequencyPromise& promise) {
  const bool noisy = !(promise.noise.value == Interval(0.0));
  return fmt::format(
      "{} A regulator that takes its frequencies from this tracker, for the plant A1 x(k+1) = B1 u(k) with "
      "A1 = {} "
      "and B1 = {}{}, known exactly and at rest at sample 0, and whose own sums are exact, controls the "
      "output y = "
      "x + v from sample 0 on{}. For every such tone v with a frequency between {} and {} at every sample, ",
      promise.sentence, delay_polynomial("1", tables.plant.a),
      delay_polynomial(tables.plant.b.front().text, tables.plant.b, 1),
      promise.two_channels ? ", the same in both channels" : "", noisy ? "; it sees y with that noise" : "",
      promise.frequency[0].text, frequency_words(promise.frequency[1]));
}

/// The claims, and the derivation that decides them.
class RegulatorClaims {
 public:
  explicit RegulatorClaims(Certificate& certificate)
      : certificate_(&certificate),
        tables_(&regulator_tables(certificate.design)),
        found_(&certificate.derivations.back()),
        hypotheses_(hypotheses_of(*tables_, regulator_particulars(certificate).promise)) {}

  void add_all() {
    add_guarantee();
    add_tracker();
    const RegulatorRequirements& require = tables_->require;
    if (const auto& number = require.attenuation_above) {
      const theorems::Quantity* decibels = quantity("ultimate_attenuation");
      Claim claim = required(
          "regulator/attenuation", *number,
          fmt::format("the vibration is attenuated by at least {} dB in the long run", number->text));
      if (decibels != nullptr) {
        decide(claim, rigor::certainly_less_equal(number->value, decibels->value),
               fmt::format("The proved attenuation in the long run is {} dB",
                           rigor::lower_decimal(decibels->value, kDigits)),
               {decibels});
      }
      add(claim);
      if (require.attenuated_within) {
        add_attenuated_within(*number, *require.attenuated_within);
      }
    }
    if (const auto& number = require.output_below) {
      add_bound("regulator/output-bound", "output", quantity("output_bound"), *number);
    }
    if (const auto& number = require.input_below) {
      add_bound("regulator/input-bound", "input", quantity("input_bound"), *number);
    }
    conclude_requirements(*certificate_);
  }

 private:
  /// Null where it is not proved.
  [[nodiscard]] const theorems::Quantity* quantity(const char* name) const {
    return found_->verdict == Verdict::proved ? theorems::applicable_quantity(*found_, name) : nullptr;
  }
  [[nodiscard]] std::string objection() const {
    for (const theorems::Condition& condition : found_->conditions) {
      if (condition.verdict != Verdict::proved) {
        const std::string& why = regulator_particulars(*certificate_).promise.objection;
        return condition.id != "tracker" || why.empty()
                   ? condition.reason
                   : fmt::format("The frequency tracker does not qualify: {}.", why);
      }
    }
    return "The tracker's certificate does not prove what this needs.";
  }

  void add(Claim& claim) {
    if (claim.verdict == Verdict::undecided && claim.reason.empty()) {
      claim.reason = objection();
    }
    certificate_->claims.push_back(std::move(claim));
  }

  [[nodiscard]] Claim required(const char* id, const Number& number, std::string requirement) const {
    return required_claim(id, std::move(requirement), hypotheses_, number);
  }
  static void decide(Claim& claim, bool is_met, const std::string& ground,
                     std::initializer_list<const theorems::Quantity*> evidence) {
    claim.verdict = is_met ? Verdict::proved : Verdict::undecided;
    claim.reason = ground + (is_met ? "." : ", which is not what is required.");
    if (is_met) {
      for (const theorems::Quantity* one : evidence) {
        claim.evidence.push_back(*one);
      }
    }
  }

  void add_attenuated_within(const Number& above, const Number& within) {
    Claim claim = required("regulator/attenuated-within", within,
                           fmt::format("from sample {} on, the vibration is attenuated by at least {} dB",
                                       within.text, above.text));
    const theorems::Quantity* samples = quantity("settling_samples");
    const theorems::Quantity* decibels = quantity("settled_attenuation");
    if (samples != nullptr && decibels != nullptr) {
      decide(claim,
             rigor::certainly_less_equal(samples->value, within.value) &&
                 rigor::certainly_less_equal(above.value, decibels->value),
             fmt::format("From sample {} on it is attenuated by at least {} dB",
                         rigor::upper_decimal(samples->value, kDigits),
                         rigor::lower_decimal(decibels->value, kDigits)),
             {samples, decibels});
    }
    add(claim);
  }

  void add_bound(const char* id, const char* what, const theorems::Quantity* bound, const Number& below) {
    Claim claim = required(id, below, fmt::format("the {} stays below {} for ever", what, below.text));
    if (bound != nullptr) {
      decide(claim, rigor::certainly_less(bound->value, below.value),
             fmt::format("The proved bound is {}", rigor::upper_decimal(bound->value, kDigits)), {bound});
    }
    add(claim);
  }

  /// The proved bounds on output and input, with all numbers.
  void add_guarantee() {
    Claim claim;
    claim.id = "regulator/guarantee";
    claim.statement = hypotheses_;
    const theorems::Quantity* output = quantity("output_bound");
    const theorems::Quantity* input = quantity("input_bound");
    if (output == nullptr || input == nullptr) {
      claim.statement += "the output is bounded.";
      add(claim);
      return;
    }
    const auto most = [](const theorems::Quantity* one) { return rigor::upper_decimal(one->value, kDigits); };
    const auto least = [](const theorems::Quantity* one) {
      return rigor::lower_decimal(one->value, kDigits);
    };
    claim.verdict = Verdict::proved;
    claim.statement += fmt::format("the output never exceeds {}", most(output));
    claim.evidence = {*output};
    const theorems::Quantity* samples = quantity("settling_samples");
    const theorems::Quantity* settled = quantity("settled_output");
    const theorems::Quantity* settled_by = quantity("settled_attenuation");
    if (samples != nullptr && settled != nullptr && settled_by != nullptr &&
        settled->value.upper() < output->value.upper() && most(settled) != most(output)) {
      claim.statement +=
          fmt::format("; from sample {} on it stays at or below {}, at least {} dB below the tone",
                      most(samples), most(settled), least(settled_by));
      claim.evidence.insert(claim.evidence.end(), {*samples, *settled, *settled_by});
    }
    const theorems::Quantity* ultimate = quantity("ultimate_output");
    const theorems::Quantity* ultimate_by = quantity("ultimate_attenuation");
    if (ultimate != nullptr && ultimate_by != nullptr) {
      claim.statement += fmt::format("; in the long run it is at most {}, at least {} dB below the tone",
                                     most(ultimate), least(ultimate_by));
      claim.evidence.insert(claim.evidence.end(), {*ultimate, *ultimate_by});
    }
    claim.statement += fmt::format("; the input never exceeds {}.", most(input));
    claim.evidence.push_back(*input);
    claim.reason =
        "The frequency error is bounded by the tracker's certificate, and the output by the frequency "
        "error.";
    certificate_->claims.push_back(std::move(claim));
  }

  /// The requirements of the tracker's own [require].
  void add_tracker() {
    const Certificate& tracker = regulator_particulars(*certificate_).tracker;
    if (!tracker.verdict) {
      return;
    }
    Claim claim;
    claim.id = "regulator/frequency-tracker";
    claim.requirement = "the frequency tracker does what its own require asks";
    claim.required = true;
    claim.verdict = *tracker.verdict;
    for (const Claim& one : tracker.claims) {
      if (one.required && one.verdict == claim.verdict) {
        claim.statement += (claim.statement.empty() ? "" : " ") + one.statement;
        claim.position = one.position;
      }
      if (one.required && one.verdict != Verdict::proved && claim.reason.empty()) {
        claim.reason = one.reason;
      }
    }
    if (claim.reason.empty()) {
      claim.reason = "Each of its requirements is proved.";
    }
    certificate_->claims.push_back(std::move(claim));
  }

  Certificate* certificate_;
  const RegulatorTables* tables_;
  const theorems::Derivation* found_;
  std::string hypotheses_;
};

}  // namespace

const RegulatorParticulars& regulator_particulars(const Certificate& certificate) {
  return std::any_cast<const RegulatorParticulars&>(certificate.particulars);
}

std::string delay_polynomial(const std::string& first, const std::vector<Number>& rest, std::size_t skipped) {
  std::string text = first;
  for (std::size_t i = skipped; i < rest.size(); ++i) {
    const std::string& number = rest[i].text;
    const bool negative = number.starts_with('-');
    const std::size_t sign = negative || number.starts_with('+') ? 1 : 0;
    text += fmt::format(" {} {} q^-{}", negative ? '-' : '+', number.substr(sign), i + 1 - skipped);
  }
  return text;
}

void certify_regulator(Certificate& certificate, const CertifyProgress& progress) {
  const RegulatorTables& tables = regulator_tables(certificate.design);
  Design inner = tables.design.frequency_tracker;
  inner.name = certificate.design.name;
  RegulatorParticulars particulars{certify(inner, certificate.design_file, certificate.design_text, progress,
                                           Extent::requirements, certificate.deadline),
                                   {}};
  particulars.promise = kind_of(inner).frequency_promise(particulars.tracker);
  certificate.particulars = std::move(particulars);
  certificate.derivations.push_back(
      regulator::derive_output_bound(question_of(tables, regulator_particulars(certificate).promise)));
  RegulatorClaims(certificate).add_all();
}

namespace {

Json numbers_json(const std::vector<Number>& numbers) {
  Json list = Json::array();
  for (const Number& number : numbers) {
    list.push_back(number_json(number));
  }
  return list;
}

}  // namespace

Json regulator_design_json(const Design& design) {
  const auto& [plant, chosen, require, simulate] = regulator_tables(design);
  Json required = Json::object();
  add_number(required, "attenuation_above", require.attenuation_above);
  add_number(required, "attenuated_within", require.attenuated_within);
  add_number(required, "output_below", require.output_below);
  add_number(required, "input_below", require.input_below);
  return {{"plant", {{"a", numbers_json(plant.a)}, {"b", numbers_json(plant.b)}}}, {"require", required}};
}

Json regulator_evidence_json(const Certificate& certificate) {
  return {{"frequency_tracker", inner_certificate_json(regulator_particulars(certificate).tracker)}};
}

}  // namespace veritrack::certificates
