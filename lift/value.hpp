// What a register of LLVM, or a cell of memory, holds while a function is executed with symbols.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "trackers/code/listing.hpp"

namespace llvm {
class Function;
}  // namespace llvm

namespace veritrack::lift {

/// The function cannot become a listing, and why; the place is that of the user's source, where it is known.
class LiftError : public std::runtime_error {
 public:
  explicit LiftError(const std::string& text) : std::runtime_error(text) {}
};

struct Undefined {
  friend bool operator==(const Undefined&, const Undefined&) = default;
};
/// A register of the listing.
struct Register {
  int number = -1;
  friend bool operator==(const Register&, const Register&) = default;
};
/// A place in memory; with an `index`, one of places that are `stride` bytes from each other.
struct Address {
  int object = -1;  ///< -1: the null pointer
  std::int64_t offset = 0;
  int index = -1;
  std::int64_t stride = 0;
  friend bool operator==(const Address&, const Address&) = default;
};
struct FunctionAddress {
  const llvm::Function* function = nullptr;
  friend bool operator==(const FunctionAddress&, const FunctionAddress&) = default;
};

struct Value;

/// One of two addresses.
struct Choice {
  int condition = -1;
  std::shared_ptr<const Value> yes, no;
  friend bool operator==(const Choice& a, const Choice& b);
};
/// A structure, an array or a vector in a register.
struct Parts {
  std::vector<Value> parts;
  friend bool operator==(const Parts& a, const Parts& b);
};

struct Value {
  std::variant<Undefined, Register, Address, FunctionAddress, Choice, Parts> of;

  Value() = default;
  template <typename Held>
  Value(Held held) : of(std::move(held)) {}  // NOLINT(google-explicit-constructor): it is one of these

  [[nodiscard]] bool is_undefined() const { return std::holds_alternative<Undefined>(of); }
  template <typename Held>
  [[nodiscard]] const Held* as() const {
    return std::get_if<Held>(&of);
  }
  friend bool operator==(const Value& a, const Value& b) { return a.of == b.of; }
};

inline bool operator==(const Choice& a, const Choice& b) {
  return a.condition == b.condition && *a.yes == *b.yes && *a.no == *b.no;
}
inline bool operator==(const Parts& a, const Parts& b) {
  return a.parts == b.parts;
}

}  // namespace veritrack::lift
