#include "checker/verification.hpp"

#include <stdexcept>

#include "checker/numbers/budget.hpp"
#include "checker/registry.hpp"

namespace veritrack::checker {

namespace {

/// A value that no check has read is a place to lie.
void add_unread(const Tree& certificate, Verification& result) {
  constexpr std::size_t kMostShown = 10;
  Objections objections;
  for (const std::string& path : certificate.unread(kMostShown)) {
    objections.push_back(path + " is not read by any check");
  }
  result.parts.push_back({"every member is read", objections});
}

}  // namespace

Verification verify(const Tree& certificate, bool all_boxes) {
  if (certificate.at("schema").text() != kFormat) {
    throw Malformed(std::string("not a certificate of the format ") + kFormat);
  }
  // Each certificate has the whole budget.
  go_on_from(0);
  Verification result;
  try {
    // Names for people: printed as quotations, and nothing rests on them.
    for (const char* quoted : {"name", "source"}) {
      result.quoted.push_back(certificate.at("design").at(quoted).text());
    }
    result.design_sha256 = certificate.at("design_sha256").text();
    constexpr std::size_t kDigits = 64;
    if (result.design_sha256.size() != kDigits ||
        result.design_sha256.find_first_not_of("0123456789abcdef") != std::string::npos) {
      throw Malformed("design_sha256 is not 64 hexadecimal digits");
    }
    verify_tracker(certificate, all_boxes, result);
  } catch (const std::invalid_argument& error) {
    throw Malformed(error.what());
  } catch (const OutOfBudget& error) {
    const std::string last = result.parts.empty() ? "the design" : result.parts.back().name;
    result.parts.push_back(
        {"budget", {std::string(error.what()) + ", in the part after " + last + "; see --budget"}});
    return result;
  }
  add_unread(certificate, result);
  return result;
}

}  // namespace veritrack::checker
