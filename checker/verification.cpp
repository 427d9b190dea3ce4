#include "checker/verification.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "checker/contraction.hpp"
#include "checker/guarantee.hpp"
#include "checker/kkl_observer.hpp"
#include "checker/proof_gaps.hpp"
#include "checker/published_results.hpp"
#include "checker/repaired_theorem.hpp"
#include "checker/single_channel.hpp"
#include "checker/table_3_1.hpp"
#include "checker/theorem_2_9.hpp"

namespace veritrack::checker {

namespace {

constexpr const char* kUnknown = "no check for this kind";
constexpr const char* kUnverified = "its derivation is not verified";

/// Walks through a certificate of the quadrature tracker.
class QuadratureVerifier {
 public:
  QuadratureVerifier(const Tree& certificate, Verification& result)
      : certificate_(certificate), result_(result) {}

  void run() {
    Objections objections;
    design_ = read_design(certificate_.at("design"), objections);
    add("design", objections);
    for (const Tree& set : certificate_.at("certified_sets").elements()) {
      objections.clear();
      sets_.push_back(check_set(set, design_, result_.cells, objections));
      add("certified set " + set.at("purpose").text(), objections);
    }
    for (const Tree& derivation : certificate_.at("derivations").elements()) {
      check_one(derivation);
    }
    for (const Tree& row : certificate_.at("comparison").elements()) {
      check_comparison(row);
    }
    check_claims();
  }

 private:
  struct Known {
    const Tree* derivation = nullptr;
    bool verified = false;
  };

  void add(const std::string& name, const Objections& objections) {
    result_.parts.push_back({name, objections});
  }

  void check_one(const Tree& derivation) {
    const std::string& id = derivation.at("id").text();
    Objections objections;
    if (derivations_.count(id) != 0) {
      objections.emplace_back("a second derivation of this id");
    }
    if (id == "theorem-2.9/printed") {
      check_theorem_2_9(derivation, design_, Reading::printed, objections);
    } else if (id == "theorem-2.9/errata") {
      check_theorem_2_9(derivation, design_, Reading::errata, objections);
    } else if (id == "contraction" && certainly_equal(design_.epsilon, Ball(0.0))) {
      promises_ = check_contraction(derivation, design_, sets_, objections);
    } else if (id == "theorem-2.9/repaired") {
      check_repaired_theorem(derivation, design_, objections);
    } else if (id == "table-3.1/printed" || id == "table-3.1/errata") {
      check_table_3_1(derivation, design_, id == "table-3.1/printed", objections);
    } else if (is_published_result(id)) {
      check_published_result(id, derivation, design_, objections);
    } else {
      objections.emplace_back(kUnknown);
    }
    derivations_[id] = {&derivation, objections.empty()};
    add(id, objections);
  }

  /// A row repeats what its derivation says.
  void check_comparison(const Tree& row) {
    const std::string& result = row.at("result").text();
    if (!row.at("proved").truth()) {
      return;
    }
    Objections objections;
    const auto known = derivations_.find(result);
    if (known == derivations_.end()) {
      objections.emplace_back("a row of the comparison without its derivation");
      add("comparison " + result, objections);
      return;
    }
    const Tree& derivation = *known->second.derivation;
    if (!known->second.verified) {
      objections.emplace_back(kUnverified);
    }
    if (row.at("verdict").text() != derivation.at("verdict").text()) {
      objections.emplace_back("not the verdict of the derivation");
    }
    const auto repeats = [&](const char* name, const char* first, const char* second) {
      if (const Tree* value = row.find(name)) {
        const Tree* quantity = derivation.at("quantities").find(first);
        quantity = quantity != nullptr ? quantity : derivation.at("quantities").find(second);
        const bool same = quantity != nullptr && value->at("lo").text() == quantity->at("lo").text() &&
                          value->at("hi").text() == quantity->at("hi").text() &&
                          value->at("decimal").text() == quantity->at("decimal").text();
        if (!same) {
          objections.push_back(std::string(name) + " is not that of the derivation");
        }
      }
    };
    repeats("initial_frequency_error", "initial_frequency_error_bound", "frequency_error_radius");
    repeats("noise", "noise_bound", "largest_noise");
    repeats("rate", "rate", "contraction_rate");
    add("comparison " + result, objections);
  }

  /// "All conditions of ... hold": as the derivation says, whose conditions were checked.
  void check_conditions_claim(const Tree& claim, const std::string& id, Objections& objections) {
    const auto known = derivations_.find(id.substr(0, id.rfind("/conditions")));
    if (known == derivations_.end() || !known->second.verified) {
      objections.emplace_back(kUnverified);
      return;
    }
    const Tree& derivation = *known->second.derivation;
    check_claim(
        claim,
        {"All conditions of " + derivation.at("title").text() + " hold for the design and the assumed start.",
         verdict_from(derivation.at("verdict").text()),
         {}},
        objections);
  }

