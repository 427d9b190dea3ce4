#include "certificates/document/output_target.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <string>

#include "certificates/document/output_files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

namespace fs = std::filesystem;
using veritrack::certificates::is_file;
using veritrack::certificates::OutputError;
using veritrack::certificates::OutputFiles;
using veritrack::certificates::OutputTarget;
using veritrack::certificates::resolve_output;
using veritrack::certificates::same_target;
using veritrack::test::ScratchFolder;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_text(const fs::path& path, const std::string& content) {
  std::ofstream(path) << content;
}

void write_output(const fs::path& target, const std::string& content) {
  OutputFiles files;
  files.stage(target, content);
  files.commit();
}

}  // namespace

TEST_CASE("a device is written as it is and stays a device") {
  CHECK(resolve_output("/dev/null").as_it_is);
  write_output("/dev/null", "gone");
  CHECK(fs::is_character_file("/dev/null"));
  try {
    write_output("/dev/full", "x");
    FAIL("a full device took it");
  } catch (const OutputError& error) {
    CHECK(error.reason() == "No space left on device");
  }
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("when a device cannot be written the files beside it are as before") {
  const ScratchFolder scratch;
  write_text(scratch / "a", "old");
  OutputFiles files;
  files.stage("/dev/full", "x");
  files.stage(scratch / "a", "new");
  files.stage(scratch / "folder" / "b", "new");
  CHECK_THROWS_AS(files.commit(), OutputError);
  CHECK(text_of(scratch / "a") == "old");
  CHECK_FALSE(fs::exists(scratch / "folder"));
}

TEST_CASE("a FIFO is written to whoever reads it") {
  const ScratchFolder scratch;
  const fs::path fifo = scratch / "fifo";
  REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
  auto reader = std::async(std::launch::async, [&] { return text_of(fifo); });
  write_output(fifo, "through");
  CHECK(reader.get() == "through");
  CHECK(fs::is_fifo(fifo));
}

TEST_CASE("a link stays a link, and what it leads to is replaced or made") {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "real");
  write_text(scratch / "real" / "a", "old");
  fs::create_symlink("real/a", scratch / "to-a");
  fs::create_symlink("to-a", scratch / "to-to-a");
  fs::create_symlink("real/new", scratch / "dangling");
  fs::create_symlink("/dev/null", scratch / "to-null");
  write_output(scratch / "to-to-a", "new");
  CHECK(fs::is_symlink(scratch / "to-to-a"));
  CHECK(fs::is_symlink(scratch / "to-a"));
  CHECK(text_of(scratch / "real" / "a") == "new");
  write_output(scratch / "dangling", "made");
  CHECK(fs::is_symlink(scratch / "dangling"));
  CHECK(text_of(scratch / "real" / "new") == "made");
  write_output(scratch / "to-null", "gone");
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("links in a circle are refused") {
  const ScratchFolder scratch;
  fs::create_symlink("b", scratch / "a");
  fs::create_symlink("a", scratch / "b");
  CHECK_THROWS_AS((void)resolve_output(scratch / "a"), OutputError);
}

TEST_CASE("an output that is an input is refused under every name") {
  const ScratchFolder scratch;
  write_text(scratch / "design", "input");
  fs::create_symlink("design", scratch / "link");
  fs::create_hard_link(scratch / "design", scratch / "twin");
  OutputFiles files;
  files.keep(scratch / "design");
  for (const char* name : {"design", "./design", "link", "twin"}) {
    CAPTURE(name);
    CHECK_THROWS_WITH_AS(files.stage(scratch / name, "x"), doctest::Contains("input"), OutputError);
  }
  files.stage(scratch / "other", "x");
  files.commit();
  CHECK(text_of(scratch / "design") == "input");
}

TEST_CASE("one file under two names is one target") {
  const ScratchFolder scratch;
  fs::create_symlink("a", scratch / "link");
  const auto target = [&](const char* name) { return resolve_output(scratch / name); };
  CHECK(same_target(target("a"), target("link")));
  CHECK(same_target(target("a"), target("./a")));
  CHECK_FALSE(same_target(target("a"), target("b")));
  OutputFiles files;
  files.stage(scratch / "a", "x");
  CHECK_THROWS_AS(files.stage(scratch / "link", "x"), OutputError);
}

TEST_CASE("a file that is not there is no input") {
  const ScratchFolder scratch;
  CHECK_FALSE(is_file(resolve_output(scratch / "a"), scratch / "a"));
}
