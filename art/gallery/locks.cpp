#include "art/gallery/locks.h"

#include "engine/base/hash.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace sikku {
namespace {

const std::string lock_name = ".gallery.lock";
constexpr std::string_view line_start = "sikku gallery ";

// Bytes of the lock file. Files of the gallery use those from `first_file` on.
constexpr std::int64_t presence = 0;  // shared by all runs
constexpr std::int64_t turn = 1;      // for records
constexpr std::int64_t first_file = 2;

std::int64_t byte_of(const std::string& file) {
    TextHash hash;
    hash.add(file);
    return first_file + std::stoll(hash.digits().substr(0, 15), nullptr, 16);
}

/// Identifies this process to readers of the lock file.
std::string own_line() {
    std::array<char, HOST_NAME_MAX + 1> host{};
    ::gethostname(host.data(), host.size() - 1);
    return fmt::format("{}{} {}\n", line_start, host.data(), ::getpid());
}

}  // namespace

GalleryLocks::GalleryLocks(const GalleryFolder& folder) : folder_(folder) {
    do {
        file_ = folder_.create(lock_name, O_RDWR | O_APPEND);
        const std::string held = folder_.read(lock_name, line_start.size());
        if (!line_start.starts_with(held)) {
            throw std::runtime_error(
                fmt::format("'{}' already exists and was not made by a gallery", folder_.shown(lock_name)));
        }
        if (lock(F_RDLCK, presence, true) == Result::unsupported) {
            file_.reset();
            folder_.remove(lock_name);
            return;
        }
        // The last run may just have removed it.
    } while (!is_named());
    const std::string line = own_line();
    // If the disk is full, the lock alone shows this run to others.
    [[maybe_unused]] const ssize_t written = ::write(file_.get(), line.data(), line.size());
}

GalleryLocks::~GalleryLocks() {
    if (!file_) return;
    // Runs end one at a time, so that exactly one of them detects that it is the last.
    lock(F_WRLCK, turn, true);
    if (lock(F_WRLCK, presence, false) == Result::locked) {
        try {
            if (is_named()) folder_.remove(lock_name);
        } catch (const std::exception&) {
            // The next run removes it.
        }
    } else {
        lock(F_UNLCK, presence, false);
    }
}

GalleryLocks::Result GalleryLocks::lock(short type, std::int64_t byte, bool waits) const {
    struct flock range {};
    range.l_type = type;
    range.l_whence = SEEK_SET;
    range.l_start = byte;
    range.l_len = 1;
    while (::fcntl(file_.get(), waits ? F_OFD_SETLKW : F_OFD_SETLK, &range) != 0) {
        if (errno == EINTR) continue;
        // EACCES means that locks are denied; Linux reports a lock of another process as EAGAIN.
        return errno == EAGAIN ? Result::busy : Result::unsupported;
    }
    return Result::locked;
}

/// Locks a byte on a file system that is known to support locks.
GalleryLocks::Result GalleryLocks::require_lock(short type, std::int64_t byte, bool waits) const {
    const Result result = lock(type, byte, waits);
    if (result == Result::unsupported) {
        const int error = errno;
        throw std::runtime_error(fmt::format("cannot lock '{}': {}; start the run again to resume it",
                                             folder_.shown(lock_name), std::generic_category().message(error)));
    }
    return result;
}

/// True if the lock file is still the file of that name.
bool GalleryLocks::is_named() const {
    struct stat opened {};
    const auto named = folder_.status(lock_name);
    return named && ::fstat(file_.get(), &opened) == 0 && opened.st_ino == named->st_ino &&
           opened.st_dev == named->st_dev;
}

bool GalleryLocks::take(const std::string& file) {
    return !file_ || require_lock(F_WRLCK, byte_of(file), false) == Result::locked;
}

void GalleryLocks::release(const std::string& file) {
    if (file_) lock(F_UNLCK, byte_of(file), false);
}

bool GalleryLocks::others_present() const {
    if (!file_) return true;
    struct flock range {};
    range.l_type = F_WRLCK;
    range.l_whence = SEEK_SET;
    range.l_start = presence;
    range.l_len = 1;
    return ::fcntl(file_.get(), F_OFD_GETLK, &range) != 0 || range.l_type != F_UNLCK;
}

std::uint64_t GalleryLocks::arrivals() {
    struct stat status {};
    if (!file_ || ::fstat(file_.get(), &status) != 0) return ++calls_;
    return static_cast<std::uint64_t>(status.st_size);
}

GalleryLocks::Turn::Turn(GalleryLocks& locks, bool exclusive) : locks_(locks) {
    if (locks_.file_) locks_.require_lock(exclusive ? F_WRLCK : F_RDLCK, turn, true);
}

GalleryLocks::Turn::~Turn() {
    if (locks_.file_) locks_.lock(F_UNLCK, turn, false);
}

}  // namespace sikku
