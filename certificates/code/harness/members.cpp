#include "certificates/code/harness/members.hpp"

#include <cstddef>

#include "certificates/code/harness/types.hpp"

namespace veritrack::certificates::code {

namespace {

constexpr int kDeepest = 3;

std::optional<double> assigned_value(const Declarations& declarations, const std::string& name) {
  for (const Function& function : declarations.functions) {
    const auto found = function.assigned.find(name);
    if (found != function.assigned.end() && function.written_members.count(name) == 0) {
      return found->second;
    }
  }
  return std::nullopt;
}

class MemberList {
 public:
  explicit MemberList(const Declarations& declarations) : declarations_(declarations) {}

  void add(const Variable& variable, const std::string& expression, std::optional<double> value, int depth) {
    if (is_number_type(variable.type)) {
      value = value ? value : variable.value ? variable.value : assigned_value(declarations_, variable.name);
      result_.push_back({expression, variable.name, variable.type, variable.place, value, depth});
      return;
    }
    const bool points = is_pointer(variable.type);
    const Record* record = declarations_.record_of(variable.type);
    if (record == nullptr || depth >= kDeepest) {
      return;
    }
    // A structure that is pointed to is likely the only variable of its type.
    const Variable* pointed = points ? object_in_file(declarations_, variable.type) : nullptr;
    const std::vector<std::optional<double>>& values = pointed != nullptr ? pointed->values : variable.values;
    for (std::size_t i = 0; i < record->members.size(); ++i) {
      const Variable& member = record->members[i];
      add(member, expression + (points ? "->" : ".") + member.name,
          i < values.size() ? values[i] : std::optional<double>(), depth + 1);
    }
  }

  std::vector<Member> take() { return std::move(result_); }

 private:
  const Declarations& declarations_;
  std::vector<Member> result_;
};

}  // namespace

std::vector<Member> members_of(const Declarations& declarations, const std::string& object,
                               const std::string& object_type, const std::string& file) {
  MemberList list(declarations);
  if (!object.empty()) {
    Variable root{object, object_type, {}, {}, {}};
    for (const Variable& variable : declarations.variables) {
      root = variable.name == object ? variable : root;
    }
    list.add(root, object, std::nullopt, 0);
  }
  for (const Variable& variable : declarations.variables) {
    if (variable.name != object && variable.place.file == file) {
      list.add(variable, variable.name, std::nullopt, 0);
    }
  }
  return list.take();
}

}  // namespace veritrack::certificates::code
