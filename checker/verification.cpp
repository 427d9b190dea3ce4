#include "checker/verification.hpp"

#include <set>
#include <stdexcept>

#include "checker/registry.hpp"

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
  try {
    verify_tracker(certificate, all_boxes, result);
  } catch (const std::invalid_argument& error) {
    throw Malformed(error.what());
  }
  return result;
}

}  // namespace veritrack::checker
