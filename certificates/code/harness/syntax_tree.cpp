#include "certificates/code/harness/syntax_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "certificates/code/compiler.hpp"
#include "certificates/document/program.hpp"

namespace veritrack::certificates::code {

namespace {

using nlohmann::json;

/// Keeps the declarations of the user's own files: a tree of C++ has tens of megabytes, most of it of the
/// standard library, which is not built.
class OwnDeclarations : public nlohmann::json_sax<json> {
 public:
  explicit OwnDeclarations(const std::filesystem::path& source) : folder_(source.parent_path().string()) {}

  std::vector<json> take() { return std::move(kept_); }

  bool null() override { return value(nullptr); }
  bool boolean(bool given) override { return value(given); }
  bool number_integer(number_integer_t given) override { return value(given); }
  bool number_unsigned(number_unsigned_t given) override {
    if (!frames_.empty() && frames_.back().key == "line" && is_place()) {
      line_ = given;
    }
    return value(given);
  }
  bool number_float(number_float_t given, const string_t& /*text*/) override { return value(given); }
  bool string(string_t& given) override {
    if (!frames_.empty() && frames_.back().key == "file" && is_place()) {
      file_ = given;
    }
    return value(std::move(given));
  }
  bool binary(binary_t& /*given*/) override { return false; }

  bool start_object(std::size_t /*elements*/) override {
    begin(json::object(), false);
    return true;
  }
  bool start_array(std::size_t /*elements*/) override {
    begin(json::array(), true);
    return true;
  }
  bool key(string_t& name) override {
    frames_.back().key = name;
    if (frames_.size() == kDeclaration && name == "range" && is_of_the_system()) {
      is_building_ = false;
    }
    return true;
  }
  bool end_object() override {
    if (is_building_ && frames_.back().value.contains("offset")) {
      frames_.back().value["file"] = file_;
      frames_.back().value["line"] = line_;
    }
    end();
    return true;
  }
  bool end_array() override {
    end();
    return true;
  }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    throw std::invalid_argument(error.what());
  }

 private:
  struct Frame {
    json value;
    std::string key;
    bool is_array;
  };
  /// The frames of the tree, of its list "inner", and of a declaration in it.
  static constexpr std::size_t kDeclaration = 3;

  bool is_place() const {
    return frames_.size() > 1 && frames_[frames_.size() - 2].key != "includedFrom" &&
           !frames_.back().is_array;
  }
  bool is_of_the_system() const {
    const bool is_installed = file_.starts_with("/usr/") || file_.starts_with("<") || file_.empty();
    return is_installed && !(folder_.starts_with("/usr/") && file_.starts_with(folder_));
  }

  bool value(json given) {
    if (is_building_ && frames_.size() >= kDeclaration) {
      put(frames_.back(), std::move(given));
    }
    return true;
  }
  static void put(Frame& frame, json given) {
    if (frame.is_array) {
      frame.value.push_back(std::move(given));
    } else {
      frame.value[frame.key] = std::move(given);
    }
  }
  void begin(json empty, bool is_array) {
    if (frames_.size() + 1 == kDeclaration && frames_.back().is_array) {
      is_building_ = true;
    }
    frames_.push_back({is_building_ ? std::move(empty) : json(), {}, is_array});
  }
  void end() {
    json finished = std::move(frames_.back().value);
    frames_.pop_back();
    if (is_building_ && frames_.size() + 1 == kDeclaration) {
      kept_.push_back(std::move(finished));
      is_building_ = false;
    } else if (is_building_) {
      put(frames_.back(), std::move(finished));
    }
  }

  std::string folder_;
  std::vector<Frame> frames_;
  std::vector<json> kept_;
  std::string file_;
  std::uint64_t line_ = 0;
  bool is_building_ = false;
};

}  // namespace

std::vector<json> own_declarations_in(std::string_view dump, const std::filesystem::path& source) {
  OwnDeclarations reader(source);
  if (!json::sax_parse(dump, &reader)) {
    throw std::invalid_argument("not a syntax tree");
  }
  return reader.take();
}

std::vector<json> own_declarations(const std::filesystem::path& source,
                                   const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"-fsyntax-only", "-Xclang", "-ast-dump=json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.push_back(source.string());
  const ProgramRun run = run_limited(kCompiler, all, source, {});
  if (!run.has_succeeded()) {
    refuse_compilation(run.errors, source);
  }
  return own_declarations_in(run.output, source);
}

}  // namespace veritrack::certificates::code
