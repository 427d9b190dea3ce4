#include "certificates/model/code_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "certificates/code/recursion.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them
using code::CodeTable;

constexpr std::size_t kLongestName = 1000;  // bytes
constexpr std::size_t kMostFiles = 64;

template <auto member>
void text_list(const TomlValue& value, CodeTable& target) {
  for (const TomlValue& element : value.elements(1, kMostFiles)) {
    (target.*member).push_back(element.source_text(kLongestName));
  }
  target.position = value.position();
}

constexpr std::array kCodeKeys{
    Key<CodeTable>{
        "files",
        "a list of files of C or C++, named from the folder of the design, that define setup, step and "
        "frequency, e.g. ['pll.c', 'harness.c']",
        text_list<&CodeTable::files>, kOptional, kOnlyEqual},
    Key<CodeTable>{"flags", "a list of flags of the compiler, e.g. ['-DMOTOR=3', '-Iinclude']",
                   text_list<&CodeTable::flags>, kOptional, kOnlyEqual},
};

/// The first key of [model] that [code] fills in and that is given all the same.
std::optional<std::pair<std::string_view, Position>> given_beside_code(const ModelTable& model) {
  const auto first =
      [](std::string_view name,
         const std::vector<SourceText>& texts) -> std::optional<std::pair<std::string_view, Position>> {
    return texts.empty() ? std::nullopt : std::optional(std::pair(name, texts.front().position));
  };
  for (const auto& given :
       {first("samples", model.samples), first("states", model.states), first("angles", model.angles)}) {
    if (given) {
      return given;
    }
  }
  if (!model.step.text.empty()) {
    return std::pair(std::string_view("step"), model.step.position);
  }
  if (!model.frequency.text.empty()) {
    return std::pair(std::string_view("frequency"), model.frequency.position);
  }
  return model.ekf ? std::optional(std::pair(std::string_view("ekf"), model.ekf->predict.position))
                   : std::nullopt;
}

std::optional<TableObjection> objection_to_missing(const ModelTable& model) {
  const auto missing = [](std::string_view key, std::string_view allowed) {
    return TableObjection{"model", fmt::format("missing key model.{}; allowed: {}", key, allowed),
                          std::nullopt};
  };
  if (model.samples.empty()) {
    return missing("samples",
                   "the name of the sample, e.g. 'y', or of the two of two channels, e.g. ['y1', 'y2']");
  }
  if (model.frequency.text.empty()) {
    return missing("frequency", "a formula of the states: the estimated frequency in rad/sample");
  }
  return std::nullopt;
}

}  // namespace

BoundTable code_keys(CodeTable& target) {
  return bound_table("code", kCodeKeys, target);
}

std::optional<TableObjection> complete_from_code(ModelTable& model,
                                                 const std::filesystem::path& design_file) {
  if (!model.code.is_given()) {
    return model.code.flags.empty()
               ? objection_to_missing(model)
               : std::optional(TableObjection{"code", "flags without files; allowed: files = [...]",
                                              model.code.position});
  }
  if (const auto given = given_beside_code(model)) {
    return TableObjection{
        "model",
        fmt::format("model.{} beside [code], whose functions say what it is; allowed: one of them",
                    given->first),
        given->second};
  }
  const Position position = model.code.position;
  model.compiled = code::compiled(model.code, design_file);
  code::Recursion& recursion = model.compiled->recursion;
  try {
    recursion = code::recursion_of(model.compiled->replaced);
  } catch (const code::NoRecursion& error) {
    const trackers::code::Place place = error.place();
    if (place.file < 0) {
      return TableObjection{"code", error.what(), position};
    }
    const std::filesystem::path file = model.compiled->listing.files.at(static_cast<std::size_t>(place.file));
    throw InputError((file.is_absolute() ? file : design_file.parent_path() / file).string(),
                     {place.line, place.column}, error.what());
  }
  const auto texts = [&](const std::vector<std::string>& names) {
    std::vector<SourceText> result;
    result.reserve(names.size());
    for (const std::string& name : names) {
      result.push_back({name, position});
    }
    return result;
  };
  model.samples = texts(recursion.samples);
  model.states = texts(recursion.states);
  model.angles = texts(recursion.angles);
  model.step = {recursion.step, position};
  model.frequency = {recursion.frequency, position};
  if (model.start.empty()) {
    for (std::size_t i = 0; i < recursion.states.size(); ++i) {
      model.start.push_back({{recursion.states[i], position}, {recursion.start[i], position}});
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::certificates
