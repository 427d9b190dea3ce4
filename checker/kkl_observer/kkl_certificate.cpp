#include "checker/kkl_observer/kkl_certificate.hpp"

#include <array>
#include <set>

#include "checker/document/evidence.hpp"
#include "checker/kkl_observer/kkl_ell.hpp"
#include "checker/kkl_observer/paper_claims.hpp"
#include "checker/kkl_observer/robustness.hpp"

namespace veritrack::checker {

namespace {

/// A key of [require], and the claim that it makes of a quantity of "kkl-robustness".
struct Requirement {
  const char *key, *claim, *quantity, *before, *after;
};
constexpr std::array kRequirements{
    Requirement{"frequency_error_below", "kkl/frequency-error-bound", "frequency_error_bound",
                "the frequency error stays below ", " rad/s once settled"},
    Requirement{"amplitude_error_below", "kkl/amplitude-error-bound", "amplitude_error_bound",
                "the amplitude error stays below ", " signal units once settled"},
    Requirement{"settles_within", "kkl/settling-time", "settling_time", "the proved bounds are valid from ",
                " s after the start on"}};

/// Walks through a certificate of the KKL observer.
class KklVerifier {
 public:
  KklVerifier(const Tree& certificate, Verification& result) : certificate_(certificate), result_(result) {}

  void run() {
    Objections objections;
    design_ = read_kkl_design(certificate_.at("design"), objections);
    result_.parts.push_back({"design", objections});
    for (const Tree& derivation : certificate_.at("derivations").elements()) {
      check_one(derivation);
    }
    for (const char* list : {"certified_sets", "comparison"}) {
      if (!certificate_.at(list).elements().empty()) {
        result_.parts.push_back({list, {kUnknown}});
      }
    }
    std::vector<std::string> asked;
    for (const auto& [key, value] : certificate_.at("design").at("require").members()) {
      const Requirement* known = requirement_of(&Requirement::key, key);
      asked.push_back(known != nullptr ? known->claim : key);
    }
    const auto check = [this](const Tree& claim, Objections& found) { check_requirement(claim, found); };
    check_claims(certificate_, asked, check, result_);
  }

 private:
  static const Requirement* requirement_of(const char* Requirement::*member, const std::string& name) {
    for (const Requirement& requirement : kRequirements) {
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
      if (objections.empty() && verdict_from(derivation.at("verdict").text()) == Verdict::proved) {
        robustness_ = &derivation;
      }
    } else if (id == "kkl-paper") {
      check_paper_claims(derivation, design_, ell_in_use(), infimum_, objections);
    } else if (id == "kkl-section-v") {
      // Simulations, for which no proof is claimed.
      check_derivation(derivation, {"The simulations of section V, repeated", {}, {}}, objections);
    } else {
      objections.emplace_back(kUnknown);
    }
    result_.parts.push_back({id, objections});
  }

  /// A requirement on a bound follows from the bound, which was verified.
  void check_requirement(const Tree& claim, Objections& objections) const {
    const Requirement* known = requirement_of(&Requirement::claim, claim.at("id").text());
    const Tree* asked = known != nullptr ? certificate_.at("design").at("require").find(known->key) : nullptr;
    if (asked == nullptr) {
      objections.emplace_back(kUnknown);
      return;
    }
    Ball bound = Ball::everything();
    if (robustness_ != nullptr) {
      bound = high_of(robustness_->at("quantities").at(known->quantity));
    }
    const Ball limit = read_number(*asked, objections);
    check_claim(claim,
                {known->before + asked->at("text").text() + known->after,
                 proved_if(certainly_less(bound, limit)),
                 {{known->quantity, bound, Sense::bounds_above}}},
                objections);
  }

  const Tree& certificate_;
  Verification& result_;
  KklDesign design_;
  std::set<std::string> seen_;
  std::optional<EllEnclosure> infimum_;  ///< (10)
  const Tree* robustness_ = nullptr;     ///< once verified, and PROVED as a whole
};

}  // namespace

TrackerKind kkl_observer() {
  return {"kkl-observer", [](const Tree& certificate, bool /*all_boxes*/, Verification& result) {
            KklVerifier(certificate, result).run();
          }};
}

}  // namespace veritrack::checker
