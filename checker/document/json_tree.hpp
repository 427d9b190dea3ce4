// The certificate as a tree. Read with a SAX parser: duplicate keys, which a DOM would silently resolve, are
// malformed, as are numbers with a fraction (reals that mean something are strings) and deep nesting.
//
// The tree records which of its values have been read: a value that no check reads is a place to lie, and
// `unread` finds them all.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace veritrack::checker {

/// The file is not a certificate; says why in a sentence. Exit status 2.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One value. Reading it as another type than it has throws Malformed.
class Tree {
 public:
  enum class Kind { nothing, truth, integer, text, array, object };

  Tree() = default;
  explicit Tree(Kind kind) : kind_(kind) {}
  static Tree of_truth(bool value);
  static Tree of_integer(long value);
  static Tree of_text(std::string value);

  /// The member of this name, or none.
  [[nodiscard]] const Tree* find(std::string_view name) const;
  [[nodiscard]] const Tree& at(std::string_view name) const;
  [[nodiscard]] const Tree& at(std::size_t index) const;
  [[nodiscard]] const std::vector<std::pair<std::string, Tree>>& members() const;
  [[nodiscard]] const std::vector<Tree>& elements() const;
  [[nodiscard]] const std::string& text() const;
  /// Whether the value is this text. If so it counts as read; any other value is left unread.
  [[nodiscard]] bool is(std::string_view text) const;
  [[nodiscard]] bool truth() const;
  [[nodiscard]] long integer() const;
  [[nodiscard]] Kind kind() const { return kind_; }
  /// The paths, as "claims[3].verdict", of the values that nothing has read, at most `most` of them. A text
  /// or a truth value is read when it was asked for, an object or array when all in it is, and an empty one
  /// when its members or elements were asked for.
  [[nodiscard]] std::vector<std::string> unread(std::size_t most) const;

  /// Adds a member; false when there is one of this name.
  bool add_key(std::string name);
  /// Sets the last member, or appends an element.
  void add_value(Tree value);

 private:
  void require(Kind kind, const char* what) const;

  Kind kind_ = Kind::nothing;
  mutable bool read_ = false;
  bool truth_ = false;
  long integer_ = 0;
  std::string text_;
  std::vector<Tree> elements_;
  std::vector<std::pair<std::string, Tree>> members_;       ///< in the order of the file
  std::map<std::string, std::size_t, std::less<>> places_;  ///< of the members, by name
};

/// Throws Malformed.
Tree read_json(const std::string& text);

}  // namespace veritrack::checker
