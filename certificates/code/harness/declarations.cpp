#include "certificates/code/harness/declarations.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "certificates/code/harness/constants.hpp"
#include "certificates/code/harness/function_body.hpp"
#include "certificates/code/harness/tree_nodes.hpp"
#include "certificates/code/harness/types.hpp"

namespace veritrack::certificates::code {

namespace {

using nlohmann::json;

constexpr int kMostNested = 32;

std::string place_suffix(const DeclarationPlace& place) {
  return ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ")";
}

/// clang names a structure without a name by its place, in a type that a user cannot write.
std::string unnamed(const DeclarationPlace& place) {
  return "(unnamed at" + place_suffix(place);
}

class DeclarationReader {
 public:
  void read(const json& node, const std::string& scope, int depth) {
    if (depth > kMostNested || node.value("isImplicit", false)) {
      return;
    }
    const std::string kind = node.value("kind", "");
    if (kind == "FunctionDecl") {
      add_function(node, scope, "", false);
    } else if ((kind == "CXXMethodDecl" || kind == "CXXConstructorDecl") &&
               node.contains("parentDeclContextId")) {
      add_outside_its_class(node);
    } else if (kind == "VarDecl") {
      result_.variables.push_back(variable(node, scope));
    } else if (kind == "RecordDecl" || kind == "CXXRecordDecl") {
      add_record(node, scope, depth, false);
    } else if (kind == "TypedefDecl" || kind == "TypeAliasDecl") {
      add_alias(node, scope);
    } else if (kind == "NamespaceDecl" || kind == "LinkageSpecDecl") {
      const std::string name = node.value("name", "");
      read_all(node, name.empty() ? scope : scope + name + "::", depth);
    } else if (kind == "ClassTemplateDecl" || kind == "FunctionTemplateDecl") {
      add_template(node, scope, depth);
    }
  }

  Declarations take() {
    // clang gives a method of an instance a body where something uses it; the template has one.
    for (Function& function : result_.functions) {
      for (const Function& pattern : result_.functions) {
        const bool is_its_own =
            pattern.is_template && pattern.has_body && pattern.place.file == function.place.file &&
            pattern.place.line == function.place.line && pattern.place.column == function.place.column;
        if (is_its_own && !function.is_template && !function.has_body) {
          copy_body(pattern, function);
        }
      }
    }
    return std::move(result_);
  }

 private:
  static void copy_body(const Function& from, Function& to) {
    to.has_body = true;
    to.writes = from.writes;
    to.written_members = from.written_members;
    to.assigned = from.assigned;
    to.products = from.products;
    to.calls = from.calls;
    to.uses = from.uses;
  }

  void read_all(const json& node, const std::string& scope, int depth) {
    if (const auto inner = node.find("inner"); inner != node.end()) {
      for (const json& each : *inner) {
        read(each, scope, depth + 1);
      }
    }
  }

  static Variable variable(const json& node, const std::string& scope) {
    Variable result{scope + node.value("name", ""), type_of_node(node), place_of_node(node), {}, {}};
    const auto inner = node.find("inner");
    if (inner == node.end() || inner->empty()) {
      return result;
    }
    const json& initial = inner->back();
    if (is_number_type(result.type)) {
      result.value = constant_value(initial);
    }
    if (initial.value("kind", "") == "InitListExpr" && initial.contains("inner")) {
      for (const json& each : initial.at("inner")) {
        result.values.push_back(constant_value(each));
      }
    }
    return result;
  }

  Function& add_function(const json& node, const std::string& scope, const std::string& owner,
                         bool is_template) {
    Function function;
    function.name = scope + node.value("name", "");
    function.owner = owner;
    const std::string type = type_of_node(node);
    function.result = type.substr(0, type.find(" ("));
    function.is_const = type.find(") const") != std::string::npos;
    function.place = place_of_node(node);
    function.is_static = node.value("storageClass", "") == "static";
    function.is_constructor = node.value("kind", "") == "CXXConstructorDecl";
    function.is_template = is_template;
    for (const json& each : node.value("inner", json::array())) {
      const std::string kind = each.value("kind", "");
      if (kind == "ParmVarDecl") {
        function.parameters.push_back(
            {each.value("name", ""), type_of_node(each), place_of_node(each), {}, {}});
      } else if (kind == "CompoundStmt") {
        function.has_body = true;
        read_body(each, function);
      }
    }
    if (function.is_const) {
      function.writes.erase("this");  // what it calls on its object is const, too
    }
    result_.functions.push_back(std::move(function));
    return result_.functions.back();
  }

