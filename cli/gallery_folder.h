// cli/gallery_folder.h: the folder of a gallery: all that is opened, made, read and removed in it.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// A file descriptor that is closed with its owner; -1: none.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept;
    ~Descriptor() { close(); }
    int get() const { return descriptor_; }
    explicit operator bool() const { return descriptor_ >= 0; }
    void close();

private:
    int descriptor_ = -1;
};

/// Where a file of a gallery is to be written: its folder, held open, and its name there.
class GalleryPlace {
public:
    GalleryPlace(Descriptor folder, std::string name, std::filesystem::path shown);

    /// A path for whatever opens files by their names, `/proc/PID/fd/N/NAME`: it leads into the folder that is held
    /// open, whatever stands in the folder's place by now, and other programs can follow it. OutputFile follows no
    /// link of that name. Where there is no /proc it is the plain path, which nobody must exchange during the run.
    const std::filesystem::path& path() const { return path_; }
    /// The state of the file itself, be it a link; nullopt if it is not there.
    std::optional<struct stat> status() const;
    void remove() const;
    /// Replaces that path by what the user calls it.
    std::string readable(std::string text) const { return readable(std::move(text), shown_.string()); }
    std::string readable(std::string text, const std::string& shown) const;

private:
    Descriptor folder_;
    std::string name_;
    std::filesystem::path shown_;
    std::filesystem::path path_;
};

/// A folder, held open. Files are named by their path below it, and reached from it one component after the other:
/// no symbolic link is followed, and no `..`, so that a folder that came from a stranger cannot lead out of itself.
/// The path of the folder itself may lead through links; that is its user's own word. May be used from several
/// threads.
class GalleryFolder {
public:
    /// Makes the folder, and those above it, if it is not there.
    /// @throws std::runtime_error if it cannot be made or opened
    explicit GalleryFolder(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    /// The path of `file` as the user sees it, for messages.
    std::string shown(const std::string& file) const { return (path_ / file).string(); }

    /// The state of the file itself, be it a link; nullopt if it is not there or behind a link.
    /// @throws std::runtime_error, as all below, if that cannot be found out, as with too many open files
    std::optional<struct stat> status(const std::string& file) const;
    /// Opens a regular file for reading; no descriptor if that is not what it is, or if it may not be read.
    Descriptor open(const std::string& file) const;
    /// Opens a regular file, and makes it if it is not there.
    /// @param flags  of open(2): O_RDWR, O_APPEND
    /// @throws std::runtime_error if that fails, or if it or a folder on the way is a link or not what it should be
    Descriptor create(const std::string& file, int flags) const;
    /// What a regular file holds, or its first `most` bytes; empty if there is none.
    std::string read(const std::string& file, std::size_t most = std::string::npos) const;
    /// Hash of a regular file's bytes; empty if it cannot be read.
    std::string content_hash(const std::string& file) const;
    /// Removes a file or a link; that there is none is no error.
    void remove(const std::string& file) const;
    /// Names of all that lies in the folder, or in one below it.
    std::vector<std::string> names(const std::string& below = "") const;
    /// Makes the folders on the way to `file`.
    /// @throws std::runtime_error if that fails, or if one of them is a link or not a folder
    GalleryPlace place(const std::string& file) const;

private:
    Descriptor parent(const std::string& file, bool creates) const;
    [[noreturn]] void refuse(int folder, const std::string& name, const std::string& file, int error) const;

    std::filesystem::path path_;
    Descriptor descriptor_;
};

}  // namespace sikku
