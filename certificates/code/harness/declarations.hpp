// What a file of C or C++ declares, as far as a harness needs it: functions, structures, variables.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace veritrack::certificates::code {

/// Where something is declared; `file` as clang names it.
struct DeclarationPlace {
  std::string file;
  int line = 0;
  int column = 0;
};

/// A parameter, a member, or a variable outside functions.
struct Variable {
  std::string name;
  std::string type;  ///< as clang spells it, without the names of typedefs where it knows better
  DeclarationPlace place;
  std::optional<double> value;                ///< its initializer, where that is a constant
  std::vector<std::optional<double>> values;  ///< the same for a list in braces
};

struct Function {
  std::string name;   ///< with its namespaces, without its class
  std::string owner;  ///< the class of a method, with its namespaces and arguments; empty for others
  std::string result;
  std::vector<Variable> parameters;
  DeclarationPlace place;
  bool is_static = false;  ///< without an object, of a class; not seen by other files, otherwise
  bool is_const = false;
  bool is_constructor = false;
  bool is_template = false;  ///< a pattern: clang knows types only where it is used
  bool has_body = false;
  /// What it assigns to: parameters, "this", and variables outside functions, by their names.
  std::set<std::string> writes;
  std::set<std::string> written_members;   ///< the last name of an assignment to a member
  std::map<std::string, double> assigned;  ///< members and variables to which it assigns a constant
  /// Names that occur in the two factors of a product, or a quotient; a turn, 6.28, is "2pi".
  std::set<std::pair<std::string, std::string>> products;
  std::set<std::string> calls;  ///< the names of functions it calls
  std::set<std::string> uses;   ///< the names of variables outside functions in its body

  /// `Loop<float>::feed`, or the name.
  [[nodiscard]] std::string full_name() const { return owner.empty() ? name : owner + "::" + name; }
};

struct Record {
  std::string name;  ///< with namespaces and arguments; of a typedef where it has none of its own
  std::vector<Variable> members;
  DeclarationPlace place;
};

struct Declarations {
  std::vector<Function> functions;  ///< once for each declaration
  std::vector<Record> records;
  std::vector<Variable> variables;             ///< outside functions
  std::map<std::string, std::string> aliases;  ///< of types

  /// The structure that is meant by a type, a pointer or a reference to it, const or not; nullptr: none.
  [[nodiscard]] const Record* record_of(const std::string& type) const;
};

/// Of the declarations that syntax_tree.hpp makes.
[[nodiscard]] Declarations declarations_in(const std::vector<nlohmann::json>& tree);

}  // namespace veritrack::certificates::code
