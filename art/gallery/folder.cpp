#include "art/gallery/folder.h"

#include "engine/base/output_file.h"

#include "engine/base/hash.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace sikku {

namespace {

/// True if the error means that the file is missing or not accessible to this user.
bool is_absent(int error) {
    return error == ENOENT || error == ENOTDIR || error == ELOOP || error == EACCES || error == EPERM;
}

std::optional<struct stat> status_at(int folder, const std::string& name) {
    struct stat status {};
    if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) return status;
    if (!is_absent(errno)) cannot_write(name, errno);
    return std::nullopt;
}

/// Passes the contents of a regular file to `take`, block by block; false if it cannot be read.
template <typename Take>
bool read_blocks(const Descriptor& descriptor, std::size_t most, const Take& take) {
    if (!descriptor) return false;
    std::vector<char> block(std::size_t{1} << 16);
    while (most > 0) {
        const ssize_t got = ::read(descriptor.get(), block.data(), std::min(block.size(), most));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return got == 0;
        take(std::string_view(block.data(), static_cast<std::size_t>(got)));
        most -= static_cast<std::size_t>(got);
    }
    return true;
}

}  // namespace

GalleryPlace::GalleryPlace(Descriptor folder, std::string name, std::filesystem::path shown)
    : folder_(std::move(folder)), name_(std::move(name)), shown_(std::move(shown)) {
    const std::filesystem::path held = fmt::format("/proc/{}/fd/{}", ::getpid(), folder_.get());
    path_ = ::access((held / ".").c_str(), F_OK) == 0 ? held / name_ : shown_;
}

std::optional<struct stat> GalleryPlace::status() const {
    return status_at(folder_.get(), name_);
}

void GalleryPlace::remove() const {
    ::unlinkat(folder_.get(), name_.c_str(), 0);
}

std::string GalleryPlace::readable(std::string text, const std::string& shown) const {
    const std::string& hidden = path_.native();
    for (std::size_t at = 0; (at = text.find(hidden, at)) != std::string::npos; at += shown.size()) {
        text.replace(at, hidden.size(), shown);
    }
    return text;
}

GalleryFolder::GalleryFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error && !std::filesystem::is_directory(path_)) cannot_write(path_.string(), error.value());
    descriptor_ = Descriptor(::open(path_.empty() ? "." : path_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!descriptor_) cannot_write(path_.string(), errno);
}

void GalleryFolder::refuse(int folder, const std::string& name, const std::string& file, int error) const {
    const auto status = status_at(folder, name);
    if (status && S_ISLNK(status->st_mode)) {
        throw std::runtime_error(
            fmt::format("'{}' is a symbolic link; a gallery does not write through links", shown(file)));
    }
    cannot_write(shown(file), error);
}

/// Opens the folder that contains `file`. Without `creates`, no descriptor if it is missing.
Descriptor GalleryFolder::parent(const std::string& file, bool creates) const {
    const std::filesystem::path path = file;
    std::filesystem::path so_far;
    Descriptor folder(::openat(descriptor_.get(), ".", O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder) cannot_write(shown(file), errno);
    for (const std::filesystem::path& part : path.parent_path()) {
        if (!folder) return folder;
        so_far /= part;
        if (part.empty() || part == ".." || part.is_absolute()) {
            if (!creates) return {};
            throw std::runtime_error(fmt::format("'{}' is outside the gallery folder", shown(file)));
        }
        if (creates && ::mkdirat(folder.get(), part.c_str(), 0777) != 0 && errno != EEXIST) {
            cannot_write(shown(so_far.string()), errno);
        }
        Descriptor next(::openat(folder.get(), part.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        if (!next && (creates || !is_absent(errno))) refuse(folder.get(), part.string(), so_far.string(), errno);
        folder = std::move(next);
    }
    return folder;
}

std::optional<struct stat> GalleryFolder::status(const std::string& file) const {
    const Descriptor folder = parent(file, false);
    if (!folder) return std::nullopt;
    return status_at(folder.get(), std::filesystem::path(file).filename().string());
}

Descriptor GalleryFolder::open(const std::string& file) const {
    const Descriptor folder = parent(file, false);
    const std::string name = std::filesystem::path(file).filename().string();
    // Devices are not even opened.
    const auto before = folder ? status_at(folder.get(), name) : std::nullopt;
    if (!before || !S_ISREG(before->st_mode)) return {};
    Descriptor opened(::openat(folder.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!opened && !is_absent(errno)) cannot_write(shown(file), errno);
    struct stat status {};
    if (!opened || ::fstat(opened.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    return opened;
}

Descriptor GalleryFolder::create(const std::string& file, int flags) const {
    const Descriptor folder = parent(file, true);
    const std::string name = std::filesystem::path(file).filename().string();
    const auto check = [&](const struct stat& status) {
        if (S_ISREG(status.st_mode) || S_ISLNK(status.st_mode)) return;
        throw std::runtime_error(fmt::format("'{}' is not a regular file", shown(file)));
    };
    if (const auto before = status_at(folder.get(), name)) check(*before);
    constexpr int always = O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
    Descriptor opened(::openat(folder.get(), name.c_str(), flags | always, 0666));
    if (!opened) refuse(folder.get(), name, file, errno);
    struct stat status {};
    if (::fstat(opened.get(), &status) != 0) cannot_write(shown(file), errno);
    check(status);
    return opened;
}

std::string GalleryFolder::read(const std::string& file, std::size_t most) const {
    std::string text;
    read_blocks(open(file), most, [&](std::string_view block) { text += block; });
    return text;
}

std::string GalleryFolder::content_hash(const std::string& file) const {
    TextHash hash;
    const bool is_whole =
        read_blocks(open(file), std::string::npos, [&](std::string_view block) { hash.add(block); });
    return is_whole ? hash.digits() : "";
}

void GalleryFolder::remove(const std::string& file) const {
    const Descriptor folder = parent(file, false);
    if (folder) ::unlinkat(folder.get(), std::filesystem::path(file).filename().c_str(), 0);
}

std::vector<std::string> GalleryFolder::names(const std::string& below) const {
    std::vector<std::string> list;
    const Descriptor folder = parent(below.empty() ? "x" : below + "/x", false);
    if (!folder) return list;
    const int opened = ::openat(folder.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0 && !is_absent(errno)) cannot_write(shown(below), errno);
    if (opened < 0) return list;
    const std::unique_ptr<DIR, int (*)(DIR*)> stream(::fdopendir(opened), ::closedir);
    if (!stream) {
        ::close(opened);
        return list;
    }
    while (const dirent* entry = ::readdir(stream.get())) list.emplace_back(entry->d_name);
    std::sort(list.begin(), list.end());
    return list;
}

GalleryPlace GalleryFolder::place(const std::string& file) const {
    return {parent(file, true), std::filesystem::path(file).filename().string(), path_ / file};
}

void GalleryFolder::write(const std::string& file, const std::string& text) const {
    const GalleryPlace there = place(file);
    try {
        OutputFile output(there.path());
        output.write(text);
        output.commit();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(there.readable(error.what()));
    }
}

}  // namespace sikku
