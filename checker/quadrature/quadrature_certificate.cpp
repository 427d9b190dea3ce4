#include "checker/quadrature/quadrature_certificate.hpp"

#include <map>

#include "checker/quadrature/capture.hpp"
#include "checker/quadrature/contraction.hpp"
#include "checker/quadrature/lock.hpp"
#include "checker/quadrature/lock_set.hpp"
#include "checker/quadrature/lowest_snr.hpp"
#include "checker/quadrature/mean_square.hpp"
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
    const Tree& design = certificate_.at("design");
    leaks_ = !design_.without_leak();
    // Without a leak the frequency does not act on the errors.
    Wording wording{leaks_, true, kDoublePrecision};
    if (is_gaussian(design.at("assume"))) {
      noise_ = read_gaussian_noise(design.at("assume"), design_.amplitude, objections);
      wording.deviation = noise_->deviation;
    }
    const Guarantee guarantee(design, wording, objections);
    add("design", objections);
    if (!objections.empty()) {
      return;  // no statement is made about an invalid design
    }
    for (const Tree& set : certificate_.at("certified_sets").elements()) {
      objections.clear();
      sets_.push_back(check_set(set, design_, result_.cells, objections));
      add("certified set " + set.at("purpose").text(), objections);
    }
    check_lock_sets();
    check_lock_mean_squares();
    check_set_for_lowest_snr();
    for (const Tree& derivation : certificate_.at("derivations").elements()) {
      check_one(derivation);
    }
    check_all_claims(guarantee);
  }

 private:
  struct Known {
    const Tree* derivation = nullptr;
    bool verified = false;
    std::string title;
  };

  void add(const std::string& name, const Objections& objections) {
    result_.parts.push_back({name, objections});
  }

  /// With Gaussian noise only; otherwise nothing reads them.
  void check_lock_sets() {
    const Tree* sets = certificate_.find("lock_sets");
    if (sets == nullptr || !noise_) {
      return;
    }
    Objections objections;
    if (!leaks_ && sets->elements().size() != 1) {
      objections.emplace_back("more or less than one set");
    }
    std::vector<LockSet> found;
    for (const Tree& set : sets->elements()) {
      if (objections.empty()) {
        found.push_back(check_lock_set(set, design_, *noise_, result_.cells, objections));
      }
    }
    if (leaks_ && objections.empty() && !cover_the_band(found, design_)) {
      objections.emplace_back("the sets do not cover the band of frequencies");
    }
    if (objections.empty()) {
      lock_sets_ = std::move(found);
    }
    add("lock set", objections);
  }

  /// For every set, or for none: a statement on one alone bounds nothing over the band.
  void check_lock_mean_squares() {
    std::vector<const Tree*> forms;
    for (std::size_t k = 0; k < lock_sets_.size(); ++k) {
      if (const Tree* form = certificate_.at("lock_sets").at(k).find("mean_square")) {
        forms.push_back(form);
      }
    }
    if (forms.empty()) {
      return;
    }
    Objections objections;
    if (forms.size() != lock_sets_.size()) {
      objections.emplace_back("some of the sets have a mean square and some have none");
    }
    std::vector<LockMeanSquare> found;
    for (std::size_t k = 0; k < forms.size() && objections.empty(); ++k) {
      found.push_back(check_lock_mean_square(*forms[k], design_, lock_sets_[k], result_.cells, objections));
    }
    add("mean square in lock", objections);
    if (objections.empty()) {
      lock_mean_squares_ = std::move(found);
    }
  }

  void check_set_for_lowest_snr() {
    const Tree* set = certificate_.find("lowest_snr_set");
    if (set == nullptr || !noise_) {
      return;
    }
    Objections objections;
    const LockSet found = check_lowest_snr_set(*set, design_, *noise_, result_.cells, objections);
    lowest_snr_set_ = objections.empty() ? std::optional(found) : std::nullopt;
    add("set for the lowest SNR", objections);
  }

  void check_one(const Tree& derivation) {
    const std::string& id = derivation.at("id").text();
    Objections objections;
    std::string title;
    if (derivations_.count(id) != 0) {
      objections.emplace_back("a second derivation of this id");
    }
    if (noise_.has_value() != (id == "lock" || id == "mean-square" || id == "lowest-snr")) {
      objections.emplace_back("this is for noise of another kind");
    } else if (id == "lock") {
      promises_ = check_lock(derivation, design_, *noise_, lock_sets_, objections);
    } else if (id == "mean-square") {
      check_mean_square(derivation, *noise_, lock_sets_, lock_mean_squares_, promises_, objections);
    } else if (id == "lowest-snr") {
      check_lowest_snr(derivation, design_, *noise_, lowest_snr_set_, promises_, objections);
    } else if (id == "theorem-2.9/printed") {
      title = check_theorem_2_9(derivation, design_, Reading::printed, objections);
    } else if (id == "theorem-2.9/errata") {
      title = check_theorem_2_9(derivation, design_, Reading::errata, objections);
    } else if (id == "contraction") {
      promises_ = leaks_ ? check_steady_contraction(derivation, design_, result_.cells, objections)
                         : check_contraction(derivation, design_, sets_, objections);
    } else if (id == "capture" || id == "capture/noise-free" || id == "capture/reduced-noise") {
      captured_[id] = check_capture(derivation, design_, sets_, all_boxes_, objections);
      if (!objections.empty()) {
        captured_.erase(id);
      }
    } else if (id == "theorem-2.9/repaired") {
      title = check_repaired_theorem(derivation, design_, objections);
    } else if (id == "table-3.1/printed" || id == "table-3.1/errata") {
      title = check_table_3_1(derivation, design_, id == "table-3.1/printed", objections);
    } else if (is_published_result(id)) {
      title = check_published_result(id, derivation, design_, objections);
    } else {
      objections.emplace_back(kUnknown);
    }
    derivations_[id] = {&derivation, objections.empty(), title};
    add(id, objections);
  }

  /// "... satisfy all conditions of ...": as the derivation says, whose conditions were checked.
  Claim check_conditions_claim(const Tree& claim, const std::string& id, Objections& objections) {
    const auto known = derivations_.find(id.substr(0, id.rfind("/conditions")));
    if (known == derivations_.end() || !known->second.verified || known->second.title.empty()) {
      objections.emplace_back(kUnverified);
      return {};
    }
    Claim found{"The design and the assumed start satisfy all conditions of " + known->second.title + ".",
                verdict_of(*known->second.derivation),
                {}};
    check_claim(claim, found, objections);
    return found;
  }

  void check_all_claims(const Guarantee& guarantee) {
    if (derivations_.count("capture") != 0) {
      // The starts had to be followed, and the claims about them rest on that.
      const Captured& found = captured_["capture"];
      promises_.bound = found.verdict == Verdict::proved ? found.bound : std::nullopt;
      promises_.settled = found.settled;
      promises_.ultimate = found.ultimate;
      promises_.covariance = found.covariance;
      promises_.wrong_lock = found.wrong_lock;
    }
    const std::map<std::string, Claim> gaps = proof_gaps(design_);
    const auto check = [&](const Tree& claim, Objections& objections) {
      const std::string& id = claim.at("id").text();
      if (id.ends_with("/conditions")) {
        return check_conditions_claim(claim, id, objections);
      }
      if (Guarantee::is_guarantee(id)) {
        return guarantee.check(claim, promises_, objections);
      }
      if (is_capture_claim(id)) {
        return check_capture_claim(claim, captured_, guarantee, objections);
      }
      if (const auto gap = gaps.find(id); gap != gaps.end()) {
        check_claim(claim, gap->second, objections);
        return gap->second;
      }
      objections.emplace_back(kUnknown);
      return Claim();
    };
    check_claims(certificate_, guarantee.required(), check, result_);
  }

  const Tree& certificate_;
  bool all_boxes_;
  Verification& result_;
  Design design_;
  bool leaks_ = false;  ///< then the contraction is that about a biased steady state
  std::vector<CertifiedSet> sets_;
  std::optional<GaussianNoise> noise_;             ///< in place of a bound
  std::vector<LockSet> lock_sets_;                 ///< proved
  std::vector<LockMeanSquare> lock_mean_squares_;  ///< likewise, one for each of them
  std::optional<LockSet> lowest_snr_set_;          ///< likewise
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
