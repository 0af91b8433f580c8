#include "nlmech/scene/program/files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "nlmech/support/errors.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"
#include "tests/thrown.hpp"

namespace nlmech::scene::files_test {
namespace {

namespace fs = std::filesystem;
using tests::bytes_of;
using tests::files_in;
using tests::put;
using tests::TemporaryFolder;

TEST(FilesWith, AreThoseOfOneKindInOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"b.csv", "a.csv", "README.md", ".a.csv.17"}) put(folder / name, "");
  const auto files = files_with(folder.path(), ".csv");
  EXPECT_EQ(files, (std::vector<std::filesystem::path>{folder / "a.csv", folder / "b.csv"}));
  EXPECT_THROW((void)files_with(folder / "none", ".csv"), InputError);
}

TEST(WriteWhole, MakesFoldersAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_whole(folder / "x/y/z.csv", bytes);
  EXPECT_EQ(files_in(folder.path()), (std::map<std::string, std::string>{{"x/y/z.csv", bytes}}));
}

TEST(WriteWhole, ReplacesWhatWasThere) {
  const TemporaryFolder folder;
  put(folder / "a.csv", "something longer than the new text");
  write_whole(folder / "a.csv", "new");
  write_whole(folder / "empty.csv", "");
  EXPECT_EQ(files_in(folder.path()),
            (std::map<std::string, std::string>{{"a.csv", "new"}, {"empty.csv", ""}}));
  EXPECT_TRUE(fs::exists(folder / "empty.csv"));
}

TEST(WriteWhole, LeavesAnUnchangedFileAlone) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.csv";
  write_whole(file, "1,2\n");
  const auto old = fs::last_write_time(file) - std::chrono::hours(1);
  fs::last_write_time(file, old);
  write_whole(file, "1,2\n");
  EXPECT_EQ(fs::last_write_time(file), old);
  write_whole(file, "1,3\n");  // equal length, other bytes
  EXPECT_NE(fs::last_write_time(file), old);
  EXPECT_EQ(bytes_of(file), "1,3\n");
}

TEST(WriteWhole, WritesBesideTheCurrentFolder) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_whole("plain.csv", "x");
  fs::current_path(before);
  EXPECT_EQ(files_in(folder.path()), (std::map<std::string, std::string>{{"plain.csv", "x"}}));
}

TEST(WriteWhole, SaysThatTheNameIsTooLong) {
  const TemporaryFolder folder;
  const std::string said = tests::thrown<Failure>([&] { write_whole(folder / std::string(300, 'n'), "x"); });
  EXPECT_TRUE(tests::holds(said, "File name too long"));
}

// Root may write everywhere: a test that runs as root drops its rights temporarily.
TEST(WriteWhole, SaysThatTheFolderIsNotWritable) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms{0555});
  fs::permissions(folder.path(), fs::perms{0755});
  constexpr uid_t nobody = 65534;
  const bool root = ::geteuid() == 0;
  if (root) {
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  const std::string said = tests::thrown<Failure>([&] { write_whole(folder / "closed/a.csv", "x"); });
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  fs::permissions(folder / "closed", fs::perms::owner_all);
  EXPECT_EQ(said, (folder / "closed/a.csv").string() + ": cannot be written: Permission denied");
  EXPECT_TRUE(files_in(folder.path()).empty());
}

TEST(WriteWhole, SaysThatTheFileSystemRefuses) {
  // No user, not even root, can create a file in /proc.
  const std::string said = tests::thrown<Failure>([] { write_whole("/proc/nlmech.csv", "x"); });
  EXPECT_TRUE(tests::holds(said, "/proc/nlmech.csv: cannot be written: "));
}

TEST(ReadWhole, GivesAllBytes) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff\n", 7);
  put(folder / "a.csv", bytes);
  put(folder / "empty.csv", "");
  EXPECT_EQ(read_whole(folder / "a.csv"), bytes);
  EXPECT_EQ(read_whole(folder / "empty.csv"), "");
}

TEST(ReadWhole, SaysThatReadingFailed) {
  // The first page of a process is never mapped: opening its memory succeeds, reading fails.
  const std::string said = tests::thrown<InputError>([] { return read_whole("/proc/self/mem"); });
  EXPECT_TRUE(tests::holds(said, "/proc/self/mem: "));
}

TEST(DataFolder, IsTheSourceTreeUnlessChosen) {
  ::unsetenv("NLMECH_DATA");
  EXPECT_EQ(data_folder(), NLMECH_SOURCE_DIR);
  ::setenv("NLMECH_DATA", "/somewhere/else", 1);
  EXPECT_EQ(data_folder(), "/somewhere/else");
  ::unsetenv("NLMECH_DATA");
}

}  // namespace
}  // namespace nlmech::scene::files_test
