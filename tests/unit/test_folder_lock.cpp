// One writer per folder.
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include "lichtmc/error.hpp"
#include "lichtmc/folder_lock.hpp"
#include "support/catch.hpp"
#include "support/small_result.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;

TEST_CASE("folder lock: the second writer is refused, also in the same process, until the first ends") {
  const Folder folder;
  const fs::path file = folder.path() / ".lichtmc.lock";
  {
    const FolderLock lock(folder.path());
    CHECK(lock.holds());
    CHECK(lock.supported());
    CHECK(fs::exists(file));
    CHECK_THROWS_AS(FolderLock(folder.path()), InputError);
    CHECK_THROWS_WITH(FolderLock(folder.path()), ContainsSubstring(folder.path().string()) &&
                                                     ContainsSubstring("process " + std::to_string(::getpid())) &&
                                                     ContainsSubstring("--output"));
    CHECK(lock.holds());  // a failed attempt does not end it
    CHECK_THROWS_AS(FolderLock(folder.path()), InputError);
  }
  CHECK_FALSE(fs::exists(file));
  CHECK(FolderLock(folder.path()).holds());
}

TEST_CASE("folder lock: a file that a killed process has left does not block, and its number is not reported") {
  const Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    ::_exit(0);  // as after a kill: no destructor runs
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(fs::exists(folder.path() / ".lichtmc.lock"));
  const FolderLock lock(folder.path());
  CHECK(lock.holds());
  CHECK_THROWS_WITH(FolderLock(folder.path()), ContainsSubstring("process " + std::to_string(::getpid())));
}

TEST_CASE("folder lock: it can be moved, and notices that its file is gone") {
  const Folder folder;
  std::optional<FolderLock> lock = FolderLock(folder.path());
  CHECK(lock->holds());
  fs::remove(folder.path() / ".lichtmc.lock");
  CHECK_FALSE(lock->holds());
  // A new writer may come; the end of the old lock does not remove the new file.
  const FolderLock next(folder.path());
  lock.reset();
  CHECK(next.holds());
  CHECK_THROWS_AS(FolderLock(folder.path()), InputError);
}

TEST_CASE("folder lock: a folder that is missing is refused, a link in place of the file is not followed") {
  const Folder folder;
  CHECK_THROWS_AS(FolderLock(folder.path() / "none"), InputError);
  fs::create_symlink(folder.path() / "elsewhere", folder.path() / ".lichtmc.lock");
  CHECK_THROWS_WITH(FolderLock(folder.path()), ContainsSubstring("Cannot write into the output folder"));
  CHECK_FALSE(fs::exists(folder.path() / "elsewhere"));
}
