// veritrack-lift FILE.bc...: the listing of the functions setup, step and frequency in files of LLVM IR, on
// standard output. `veritrack` runs it on the files of [code], which clang has compiled; nothing of them is
// executed.
#include <llvm/IR/LLVMContext.h>
#include <llvm/IRReader/IRReader.h>
#include <llvm/Linker/Linker.h>
#include <llvm/Support/SourceMgr.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "certificates/code/listing_text.hpp"
#include "lift/lifted.hpp"

namespace {

using veritrack::lift::Executor;

std::unique_ptr<llvm::Module> linked(int count, char** names, llvm::LLVMContext& context) {
  std::unique_ptr<llvm::Module> whole;
  for (int i = 1; i < count; ++i) {
    llvm::SMDiagnostic error;
    std::unique_ptr<llvm::Module> part = llvm::parseIRFile(names[i], error, context);
    if (!part) {
      std::fprintf(stderr, "%s: %s\n", names[i], error.getMessage().str().c_str());
      return nullptr;
    }
    if (!whole) {
      whole = std::move(part);
    } else if (llvm::Linker::linkModules(*whole, std::move(part))) {
      std::fprintf(stderr, "%s: does not fit to the files before it\n", names[i]);
      return nullptr;
    }
  }
  return whole;
}

int lift(const llvm::Module& module) {
  Executor executor(module);
  try {
    const veritrack::trackers::code::Listing listing = veritrack::lift::lifted(executor);
    std::fputs(veritrack::certificates::code::listing_text(listing).c_str(), stdout);
    return 0;
  } catch (const veritrack::lift::LiftError& error) {
    const auto place = executor.graph().place();
    if (place.file >= 0) {
      std::fprintf(stderr, "%s:%d:%d: ", executor.files()[static_cast<std::size_t>(place.file)].c_str(),
                   place.line, place.column);
    }
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

}  // namespace

int main(int count, char** names) {
  if (count < 2) {
    std::fputs("veritrack-lift FILE.bc...\n", stderr);
    return 2;
  }
  try {
    llvm::LLVMContext context;
    const std::unique_ptr<llvm::Module> module = linked(count, names, context);
    return module ? lift(*module) : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
