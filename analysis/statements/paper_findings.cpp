#include "analysis/statements/paper_findings.hpp"

#include <algorithm>
#include <cctype>

namespace veritrack::theorems {

namespace {

using rigor::Verdict;
using enum FindingKind;

/// "False as stated (thesis, (2.33)): " before the reason, when the claim is in the ledger and REFUTED. A
/// claim that the scan does not show is neither proved nor refuted: the verdict was one on our reading of it.
void cite(std::string_view claim, Verdict& verdict, std::string& reason) {
  const PaperFinding* finding = find_paper_finding(claim);
  if (finding != nullptr && finding->kind == illegible) {
    const std::string reading = verdict == Verdict::refuted  ? "as we read it, it would be false: "
                                : verdict == Verdict::proved ? "as we read it, it would be true: "
                                                             : "";
    reason = "Illegible in the scan (" + std::string(finding->place) + "): " + reading + reason;
    verdict = Verdict::undecided;
    return;
  }
  if (finding == nullptr || verdict != Verdict::refuted) {
    return;
  }
  std::string words(to_string(finding->kind));
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  reason = words + " (" + std::string(finding->place) + "): " + reason;
}

}  // namespace

std::string_view to_string(FindingKind kind) {
  switch (kind) {
    case false_as_stated:
      return "false as stated";
    case slip_without_consequence:
      return "slip without consequence";
    case needs_unstated_assumption:
      return "needs an assumption that is not stated";
    case illegible:
      return "illegible";
  }
  return "";
}

const std::vector<PaperFinding>& paper_findings() {
  static const std::vector<PaperFinding> ledger{
#include "analysis/statements/paper_findings.def"
  };
  return ledger;
}

const PaperFinding* find_paper_finding(std::string_view claim) {
  const auto find = [](std::string_view wanted) -> const PaperFinding* {
    const auto& ledger = paper_findings();
    const auto found = std::find_if(ledger.begin(), ledger.end(),
                                    [&](const PaperFinding& finding) { return finding.claim == wanted; });
    return found == ledger.end() ? nullptr : &*found;
  };
  const PaperFinding* exact = find(claim);
  const std::size_t slash = claim.rfind('/');
  return exact != nullptr || slash == std::string_view::npos ? exact : find(claim.substr(0, slash));
}

void cite_findings(std::vector<Statement>& statements) {
  for (Statement& statement : statements) {
    cite(statement.id, statement.verdict, statement.witness);
  }
}

void cite_findings(Derivation& derivation) {
  for (Condition& condition : derivation.conditions) {
    cite(derivation.id + "/" + condition.id, condition.verdict, condition.reason);
  }
}

}  // namespace veritrack::theorems
