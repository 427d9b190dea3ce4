#include "certificates/model/identifiers.hpp"

#include <algorithm>
#include <string_view>

namespace veritrack::certificates {

namespace {

/// Names that some language keeps for itself, or that the code around the formulas uses, each between spaces.
constexpr std::string_view kTakenNames =
    " auto break case char const continue default do double else enum extern float for goto if int "
    "long register return short signed sizeof static struct switch typedef union unsigned void "
    "volatile while inline restrict and as assert async await class def del elif except finally from "
    "global import in is lambda nonlocal not or pass raise try with yield None True False end endif "
    "function endfunction math state sample next power state_next amplitude frequency tracker_step "
    "tracker_frequency tracker_start minimum maximum absolute sign_of clamped chosen j0 j1 jn y0 y1 yn "
    "gamma ";

bool is_taken(const std::string& name) {
  return kTakenNames.find(" " + name + " ") != std::string_view::npos;
}

}  // namespace

std::string Identifiers::of(const std::string& name) {
  if (language_ == CodeLanguage::formulas) {
    return name;
  }
  const auto known = known_.find(name);
  if (known != known_.end()) {
    return known->second;
  }
  std::string identifier = name;
  std::replace(identifier.begin(), identifier.end(), '.', '_');
  if (identifier.back() == '\'') {
    identifier.replace(identifier.size() - 1, 1, "_next");
  }
  while (is_taken(identifier) || !used_.insert(identifier).second) {
    identifier += "_";
  }
  known_[name] = identifier;
  return identifier;
}

std::vector<std::string> Identifiers::of(const std::vector<std::string>& names) {
  std::vector<std::string> identifiers;
  identifiers.reserve(names.size());
  for (const std::string& name : names) {
    identifiers.push_back(of(name));
  }
  return identifiers;
}

}  // namespace veritrack::certificates
