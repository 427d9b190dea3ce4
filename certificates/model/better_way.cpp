#include "certificates/model/better_way.hpp"

#include <algorithm>

#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

namespace {

std::ptrdiff_t required_and_proved(const Certificate& certificate) {
  return std::count_if(certificate.claims.begin(), certificate.claims.end(), [](const Claim& claim) {
    return claim.required && claim.verdict == rigor::Verdict::proved;
  });
}

std::ptrdiff_t required_claims_of(const Certificate& certificate) {
  return std::count_if(certificate.claims.begin(), certificate.claims.end(),
                       [](const Claim& claim) { return claim.required; });
}

}  // namespace

Certificate better_way(const std::function<Certificate(bool by_structure)>& certify) {
  Certificate first = certify(true);
  if (!model_sets(first).bounds_covariance || required_and_proved(first) >= required_claims_of(first) ||
      first.deadline.is_over()) {
    return first;
  }
  Certificate second = certify(false);
  return required_and_proved(second) > required_and_proved(first) ? second : first;
}

}  // namespace veritrack::certificates
