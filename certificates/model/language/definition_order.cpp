#include "certificates/model/language/definition_order.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "certificates/design/input_error.hpp"

namespace veritrack::certificates::language {

namespace {

constexpr std::size_t kShownNames = 60;

}  // namespace

std::vector<const Definition*> in_order(const std::vector<Definition>& definitions) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < definitions.size(); ++i) {
    if (!places.try_emplace(definitions[i].name, i).second) {
      throw LanguageError(definitions[i].position,
                          fmt::format("{} is defined a second time; allowed: one definition of each name",
                                      printable(definitions[i].name, kShownNames)));
    }
  }
  std::vector<std::set<std::size_t>> needs(definitions.size());
  std::vector<std::vector<std::size_t>> needed_by(definitions.size());
  std::set<std::size_t> ready;
  for (std::size_t i = 0; i < definitions.size(); ++i) {
    for_each_leaf(definitions[i].value, [&](const Expression& leaf) {
      const auto place = places.find(leaf.text);
      if (leaf.kind == Expression::Kind::name && place != places.end() &&
          needs[i].insert(place->second).second) {
        needed_by[place->second].push_back(i);
      }
    });
    if (needs[i].empty()) {
      ready.insert(i);
    }
  }
  std::vector<const Definition*> ordered;
  while (!ready.empty()) {
    const std::size_t next = *ready.begin();
    ready.erase(ready.begin());
    ordered.push_back(&definitions[next]);
    for (const std::size_t user : needed_by[next]) {
      needs[user].erase(next);
      if (needs[user].empty()) {
        ready.insert(user);
      }
    }
  }
  if (ordered.size() == definitions.size()) {
    return ordered;
  }
  // The definitions needed by any remaining definition lead into the circle.
  std::size_t at = 0;
  while (needs[at].empty()) {
    ++at;
  }
  std::vector<std::size_t> path;
  while (std::find(path.begin(), path.end(), at) == path.end()) {
    path.push_back(at);
    at = *needs[at].begin();
  }
  path.erase(path.begin(), std::find(path.begin(), path.end(), at));
  std::vector<std::string> names;
  names.reserve(path.size() + 1);
  for (const std::size_t place : path) {
    names.push_back(definitions[place].name);
  }
  names.push_back(definitions[at].name);
  throw LanguageError(
      definitions[at].position,
      fmt::format("a circle of definitions: {}; allowed: formulas that end at states, samples and "
                  "parameters",
                  printable(fmt::format("{}", fmt::join(names, " needs ")), 4 * kShownNames)));
}

}  // namespace veritrack::certificates::language
