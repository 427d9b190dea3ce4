#include "checker/kkl_observer/kkl_certificate.hpp"

#include <array>
#include <set>

#include "checker/document/design_number.hpp"
#include "checker/document/evidence.hpp"
#include "checker/kkl_observer/kkl_ell.hpp"
#include "checker/kkl_observer/paper_claims.hpp"
#include "checker/kkl_observer/robustness.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

/// A key of [require], and its claim on a quantity of "kkl-robustness".
struct RequiredBound {
  const char *key, *claim, *quantity, *before, *after;
};
constexpr std::array kRequirements{
    RequiredBound{"frequency_error_below", "kkl/frequency-error-bound", "frequency_error_bound",
                  "the frequency error stays below ", " rad/s once settled"},
    RequiredBound{"amplitude_error_below", "kkl/amplitude-error-bound", "amplitude_error_bound",
                  "the amplitude error stays below ", " signal units once settled"},
    RequiredBound{"settles_within", "kkl/settling-time", "settling_time", "the proved bounds are valid from ",
                  " s after the start on"}};

/// The input of the estimates, and the way they are computed.
std::string arithmetic(const Tree& chosen) {
  if (const Tree* interval = chosen.find("sampling_interval")) {
    return "For the program in double precision, started at rest, with samples every " + text_of(*interval) +
           " s and straight lines between them, ";
  }
  return "For filters within 1e-9 A/lambda of the exact solution from rest (A: the tone's amplitude, lambda: "
         "the filter's rate) and estimates computed from them in double precision, ";
}

/// The arithmetic, then "for every tone ..., with ..., ".
std::string hypotheses(const Tree& design) {
  const Tree& assume = design.at("assume");
  const auto range = [&](const char* name, const char* unit) {
    const Tree& ends = assume.at(name);
    return "from " + text_of(ends.at(0)) + " to " + text_of(ends.at(1)) + unit;
  };
  std::string text = arithmetic(design.at("design")) + "for every tone of constant frequency " +
                     range("frequency", " rad/s") + " and constant amplitude " +
                     range("amplitude", " signal units");
  const Tree* disturbance = assume.find("disturbance");
  if (disturbance == nullptr) {
    return text + ", without disturbance, ";
  }
  if (const Tree* bound = disturbance->find("bound")) {
    const char* where = design.at("design").find("sampling_interval") != nullptr ? " in each sample, " : ", ";
    return text + ", with any disturbance of at most " + text_of(*bound) + " signal units" + where;
  }
  return text + ", with a sinusoidal disturbance of amplitude " + text_of(disturbance->at("amplitude")) +
         " signal units and frequency " + text_of(disturbance->at("frequency")) + " rad/s or more, ";
}

/// Walks through a certificate of the KKL observer.
class KklVerifier {
 public:
  KklVerifier(const Tree& certificate, Verification& result) : certificate_(certificate), result_(result) {}

  void run() {
    Objections objections;
    design_ = read_kkl_design(certificate_.at("design"), objections);
    std::vector<Requirement> asked;
    for (const auto& [key, value] : certificate_.at("design").at("require").members()) {
      const RequiredBound* known = requirement_of(&RequiredBound::key, key);
      if (known == nullptr) {
        objections.push_back("[require] has no key " + key);
        continue;
      }
      read_positive(value, key, objections);
      asked.push_back({known->claim, known->before + text_of(value) + known->after});
    }
    result_.parts.push_back({"design", objections});
    if (!objections.empty()) {
      return;  // no statement is made about an invalid design
    }
    for (const Tree& derivation : certificate_.at("derivations").elements()) {
      check_one(derivation);
    }
    const auto check = [this](const Tree& claim, Objections& found) {
      return check_requirement(claim, found);
    };
    check_claims(certificate_, asked, check, result_);
  }

 private:
  static const RequiredBound* requirement_of(const char* RequiredBound::*member, const std::string& name) {
    for (const RequiredBound& requirement : kRequirements) {
      if (name == requirement.*member) {
        return &requirement;
      }
    }
    return nullptr;
  }

  /// The one in use in (9): the design's, or the lower end of the enclosure of (10).
  [[nodiscard]] Ball ell_in_use() const {
    return design_.ell.value_or(infimum_ ? infimum_->low : Ball::everything());
  }

  void check_one(const Tree& derivation) {
    const std::string& id = derivation.at("id").text();
    Objections objections;
    if (!seen_.insert(id).second) {
      objections.emplace_back("a second derivation of this id");
    }
    if (id == "kkl-ell") {
      infimum_ = check_kkl_ell(derivation, design_, objections);
    } else if (id == "kkl-robustness") {
      check_kkl_robustness(derivation, design_, ell_in_use(), objections);
      if (objections.empty() && verdict_of(derivation) == Verdict::proved) {
        robustness_ = &derivation;
      }
    } else if (id == "kkl-paper") {
      check_paper_claims(derivation, design_, ell_in_use(), infimum_, objections);
    } else {
      objections.emplace_back(kUnknown);
    }
    result_.parts.push_back({id, objections});
  }

  /// A requirement on a bound follows from the bound, which was verified.
  Claim check_requirement(const Tree& claim, Objections& objections) const {
    const RequiredBound* known = requirement_of(&RequiredBound::claim, claim.at("id").text());
    const Tree& design = certificate_.at("design");
    const Tree* asked = known != nullptr ? design.at("require").find(known->key) : nullptr;
    if (asked == nullptr) {
      objections.emplace_back(kUnknown);
      return {};
    }
    const auto bound = [this](const char* name) {
      const Tree* quantity = robustness_ != nullptr ? robustness_->at("quantities").find(name) : nullptr;
      return quantity != nullptr ? high_of(*quantity) : Ball::everything();
    };
    const Ball settling = bound("settling_time");
    const Ball value = bound(known->quantity);
    Claim found;
    found.is_summary = true;
    found.hypotheses = hypotheses(design);
    found.statement = found.hypotheses + known->before + text_of(*asked) + known->after + ": from " +
                      upper_decimal(settling) + " s after the start on, ";
    const bool is_time = std::string(known->quantity) == "settling_time";
    found.statement += is_time ? "the frequency error is at most " +
                                     upper_decimal(bound("frequency_error_bound")) +
                                     " rad/s and the amplitude error at most " +
                                     upper_decimal(bound("amplitude_error_bound")) + " signal units."
                               : "it is at most " + upper_decimal(value) + ".";
    found.verdict = proved_if(certainly_less(value, read_number(*asked, objections)));
    found.evidence = {{known->quantity, value, Sense::bounds_above}};
    check_claim(claim, found, objections);
    return found;
  }

  const Tree& certificate_;
  Verification& result_;
  KklDesign design_;
  std::set<std::string> seen_;
  std::optional<EllEnclosure> infimum_;  ///< (10)
  const Tree* robustness_ = nullptr;     ///< once verified, and PROVED as a whole
};

}  // namespace

TrackerKind kkl_observer_tracker() {
  return {"kkl-observer", [](const Tree& certificate, bool /*all_boxes*/, Verification& result) {
            KklVerifier(certificate, result).run();
          }};
}

}  // namespace veritrack::checker
