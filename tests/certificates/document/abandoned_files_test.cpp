#include "certificates/document/abandoned_files.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "certificates/document/output_files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

namespace fs = std::filesystem;
using veritrack::certificates::OutputFiles;
using veritrack::certificates::remove_abandoned_files;
using veritrack::test::ScratchFolder;

std::set<std::string> names_in(const ScratchFolder& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

using Names = std::set<std::string>;

/// A process that has staged the file and is killed; until then `while_alive` runs.
template <typename Work>
void with_a_process_at_work_on(const fs::path& target, Work while_alive) {
  int pipe_ends[2];
  REQUIRE(::pipe(pipe_ends) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    OutputFiles files;
    files.stage(target, "unfinished");
    (void)::write(pipe_ends[1], "x", 1);
    for (;;) {
      ::pause();
    }
  }
  char ready = 0;
  REQUIRE(::read(pipe_ends[0], &ready, 1) == 1);
  while_alive();
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
}

}  // namespace

TEST_CASE("what a killed process leaves is removed by the next, and what a living one has is not") {
  const ScratchFolder scratch;
  with_a_process_at_work_on(scratch / "a", [&] {
    CHECK(names_in(scratch).size() == 1);
    OutputFiles files;
    files.stage(scratch / "a", "finished");
    CHECK(names_in(scratch).size() == 2);
    files.commit();
    CHECK(names_in(scratch).size() == 2);
  });
  CHECK(names_in(scratch).size() == 2);
  OutputFiles files;
  files.stage(scratch / "a", "again");
  files.commit();
  CHECK(names_in(scratch) == Names{"a"});
}

TEST_CASE("only names that outputs have are removed") {
  const ScratchFolder scratch;
  const Names others{"a",          ".a",        ".a.toml",          ".a.12345",
                     ".a.1234567", ".a.12_456", ".a.abcdef.before", "b.abcdef",
                     ".b.abcdef"};
  Names all = others;
  all.insert({".a.abcdef", ".a.ABC123", ".a.abcdef.previous"});
  for (const std::string& name : all) {
    std::ofstream(scratch / name) << "x";
  }
  fs::create_directory(scratch / ".a.folder");
  remove_abandoned_files(scratch / "a");
  Names expected = others;
  expected.insert(".a.folder");
  CHECK(names_in(scratch) == expected);
}

TEST_CASE("a folder that is not there has nothing to remove") {
  const ScratchFolder scratch;
  CHECK_NOTHROW(remove_abandoned_files(scratch / "nowhere" / "a"));
}
