#include "checker/document/json_tree.hpp"

#include <nlohmann/json.hpp>

namespace veritrack::checker {

namespace {

using Json = nlohmann::json;

/// Builds the tree; every member function says whether to go on.
class Builder : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return add(Tree()); }
  bool boolean(bool value) override { return add(Tree::of_truth(value)); }
  bool number_integer(number_integer_t value) override { return add(Tree::of_integer(value)); }
  bool number_unsigned(number_unsigned_t value) override {
    return value < (1ULL << 62U) ? add(Tree::of_integer(static_cast<long>(value)))
                                 : fail("an integer is too large");
  }
  bool number_float(number_float_t /*value*/, const string_t& text) override {
    return fail("a number with a fraction or an exponent: " + text);
  }
  bool string(string_t& value) override { return add(Tree::of_text(value)); }
  bool binary(binary_t& /*value*/) override { return fail("binary data"); }
  bool start_object(std::size_t /*size*/) override { return open(Tree(Tree::Kind::object)); }
  bool start_array(std::size_t /*size*/) override { return open(Tree(Tree::Kind::array)); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    return open_.back().add_key(name) || fail("the key \"" + name + "\" occurs twice in an object");
  }
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    return fail("not JSON at byte " + std::to_string(position));
  }

  /// The tree that was read, when it was read to the end.
  Tree result() { return std::move(root_); }
  [[nodiscard]] const std::string& objection() const { return objection_; }

 private:
  static constexpr std::size_t kDeepest = 32;
  /// Each takes some hundred bytes; the largest certificate of designs/ has a hundredth of this number.
  static constexpr std::size_t kMostValues = 4'000'000;

  bool fail(std::string objection) {
    objection_ = std::move(objection);
    return false;
  }
  bool add(Tree value) {
    if (++count_ > kMostValues) {
      return fail("more than " + std::to_string(kMostValues) + " values");
    }
    if (open_.empty()) {
      root_ = std::move(value);
    } else {
      open_.back().add_value(std::move(value));
    }
    return true;
  }
  bool open(Tree value) {
    open_.push_back(std::move(value));
    return open_.size() <= kDeepest || fail("nested too deeply");
  }
  bool close() {
    Tree done = std::move(open_.back());
    open_.pop_back();
    return add(std::move(done));
  }

  Tree root_;
  std::vector<Tree> open_;
  std::string objection_;
  std::size_t count_ = 0;
};

}  // namespace

Tree Tree::of_truth(bool value) {
  Tree tree(Kind::truth);
  tree.truth_ = value;
  return tree;
}
Tree Tree::of_integer(long value) {
  Tree tree(Kind::integer);
  tree.integer_ = value;
  return tree;
}
Tree Tree::of_text(std::string value) {
  Tree tree(Kind::text);
  tree.text_ = std::move(value);
  return tree;
}

void Tree::require(Kind kind, const char* what) const {
  if (kind_ != kind) {
    throw Malformed(std::string("something is not ") + what);
  }
}

const Tree* Tree::find(std::string_view name) const {
  require(Kind::object, "an object");
  const auto place = places_.find(name);
  return place == places_.end() ? nullptr : &members_[place->second].second;
}

const Tree& Tree::at(std::string_view name) const {
  const Tree* member = find(name);
  if (member == nullptr) {
    throw Malformed("there is no \"" + std::string(name) + "\"");
  }
  return *member;
}

const Tree& Tree::at(std::size_t index) const {
  if (index >= elements().size()) {
    throw Malformed("an array is too short");
  }
  return elements_[index];
}

const std::vector<std::pair<std::string, Tree>>& Tree::members() const {
  require(Kind::object, "an object");
  read_ = true;
  return members_;
}
const std::vector<Tree>& Tree::elements() const {
  require(Kind::array, "an array");
  read_ = true;
  return elements_;
}
const std::string& Tree::text() const {
  require(Kind::text, "a string");
  read_ = true;
  return text_;
}
bool Tree::is(std::string_view text) const {
  require(Kind::text, "a string");
  read_ = read_ || text_ == text;
  return text_ == text;
}
bool Tree::truth() const {
  require(Kind::truth, "true or false");
  read_ = true;
  return truth_;
}

long Tree::integer() const {
  require(Kind::integer, "an integer");
  read_ = true;
  return integer_;
}

std::vector<std::string> Tree::unread(std::size_t most) const {
  // Recursion as deep as the file is nested, which the reader limits. Names are copied only for findings.
  std::vector<std::string> paths;
  const auto add = [&](const Tree& value, const std::string& name) {
    for (const std::string& rest : value.unread(most - paths.size())) {
      std::string& path = paths.emplace_back(name);
      path.append(rest.empty() || rest.starts_with('[') ? "" : ".").append(rest);
    }
  };
  for (auto member = members_.begin(); member != members_.end() && paths.size() < most; ++member) {
    add(member->second, member->first);
  }
  for (std::size_t i = 0; i < elements_.size() && paths.size() < most; ++i) {
    add(elements_[i], "[" + std::to_string(i) + "]");
  }
  if (members_.empty() && elements_.empty() && !read_ && most > 0) {
    paths.emplace_back();
  }
  return paths;
}

bool Tree::add_key(std::string name) {
  if (!places_.emplace(name, members_.size()).second) {
    return false;
  }
  members_.emplace_back(std::move(name), Tree());
  return true;
}

void Tree::add_value(Tree value) {
  if (kind_ == Kind::object) {
    members_.back().second = std::move(value);
  } else {
    elements_.push_back(std::move(value));
  }
}

Tree read_json(const std::string& text) {
  Builder builder;
  if (!Json::sax_parse(text, &builder)) {
    throw Malformed(builder.objection());
  }
  return builder.result();
}

}  // namespace veritrack::checker
