#include "certificates/code/harness/function_body.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "certificates/code/harness/constants.hpp"
#include "certificates/code/harness/types.hpp"

namespace veritrack::certificates::code {

namespace {

using nlohmann::json;

constexpr int kMostNesting = 400;

std::string kind_of_node(const json& node) {
  return node.is_object() ? node.value("kind", "") : std::string();
}

/// What an expression begins with: a parameter, a variable, or "this"; and the last member on the way.
struct Root {
  std::string name;
  std::string member;
  bool is_parameter = false;
  bool is_local = false;
  std::string type;
};

class BodyReader {
 public:
  explicit BodyReader(Function& function) : function_(function) {}

  void find_locals(const json& node, int depth) {
    if (!node.is_object() || depth > kMostNesting) {
      return;
    }
    if (kind_of_node(node) == "VarDecl") {
      locals_.insert(node.value("id", ""));
    }
    if (const auto inner = node.find("inner"); inner != node.end()) {
      for (const json& each : *inner) {
        find_locals(each, depth + 1);
      }
    }
  }

  void read(const json& node, int depth) {
    if (!node.is_object() || depth > kMostNesting) {
      return;
    }
    const std::string kind = kind_of_node(node);
    if (kind == "VarDecl") {
      read_local(node);
    } else if (kind == "DeclRefExpr") {
      read_reference(node);
    } else if (kind == "BinaryOperator" || kind == "CompoundAssignOperator" || kind == "UnaryOperator") {
      read_operator(node, kind);
      read_product(node);
    } else if (kind == "CallExpr" || kind == "CXXMemberCallExpr" || kind == "CXXOperatorCallExpr") {
      read_call(node, kind);
    }
    if (const auto inner = node.find("inner"); inner != node.end()) {
      for (const json& each : *inner) {
        read(each, depth + 1);
      }
    }
  }

 private:
  void read_local(const json& node) {
    if (node.value("storageClass", "") == "static") {
      static_locals_.insert(node.value("id", ""));
      return;
    }
    // struct sogi* s = &grid;
    const std::string type = node.value("/type/qualType"_json_pointer, "");
    const auto inner = node.find("inner");
    if (inner != node.end() && !inner->empty() && is_writable(type)) {
      const std::optional<Root> root = root_of(inner->back());
      if (root && !root->is_local) {
        stands_for_[node.value("id", "")] = *root;
      }
    }
  }

  void read_reference(const json& node) {
    const json& declaration = node.at("referencedDecl");
    const std::string id = declaration.value("id", "");
    if (declaration.value("kind", "") == "VarDecl" && locals_.count(id) == 0) {
      function_.uses.insert(declaration.value("name", ""));
    }
  }

  void read_operator(const json& node, const std::string& kind) {
    const std::string operation = node.value("opcode", "");
    const bool assigns = kind == "CompoundAssignOperator" || (kind == "BinaryOperator" && operation == "=") ||
                         (kind == "UnaryOperator" && (operation == "++" || operation == "--"));
    if (!assigns) {
      return;
    }
    const json& inner = node.at("inner");
    const std::optional<Root> root = root_of(inner.front());
    if (!root || root->is_local) {
      return;
    }
    if (root->is_parameter && root->member.empty() && !is_pointer(root->type) && !is_reference(root->type)) {
      return;  // its own copy
    }
    function_.writes.insert(root->name);
    const std::string target = root->member.empty() ? root->name : root->member;
    if (kind == "BinaryOperator") {
      if (const std::optional<double> value = constant_value(inner.back())) {
        function_.assigned[target] = *value;
        return;  // a start or a limit, not what a loop computes
      }
    }
    function_.written_members.insert(target);
  }

  void read_product(const json& node) {
    const std::string operation = node.value("opcode", "");
    if (!operation.starts_with("*") && !operation.starts_with("/")) {
      return;
    }
    const json& inner = node.at("inner");
    std::set<std::string> first, second;
    names_in(inner.front(), first, 0);
    names_in(inner.back(), second, 0);
    for (const std::string& a : first) {
      for (const std::string& b : second) {
        function_.products.insert({a, b});
        function_.products.insert({b, a});
      }
    }
  }

  static void names_in(const json& node, std::set<std::string>& names, int depth) {
    constexpr double kTurn = 6.28318;
    constexpr double kClose = 1e-3;
    if (!node.is_object() || depth > kMostNesting) {
      return;
    }
    if (const std::optional<double> value = constant_value(node)) {
      if (std::fabs(*value - kTurn) < kClose) {
        names.insert("2pi");
      }
      return;
    }
    const std::string kind = kind_of_node(node);
    if (kind == "MemberExpr") {
      names.insert(node.value("name", ""));
    } else if (kind == "DeclRefExpr") {
      names.insert(node.at("referencedDecl").value("name", ""));
    }
    for (const json& each : node.value("inner", json::array())) {
      names_in(each, names, depth + 1);
    }
  }

  void read_call(const json& node, const std::string& kind) {
    const json& inner = node.at("inner");
    const std::optional<Root> called = root_of(inner.front());
    if (called) {
      function_.calls.insert(called->member.empty() ? called->name : called->member);
    }
    for (std::size_t i = 0; i < inner.size(); ++i) {
      const std::optional<Root> root = root_of(inner[i]);
      if (!root || root->is_local) {
        continue;
      }
      const bool is_object = kind == "CXXMemberCallExpr" && i == 0;
      const bool is_operand = kind == "CXXOperatorCallExpr" && i == 1;
      const std::string type = inner[i].value("/type/qualType"_json_pointer, "");
      if (is_object || is_operand || (i > 0 && is_writable(type))) {
        function_.writes.insert(root->name);
      }
    }
  }

  std::optional<Root> root_of(const json& expression) const {
    const json* at = &expression;
    std::string member;
    for (int i = 0; i < kMostNesting && at->is_object(); ++i) {
      const std::string kind = kind_of_node(*at);
      if (kind == "CXXThisExpr") {
        return Root{"this", member, false, false, ""};
      }
      if (kind == "DeclRefExpr") {
        const json& declaration = at->at("referencedDecl");
        return root_named(declaration, std::move(member));
      }
      if (kind == "MemberExpr" && member.empty()) {
        member = at->value("name", "");
      }
      const auto inner = at->find("inner");
      if (inner == at->end() || inner->empty()) {
        return std::nullopt;
      }
      at = &inner->front();
    }
    return std::nullopt;
  }

  Root root_named(const json& declaration, std::string member) const {
    const std::string id = declaration.value("id", "");
    if (const auto found = stands_for_.find(id); found != stands_for_.end()) {
      Root root = found->second;
      root.member = member.empty() ? root.member : member;
      return root;
    }
    const std::string kind = declaration.value("kind", "");
    const std::string name = declaration.value("name", "");
    return Root{name, std::move(member), kind == "ParmVarDecl",
                kind == "VarDecl" && locals_.count(id) != 0 && static_locals_.count(id) == 0,
                declaration.value("/type/qualType"_json_pointer, "")};
  }

  Function& function_;
  std::set<std::string> locals_, static_locals_;
  std::map<std::string, Root> stands_for_;
};

}  // namespace

void read_body(const json& body, Function& function) {
  BodyReader reader(function);
  reader.find_locals(body, 0);
  reader.read(body, 0);
}

}  // namespace veritrack::certificates::code
