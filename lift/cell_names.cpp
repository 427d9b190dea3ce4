#include "lift/cell_names.hpp"

#include <llvm/ADT/SmallVector.h>
#include <llvm/IR/DebugInfoMetadata.h>

namespace veritrack::lift {

namespace {

/// The type without the names that it has been given, and without const and volatile.
const llvm::DIType* plain_type(const llvm::DIType* type) {
  while (const auto* derived = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type)) {
    if (derived->getTag() == llvm::dwarf::DW_TAG_pointer_type) {
      break;
    }
    type = derived->getBaseType();
  }
  return type;
}

std::string element_name(const llvm::DICompositeType& array, std::int64_t bits, std::string name);

/// The name of the part of a type at an offset, behind `name`.
std::string part_name(const llvm::DIType* of, std::int64_t bits, std::string name) {
  const auto* type = llvm::dyn_cast_or_null<llvm::DICompositeType>(plain_type(of));
  if (type == nullptr) {
    return bits == 0 ? name : name + "_" + std::to_string(bits / 8);  // e.g. of a complex number
  }
  if (type->getTag() == llvm::dwarf::DW_TAG_array_type) {
    return element_name(*type, bits, std::move(name));
  }
  for (const llvm::Metadata* element : type->getElements()) {
    const auto* member = llvm::dyn_cast<llvm::DIDerivedType>(element);
    if (member == nullptr || member->isStaticMember()) {
      continue;
    }
    const auto begin = static_cast<std::int64_t>(member->getOffsetInBits());
    const auto size = static_cast<std::int64_t>(member->getSizeInBits());
    if (bits >= begin && bits < begin + size) {
      const bool is_base = member->getTag() == llvm::dwarf::DW_TAG_inheritance;
      return part_name(member->getBaseType(), bits - begin,
                       is_base ? name : name + "." + member->getName().str());
    }
  }
  return name;
}

std::string element_name(const llvm::DICompositeType& array, std::int64_t bits, std::string name) {
  const llvm::DIType* element = plain_type(array.getBaseType());
  if (element == nullptr || element->getSizeInBits() == 0) {
    return name;
  }
  const auto size = static_cast<std::int64_t>(element->getSizeInBits());
  name += "_" + std::to_string(bits / size);
  return part_name(element, bits % size, std::move(name));
}

}  // namespace

std::string cell_name(const Object& object, std::int64_t offset) {
  if (object.global != nullptr) {
    llvm::SmallVector<llvm::DIGlobalVariableExpression*, 1> known;
    object.global->getDebugInfo(known);
    if (!known.empty()) {
      const llvm::DIGlobalVariable* variable = known.front()->getVariable();
      std::int64_t bits = 8 * offset;
      if (const auto fragment = known.front()->getExpression()->getFragmentInfo()) {
        bits += static_cast<std::int64_t>(fragment->OffsetInBits);
      }
      return part_name(variable->getType(), bits, variable->getName().str());
    }
  }
  std::string name = object.name;
  for (char& letter : name) {
    const bool is_allowed = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                            (letter >= '0' && letter <= '9') || letter == '_';
    letter = is_allowed ? letter : '_';
  }
  return name + "_" + std::to_string(offset);
}

}  // namespace veritrack::lift
