#include "certificates/document/program.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <string>
#include <system_error>

namespace veritrack::certificates {

TEST_CASE("a program reads its input and is not changed by a shell") {
  const std::string input(300000, 'x');
  CHECK(run_program("cat", {}, input).output == input);
  CHECK(run_program("printf", {"%s|", "$HOME; ls", ""}, "").output == "$HOME; ls||");
}

TEST_CASE("what a program says last: a status, a message, a signal") {
  const ProgramRun run = run_program("/bin/sh", {"-c", "echo no >&2; exit 7"}, "");
  CHECK(run.status == 7);
  CHECK(run.signal == 0);
  CHECK(run.errors == "no\n");
  CHECK_FALSE(run.has_succeeded());
  const ProgramRun killed = run_program("/bin/sh", {"-c", "kill -9 $$"}, "");
  CHECK(killed.signal == SIGKILL);
  CHECK_FALSE(killed.has_succeeded());
  CHECK(run_program("true", {}, "").has_succeeded());
}

TEST_CASE("a program that works for too long is ended") {
  const ProgramRun run = run_program("/bin/sh", {"-c", "while true; do true; done"}, "", {}, 1);
  CHECK(run.signal == SIGXCPU);
  CHECK_FALSE(run.has_succeeded());
}

TEST_CASE("a program that is not there") {
  for (const char* name : {"no-such-program", "/no/such/program"}) {
    try {
      static_cast<void>(run_program(name, {}, ""));
      FAIL("no exception");
    } catch (const std::system_error& error) {
      CHECK(error.code() == std::errc::no_such_file_or_directory);
    }
  }
}

TEST_CASE("a program sees the files in memory that it is handed, and no others") {
  const MemoryFile file("as it is");
  CHECK(run_program("cat", {file.path(), file.path()}, "", {&file}).output == "as it isas it is");
  CHECK_FALSE(run_program("cat", {file.path()}, "").has_succeeded());
}

}  // namespace veritrack::certificates
