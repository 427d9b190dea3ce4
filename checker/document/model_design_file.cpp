#include "checker/document/model_design_file.hpp"

#include <map>
#include <string>

#include "checker/document/code_files.hpp"

namespace veritrack::checker {

namespace {

/// Everything in a design, by its place.
using Said = std::map<std::string, std::string>;

std::string element(const std::string& path, std::size_t number) {
  return path + "[" + std::to_string(number) + "]";
}

/// The content of the certificate.
class CertificateSays {
 public:
  explicit CertificateSays(Objections& objections) : objections_(&objections) {}

  /// Names with formulas are lists in the certificate and tables in the file: they are identified by their
  /// names. (A tree is not nested deeply.)
  void add(const std::string& path, const Tree& value) {
    switch (value.kind()) {
      case Tree::Kind::text:
        put(path, value.text());
        break;
      case Tree::Kind::truth:
        put(path, value.truth() ? "true" : "false");
        break;
      case Tree::Kind::array:
        for (std::size_t i = 0; i < value.elements().size(); ++i) {
          const Tree& each = value.at(i);
          const bool is_named = each.kind() == Tree::Kind::object && each.find("formula") != nullptr;
          add(is_named ? path + "." + each.at("name").text() : element(path, i),
              is_named ? each.at("formula") : each);
        }
        break;
      case Tree::Kind::object:
        if (const Tree* text = value.find("text")) {
          put(path, text->text());
          break;
        }
        for (const auto& [name, member] : value.members()) {
          std::string inside = path;
          add(inside.append(path.empty() ? "" : ".").append(name), member);
        }
        break;
      default:
        objections_->push_back(path + " is nothing that a design says");
    }
  }
  [[nodiscard]] const Said& said() const { return said_; }

 private:
  void put(const std::string& path, const std::string& text) {
    if (!said_.emplace(path, text).second) {
      objections_->push_back(path + " is twice in the certificate");
    }
  }

  Objections* objections_;
  Said said_;
};

/// The content of the file, with its defaults, in the form of the certificate.
class FileSays {
 public:
  /// `two_channels`: by default, where the functions of [code] say how many there are.
  FileSays(const TomlFile& file, const toml::table& part, bool two_channels, Objections& objections)
      : file_(&file), objections_(&objections) {
    for (const auto& [key, value] : part) {
      const std::string name(key.str());
      if (name == "model") {
        model(value);
      } else if (name == "assume") {
        assume(value);
      } else if (name == "require") {
        requirements(value);
      } else if (name == "code") {
        code(value);
      } else if (name != "simulate") {
        leaf(name, value);
      }
    }
    if (&part == &file.table()) {  // a design inside another one's file has no source
      fallback("source", "");
    }
    if (!has_amplitude_) {
      said_["assume.amplitude"] = "1";
    }
    fallback("assume.slew", "0");
    fallback("assume.frequency_in_hertz", "false");
    fallback("assume.slew_in_hertz_per_second", "false");
    if (!has_signal_) {
      said_["model.signal[0]"] = "A*cos(phi)";
      if (said_.contains("model.samples[1]") || (part.contains("code") && two_channels)) {
        said_["model.signal[1]"] = "A*sin(phi)";
      }
    }
  }
  [[nodiscard]] const Said& said() const { return said_; }

 private:
  void fallback(const std::string& path, const std::string& text) { said_.try_emplace(path, text); }
  void leaf(const std::string& path, const toml::node& value) {
    if (!value.is_string() && !value.is_number()) {
      objections_->push_back(path + " in the design file is neither a text nor a number");
      return;
    }
    put(path, file_->text(value));
  }
  void put(const std::string& path, const std::string& text) {
    if (!said_.emplace(path, text).second) {
      objections_->push_back(path + " is twice in the design file");
    }
  }
  /// A text or a list of texts: always a list in the certificate.
  void list(const std::string& path, const toml::node& value) {
    const toml::array* values = value.as_array();
    if (values == nullptr) {
      leaf(element(path, 0), value);
      return;
    }
    for (std::size_t i = 0; i < values->size(); ++i) {
      leaf(element(path, i), *values->get(i));
    }
  }
  void matrix(const std::string& path, const toml::node& value) {
    const toml::array* rows = value.as_array();
    if (rows == nullptr) {
      leaf(element(element(path, 0), 0), value);
      return;
    }
    for (std::size_t i = 0; i < rows->size(); ++i) {
      list(element(path, i), *rows->get(i));
    }
  }
  /// The values of a table.
  template <typename Work>
  void each_of(const std::string& path, const toml::node& value, const Work& work) {
    if (!value.is_table()) {
      objections_->push_back(path + " is no table in the design file");
      return;
    }
    for (const auto& [key, member] : *value.as_table()) {
      work(std::string(key.str()), member);
    }
  }
  void members(const std::string& path, const toml::node& value) {
    each_of(path, value,
            [&](const std::string& name, const toml::node& member) { leaf(path + "." + name, member); });
  }

