#include "checker/quadrature/quadrature_certificate.hpp"

#include <map>

#include "checker/quadrature/capture.hpp"
#include "checker/quadrature/contraction.hpp"
#include "checker/quadrature/steady_contraction.hpp"
#include "checker/sets/guarantee.hpp"
#include "checker/theorems/proof_gaps.hpp"
#include "checker/theorems/published_results.hpp"
#include "checker/theorems/repaired_theorem.hpp"
#include "checker/theorems/table_3_1.hpp"
#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

namespace {

/// Walks through a certificate of the quadrature tracker.
class QuadratureVerifier {
 public:
  QuadratureVerifier(const Tree& certificate, bool all_boxes, Verification& result)
      : certificate_(certificate), all_boxes_(all_boxes), result_(result) {}

  void run() {
    Objections objections;
    design_ = read_design(certificate_.at("design"), objections);
    leaks_ = !design_.without_leak();
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
    check_all_claims();
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
    } else if (id == "contraction") {
      promises_ = leaks_ ? check_steady_contraction(derivation, design_, result_.cells, objections)
                         : check_contraction(derivation, design_, sets_, objections);
    } else if (id == "capture" || id == "capture/noise-free" || id == "capture/reduced-noise") {
      captured_[id] = check_capture(derivation, design_, sets_, all_boxes_, objections);
      if (!objections.empty()) {
        captured_.erase(id);
      }
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

  /// "... satisfy all conditions of ...": as the derivation says, whose conditions were checked.
  void check_conditions_claim(const Tree& claim, const std::string& id, Objections& objections) {
    const auto known = derivations_.find(id.substr(0, id.rfind("/conditions")));
    if (known == derivations_.end() || !known->second.verified) {
      objections.emplace_back(kUnverified);
      return;
    }
    const Tree& derivation = *known->second.derivation;
    check_claim(
        claim,
        {"The design and the assumed start satisfy all conditions of " + derivation.at("title").text() + ".",
         verdict_from(derivation.at("verdict").text()),
         {}},
        objections);
  }

  void check_all_claims() {
    if (derivations_.count("capture") != 0) {
      // The starts had to be followed, and what is claimed of them rests on that.
      const Captured& found = captured_["capture"];
      promises_.bound = found.verdict == Verdict::proved ? found.bound : std::nullopt;
      promises_.settling = found.settling;
      promises_.wrong_lock = found.wrong_lock;
    }
    const std::map<std::string, Claim> gaps = proof_gaps(design_);
    // Without a leak the frequency does not act on the errors.
    const Frequencies frequencies = leaks_ ? Frequencies::assumed_band : Frequencies::every;
    const auto check = [&](const Tree& claim, Objections& objections) {
      const std::string& id = claim.at("id").text();
      if (id.ends_with("/conditions")) {
        check_conditions_claim(claim, id, objections);
      } else if (is_guarantee(id)) {
        check_guarantee(claim, certificate_, promises_, frequencies, objections);
      } else if (is_capture_claim(id)) {
        check_capture_claim(claim, captured_, objections);
      } else if (const auto gap = gaps.find(id); gap != gaps.end()) {
        check_claim(claim, gap->second, objections);
      } else {
        objections.emplace_back(kUnknown);
      }
    };
    check_claims(certificate_, requirements(certificate_.at("design")), check, result_);
  }

  const Tree& certificate_;
  bool all_boxes_;
  Verification& result_;
  Design design_;
  bool leaks_ = false;  ///< then the contraction is that about a biased steady state
  std::vector<CertifiedSet> sets_;
  std::map<std::string, Known> derivations_;
  std::map<std::string, Captured> captured_;  ///< of the derivations that are verified
  Promises promises_;
};

}  // namespace

TrackerKind quadrature_tracker() {
  return {"quadrature-ekf", [](const Tree& certificate, bool all_boxes, Verification& result) {
            QuadratureVerifier(certificate, all_boxes, result).run();
          }};
}

}  // namespace veritrack::checker
