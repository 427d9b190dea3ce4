#include "checker/kkl/kkl_certificate.hpp"

#include "checker/kkl/kkl_observer.hpp"

namespace veritrack::checker {

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

}  // namespace veritrack::checker
