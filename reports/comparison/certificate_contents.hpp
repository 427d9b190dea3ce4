// What certificate.json says, as far as two of them are compared.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace veritrack::reports {

/// What is proved of a value from one side.
struct Bound {
  double value = 0.0;
  bool is_upper = true;      ///< then less is better
  std::string decimal = {};  ///< as the claim has it; empty where it has the number itself
};

/// What is said under one id: once, or for each part of a band, of which the worst counts.
struct Said {
  std::string verdict;
  bool is_required = false;
  std::map<std::string, Bound> bounds = {};  ///< where it is PROVED, by name

  /// Whether it is about the design itself, and not about what somebody has published. A false lock is no
  /// guarantee.
  [[nodiscard]] bool is_guaranteed(const std::string& id) const;
};

/// What two certificates may differ in.
struct CertificateContents {
  nlohmann::ordered_json json;
  std::map<std::string, Said> claims;  ///< by id
  std::string verdict;
};

/// 0 to 2, REFUTED to PROVED. A verdict that is not in a certificate is none, as "undecided" is.
[[nodiscard]] int rank(const std::string& verdict);

/// Throws std::invalid_argument, which says what is wrong, for a text that is no certificate.json.
[[nodiscard]] CertificateContents contents_of(const std::string& text);

}  // namespace veritrack::reports
