#include "checker/single_channel/single_channel_certificate.hpp"

#include <set>

#include "checker/sets/guarantee.hpp"
#include "checker/single_channel/bias.hpp"
#include "checker/single_channel/frozen_filter.hpp"
#include "checker/single_channel/phase_contraction.hpp"
#include "checker/single_channel/proposition_claims.hpp"
#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

namespace {

/// Every number of a design file is in an object with its text.
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

void verify(const Tree& certificate, bool /*all_boxes*/, Verification& result) {
  Objections objections;
  read_numbers(certificate.at("design"), objections);
  const SingleChannelDesign design = read_single_channel_design(certificate.at("design"), objections);
  result.parts.push_back({"design", objections});
  for (const Tree& set : certificate.at("certified_sets").elements()) {
    result.parts.push_back({"certified set " + set.at("purpose").text(), {kUnknown}});
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
  for (const Tree& row : certificate.at("comparison").elements()) {
    result.parts.push_back({"comparison " + row.at("result").text(), {kUnknown}});
  }
  const std::map<std::string, Claim> propositions = proposition_claims();
  const auto check = [&](const Tree& claim, Objections& found) {
    const std::string& id = claim.at("id").text();
    if (is_guarantee(id)) {
      check_guarantee(claim, certificate, promises, Frequencies::assumed_band, found);
    } else if (id == "proposition-1/if" || id == "proposition-1/only-if") {
      check_proposition_1(claim, design, biases, found);
    } else if (const auto known = propositions.find(id); known != propositions.end()) {
      check_claim(claim, known->second, found);
    } else {
      found.emplace_back(kUnknown);
    }
  };
  check_claims(certificate, requirements(certificate.at("design")), check, result);
}

}  // namespace

TrackerKind single_channel_tracker() {
  return {"single-channel-ekf", verify};
}

}  // namespace veritrack::checker
