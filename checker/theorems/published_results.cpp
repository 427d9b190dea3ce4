#include "checker/theorems/published_results.hpp"

namespace veritrack::checker {

bool is_published_result(const std::string& id) {
  return model_results().count(id) != 0 || error_equation_results().count(id) != 0;
}

void check_published_result(const std::string& id, const Tree& derivation, const Design& design,
                            Objections& objections) {
  const auto& results = model_results().count(id) != 0 ? model_results() : error_equation_results();
  check_derivation(derivation, results.at(id)(design, derivation), objections);
}

}  // namespace veritrack::checker
