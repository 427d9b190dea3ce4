// The contents of certificate.json that comparisons need.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace veritrack::reports {

/// A proved one-sided bound.
struct Bound {
  double value = 0.0;
  bool is_upper = true;      ///< then less is better
  std::string decimal = {};  ///< as the claim has it; empty where it has the number itself
};

/// The statements under one id: one, or one for each part of a band, the worst of which counts.
struct Said {
  std::string verdict;
  bool is_required = false;
  std::map<std::string, Bound> bounds = {};  ///< where it is PROVED, by name

  /// Whether it is about the design itself, not about a publication. A false lock does not count as a
  /// guarantee.
  [[nodiscard]] bool is_guaranteed(const std::string& id) const;
};

/// The things in which two certificates may differ.
struct CertificateContents {
  nlohmann::ordered_json json;
  std::map<std::string, Said> claims;  ///< by id
  std::string verdict;
};

/// 0 to 2, REFUTED to PROVED. A missing verdict counts as "undecided".
[[nodiscard]] int rank(const std::string& verdict);

/// Throws std::invalid_argument, which names the error, for a text that is not a certificate.json.
[[nodiscard]] CertificateContents contents_of(const std::string& text);

}  // namespace veritrack::reports
