#include "checker/document/design_file.hpp"

#include <map>
#include <set>
#include <utility>

#include "checker/document/code_files.hpp"
#include "checker/document/design_number.hpp"
#include "checker/document/model_design_file.hpp"
#include "checker/document/sha256.hpp"
#include "checker/document/toml_file.hpp"

namespace veritrack::checker {

namespace {

/// The meaning of a design file that omits a key (docs/design-file.md).
const std::string* default_of(const std::string& path) {
  static const std::map<std::string, std::string> defaults{
      {"assume.amplitude", "1"}, {"assume.slew", "0"},          {"assume.initial_covariance", "steady-state"},
      {"design.epsilon", "0"},   {"design.half_width", "2"},    {"source", ""},
      {"theorem_2_9.R_x", "7"},  {"theorem_2_9.sigma", "1e-3"}, {"theorem_2_9.gamma_fraction", "0.5"},
      {"theorem_2_9.c1", "3"},   {"theorem_2_9.c2", "3"}};
  const auto found = defaults.find(path);
  return found == defaults.end() ? nullptr : &found->second;
}

/// "table.key"
std::string inside(const std::string& path, const std::string& name) {
  std::string longer = path;
  return longer.append(path.empty() ? "" : ".").append(name);
}

/// The name in braces of a value with its unit, and the unit as the certificate writes it behind numbers.
struct Measured {
  const toml::node* value;
  std::string unit;
};

Measured without_braces(const std::string& path, const toml::node* file) {
  const toml::table* table = file != nullptr ? file->as_table() : nullptr;
  if (table == nullptr || table->size() != 1) {
    return {file, ""};
  }
  if (const toml::node* hertz = table->get("hz")) {
    return {hertz, " Hz"};
  }
  if (const toml::node* slew = table->get("hz_per_second")) {
    return {slew, " Hz per second"};
  }
  const toml::node* bound = path == "assume.noise" ? table->get("bound") : nullptr;
  return {bound != nullptr ? bound : file, ""};
}

/// Walks through the certificate's design and the file together.
class Comparison {
 public:
  Comparison(const TomlFile& file, Objections& objections) : file_(&file), objections_(objections) {}

  /// A table of the file that is compared apart.
  void leave_aside(std::string name) { left_aside_.insert(std::move(name)); }

  void table(const std::string& path, const Tree& claimed, const toml::table* file) {
    for (const auto& [name, value] : claimed.members()) {
      node(inside(path, name), value, file != nullptr ? file->get(name) : nullptr);
    }
    if (file == nullptr) {
      return;
    }
    for (const auto& [key, value] : *file) {
      const std::string name(key.str());
      const bool left_aside = path.empty() && left_aside_.contains(name);
      if (!left_aside && claimed.find(name) == nullptr) {
        objections_.push_back(inside(path, name).append(" is in the design file and not in the certificate"));
      }
    }
  }

 private:
  void node(const std::string& path, const Tree& claimed, const toml::node* file) {
    const bool is_number = claimed.kind() == Tree::Kind::object && claimed.find("text") != nullptr;
    if (is_number) {
      const Measured inside = without_braces(path, file);
      number(path, claimed, inside.value, inside.unit);
    } else if (claimed.kind() == Tree::Kind::text) {
      same(path, claimed.text(), file, file != nullptr && file->is_string() ? file->as_string()->get() : "");
    } else if (claimed.kind() == Tree::Kind::object) {
      if (file != nullptr && !file->is_table()) {
        objections_.push_back(path + " is no table in the design file");
        return;
      }
      table(path, claimed, file != nullptr ? file->as_table() : nullptr);
    } else {
      array(path, claimed, file);
    }
  }

  void number(const std::string& path, const Tree& claimed, const toml::node* file, const std::string& unit) {
    const bool is_number = file != nullptr && file->is_number();
    same(path, text_of(claimed), file, is_number ? file_->literal(*file) + unit : "");
  }

  void array(const std::string& path, const Tree& claimed, const toml::node* in_file) {
    const auto& elements = claimed.elements();
    const auto [file, unit] = without_braces(path, in_file);
    const toml::array* values = file != nullptr ? file->as_array() : nullptr;
    // One frequency is a band of one frequency.
    const bool is_single = file != nullptr && file->is_number() && path == "assume.frequency";
    if (!is_single && (values == nullptr || values->size() != elements.size())) {
      objections_.push_back(path + " is another array in the design file");
      return;
    }
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const toml::node* element = is_single ? file : values->get(i);
      const std::string place = path + "[" + std::to_string(i) + "]";
      if (unit.empty()) {
        node(place, elements[i], element);
      } else {
        number(place, elements[i], element, unit);
      }
    }
  }

  void same(const std::string& path, const std::string& claimed, const toml::node* file,
            const std::string& text) {
    const std::string* fallback = default_of(path);
    if (file == nullptr && fallback == nullptr) {
      objections_.push_back(path + " is in the certificate and not in the design file");
    } else if (claimed != (file == nullptr ? *fallback : text)) {
      objections_.push_back(path + " is " + (file == nullptr ? *fallback + " by default" : text) +
                            " in the design file");
    }
  }

  const TomlFile* file_;
  Objections& objections_;
  std::set<std::string> left_aside_{"simulate"};
};

/// The part of a file that is a design of this tracker.
void compare_design(const Tree& design, const TomlFile& file, const toml::table& part,
                    const std::filesystem::path& folder, Objections& objections) {
  if (design.at("tracker").text() == "model") {
    compare_model_design(design, file, part, objections);
    compare_code_files(design, folder, objections);
  } else {
    Comparison(file, objections).table("", design, &part);
  }
}

/// [design] of a regulator is the design of its tracker, which has a certificate of its own.
void compare_regulator(const Tree& certificate, const TomlFile& file, const std::filesystem::path& folder,
                       Objections& objections) {
  Comparison outside(file, objections);
  outside.leave_aside("design");
  outside.table("", certificate.at("design"), &file.table());
  const toml::table* chosen = file.table().get_as<toml::table>("design");
  const toml::table* tracker = chosen != nullptr ? chosen->get_as<toml::table>("frequency_tracker") : nullptr;
  if (tracker == nullptr || chosen->size() != 1) {
    objections.emplace_back("[design] of the design file is not the table frequency_tracker alone");
    return;
  }
  Objections inside;
  compare_design(certificate.at("frequency_tracker").at("design"), file, *tracker, folder, inside);
  for (const std::string& objection : inside) {
    objections.push_back("design.frequency_tracker: " + objection);
  }
}

}  // namespace

void compare_with_design_file(const Tree& certificate, const std::string& file, Objections& objections,
                              const std::filesystem::path& folder) {
  if (sha256(file) != certificate.at("design_sha256").text()) {
    objections.emplace_back("the design file has another SHA-256 than the certificate names");
  }
  try {
    const TomlFile toml(file);
    const Tree& design = certificate.at("design");
    if (design.at("tracker").text() == "vibration-regulator") {
      compare_regulator(certificate, toml, folder, objections);
    } else {
      compare_design(design, toml, toml.table(), folder, objections);
    }
  } catch (const toml::parse_error& error) {
    throw Malformed("the design file is not TOML: " + std::string(error.description()));
  }
}

}  // namespace veritrack::checker