  void check_claims() {
    const std::map<std::string, Claim> gaps = proof_gaps(design_);
    std::vector<std::string> required;
    std::vector<Verdict> verdicts;
    Objections unverified;
    if (derivations_.count("capture") != 0) {
      // The starts had to be followed, and what is claimed of them rests on that.
      promises_.bound.reset();
      promises_.settling.reset();
    }
    for (const Tree& claim : certificate_.at("claims").elements()) {
      const std::string& id = claim.at("id").text();
      Objections objections;
      if (claim.at("required").truth()) {
        required.push_back(id);
        verdicts.push_back(verdict_from(claim.at("verdict").text()));
      }
      if (id.ends_with("/conditions")) {
        check_conditions_claim(claim, id, objections);
      } else if (is_guarantee(id)) {
        check_guarantee(claim, certificate_, design_, promises_, objections);
      } else if (const auto gap = gaps.find(id); gap != gaps.end()) {
        check_claim(claim, gap->second, objections);
      } else {
        objections.emplace_back(kUnknown);
      }
      if (claim.at("required").truth() && !objections.empty()) {
        unverified.push_back(id + " is required and not verified");
      }
      add("claim " + id, objections);
    }
    Objections objections = unverified;
    std::vector<std::string> asked = requirements(certificate_.at("design"));
    std::sort(asked.begin(), asked.end());
    std::sort(required.begin(), required.end());
    if (required != asked) {
      objections.emplace_back("the required claims are not those of the design's [require]");
    }
    const std::string& verdict = certificate_.at("verdict").text();
    const bool nothing_required = required.empty() && verdict == "nothing-required";
    if (!nothing_required) {
      check_verdict(verdict, all_of(verdicts), "the certificate", objections);
    }
    add("verdict " + verdict, objections);
  }

  const Tree& certificate_;
  Verification& result_;
  Design design_;
  std::vector<CertifiedSet> sets_;
  std::map<std::string, Known> derivations_;
  Promises promises_;
};

/// A certificate of the KKL observer: ell, and whatever claims nothing.
void verify_kkl_observer(const Tree& certificate, Verification& result) {
  Objections objections;
  const KklDesign design = read_kkl_design(certificate.at("design"), objections);
  result.parts.push_back({"design", objections});
  for (const Tree& derivation : certificate.at("derivations").elements()) {
    const std::string& id = derivation.at("id").text();
    objections.clear();
    if (id == "kkl-ell") {
      check_kkl_ell(derivation, design, objections);
    } else if (id == "kkl-section-v") {
      check_derivation(derivation, {derivation.at("title").text(), {}, {}}, objections);
    } else {
      objections.emplace_back(kUnknown);
    }
    result.parts.push_back({id, objections});
  }
  for (const Tree& claim : certificate.at("claims").elements()) {
    result.parts.push_back({"claim " + claim.at("id").text(), {kUnknown}});
  }
  result.parts.push_back({"verdict " + certificate.at("verdict").text(), {kUnknown}});
}

/// Every number of a design file stands in an object with its text.
void read_numbers(const Tree& tree, Objections& objections) {
  if (tree.kind() == Tree::Kind::array) {
    for (const Tree& element : tree.elements()) {
      read_numbers(element, objections);
    }
  } else if (tree.kind() == Tree::Kind::object && tree.find("text") != nullptr) {
    read_number(tree, objections);
  } else if (tree.kind() == Tree::Kind::object) {
    for (const auto& [key, value] : tree.members()) {
      read_numbers(value, objections);
    }
  }
}

/// A certificate of another tracker: the claims about its formulas; what else is proved has no check yet.
void verify_claims_alone(const Tree& certificate, const std::map<std::string, Claim>& known,
                         Verification& result) {
  Objections objections;
  read_numbers(certificate.at("design"), objections);
  result.parts.push_back({"design", objections});
  for (const Tree& set : certificate.at("certified_sets").elements()) {
    result.parts.push_back({"certified set " + set.at("purpose").text(), {kUnknown}});
  }
  for (const Tree& derivation : certificate.at("derivations").elements()) {
    result.parts.push_back({derivation.at("id").text(), {kUnknown}});
  }
  for (const Tree& claim : certificate.at("claims").elements()) {
    const auto found = known.find(claim.at("id").text());
    objections.clear();
    if (found == known.end()) {
      objections.emplace_back(kUnknown);
    } else {
      check_claim(claim, found->second, objections);
    }
    result.parts.push_back({"claim " + claim.at("id").text(), objections});
  }
  result.parts.push_back({"verdict " + certificate.at("verdict").text(), {kUnknown}});
}

}  // namespace

bool Verification::verified() const {
  return !parts.empty() &&
         std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.objections.empty(); });
}

Verification verify(const Tree& certificate) {
  if (certificate.at("schema").text() != "veritrack/certificate/1") {
    throw Malformed("not a certificate of format 1");
  }
  // "formal_proofs" is a table of contents of another file, which Coq checks; nothing here rests on it.
  static const std::set<std::string> known{"schema",         "design",        "derivations",
                                           "certified_sets", "audits",        "comparison",
                                           "claims",         "formal_proofs", "verdict"};
  for (const auto& [key, value] : certificate.members()) {
    if (known.count(key) == 0) {
      throw Malformed("the format has no \"" + key + "\"");
    }
  }
  Verification result;
  const std::string& tracker = certificate.at("design").at("tracker").text();
  try {
    if (tracker == "quadrature-ekf") {
      QuadratureVerifier(certificate, result).run();
    } else if (tracker == "kkl-observer") {
      verify_kkl_observer(certificate, result);
    } else if (tracker == "single-channel-ekf") {
      verify_claims_alone(certificate, proposition_claims(), result);
    } else {
      result.parts.push_back({"tracker " + tracker, {kUnknown}});
    }
  } catch (const std::invalid_argument& error) {
    throw Malformed(error.what());
  }
  return result;
}

}  // namespace veritrack::checker
