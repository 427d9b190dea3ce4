#include "certificates/sets/statement_claim.hpp"

namespace veritrack::certificates {

Claim to_claim(const theorems::Statement& statement) {
  Claim claim;
  claim.id = statement.id;
  claim.statement = statement.sentence;
  claim.verdict = statement.verdict;
  claim.reason = statement.witness;
  claim.evidence = statement.evidence;
  claim.values = statement.values;
  return claim;
}

}  // namespace veritrack::certificates
