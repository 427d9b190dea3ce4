#include "checker/document/evidence.hpp"

#include <algorithm>

namespace veritrack::checker {

const Tree* find_evidence(const Tree& derivation, const std::string& name) {
  const Tree* evidence = derivation.find("evidence");
  if (evidence == nullptr) {
    return nullptr;
  }
  const auto& items = evidence->elements();
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Tree& item) { return item.at("name").is(name); });
  return found == items.end() ? nullptr : &*found;
}

Ball exact_number(const Tree& number) {
  return from_hexadecimal(number.text());
}

Ball low_of(const Tree& enclosure) {
  return exact_number(enclosure.at("lo"));
}

Ball high_of(const Tree& enclosure) {
  return exact_number(enclosure.at("hi"));
}

Matrix3 exact_matrix(const Tree& rows) {
  Matrix3 m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      m[i][j] = exact_number(rows.at(i).at(j));
    }
  }
  return m;
}

}  // namespace veritrack::checker
