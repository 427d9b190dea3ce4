// Explanations of the keys of a design file and the claims of a certificate.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace veritrack::certificates {

/// The explanation of one key or claim.
struct Explanation {
  std::string name;                   ///< "design.q1" or "ekf/guarantee"
  std::vector<std::string> trackers;  ///< whose key it is; empty for a claim
  /// The texts on it, each under a heading such as "Unit".
  std::vector<std::pair<std::string, std::string>> parts;
};

/// Everything that is explained: the keys of all trackers in the order of their tables, then the claims. A
/// key with the same meaning for several trackers stands there once. Throws std::logic_error when a key has
/// no explanation.
[[nodiscard]] const std::vector<Explanation>& explanations();

/// The possible meanings of the word: a claim's id, a key with its table ("design.q1") or without ("q1"), or
/// a table ("assume"), then all its keys. Empty when it has none.
[[nodiscard]] std::vector<Explanation> explain(std::string_view word);

/// The explained word that is most like this one.
[[nodiscard]] std::string nearest_explained(std::string_view word);

/// Explanations whose text contains this word, in small letters or capitals: the first few names.
[[nodiscard]] std::vector<std::string> explanations_with(std::string_view word);

}  // namespace veritrack::certificates
