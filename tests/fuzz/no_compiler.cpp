// Files that arbitrary bytes name are neither read nor compiled.
#include "certificates/code/compilation.hpp"
#include "certificates/code/harness/new_code.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::certificates::code {

CompiledCode compiled(const CodeTable& code, const std::filesystem::path& design_file) {
  throw InputError(design_file.string(), code.position, "nothing is compiled here");
}

NewCode new_code(const NewCodeRequest& request) {
  throw InputError(request.source.string(), {}, "nothing is compiled here");
}

std::string new_code_design(const NewCode& /*code*/, double /*start*/) {
  return {};
}

double start_frequency(const NewCode& /*code*/, const std::filesystem::path& /*design*/) {
  return 0.0;
}

}  // namespace veritrack::certificates::code
