// art/gallery/folder.h: the folder of a gallery: opens, creates, reads and removes its files.
#pragma once

#include "engine/base/child_process.h"

#include <sys/stat.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Output location of a gallery file: its folder, held open, and its name in that folder.
class GalleryPlace {
public:
    GalleryPlace(Descriptor folder, std::string name, std::filesystem::path shown);

    /// Path for code that opens files by name, `/proc/PID/fd/N/NAME`: it refers to the folder that is held open, even
    /// if another folder has replaced that by now, and other programs can use it. OutputFile does not follow a link
    /// of that name. Without /proc it is the plain path, which must not be exchanged during the run.
    const std::filesystem::path& path() const { return path_; }
    /// The state of the file itself, even if it is a link; nullopt if it does not exist.
    std::optional<struct stat> status() const;
    void remove() const;
    /// Replaces that path with the name the user gave.
    std::string readable(std::string text) const { return readable(std::move(text), shown_.string()); }
    std::string readable(std::string text, const std::string& shown) const;

private:
    Descriptor folder_;
    std::string name_;
    std::filesystem::path shown_;
    std::filesystem::path path_;
};

/// A folder, held open. Files are named by their path below it and reached one component at a time without following
/// symbolic links or `..`, so an untrusted folder cannot lead outside itself. The path of the folder itself may
/// contain links, as its user chose it. May be used from several threads.
class GalleryFolder {
public:
    /// Creates the folder and its parents if missing.
    /// @throws std::runtime_error if it cannot be made or opened
    explicit GalleryFolder(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    /// Path of `file` as the user sees it, for messages.
    std::string shown(const std::string& file) const { return (path_ / file).string(); }

    /// The state of the file itself, even if it is a link; nullopt if it does not exist or lies behind a link.
    /// @throws std::runtime_error, as all below, if the state cannot be determined, as with too many open files
    std::optional<struct stat> status(const std::string& file) const;
    /// Opens a regular file for reading; no descriptor if it is not a regular file or may not be read.
    Descriptor open(const std::string& file) const;
    /// Opens a regular file, creating it if missing.
    /// @param flags  of open(2): O_RDWR, O_APPEND
    /// @throws std::runtime_error if that fails, or if it or a folder on the way is a link or has the wrong type
    Descriptor create(const std::string& file, int flags) const;
    /// Contents of a regular file, or its first `most` bytes; empty if it is missing.
    std::string read(const std::string& file, std::size_t most = std::string::npos) const;
    /// Hash of a regular file's bytes; empty if it cannot be read.
    std::string content_hash(const std::string& file) const;
    /// Replaces a file, which appears whole or not at all. @throws std::runtime_error, with the path as the user sees
    /// it
    void write(const std::string& file, const std::string& text) const;
    /// Removes a file or a link; a missing file is not an error.
    void remove(const std::string& file) const;
    /// Names of all entries of the folder, or of a folder below it.
    std::vector<std::string> names(const std::string& below = "") const;
    /// Creates the folders on the way to `file`.
    /// @throws std::runtime_error if that fails, or if one of them is a link or not a folder
    GalleryPlace place(const std::string& file) const;

private:
    Descriptor parent(const std::string& file, bool creates) const;
    [[noreturn]] void refuse(int folder, const std::string& name, const std::string& file, int error) const;

    std::filesystem::path path_;
    Descriptor descriptor_;
};

}  // namespace sikku
