#include "certificates/model/proof_words.hpp"

#include <fmt/format.h>

namespace veritrack::certificates {

using model::NoGains;
using model::ProofObjection;

std::string gains_words(const NoGains& reason) {
  switch (reason.kind) {
    case NoGains::Kind::question:
      return "it needs a tone alone, bounded noise, no start_exactly and no filter";
    case NoGains::Kind::band:
      return "the band goes beyond half the sample rate, or, with one channel, to 0";
    case NoGains::Kind::steady_state:
      return "no steady state was found from [model] start";
    case NoGains::Kind::bounds:
      return "the bounds of its errors do not close, even without noise";
    case NoGains::Kind::residual:
      return "its steady state is not a linear function of the frequency over the whole band";
    case NoGains::Kind::time:
      return fmt::format("the time was over before {}; allowed: more --timeout", reason.detail);
    case NoGains::Kind::structure:
      break;
  }
  return reason.detail;
}

std::string phase_gains_words(const NoGains& reason) {
  switch (reason.kind) {
    case NoGains::Kind::question:
      return "it needs one amplitude, bounded noise, no start_exactly and no filter";
    case NoGains::Kind::band:
      return "the band goes to 0 or to half the sample rate";
    case NoGains::Kind::bounds:
      return "the bounds of its errors do not close";
    default:
      return gains_words(reason);
  }
}

std::string objection_words(const ProofObjection& objection, const std::optional<NoGains>& no_gains) {
  switch (objection.kind) {
    case ProofObjection::Kind::too_many_states:
      return fmt::format("{} states are too many: at most {}", objection.states, objection.most_states);
    case ProofObjection::Kind::no_band:
      break;
    case ProofObjection::Kind::negative_frequencies:
      return "frequencies below 0 are certified by gains only (docs/model.md), and this loop is not: " +
             (no_gains ? gains_words(*no_gains) : "") +
             (objection.advice.empty() ? "" : ". But " + objection.advice);
  }
  return "the assumed frequencies are no band of some width from 0 to pi rad/sample";
}

}  // namespace veritrack::certificates
