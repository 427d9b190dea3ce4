// What the keys of a design file and the claims of a certificate mean.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace veritrack::certificates {

/// What one key or claim means.
struct Explanation {
  std::string name;                   ///< "design.q1" or "ekf/guarantee"
  std::vector<std::string> trackers;  ///< whose key it is; empty for a claim
  /// What is said of it, each under a heading such as "Unit".
  std::vector<std::pair<std::string, std::string>> parts;
};

/// Everything that is explained: the keys of all trackers in the order of their tables, then the claims. A
/// key with the same meaning for several trackers stands there once. Throws std::logic_error when a key has
/// no explanation.
[[nodiscard]] const std::vector<Explanation>& explanations();

/// What the word may mean: a claim's id, a key with its table ("design.q1") or without ("q1"), or a table
/// ("assume"), then all its keys. Empty when it means nothing.
[[nodiscard]] std::vector<Explanation> explain(std::string_view word);

/// The word that is explained and is most like this one.
[[nodiscard]] std::string nearest_explained(std::string_view word);

/// What is explained in words of which this is one, in small letters or capitals: some names, the first ones.
[[nodiscard]] std::vector<std::string> explanations_with(std::string_view word);

}  // namespace veritrack::certificates
