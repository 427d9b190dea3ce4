#include "checker/single_channel/single_channel_certificate.hpp"

#include <set>

#include "checker/sets/guarantee.hpp"
#include "checker/single_channel/bias.hpp"
#include "checker/single_channel/frozen_filter.hpp"
#include "checker/single_channel/phase_contraction.hpp"
#include "checker/single_channel/proposition_claims.hpp"
#include "checker/single_channel/recursion.hpp"
#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

namespace {

void verify(const Tree& certificate, bool all_boxes, Verification& result) {
  Objections objections;
  const SingleChannelDesign design = read_single_channel_design(certificate.at("design"), objections);
  const Guarantee guarantee(certificate.at("design"), {true, false, kDoublePrecision}, objections);
  result.parts.push_back({"design", objections});
  if (!objections.empty()) {
    return;  // no statement is made about an invalid design
  }
  Promises promises;
  std::vector<SteadyStateBias> biases;
  QuadratureBranch quadrature({design.q1, design.q2, design.r, design.epsilon});
  std::set<std::string> derivations;
  for (const Tree& derivation : certificate.at("derivations").elements()) {
    const std::string& id = derivation.at("id").text();
    objections.clear();
    if (!derivations.insert(id).second) {
      objections.emplace_back("a second derivation of this id");
    } else if (id == "contraction") {
      promises = check_phase_contraction(derivation, design, result.cells, objections);
    } else if (id == "single-channel-bias" || id.starts_with("single-channel-bias/")) {
      if (const auto bias = check_bias(derivation, design, quadrature, objections)) {
        biases.push_back(*bias);
      }
    } else if (id == "single-channel/transfer-function") {
      check_transfer_function(derivation, objections);
    } else {
      objections.emplace_back(kUnknown);
    }
    result.parts.push_back({id, objections});
  }
  const Recursion recursion(certificate, design, all_boxes, result);
  const std::map<std::string, Claim> propositions = proposition_claims();
  const auto check = [&](const Tree& claim, Objections& found) {
    const std::string& id = claim.at("id").text();
    if (Recursion::is_of_recursion(id) || Recursion::decides(claim)) {
      return recursion.check(claim, guarantee, found);
    }
    if (Guarantee::is_guarantee(id)) {
      return guarantee.check(claim, promises, found);
    }
    if (id == "proposition-1/if" || id == "proposition-1/only-if") {
      return check_proposition_1(claim, design, biases, found);
    }
    if (const auto known = propositions.find(id); known != propositions.end()) {
      check_claim(claim, known->second, found);
      return known->second;
    }
    found.emplace_back(kUnknown);
    return Claim();
  };
  check_claims(certificate, guarantee.required(), check, result);
}

}  // namespace

TrackerKind single_channel_tracker() {
  return {"single-channel-ekf", verify};
}

}  // namespace veritrack::checker
