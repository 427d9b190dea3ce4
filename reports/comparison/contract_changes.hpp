// Two designs compared as contracts: requirements and assumptions, key by key.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace veritrack::reports {

/// A key whose values differ.
struct ContractChange {
  enum class Kind {
    weaker,    ///< asks for less, covers less, or cannot be compared for certain
    stronger,  ///< asks for more, or covers more
    chosen     ///< no part of the contract
  };
  Kind kind = Kind::weaker;
  std::string key;   ///< with its table: "assume.noise"
  std::string what;  ///< the effect: "covers less"; empty for the engineer's choices
  std::string text;  ///< one line: the key, both values, and what became of it
};

/// The changes from one certificate.json to another, in the order of the keys there. The certificate of a
/// regulator's frequency tracker inside another one is compared with it, its keys prefixed with
/// "design.frequency_tracker.". Throws nlohmann::json::exception for a text that is not a certificate. Needs
/// the upward rounding mode.
[[nodiscard]] std::vector<ContractChange> contract_changes(const nlohmann::ordered_json& before,
                                                           const nlohmann::ordered_json& after);

}  // namespace veritrack::reports
