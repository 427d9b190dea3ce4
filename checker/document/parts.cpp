#include "checker/document/parts.hpp"

#include <algorithm>

namespace veritrack::checker {

bool Verification::verified() const {
  return !parts.empty() &&
         std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.objections.empty(); });
}

void check_claims(const Tree& certificate, std::vector<std::string> asked,
                  const std::function<void(const Tree& claim, Objections& objections)>& check,
                  Verification& result) {
  std::vector<std::string> required;
  std::vector<Verdict> verdicts;
  Objections unverified;
  for (const Tree& claim : certificate.at("claims").elements()) {
    const std::string& id = claim.at("id").text();
    Objections objections;
    check(claim, objections);
    if (claim.at("required").truth()) {
      required.push_back(id);
      verdicts.push_back(verdict_from(claim.at("verdict").text()));
      if (!objections.empty()) {
        unverified.push_back(id + " is required and not verified");
      }
    }
    result.parts.push_back({"claim " + id, objections});
  }
  std::sort(asked.begin(), asked.end());
  std::sort(required.begin(), required.end());
  if (required != asked) {
    unverified.emplace_back("the required claims are not those of the design's [require]");
  }
  const std::string& verdict = certificate.at("verdict").text();
  const bool nothing_required = required.empty() && verdict == "nothing-required";
  if (!nothing_required) {
    check_verdict(verdict, all_of(verdicts), "the certificate", unverified);
  }
  result.parts.push_back({"verdict " + verdict, unverified});
}

}  // namespace veritrack::checker
