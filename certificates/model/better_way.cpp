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

bool says_nothing(const Certificate& certificate) {
  return std::none_of(certificate.claims.begin(), certificate.claims.end(),
                      [](const Claim& claim) { return claim.verdict == rigor::Verdict::proved; });
}

}  // namespace

Certificate better_way(const std::function<Certificate(bool by_structure)>& certify) {
  Certificate first = certify(true);
  const bool is_enough = required_and_proved(first) >= required_claims_of(first) && !says_nothing(first);
  if (!model_sets(first).bounds_covariance || is_enough || first.deadline.is_over()) {
    return first;
  }
  Certificate second = certify(false);
  const bool is_better = required_and_proved(second) > required_and_proved(first) ||
                         (says_nothing(first) && !says_nothing(second));
  return is_better ? second : first;
}

}  // namespace veritrack::certificates
