// Files that arbitrary bytes name are neither read nor compiled.
#include "certificates/code/compilation.hpp"

namespace veritrack::certificates::code {

CompiledCode compiled(const CodeTable& code, const std::filesystem::path& design_file) {
  throw InputError(design_file.string(), code.position, "nothing is compiled here");
}

}  // namespace veritrack::certificates::code