  void add_outside_its_class(const json& node) {
    const auto found = owners_.find(node.value("parentDeclContextId", ""));
    if (found != owners_.end()) {
      add_function(node, "", found->second, false);
    }
  }

  void add_record(const json& node, const std::string& scope, int depth, bool is_template) {
    Record record;
    record.place = place_of_node(node);
    const std::string own_name = node.value("name", "");
    record.name = own_name.empty() ? unnamed(record.place) : scope + own_name + arguments_of(node);
    owners_[node.value("id", "")] = record.name;
    if (!node.value("completeDefinition", false)) {
      return;
    }
    for (const json& each : node.value("inner", json::array())) {
      const std::string kind = each.value("kind", "");
      if (each.value("isImplicit", false)) {
        continue;
      }
      if (kind == "FieldDecl") {
        record.members.push_back(variable(each, ""));
      } else if (kind == "CXXMethodDecl" || kind == "CXXConstructorDecl") {
        add_function(each, "", record.name, is_template);
      } else {
        read(each, own_name.empty() ? scope : record.name + "::", depth + 1);
      }
    }
    if (!is_template) {
      result_.records.push_back(std::move(record));
    }
  }

  /// <float, 2> of an instance.
  static std::string arguments_of(const json& node) {
    std::string text;
    for (const json& each : node.value("inner", json::array())) {
      if (each.value("kind", "") == "TemplateArgument") {
        text += text.empty() ? "<" : ", ";
        text += each.contains("value") ? each.at("value").dump() : type_of_node(each);
      }
    }
    return text.empty() ? text : text + ">";
  }

  void add_template(const json& node, const std::string& scope, int depth) {
    for (const json& each : node.value("inner", json::array())) {
      const std::string kind = each.value("kind", "");
      if (kind == "CXXRecordDecl") {
        add_record(each, scope, depth, true);
      } else if (kind == "ClassTemplateSpecializationDecl") {
        add_record(each, scope, depth, false);
      } else if (kind == "FunctionDecl") {
        add_function(each, scope, "", each.value("mangledName", "").empty());
      }
    }
  }

  void add_alias(const json& node, const std::string& scope) {
    const std::string name = scope + node.value("name", "");
    // typedef struct { ... } name;
    const json inner = node.value("inner", json::array());
    if (!inner.empty() && inner.front().contains("ownedTagDecl") &&
        inner.front().at("ownedTagDecl").value("name", "").empty()) {
      const auto found = owners_.find(inner.front().at("ownedTagDecl").value("id", ""));
      for (Record& record : result_.records) {
        if (found != owners_.end() && record.name == found->second) {
          record.name = name;
          found->second = name;
          return;
        }
      }
    }
    result_.aliases[name] = type_of_node(node);
  }

  Declarations result_;
  std::map<std::string, std::string> owners_;  // names of records, by clang's ids
};

}  // namespace

const Record* Declarations::record_of(const std::string& type) const {
  std::string name = bare_type(type);
  // "(unnamed struct at file.c:8:8)"
  const std::size_t column = name.rfind(':');
  if (const std::size_t line = column == std::string::npos ? column : name.rfind(':', column - 1);
      name.find("(unnamed") != std::string::npos && line != std::string::npos) {
    name = "(unnamed at" + name.substr(line);
  }
  constexpr int kMostAliases = 8;
  for (int hops = 0; hops < kMostAliases; ++hops) {
    for (const Record& record : records) {
      if (record.name == name) {
        return &record;
      }
    }
    const auto alias = aliases.find(name);
    if (alias == aliases.end() || bare_type(alias->second) == name) {
      return nullptr;
    }
    name = bare_type(alias->second);
  }
  return nullptr;
}

Declarations declarations_in(const std::vector<json>& tree) {
  DeclarationReader reader;
  for (const json& each : tree) {
    reader.read(each, "", 0);
  }
  return reader.take();
}

}  // namespace veritrack::certificates::code
