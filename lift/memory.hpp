// The memory of a program that is executed with symbols: objects, and cells in them at known offsets.
#pragma once

#include <llvm/IR/DataLayout.h>
#include <llvm/IR/DerivedTypes.h>
#include <llvm/IR/GlobalVariable.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lift/graph.hpp"
#include "lift/value.hpp"

namespace veritrack::lift {

struct Cell {
  std::int64_t size = 0;  ///< bytes
  Value value;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// The cells of an object by their offset; none overlaps another.
using Cells = std::map<std::int64_t, Cell>;

struct Object {
  std::string name;
  const llvm::GlobalVariable* global = nullptr;  ///< null: made while the program ran
  bool read_only = false;
  bool is_variable = false;  ///< of a function
  std::int64_t size = 0;     ///< bytes
  bool is_gone = false;      ///< a variable of a function that has returned, memory that was given back
};

class Memory {
 public:
  Memory(Graph& graph, const llvm::DataLayout& layout) : graph_(&graph), layout_(&layout) {}

  /// A new object without cells; its number is never used again.
  int add(Object object);
  /// Later reads and writes are errors.
  void end(int object) { objects_[static_cast<std::size_t>(object)].is_gone = true; }
  /// Is told of what has to be 0 for a read to be defined: a bit, and why.
  void tell(std::function<void(int, const char*)> require_zero) { require_zero_ = std::move(require_zero); }
  /// The cells of a constant of the program.
  void initialize(int object, std::int64_t offset, const llvm::Constant& constant,
                  const std::map<const llvm::GlobalValue*, int>& globals);
  void fill_with_zeros(int object, std::int64_t offset, std::int64_t bytes);

  /// Throws LiftError.
  [[nodiscard]] Value load(const Value& address, llvm::Type* type);
  void store(const Value& address, llvm::Type* type, const Value& value);
  void copy(const Value& to, const Value& from, std::int64_t bytes);
  void set(const Value& to, std::uint8_t byte, std::int64_t bytes);

  /// One of two values.
  [[nodiscard]] Value select(int condition, const Value& yes, const Value& no);

  /// The cells of all objects; cheap to copy, as those that are shared are never changed.
  using Contents = std::vector<std::shared_ptr<Cells>>;
  [[nodiscard]] const Contents& contents() const { return contents_; }
  void restore(Contents contents) { contents_ = std::move(contents); }
  /// What is there after one of two ways, each of which left its contents.
  void merge(int condition, const Contents& yes, const Contents& no);

  [[nodiscard]] const Object& object(int number) const { return objects_[static_cast<std::size_t>(number)]; }
  [[nodiscard]] int objects() const { return static_cast<int>(objects_.size()); }
  [[nodiscard]] const Cells& cells(int object) const;
  void put(int object, std::int64_t offset, Cell cell);

  [[nodiscard]] Format format_of(llvm::Type* type) const;
  [[nodiscard]] std::int64_t size_of(llvm::Type* type) const;
  /// The bytes that are written, without padding behind them.
  [[nodiscard]] std::int64_t written_size_of(llvm::Type* type) const;
  /// The bits of bytes that are known; those that are not defined are 0. Nothing where there are others.
  [[nodiscard]] std::optional<std::uint64_t> known_bits(const Cells& cells, std::int64_t offset,
                                                        std::int64_t bytes) const;
  [[nodiscard]] Value constant(const llvm::Constant& constant,
                               const std::map<const llvm::GlobalValue*, int>& globals);

 private:
  [[nodiscard]] Cells& changeable(int object);
  [[nodiscard]] Value load_scalar(const Address& address, llvm::Type* type);
  [[nodiscard]] Value load_bytes(const Cells& cells, std::int64_t offset, llvm::Type* type);
  void make_room(Cells& cells, std::int64_t offset, std::int64_t bytes);
  void reshape(Cells& cells, const Cells& like);
  [[nodiscard]] Cells merged(int condition, Cells yes, Cells no, const std::string& name);
  [[nodiscard]] Value load_element(const Address& address, llvm::Type* type);
  void store_at(const Address& address, llvm::Type* type, const Value& value);
  /// The member or element `i` of a type that has some: its type and offset; null behind the last.
  [[nodiscard]] std::pair<llvm::Type*, std::int64_t> part(llvm::Type* type, unsigned i) const;
  [[nodiscard]] Address known(const Value& address, const char* purpose) const;

  Graph* graph_;
  const llvm::DataLayout* layout_;
  std::vector<Object> objects_;
  Contents contents_;
  std::function<void(int, const char*)> require_zero_;
};

}  // namespace veritrack::lift
