// Names of a model as identifiers of a programming language.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "certificates/document/code_language.hpp"

namespace veritrack::certificates {

/// Identifiers for the names of a model, each different: `alpha'` becomes alpha_next, `P.x.y` P_x_y.
class Identifiers {
 public:
  explicit Identifiers(CodeLanguage language) : language_(language) {}

  [[nodiscard]] std::string of(const std::string& name);
  [[nodiscard]] std::vector<std::string> of(const std::vector<std::string>& names);

 private:
  CodeLanguage language_;
  std::map<std::string, std::string> known_;
  std::set<std::string> used_;
};

}  // namespace veritrack::certificates
