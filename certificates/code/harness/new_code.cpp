#include "certificates/code/harness/new_code.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "certificates/code/compiler.hpp"
#include "certificates/code/harness/arguments_guessed.hpp"
#include "certificates/code/harness/harness.hpp"
#include "certificates/code/harness/harness_plan.hpp"
#include "certificates/code/harness/syntax_tree.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::certificates::code {

namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate = 10000.0;
constexpr std::string_view kInFileNames =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/+-";

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) {
    throw InputError(path.string(), {}, "it cannot be read; allowed: a file of C or C++");
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The declarations; for C++ with the first standard that the file compiles with, which is added to `flags`.
std::vector<nlohmann::json> tree_of(const NewCodeRequest& request, std::vector<std::string>& flags) {
  const auto read = [&](const std::vector<std::string>& given) {
    std::vector<SourceText> texts;
    texts.reserve(given.size());
    for (const std::string& flag : given) {
      texts.push_back({flag, {}});
    }
    require_flags(texts, request.source);
    return own_declarations(request.source, flag_arguments(texts, request.design.parent_path()));
  };
  const bool names_standard = std::any_of(flags.begin(), flags.end(),
                                          [](const std::string& flag) { return flag.starts_with("-std="); });
  try {
    return read(flags);
  } catch (const InputError&) {
    if (!is_cpp(request.source) || names_standard) {
      throw;
    }
    for (const char* standard : {"-std=c++17", "-std=c++20"}) {
      std::vector<std::string> with = flags;
      with.emplace_back(standard);
      try {
        std::vector<nlohmann::json> tree = read(with);
        flags = with;
        return tree;
      } catch (const InputError&) {
        continue;  // the message about the file as it is says more
      }
    }
    throw;
  }
}

/// A file named from the folder of another.
std::string named_from(const fs::path& folder, const fs::path& file) {
  const fs::path from = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder);
  return fs::weakly_canonical(file).lexically_relative(from).generic_string();
}

bool is_own_harness(const Declarations& declarations, const std::string& file) {
  const auto defines = [&](std::string_view name, std::size_t least, std::size_t most) {
    return std::any_of(
        declarations.functions.begin(), declarations.functions.end(), [&](const Function& each) {
          return each.full_name() == name && each.has_body && each.place.file == file && !each.is_static &&
                 each.parameters.size() >= least && each.parameters.size() <= most;
        });
  };
  return defines("setup", 0, 0) && defines("step", 1, 2) && defines("frequency", 0, 0);
}

fs::path harness_beside(const NewCodeRequest& request) {
  std::string stem = request.design.stem().string();
  for (char& c : stem) {
    c = kInFileNames.find(c) == std::string_view::npos || c == '/' ? '-' : c;
  }
  return request.design.parent_path() / (stem + "-harness" + (is_cpp(request.source) ? ".cpp" : ".c"));
}

}  // namespace

NewCode new_code(const NewCodeRequest& request) {
  const std::string text = text_of_file(request.source);
  const std::string file = request.source.string();
  NewCode result;
  result.flags = request.flags;
  result.source = request.source.filename().string();
  const Declarations declarations = declarations_in(tree_of(request, result.flags));
  const std::string source_name = named_from(request.design.parent_path(), request.source);
  if (request.function.empty() && is_own_harness(declarations, file)) {
    const auto step =
        std::find_if(declarations.functions.begin(), declarations.functions.end(),
                     [&](const Function& each) { return each.full_name() == "step" && each.has_body; });
    result.files = {source_name};
    result.step = fmt::format("step ({})", at_line(step->place));
    result.samples = static_cast<int>(step->parameters.size());
    return result;
  }
  HarnessPlan plan = harness_plan(declarations, file, text, request.function);
  if (plan.time) {
    plan.is_guessed_rate = !plan.time->hz;
    plan.sample_rate = plan.time->hz.value_or(kUsualRate);
  }
  plan.is_cpp = is_cpp(request.source);
  plan.source = result.source;
  const std::vector<std::string> headers = headers_that_declare(plan, declarations, file);
  for (const std::string& header : headers) {
    plan.includes.push_back(named_from(request.design.parent_path(), header));
  }
  result.harness = harness_beside(request);
  result.files = {result.harness.filename().string()};
  if (headers.empty() || source_name.find_first_not_of(kInFileNames) != std::string::npos) {
    plan.includes = {source_name};
  } else {
    result.files.insert(result.files.begin(), source_name);
  }
  result.harness_text = code::harness_text(plan, declarations);
  result.step = fmt::format("{} ({})", plan.step.function->full_name(), at_line(plan.step.function->place));
  result.samples = plan.step.samples();
  result.sample_rate = plan.sample_rate;
  result.is_guessed_rate = plan.is_guessed_rate;
  result.guessed = fmt::format("{}", fmt::join(guessed_numbers(plan, declarations), ", "));
  return result;
}

}  // namespace veritrack::certificates::code