  /// Numbers that may be in Hz or seconds are given with their unit.
  void requirements(const toml::node& table) {
    each_of("require", table, [&](const std::string& name, const toml::node& value) {
      const std::string path = "require." + name;
      const toml::table* braces = value.as_table();
      const bool has_unit = braces != nullptr && braces->size() == 1;
      const toml::node* hertz = has_unit ? braces->get("hz") : nullptr;
      const toml::node* slew = has_unit ? braces->get("hz_per_second") : nullptr;
      const toml::node* seconds = has_unit ? braces->get("seconds") : nullptr;
      if (hertz != nullptr && hertz->is_number()) {
        put(path, file_->text(*hertz) + " Hz");
      } else if (slew != nullptr && slew->is_number()) {
        put(path, file_->text(*slew) + " Hz per second");
      } else if (seconds != nullptr && seconds->is_number()) {
        put(path, file_->text(*seconds) + " seconds");
      } else {
        leaf(path, value);
      }
    });
  }

  void model(const toml::node& table) {
    each_of("model", table, [&](const std::string& name, const toml::node& value) {
      const std::string path = "model." + name;
      if (name == "parameters") {
        members(path, value);
      } else if (name == "ekf") {
        filter(value);
      } else if (name == "samples" || name == "states" || name == "angles") {
        list(path, value);
      } else if (name != "units" && name != "start") {
        leaf(path, value);
      }
    });
  }
  void code(const toml::node& table) {
    each_of("code", table, [&](const std::string& name, const toml::node& value) {
      const toml::array* values = value.as_array();
      for (std::size_t i = 0; name == "files" && values != nullptr && i < values->size(); ++i) {
        leaf(element("code.files", i) + ".name", *values->get(i));
      }
      if (name != "files") {
        list("code." + name, value);
      }
    });
  }
  void filter(const toml::node& table) {
    each_of("model.ekf", table, [&](const std::string& name, const toml::node& value) {
      const std::string path = "model.ekf." + name;
      if (name == "states" || name == "measure") {
        list(path, value);
      } else if (name == "Q" || name == "R" || (name == "jacobian" && value.is_array())) {
        matrix(path, value);
      } else if (const std::string text = file_->text(value);
                 !(name == "update" && text == "standard") && !(name == "jacobian" && text == "automatic")) {
        leaf(path, value);
      }
    });
  }
  void assume(const toml::node& table) {
    each_of("assume", table, [&](const std::string& name, const toml::node& value) {
      const std::string path = "assume." + name;
      if (name == "frequency") {
        list(path, in_unit(value, "hz", "assume.frequency_in_hertz"));
      } else if (name == "slew") {
        leaf(path, in_unit(value, "hz_per_second", "assume.slew_in_hertz_per_second"));
      } else if (name == "amplitude") {
        has_amplitude_ = true;
        amplitude(path, value);
      } else if (name == "signal") {
        has_signal_ = true;
        list("model.signal", value);
      } else if (const toml::node* bound = name == "noise" ? bound_of(value) : nullptr) {
        leaf(path, *bound);
      } else if (name == "start_within" || name == "start_exactly" || (name == "noise" && value.is_table())) {
        members(path, value);
      } else {
        leaf(path, value);
      }
    });
  }
  /// A number, a list, or { constant = list }.
  void amplitude(const std::string& path, const toml::node& value) {
    const toml::table* table = value.as_table();
    const toml::node* constant = table != nullptr && table->size() == 1 ? table->get("constant") : nullptr;
    if (constant != nullptr && constant->is_array()) {
      list(path + ".constant", *constant);
    } else if (value.is_array()) {
      list(path, value);
    } else {
      leaf(path, value);
    }
  }
  /// The value of { bound = value }, or none.
  static const toml::node* bound_of(const toml::node& value) {
    const toml::table* table = value.as_table();
    return table != nullptr && table->size() == 1 ? table->get("bound") : nullptr;
  }
  /// The value of { unit = value }, when the certificate gives it in that unit; otherwise the value.
  const toml::node& in_unit(const toml::node& value, const std::string& unit, const std::string& says) {
    const toml::table* table = value.as_table();
    const toml::node* inside = table != nullptr && table->size() == 1 ? table->get(unit) : nullptr;
    if (inside == nullptr) {
      return value;
    }
    put(says, "true");
    return *inside;
  }

  const TomlFile* file_;
  Objections* objections_;
  Said said_;
  bool has_signal_ = false;
  bool has_amplitude_ = false;
};

}  // namespace

void compare_model_design(const Tree& design, const TomlFile& file, const toml::table& part,
                          Objections& objections) {
  CertificateSays certificate(objections);
  certificate.add("", design);
  const FileSays there(file, part, certificate.said().contains("model.samples[1]"), objections);
  const bool has_code = design.find("code") != nullptr;
  for (const auto& [path, text] : certificate.said()) {
    const auto found = there.said().find(path);
    if (has_code && is_from_code(path)) {
      continue;
    }
    if (found == there.said().end()) {
      objections.push_back(path + " is in the certificate and not in the design file");
    } else if (found->second != text) {
      objections.push_back(path + " is another one in the design file");
    }
  }
  for (const auto& said : there.said()) {
    if (!certificate.said().contains(said.first)) {
      objections.push_back(said.first + " is in the design file and not in the certificate");
    }
  }
}

}  // namespace veritrack::checker
