#include "certificates/document/output_files.hpp"

#include <doctest/doctest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace {

namespace fs = std::filesystem;
using veritrack::certificates::OutputError;
using veritrack::certificates::OutputFiles;
using veritrack::test::ScratchFolder;
using veritrack::test::UnprivilegedUser;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const fs::path& path, const std::string& content) {
  std::ofstream(path) << content;
}

/// Everything below the folder, by relative path: nothing hidden may be left behind.
std::set<std::string> listing(const ScratchFolder& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path())) {
    names.insert(fs::relative(entry.path(), folder.path()).string());
  }
  return names;
}

using Names = std::set<std::string>;

/// The reason why staging fails.
std::string reason(OutputFiles& files, const fs::path& target, const std::string& content = "x") {
  try {
    files.stage(target, content);
  } catch (const OutputError& error) {
    CHECK(std::string(error.what()) == error.path().string() + ": cannot be written: " + error.reason());
    return error.reason();
  }
  return "staged";
}

/// While it stands no file may grow beyond `bytes`: a full disk for everybody, root or not.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &previous_) == 0);
    const rlimit limit{bytes, previous_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &previous_);
    (void)std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  FileSizeLimit(FileSizeLimit&&) = delete;
  FileSizeLimit& operator=(FileSizeLimit&&) = delete;

 private:
  void (*handler_)(int);
  rlimit previous_{};
};

}  // namespace

TEST_CASE("nothing has its name before commit, everything after") {
  const ScratchFolder scratch;
  OutputFiles files;
  const std::string binary("a\0b\r\n", 5);
  files.stage(scratch / "new" / "figures" / "a.svg", binary);
  files.stage(scratch / "new" / "b.md", "");
  CHECK_FALSE(fs::exists(scratch / "new" / "b.md"));
  CHECK_FALSE(fs::exists(scratch / "new" / "figures" / "a.svg"));
  files.commit();
  CHECK(listing(scratch) == Names{"new", "new/b.md", "new/figures", "new/figures/a.svg"});
  CHECK(contents(scratch / "new" / "figures" / "a.svg") == binary);
  CHECK(contents(scratch / "new" / "b.md").empty());
}

TEST_CASE("without commit nothing is left and nothing is changed") {
  const ScratchFolder scratch;
  write(scratch / "old.md", "old");
  {
    OutputFiles files;
    files.stage(scratch / "old.md", "new");
    files.stage(scratch / "deep" / "er" / "new.md", "new");
  }
  CHECK(listing(scratch) == Names{"old.md"});
  CHECK(contents(scratch / "old.md") == "old");
}

TEST_CASE("commit replaces what was there") {
  const ScratchFolder scratch;
  write(scratch / "a", "old");
  OutputFiles files;
  files.stage(scratch / "a", "new");
  files.commit();
  CHECK(contents(scratch / "a") == "new");
  files.stage(scratch / "a", "newer");
  files.commit();
  CHECK(contents(scratch / "a") == "newer");
  CHECK(listing(scratch) == Names{"a"});
}

TEST_CASE("a commit that fails half-way is undone") {
  const ScratchFolder scratch;
  write(scratch / "a", "old");
  OutputFiles files;
  files.stage(scratch / "a", "new");
  files.stage(scratch / "folder" / "b", "new");
  files.stage(scratch / "c", "new");
  fs::create_directory(scratch / "c");  // a folder in the way, after staging
  CHECK_THROWS_AS(files.commit(), OutputError);
  CHECK(listing(scratch) == Names{"a", "c"});
  CHECK(contents(scratch / "a") == "old");
}

TEST_CASE("files have the permissions of ordinary files") {
  const ScratchFolder scratch;
  const mode_t previous = ::umask(022);
  OutputFiles files;
  files.stage(scratch / "a", "x");
  files.commit();
  ::umask(previous);
  struct stat status {};
  REQUIRE(::stat((scratch / "a").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777U) == 0644U);
}

TEST_CASE("targets that cannot be") {
  const ScratchFolder scratch;
  write(scratch / "file", "x");
  OutputFiles files;
  CHECK(reason(files, scratch / "file" / "a") == "Not a directory");
  CHECK(reason(files, scratch / "file" / "b" / "a") == "Not a directory");
  CHECK(reason(files, scratch.path()) == "Is a directory");
  CHECK(reason(files, scratch / "") == "the name of a file is missing");
  CHECK(reason(files, scratch / std::string(300, 'x')) == "File name too long");
  CHECK(reason(files, scratch / "a") == "staged");
  CHECK(reason(files, scratch / "a") == "two outputs have this name");
  files.commit();
  CHECK(listing(scratch) == Names{"a", "file"});
}

TEST_CASE("a folder that may not be written to") {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "closed");
  const UnprivilegedUser outside(scratch.path());
  OutputFiles files;
  CHECK(reason(files, scratch / "a") == "Permission denied");
  CHECK(reason(files, scratch / "new" / "a") == "Permission denied");
  CHECK(listing(scratch) == Names{"closed"});
}

TEST_CASE("a full disk") {
  const ScratchFolder scratch;
  write(scratch / "old", "old");
  OutputFiles files;
  {
    const FileSizeLimit limit(1000);
    CHECK(reason(files, scratch / "small", std::string(1000, 'x')) == "staged");
    CHECK(reason(files, scratch / "old", std::string(1001, 'x')) == "File too large");
    CHECK(reason(files, scratch / "new" / "large", std::string(5000, 'x')) == "File too large");
  }
  CHECK(contents(scratch / "old") == "old");
  files.commit();
  CHECK(contents(scratch / "small").size() == 1000);
}

TEST_CASE("a disk that is really full") {
  const ScratchFolder scratch;
  if (::mount("tmpfs", scratch.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
    MESSAGE("skipped: this user may not mount a small file system");
    return;
  }
  {
    OutputFiles files;
    CHECK(reason(files, scratch / "a", "fits") == "staged");
    CHECK(reason(files, scratch / "b", std::string(100'000, 'x')) == "No space left on device");
  }
  CHECK(listing(scratch).empty());
  ::umount(scratch.path().c_str());
}
