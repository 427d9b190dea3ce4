#include "checker/document/parts.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace veritrack::checker {

namespace {

/// "proved", "refuted", "undecided", or "nothing-required".
std::string verdict_together(const std::vector<Requirement>& requirements) {
  std::vector<Verdict> verdicts;
  verdicts.reserve(requirements.size());
  for (const Requirement& requirement : requirements) {
    verdicts.push_back(requirement.verdict);
  }
  const Verdict together = all_of(verdicts);
  return requirements.empty()           ? "nothing-required"
         : together == Verdict::proved  ? "proved"
         : together == Verdict::refuted ? "refuted"
                                        : "undecided";
}

}  // namespace

bool Verification::verified() const {
  constexpr std::size_t kFrame = 3;  // the design, the verdict, and that all is read
  return parts.size() > kFrame &&
         std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.objections.empty(); });
}

void check_claims(const Tree& certificate, std::vector<Requirement> asked,
                  const std::function<Claim(const Tree& claim, Objections& objections)>& check,
                  Verification& result) {
  std::set<std::string> seen;
  for (const Tree& claim : certificate.at("claims").elements()) {
    const std::string& id = claim.at("id").text();
    Objections objections;
    if (!seen.insert(id).second) {
      objections.emplace_back("a second claim of this id");
    }
    const Claim found = check(claim, objections);
    const auto requirement = std::find_if(asked.begin(), asked.end(),
                                          [&](const Requirement& one_of) { return one_of.claim == id; });
    if (claim.at("required").truth() != (requirement != asked.end())) {
      objections.emplace_back("whether it is required is not as the design's [require] says");
    }
    if (objections.empty()) {
      result.sentences.push_back(
          {id, found.verdict, found.statement, found.is_summary, found.hypotheses, found.finding});
      if (requirement != asked.end()) {
        requirement->verdict = found.verdict;
      }
    }
    result.parts.push_back({"claim " + id, objections});
  }
  result.requirements = std::move(asked);
  const std::string found = verdict_together(result.requirements);
  const std::string& verdict = certificate.at("verdict").text();
  Objections objections;
  if (verdict != found) {
    objections.push_back("the verdict is claimed to be " + verdict.substr(0, 60) + " and was found to be " +
                         found);
  }
  result.requirements_proved = found == "proved";
  result.parts.push_back({"verdict " + found, objections});
}

}  // namespace veritrack::checker
