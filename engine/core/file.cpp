#include "core/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace fs = std::filesystem;

namespace {

std::string reason(int error) {
    return std::generic_category().message(error);
}

// Owns a file descriptor. close() reports what a destructor cannot: some file systems fail only there.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    bool valid() const { return fd_ >= 0; }
    int get() const { return fd_; }
    int close() {
        const int result = ::close(fd_);
        fd_ = -1;
        return result;
    }

  private:
    int fd_;
};

/// 0, or the errno of the first call that failed.
int writeAll(Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        if (written == 0) return ENOSPC;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return file.close() == 0 ? 0 : errno;
}

struct Target {
    fs::path path;
    int descriptor = -1;  // that /dev/stdout or /dev/fd/3 stands for: who opened it goes on writing there
};

// What a chain of links names, which need not exist: a write replaces it and not the link.
Target followLinks(fs::path path) {
    constexpr int kLongestChain = 40;  // as Linux
    std::error_code error;
    const fs::path descriptors = fs::canonical("/proc/self/fd", error);
    for (int i = 0; i < kLongestChain && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
        if (!descriptors.empty() && fs::canonical(path.parent_path(), error) == descriptors)
            return {path, parseInteger(path.filename().string()).value_or(-1)};
        path = path.parent_path() / fs::read_symlink(path, error);
    }
    return {path};
}

// The temporary file being written, for a signal handler.
std::atomic<const char*> unfinished{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free);

class Unfinished {
  public:
    explicit Unfinished(const fs::path& path) { unfinished = path.c_str(); }
    ~Unfinished() { unfinished = nullptr; }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;
};

[[noreturn]] void failWrite(const fs::path& path, int error) {
    throw RunError(path.string() + ": cannot be written: " + reason(error));
}

}  // namespace

void requireWritableName(const fs::path& path) {
    if (!path.has_filename()) throw InputError(path.string() + ": a file name is missing");
    std::error_code ignored;  // what cannot be looked at fails on opening, with its reason
    if (fs::is_directory(path, ignored)) throw InputError(path.string() + ": is a folder, a file is expected");
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (status.type() == fs::file_type::not_found)
        throw InputError(path.string() + ": folder " + folder.string() + " does not exist");
    if (!error && !fs::is_directory(status)) throw InputError(path.string() + ": " + folder.string() + " is no folder");
}

void makeFolder(const fs::path& path, std::string_view option) {
    std::error_code error;
    fs::create_directories(path, error);
    std::error_code unseen;
    const std::string where = std::string(option) + ": " + path.string();
    if (fs::is_directory(path, unseen)) {
        // Now rather than after a long run
        if (::access(path.c_str(), W_OK | X_OK) != 0) throw RunError(where + " cannot be written to: " + reason(errno));
        return;
    }
    if (fs::exists(path, unseen) || error == std::errc::not_a_directory)
        throw InputError(where + " is no folder, and none can be made there: a file is in the way");
    throw RunError(where + " cannot be made a folder: " + error.message());
}

void removeUnfinishedFile() {
    if (const char* path = unfinished) ::unlink(path);
}

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
    requireWritableName(path);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        if (!device.valid()) failWrite(path, errno);
        if (const int failed = writeAll(device, bytes)) failWrite(path, failed);
        return;
    }
    const auto [target, descriptor] = followLinks(path);
    if (descriptor >= 0) {
        std::fflush(nullptr);  // what was printed there comes before
        Descriptor file(::dup(descriptor));
        if (!file.valid()) failWrite(path, errno);
        if (const int failed = writeAll(file, bytes)) failWrite(path, failed);
        return;
    }

    static std::atomic<unsigned> count{0};
    const fs::path temporary =
        target.parent_path() / (".dioptre-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp");
    const Unfinished remembered(temporary);
    Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file.valid()) failWrite(path, errno);
    int failed = writeAll(file, bytes);
    if (failed == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) failed = errno;
    if (failed != 0) {
        ::unlink(temporary.c_str());
        failWrite(path, failed);
    }
}

std::string readFile(const fs::path& path, std::size_t limitBytes) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.valid()) throw InputError(path.string() + ": cannot be read: " + reason(errno));
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) throw InputError(path.string() + ": cannot be read: " + reason(errno));
    const auto tooLong = [&] {
        return InputError(path.string() + ": longer than the limit of " + std::to_string(limitBytes) + " bytes");
    };
    if (S_ISREG(info.st_mode) && static_cast<std::size_t>(info.st_size) > limitBytes) throw tooLong();

    // Sized by what arrives: a pipe has no size, and a file may grow.
    std::string bytes(S_ISREG(info.st_mode) ? static_cast<std::size_t>(info.st_size) + 1 : 65536, '\0');
    std::size_t filled = 0;
    for (;;) {
        const ssize_t got = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(path.string() + ": cannot be read: " + reason(errno));
        filled += static_cast<std::size_t>(got);
        if (filled > limitBytes) throw tooLong();
        if (got == 0) break;
        if (filled == bytes.size()) bytes.resize(2 * bytes.size());
    }
    bytes.resize(filled);
    return bytes;
}

}  // namespace dioptre
