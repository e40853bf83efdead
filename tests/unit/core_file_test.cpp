// Writes that happen completely or not at all, and bounded reads.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image.hpp"

namespace dioptre {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
  protected:
    void SetUp() override { fs::create_directory(folder); }
    void TearDown() override { fs::remove_all(folder); }

    std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    fs::path folder = fs::temp_directory_path() / ("dioptre-file-test-" + std::to_string(::getpid()));
};

// No file of this process may grow beyond `bytes`: what a full disk looks like.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &limit_);
        const rlimit lower{bytes, limit_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &lower);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &limit_);
        std::signal(SIGXFSZ, before_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    void (*before_)(int);
    rlimit limit_{};
};

template <class Error, class Function>
std::string errorOf(Function f) {
    try {
        f();
    } catch (const Error& e) {
        return e.what();
    }
    return "none";
}

TEST_F(FileTest, WritesAndReplaces) {
    const std::string bytes("a\0\n\xFF", 4);
    writeFileAtomically(folder / "f", bytes);
    EXPECT_EQ(readFile(folder / "f", 100), bytes);
    writeFileAtomically(folder / "f", "");
    EXPECT_EQ(readFile(folder / "f", 100), "");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, AFullDiskKeepsTheOldFileAndLeavesNoTrace) {
    writeFileAtomically(folder / "f.pfm", "old");
    const std::string large(1U << 20, 'x');
    {
        const FileSizeLimit limit(1000);
        EXPECT_EQ(errorOf<RunError>([&] { writeFileAtomically(folder / "f.pfm", large); }),
                  (folder / "f.pfm").string() + ": cannot be written: File too large");
        for (const char* name : {"f.pfm", "g.pfm", "g.exr"})
            EXPECT_NE(errorOf<RunError>([&] { writeImage(folder / name, Image(200, 200)); }), "none") << name;
    }
    EXPECT_EQ(readFile(folder / "f.pfm", 100), "old");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, ASignalHandlerRemovesWhatIsUnfinished) {
    const pid_t child = ::fork();
    if (child == 0) {
        // The signal comes in the middle of the write.
        const rlimit limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        std::signal(SIGXFSZ, [](int) {
            removeUnfinishedFile();
            ::_exit(3);
        });
        writeFileAtomically(folder / "f", std::string(100'000, 'x'));
        ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_EQ(entries(), 0U);
}

TEST_F(FileTest, DevicesAreWrittenAndNotReplaced) {
    EXPECT_EQ(errorOf<RunError>([] { writeFileAtomically("/dev/full", "x"); }),
              "/dev/full: cannot be written: No space left on device");
    writeFileAtomically("/dev/null", "x");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(FileTest, LinksAreFollowed) {
    writeFileAtomically(folder / "real", "old");
    fs::create_symlink(folder / "real", folder / "link");
    writeFileAtomically(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(readFile(folder / "real", 100), "new");
    // A link to nothing makes its target.
    fs::create_symlink(folder / "later", folder / "dangling");
    writeFileAtomically(folder / "dangling", "made");
    EXPECT_EQ(readFile(folder / "later", 100), "made");
}

TEST_F(FileTest, AnOpenFileIsWrittenOnAndNotReplaced) {
    const fs::path path = folder / "open";
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_EQ(::write(descriptor, "1", 1), 1);
    for (const std::string links : {"/dev/fd/", "/proc/self/fd/"})
        writeFileAtomically(links + std::to_string(descriptor), "2");
    fs::create_symlink("/dev/fd/" + std::to_string(descriptor), folder / "link");
    writeFileAtomically(folder / "link", "3");
    ASSERT_EQ(::write(descriptor, "4", 1), 1);
    ::close(descriptor);
    EXPECT_EQ(readFile(path, 100), "12234");
    EXPECT_EQ(entries(), 2U);
}

TEST_F(FileTest, FoldersAreMade) {
    makeFolder(folder / "a/b", "--out");
    makeFolder(folder / "a/b", "--out");
    EXPECT_TRUE(fs::is_directory(folder / "a/b"));
    writeFileAtomically(folder / "file", "x");
    for (const char* name : {"file", "file/below"})
        EXPECT_TRUE(errorOf<InputError>([&] { makeFolder(folder / name, "--out"); }).starts_with("--out: ")) << name;
    EXPECT_NE(errorOf<RunError>([] { makeFolder("/proc/dioptre-test", "--out"); }), "none");
}

TEST_F(FileTest, WrongNamesAreUsageErrors) {
    EXPECT_EQ(errorOf<InputError>([&] { writeFileAtomically(folder / "no" / "f", "x"); }),
              (folder / "no" / "f").string() + ": folder " + (folder / "no").string() + " does not exist");
    EXPECT_EQ(errorOf<InputError>([&] { writeFileAtomically(folder, "x"); }),
              folder.string() + ": is a folder, a file is expected");
    writeFileAtomically(folder / "file", "x");
    EXPECT_NE(errorOf<InputError>([&] { requireWritableName(folder / "file" / "f"); }), "none");
    EXPECT_NE(errorOf<InputError>([&] { requireWritableName(""); }), "none");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, WithoutPermissionTheRunFails) {
    if (::geteuid() == 0) {
        // Permissions do not bind the administrator, but nobody writes here.
        EXPECT_NE(errorOf<RunError>([] { writeFileAtomically("/proc/dioptre-test", "x"); }), "none");
        return;
    }
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(errorOf<RunError>([&] { makeFolder(folder, "--out"); }),
              "--out: " + folder.string() + " cannot be written to: Permission denied");
    EXPECT_EQ(errorOf<RunError>([&] { writeFileAtomically(folder / "f", "x"); }),
              (folder / "f").string() + ": cannot be written: Permission denied");
    fs::permissions(folder, fs::perms::owner_all);
}

TEST_F(FileTest, ReadsAreBounded) {
    writeFileAtomically(folder / "f", "12345");
    EXPECT_EQ(readFile(folder / "f", 5), "12345");
    EXPECT_THROW(readFile(folder / "f", 4), InputError);
    EXPECT_THROW(readFile("/dev/zero", 1000), InputError);
    EXPECT_THROW(readFile(folder, 1000), InputError);
    EXPECT_THROW(readFile(folder / "missing", 1000), InputError);
}

}  // namespace
}  // namespace dioptre
