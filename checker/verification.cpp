#include "checker/verification.hpp"

#include <set>
#include <stdexcept>

#include "checker/kkl_observer/kkl_certificate.hpp"
#include "checker/quadrature/quadrature_certificate.hpp"
#include "checker/single_channel/single_channel_certificate.hpp"

namespace veritrack::checker {

Verification verify(const Tree& certificate, bool all_boxes) {
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
      verify_quadrature_tracker(certificate, all_boxes, result);
    } else if (tracker == "kkl-observer") {
      verify_kkl_observer(certificate, result);
    } else if (tracker == "single-channel-ekf") {
      verify_single_channel_tracker(certificate, result);
    } else {
      result.parts.push_back({"tracker " + tracker, {kUnknown}});
    }
  } catch (const std::invalid_argument& error) {
    throw Malformed(error.what());
  }
  return result;
}

}  // namespace veritrack::checker
